// The surface's normal: central differences of the field.

// The reach of the differences: a share of the distance travelled, at least well above the noise, and a power of two, so
// that the six points are exact neighbours of p and rounding enters only through the field.
float normalReach(float travelled) {
    float h = max(frame.reach.z * travelled, 64.0 * noiseAt(travelled));
    return intBitsToFloat(floatBitsToInt(h) & 0x7F800000);
}

// The field's gradient, by six evaluations in one loop (one copy of map() instead of six, to compile sooner).
vec3 gradientAt(vec3 p, float h) {
    vec3 gradient = vec3(0.0);
    for (int i = 0; i < 6; ++i) {
        int axis = i >> 1;
        vec3 along = vec3(axis == 0, axis == 1, axis == 2) * ((i & 1) == 0 ? 1.0 : -1.0);
        gradient += along * map(p + along * h);
    }
    count(NORMAL, 6);
    return gradient / (2.0 * h);
}

// A unit vector out of the solid on the side the ray came from; against the ray where the field has no slope.
vec3 normalAt(vec3 p, float travelled, float side, vec3 direction) {
    vec3 g = gradientAt(p, normalReach(travelled)) * side;
    float size = length(g);
    return size > 1e-6 ? g / size : -direction;
}
