// Ambient occlusion: the share of the sky that nothing nearer than `ao` hides, each direction weighed by its cosine, as a diffuse
// surface sees it (Zhukov, Iones and Kronin, "An Ambient Light Illumination Model", 1998). Rays through a disc spread evenly
// leave the surface with that weight (Malley's method; Pharr, Jakob and Humphreys, "Physically Based Rendering", 2016).

float openness(Surface s) {
    float reach = renderAo();
    vec3 from = leave(s);
    Frame3 sky = frameAround(s.normal);
    int rays = reach > 0.0 && isFirstPass() ? renderAoRays() : 0;  // the ambient light comes with the first lights
    float turn = turnOfPixel();
    float open = 0.0;
    for (int i = 0; i < MOST_RAYS; ++i) {
        if (i >= rays) break;
        vec2 at = spiral(i, rays, turn);
        vec3 way = at.x * sky.x + at.y * sky.y + sqrt(max(1.0 - dot(at, at), 0.0)) * sky.z;
        March march = marchShadow(Ray(from, normalize(way), s.travelled), reach, shadowSteps());
        countRay(OCCLUSION, march.evaluations, march.state);
        open += isBlocked(march) ? 0.0 : 1.0;
    }
    return rays > 0 ? open / float(rays) : 1.0;
}
