// Diffuse light (Lambert) from each light of this pass, and what the scene's other effects make of it.

vec3 lit(Surface s, vec3 direction) {
    vec3 sum = vec3(0.0);
    for (int i = frame.pass.x; i < LIGHTS; ++i) {
        if (i >= frame.pass.y) break;
        vec3 way = lights[i].position.xyz - s.position;
        float far = length(way);
        vec3 to_light = far > 0.0 ? way / far : s.normal;
        float facing = dot(s.normal, to_light);
        if (facing > 0.0) {
            float clear = 1.0;
#effects shadow
            vec3 shine = s.diffuse * facing * s.color;
#effects highlight
            sum += clear * lights[i].color.rgb * shine;
        }
    }
    return sum;
}
