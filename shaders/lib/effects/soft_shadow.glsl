// The shadow of a light that has a size: the share of its disc that is seen, by marched rays spread over it.

float softShadow(Surface s, int light) {
    float size = lightSize(light);
    vec3 from = leave(s), middle = lights[light].position.xyz;
    Frame3 disc = frameAround(middle - from);
    int rays = size > 0.0 ? renderShadowRays() : 0;  // a point has its hard shadow
    float turn = turnOfPixel();
    float clear = 0.0;
    for (int i = 0; i < MOST_RAYS; ++i) {
        if (i >= rays) break;
        vec2 at = 0.5 * size * spiral(i, rays, turn);
        vec3 way = middle + at.x * disc.x + at.y * disc.y - from;
        float far = max(length(way), 1e-30);
        March march = marchShadow(Ray(from, way / far, s.travelled), far, shadowSteps());
        countRay(SOFT, march.evaluations, march.state);
        clear += isBlocked(march) ? 0.0 : 1.0;
    }
    return rays > 0 ? clear / float(rays) : 1.0;
}
