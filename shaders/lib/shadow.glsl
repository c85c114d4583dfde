// Whether anything stands between a surface and a light: a marched hard shadow.

#ifdef EFFECT_SHADOW
bool isLit(Surface s, vec3 light) {
    vec3 from = s.position + s.normal * biasAt(s.travelled);
    vec3 way = light - from;
    float far = length(way);
    if (far <= 0.0) return true;
    March march = marchShadow(Ray(from, way / far, s.travelled), far, shadowSteps());
    count(SHADOW, march.evaluations);
    outcome.rays.x += 1;
    outcome.rays.z += march.state == UNDECIDED ? 1 : 0;
    return march.state != HIT && march.side > 0.0;  // a start inside a solid is in its shadow
}
#else
bool isLit(Surface s, vec3 light) { return true; }
#endif
