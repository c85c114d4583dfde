// The surface's normal: differences of the field.

// The reach of the differences: a share of the distance travelled, no more than half a pixel (a narrow view brings near
// what is far), at least well above the noise, and a power of two, so that the points are exact neighbours of p and
// rounding enters only through the field.
float normalReach(float travelled) {
    float pixel = frame.right.w != 0.0 ? frame.forward.w : frame.forward.w * travelled;
    float h = max(min(frame.reach.z * travelled, 0.5 * pixel), 64.0 * noiseAt(travelled));
    return intBitsToFloat(floatBitsToInt(h) & 0x7F800000);
}

// Where the field is asked around p, in shares of the reach: six points on the axes, for central differences, or four corners of a
// tetrahedron (Quilez, "Normals for an SDF", 2015), whose errors are those of forward differences.
#ifdef TETRAHEDRON
const int TAPS = 4;
const float TAP_SQUARES = 1.0;  // the sum of the squares of one coordinate
vec3 tap(int i) { return vec3((i & 1) != 0, i > 1, i == 0 || i == 3) - 0.5; }
#else
const int TAPS = 6;
const float TAP_SQUARES = 2.0;
vec3 tap(int i) {
    int axis = i >> 1;
    return vec3(axis == 0, axis == 1, axis == 2) * ((i & 1) == 0 ? 1.0 : -1.0);
}
#endif

// The field's gradient, its evaluations in one loop (one copy of map() instead of several, to compile sooner); 0 if it is not asked
// for. llvmpipe passes over loops alone: behind an `if` it would be evaluated all the same.
vec3 gradientAt(vec3 p, float h, bool asked) {
    vec3 gradient = vec3(0.0);
    for (int i = 0; i < TAPS; ++i) {
        if (!asked) break;
        vec3 along = tap(i);
        gradient += along * map(p + along * h);
    }
    count(NORMAL, asked ? TAPS : 0);
    return gradient / (TAP_SQUARES * h);
}
vec3 gradientAt(vec3 p, float h) { return gradientAt(p, h, true); }

// A unit vector out of the solid on the side the ray came from; against the ray where the field has no slope. Where two
// surfaces lie within the differences' reach it may come out turned away from the ray: then it is turned to lie across it.
vec3 normalAt(vec3 p, float travelled, float side, vec3 direction, bool asked) {
    vec3 g = gradientAt(p, normalReach(travelled), asked) * side;
    g -= max(dot(g, direction), 0.0) * direction;
    float size = length(g);
    return size > 1e-6 ? g / size : -direction;
}
vec3 normalAt(vec3 p, float travelled, float side, vec3 direction) { return normalAt(p, travelled, side, direction, true); }

#ifdef LEAF_SURFACE
// The normal of one leaf, at a point of its frame, by differences of its distance alone: an edge between two leaves is sharp.
// Of what is taken away the inside is seen, so that the sign is the one that faces the ray.
vec3 leafNormal(vec3 at, Node node, float h, vec3 direction) {
    vec3 gradient = vec3(0.0);
    int code = int(node.y_axis.w);
    for (int i = 0; i < TAPS; ++i) {
        vec3 along = tap(i);
        gradient += along * leafDistance(code, at + along * h, at + along * h, node);
    }
    touch(TAPS);
    count(NORMAL, 0);
    vec3 g = turnedBack(gradient, node) / (TAP_SQUARES * h);
    g *= dot(g, direction) > 0.0 ? -1.0 : 1.0;
    float size = length(g);
    return size > 1e-6 ? g / size : -direction;
}
#endif
