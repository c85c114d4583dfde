// Phong's highlight, "Illumination for Computer Generated Pictures" (1975).

float highlight(Surface s, vec3 to_light, vec3 direction) {
    // pow(0, 0) differs between machines: a highlight starts where the cosine is positive.
    float mirrored = dot(reflect(-to_light, s.normal), -direction);
    return mirrored > 0.0 ? s.specular * pow(mirrored, s.shininess) : 0.0;
}
