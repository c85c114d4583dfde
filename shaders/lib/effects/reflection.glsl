// The mirror's part of a surface: another stretch of the ray. Says whether it is worth following.

const float LEAST_WEIGHT = 1.0 / 255.0;  // a step of an 8-bit picture

// The reflected ray starts on its own line, as far along it as brings it a bias away from the surface: a start moved along
// the normal would be another ray, and between mirrors the shifts add up. A flat one is moved along the normal as well.
Ray reflectRay(Ray ray, Surface s) {
    vec3 direction = normalize(reflect(ray.direction, s.normal));
    float bias = biasAt(s.travelled), rise = dot(direction, s.normal);
    float along = bias / max(rise, 0.25);
    return Ray(s.position + direction * along + s.normal * (bias - along * rise), direction, s.travelled + along);
}

bool reflected(Surface s, inout Ray ray, inout float weight) {
    weight *= s.reflectance;
    ray = reflectRay(ray, s);
    return weight >= LEAST_WEIGHT;
}
