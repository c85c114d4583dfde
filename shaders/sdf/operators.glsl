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
// value is one child's alone. `lead` is how far the second is ahead of the first; where next to nothing is blended, it must be
// ahead by more than `tie`. By a blend that is the constant 0 this folds to that comparison.
real shareOf(real lead, real blend, real tie) {
    real ahead = pick(-blend, pick(tie - blend, lead, lead - tie), lead - tie);
    real mixed = min(max(0.5f + ahead / (2.0f * max(blend, 1e-30f)), 0.0f), 1.0f);
    return pick(-blend, mixed, pick(-ahead, 1.0f, 0.0f));
}
real shareUnion(real a, real b, real blend, real tie) { return shareOf(a - b, blend, tie); }
real shareIntersect(real a, real b, real blend, real tie) { return shareOf(b - a, blend, tie); }
real shareSubtract(real a, real b, real blend, real tie) { return shareOf(-b - a, blend, tie); }
real shareMorph(real a, real b, real t, real tie) { return t; }

// Where a ray may be inside the whole, and where it is for certain, from its children's spans (primitives.glsl: outer and
// inner ones) where nothing is blended. Of what would be two pieces the outer span is both and what lies between, the inner
// one of them.
vec2 spanOrNone(real begin, real end) {
    return vec2(pick(end - begin, real(1e18f), begin), pick(end - begin, real(-1e18f), end));
}
vec2 firstOf(vec2 a, vec2 b) { return vec2(pick(a.y - a.x, b.x, a.x), pick(a.y - a.x, b.y, a.y)); }
vec2 spanBoth(vec2 a, vec2 b) { return spanOrNone(max(a.x, b.x), min(a.y, b.y)); }
vec2 spanEither(vec2 a, vec2 b) { return vec2(min(a.x, b.x), max(a.y, b.y)); }
// The one that begins first, or both where they meet.
vec2 joinedSpan(vec2 a, vec2 b) {
    vec2 first = vec2(min(a.x, b.x), pick(b.x - a.x, b.y, a.y));
    real meet = min(a.y, b.y) - max(a.x, b.x);
    return vec2(first.x, pick(meet, first.y, max(a.y, b.y)));
}
vec2 spanWithout(vec2 a, vec2 b) {
    real begin = pick(a.x - b.x, a.x, max(a.x, b.y));
    real end = pick(b.y - a.y, a.y, min(a.y, b.x));
    return spanOrNone(begin, end);
}
vec2 spanUnion(vec2 a, vec2 a_inner, vec2 b, vec2 b_inner) { return spanEither(a, b); }
vec2 innerUnion(vec2 a, vec2 a_inner, vec2 b, vec2 b_inner) { return joinedSpan(a_inner, b_inner); }
vec2 spanIntersect(vec2 a, vec2 a_inner, vec2 b, vec2 b_inner) { return spanBoth(a, b); }
vec2 innerIntersect(vec2 a, vec2 a_inner, vec2 b, vec2 b_inner) { return spanBoth(a_inner, b_inner); }
vec2 spanSubtract(vec2 a, vec2 a_inner, vec2 b, vec2 b_inner) { return spanWithout(a, b_inner); }
vec2 innerSubtract(vec2 a, vec2 a_inner, vec2 b, vec2 b_inner) {
    return firstOf(spanOrNone(a_inner.x, min(a_inner.y, b.x)), spanOrNone(max(a_inner.x, b.y), a_inner.y));
}
vec2 spanMorph(vec2 a, vec2 a_inner, vec2 b, vec2 b_inner) { return spanEither(a, b); }
vec2 innerMorph(vec2 a, vec2 a_inner, vec2 b, vec2 b_inner) { return spanBoth(a_inner, b_inner); }

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
