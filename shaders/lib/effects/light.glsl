// Diffuse light (Lambert) from each light of this pass, and what the scene's other effects make of it.

vec3 litBy(int i, Surface s, vec3 direction) {
    vec3 sent = vec3(0.0);
    vec3 way = lights[i].position.xyz - s.position;
    float far = length(way);
    vec3 to_light = far > 0.0 ? way / far : s.normal;
    float facing = dot(s.normal, to_light);
    if (facing > 0.0) {
        float clear = 1.0;
#effects shadow
        vec3 shine = s.diffuse * facing * s.color;
#effects highlight
        sent = clear * lights[i].color.rgb * shine;
    }
    return sent;
}

vec3 lit(Surface s, vec3 direction) {
    vec3 sum = vec3(0.0);
#ifdef ONE_LIGHT
    sum += litBy(0, s, direction);  // no loop of one turn, as in fragment.glsl
#else
    for (int i = frame.pass.x; i < LIGHTS; ++i) {
        if (i >= frame.pass.y) break;
        sum += litBy(i, s, direction);
    }
#endif
    return sum;
}
