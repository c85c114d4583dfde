// Operators on distances: what a tree's inner nodes do with their children's values, in turn from the left.
//
// Compiled twice, as primitives.glsl says. A blend of k metres rounds the seam where the two values differ by less
// than k, and moves the surface by at most k/4; at k = 0 the operator must be the plain one, to the bit.
// Source of the blend: Quilez, "Smooth minimum" (2013), the quadratic polynomial; it keeps a Lipschitz bound of 1.

real opBlend(real a, real b, real k) {
    real h = max(k - abs(a - b), 0.0f);
    return pick(-k, square(h) / (4.0f * max(k, 1e-30f)), 0.0f);
}

real opUnion(real a, real b, real blend) { return min(a, b) - opBlend(a, b, blend); }
real opIntersect(real a, real b, real blend) { return max(a, b) + opBlend(a, b, blend); }
real opSubtract(real a, real b, real blend) { return max(a, -b) + opBlend(a, -b, blend); }
