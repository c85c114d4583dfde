// Phong, "Illumination for Computer Generated Pictures" (1975): ambient, diffuse and specular light.

vec3 phong(Surface s, vec3 direction) {
    vec3 color = frame.pass.z != 0 ? s.ambient * s.color : vec3(0.0);
#ifdef EFFECT_LIGHT
    for (int i = frame.pass.x; i < LIGHTS; ++i) {
        if (i >= frame.pass.y) break;
        vec3 way = lights[i].position.xyz - s.position;
        float size = length(way);
        vec3 to_light = size > 0.0 ? way / size : s.normal;
        float facing = dot(s.normal, to_light);
        if (facing > 0.0 && isLit(s, lights[i].position.xyz)) {
            // pow(0, 0) differs between machines: a highlight starts where the cosine is positive.
            float mirrored = dot(reflect(-to_light, s.normal), -direction);
            float highlight = mirrored > 0.0 ? s.specular * pow(mirrored, s.shininess) : 0.0;
            color += lights[i].color.rgb * (s.diffuse * facing * s.color + highlight);
        }
    }
#endif
    return color;
}
