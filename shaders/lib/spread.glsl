// Many rays from one point: how they are spread, and how a ray leaves a surface.

const int MOST_RAYS = 256;  // the keys' limit

// Point i of n, spread evenly over the unit disc (Vogel, "A Better Way to Construct the Sunflower Head", 1979).
vec2 spiral(int i, int n, float turn) {
    float angle = 2.39996323 * float(i) + turn;
    return sqrt((float(i) + 0.5) / float(n)) * vec2(cos(angle), sin(angle));
}

// Each pixel turns its spiral by another angle, so that what is left of the pattern is fine noise; and each of its samples too
// (Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", 2014).
float turnOfPixel() {
    vec2 at = gl_FragCoord.xy + 61.0 * frame.picture.zw;
    return 6.28318531 * fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715))));
}

// Two directions across a third.
struct Frame3 {
    vec3 x, y, z;
};
Frame3 frameAround(vec3 way) {
    float size = length(way);
    vec3 z = size > 0.0 ? way / size : vec3(0.0, 1.0, 0.0);
    vec3 x = normalize(cross(abs(z.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), z));
    return Frame3(x, cross(z, x), z);
}

// Where a ray leaves a surface.
vec3 leave(Surface s) { return s.position + s.normal * biasAt(s.travelled); }
// A start inside a solid is in its shadow.
bool isBlocked(March march) { return march.state == HIT || march.side < 0.0; }
