// Warps: where in its own frame a child is asked, instead of at p, and what its answer is worth at p.
//
// Compiled twice, as primitives.glsl says. A warp stretches space by at most s within `reach` of its axis, and the child
// lies there; so the child's value is multiplied by `ease` = 1/s. A point beyond the reach is first moved to the nearest one
// within. The cylinder is convex, so the way from p to the child is at least the hypotenuse of what p was moved by and of
// what is left from there, and that hypotenuse is again no steeper than 1.

// sin(2 pi t). The series to the 13th power on a quarter turn errs by less than 1e-9, less than a float can hold.
real sineOfTurns(real t) {
    real f = t - nearestWhole(t);
    real s = real(6.28318530717958647692) * max(min(f, 0.5f - f), -0.5f - f);
    real q = square(s);
    real tail = 1.0f - q * real(1.0f / 72.0) * (1.0f - q * real(1.0f / 110.0) * (1.0f - q * real(1.0f / 156.0)));
    return min(max(s * (1.0f - q * real(1.0f / 6.0) * (1.0f - q * real(1.0f / 20.0) * (1.0f - q * real(1.0f / 42.0) * tail))), -1.0f), 1.0f);
}

vec2 within(vec2 p, real reach) { return p * min(reach / max(length(p), 1e-30f), 1.0f); }
vec2 turned(vec2 p, real t) {
    real c = sineOfTurns(t + 0.25f);
    real s = sineOfTurns(t);
    return vec2(p.x * c - p.y * s, p.x * s + p.y * c);
}
real valueWithin(real d, real beyond, real ease) {
    return pick(-beyond, length(vec2(beyond, max(d * ease, 0.0f))), d * ease);
}

// Around y, by `turns` a metre of height.
vec3 warpTwist(vec3 p, real turns, real reach, real ease) {
    vec2 q = turned(within(vec2(p.x, p.z), reach), turns * p.y);
    return vec3(q.x, p.y, q.y);
}
real opTwist(real d, vec3 p, real turns, real reach, real ease) {
    return valueWithin(d, max(length(vec2(p.x, p.z)) - reach, 0.0f), ease);
}

// In the plane of x and y, by `turns` a metre along x: Quilez, "Distance functions" (2013), the cheap bend. A bar along x
// becomes a bow whose ends rise where `turns` is positive.
vec3 warpBend(vec3 p, real turns, real reach, real ease) {
    vec2 q = within(vec2(p.x, p.y), reach);
    q = turned(q, -turns * q.x);
    return vec3(q.x, q.y, p.z);
}
real opBend(real d, vec3 p, real turns, real reach, real ease) {
    return valueWithin(d, max(length(vec2(p.x, p.y)) - reach, 0.0f), ease);
}
