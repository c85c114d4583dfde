// A marched hard shadow: 1 where nothing stands between a surface and the middle of a light, else 0.

float hardShadow(Surface s, int light) {
#ifdef EFFECT_SOFT_SHADOW
    if (lightSize(light) > 0.0) return 1.0;
#endif
    vec3 from = leave(s);
    vec3 way = lights[light].position.xyz - from;
    float far = length(way);
    if (far <= 0.0) return 1.0;
    March march = marchShadow(Ray(from, way / far, s.travelled), far, shadowSteps());
    countRay(SHADOW, march.evaluations, march.state);
    return isBlocked(march) ? 0.0 : 1.0;
}
