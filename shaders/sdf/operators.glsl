// Operators on distances: what a tree's inner nodes do with their children's values, in turn from the left.
//
// Compiled twice, as primitives.glsl says. Each keeps a Lipschitz bound of 1 if its children do. A blend of k metres rounds
// the seam where the two values differ by less than k, and moves the surface by at most k/4; at k = 0 the operator must be
// the plain one, to the bit.
// Source of the blend: Quilez, "Smooth minimum" (2013), the quadratic polynomial.

real opBlend(real a, real b, real k) {
    real h = max(k - abs(a - b), 0.0f);
    return pick(-k, square(h) / (4.0f * max(k, 1e-30f)), 0.0f);
}

real opUnion(real a, real b, real blend) { return min(a, b) - opBlend(a, b, blend); }
real opIntersect(real a, real b, real blend) { return max(a, b) + opBlend(a, b, blend); }
real opSubtract(real a, real b, real blend) { return max(a, -b) + opBlend(a, -b, blend); }
real opMorph(real a, real b, real t) { return a * (1.0f - t) + b * t; }

// How much of the second child's surface shows, from 0 to 1: the value's derivative by it. Where the share is 0 or 1 the
// value is one child's alone. `lead` is how far the second is ahead of the first; without a
// blend to speak of, it must be ahead by more than `tie`.
real shareOf(real lead, real blend, real tie) {
    real ahead = pick(tie - blend, lead, lead - tie);
    return min(max(0.5f + ahead / (2.0f * max(blend, 1e-30f)), 0.0f), 1.0f);
}
real shareUnion(real a, real b, real blend, real tie) { return shareOf(a - b, blend, tie); }
real shareIntersect(real a, real b, real blend, real tie) { return shareOf(b - a, blend, tie); }
real shareSubtract(real a, real b, real blend, real tie) { return shareOf(-b - a, blend, tie); }
real shareMorph(real a, real b, real t, real tie) { return t; }

// Operators on one distance, at a point of their own frame.

// The surface stays and becomes the outside of a wall.
real opShell(real d, real thickness) { return abs(d + 0.5f * thickness) - 0.5f * thickness; }
real opRound(real d, real radius) { return d - radius; }

// Waves of one length along all three axes: sin x sin y sin z rises by at most 1 a radian, so that the sum is divided by
// 1 plus its steepest (`ease` is that quotient). Further off, the whole distance less the amplitude is the better bound.
real opDisplace(real d, vec3 p, real amplitude, real frequency, real ease) {
    real wave = sineOfTurns(frequency * p.x) * sineOfTurns(frequency * p.y) * sineOfTurns(frequency * p.z);
    return max((d + amplitude * wave) * ease, d - amplitude);
}
