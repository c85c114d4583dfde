// Signed distances of the primitives, each centred on its own origin: metres, y up, inside is negative.
//
// Compiled twice: by the GPU's driver, and by the C++ compiler inside `template <class real> struct Sdf`
// (src/core/sdf/glsl.h) with real = float, double, Dual and Interval. The dialect both understand: `real` for float,
// literals end in f and are exact in binary or written as real(…) expressions, no swizzles, no branch on a real but
// pick(s, a, b), which is a where s < 0 and b elsewhere; square(a) instead of a * a.
//
// A parameter's name and type here are those of its row in src/core/sdf/primitives.cpp and of the scene file.
//
// Beside a distance may stand a span: between which two lengths the line from o along d, of unit length, may be inside; a span
// whose second end comes first is empty. Nothing outside the span is solid, though not all within must be. And beside that an
// inner span, within which all is solid: what is taken away leaves nothing there. Both only lengthen a march's step over what
// is known to be empty; a hit is always a sign of the distance.

// Rounding may take a hair off a span: an outer one is a millionth larger, an inner one smaller.
real wider() { return real(1.000001f); }
real narrower() { return real(0.999997f); }
real awayFromZero(real x) { return pick(abs(x) - 1e-18f, pick(x, -1e-18f, 1e-18f), x); }
// Within a box of these half sides around the origin.
vec2 spanAround(vec3 o, vec3 d, vec3 half_sides) {
    vec3 inverse = vec3(1.0f / awayFromZero(d.x), 1.0f / awayFromZero(d.y), 1.0f / awayFromZero(d.z));
    vec3 middle = o * inverse;
    vec3 reach = half_sides * abs(inverse);
    return vec2(max(-middle.x - reach.x, max(-middle.y - reach.y, -middle.z - reach.z)),
                min(reach.x - middle.x, min(reach.y - middle.y, reach.z - middle.z)));
}

// Within a ball. The nearest approach is computed as a point: the usual discriminant loses it to rounding from far away
// (Haines, Guenther and Akenine-Moeller, "Precision Improvements for Ray/Sphere Intersection", 2019).
vec2 spanBall(vec3 o, vec3 d, real radius) {
    real b = 0.0f - dot(o, d);
    vec3 nearest = o + d * b;
    real h = square(radius) - dot(nearest, nearest);
    real s = sqrt(max(h, 0.0f));
    return vec2(b - pick(h, real(-1.0f), s), b + pick(h, real(-1.0f), s));
}

real sdSphere(vec3 p, real radius) {
    return length(p) - radius;
}
vec2 spanSphere(vec3 o, vec3 d, real radius) { return spanBall(o, d, radius * wider()); }
vec2 innerSphere(vec3 o, vec3 d, real radius) { return spanBall(o, d, radius * narrower()); }

// The distance to a rounded corner region, q being how far a point lies beyond each face of a box.
real outside(vec3 q) { return length(max(q, 0.0f)) + min(max(q.x, max(q.y, q.z)), 0.0f); }
real outside(vec2 q) { return length(max(q, 0.0f)) + min(max(q.x, q.y), 0.0f); }

real sdBox(vec3 p, vec3 size, real round) {
    real r = min(round, 0.5f * min(size.x, min(size.y, size.z)));
    return outside(abs(p) - size * real(0.5f) + r) - r;
}
vec2 spanBox(vec3 o, vec3 d, vec3 size, real round) { return spanAround(o, d, size * (0.5f * wider())); }
// Of a rounded edge, the point in its middle lies 1 - sqrt(1/2) of the radius within the sharp one, a corner's 1 - sqrt(1/3).
vec2 innerBox(vec3 o, vec3 d, vec3 size, real round) {
    real r = min(round, 0.5f * min(size.x, min(size.y, size.z)));
    return spanAround(o, d, (size * real(0.5f) - r * real(0.42266f)) * narrower());
}

// The half-space normal·p <= offset is solid.
real sdPlane(vec3 p, vec3 normal, real offset) {
    return dot(p, normal) - offset;
}
vec2 spanPlane(vec3 o, vec3 d, vec3 normal, real offset) {
    real rate = dot(d, normal);
    real t = (offset - dot(o, normal)) / awayFromZero(rate);
    return vec2(pick(rate, t, real(-1e18f)), pick(rate, real(1e18f), t));
}

real sdTorus(vec3 p, real major, real minor) {
    return length(vec2(length(vec2(p.x, p.z)) - major, p.y)) - minor;
}
vec2 spanTorus(vec3 o, vec3 d, real major, real minor) { return spanAround(o, d, vec3(major + minor, minor, major + minor) * wider()); }

real sdCylinder(vec3 p, real radius, real height, real round) {
    real r = min(round, min(radius, 0.5f * height));
    return outside(vec2(length(vec2(p.x, p.z)) - radius + r, abs(p.y) - 0.5f * height + r)) - r;
}
// Within an endless cylinder around y, as within a ball seen from above; and within a slab of that half height.
vec2 spanUpright(vec3 o, vec3 d, real radius, real half_height) {
    real across = square(d.x) + square(d.z);
    real a = max(across, real(1e-30f));
    real b = pick(across - a, 0.0f, (0.0f - (o.x * d.x + o.z * d.z)) / a);  // as good as upright: no nearer anywhere
    real h = square(radius) - square(o.x + d.x * b) - square(o.z + d.z * b);
    real s = sqrt(max(h, 0.0f) / a);
    real inverse = 1.0f / awayFromZero(d.y);
    real middle = o.y * inverse;
    real reach = half_height * abs(inverse);
    return vec2(max(b - pick(h, real(-1e18f), s), -middle - reach), min(b + pick(h, real(-1e18f), s), reach - middle));
}
vec2 spanCylinder(vec3 o, vec3 d, real radius, real height, real round) { return spanUpright(o, d, radius * wider(), height * (0.5f * wider())); }
vec2 innerCylinder(vec3 o, vec3 d, real radius, real height, real round) {
    real edge = min(round, min(radius, 0.5f * height)) * real(0.2929f);
    return spanUpright(o, d, (radius - edge) * narrower(), (0.5f * height - edge) * narrower());
}

real sdCapsule(vec3 p, real radius, real height) {
    return length(vec3(p.x, max(abs(p.y) - 0.5f * height, 0.0f), p.z)) - radius;
}
vec2 spanCapsule(vec3 o, vec3 d, real radius, real height) { return spanUpright(o, d, radius * wider(), (0.5f * height + radius) * wider()); }
vec2 innerCapsule(vec3 o, vec3 d, real radius, real height) { return spanUpright(o, d, radius * narrower(), height * (0.5f * narrower())); }

// A frustum between a base of `radius` and a top of `radius2`. From outside the nearest feature is a disc (the caps) or the slanted
// side, a segment in the half-plane of the radius q.x and the height q.y.
real sdCone(vec3 p, real radius, real radius2, real height) {
    vec2 q = vec2(length(vec2(p.x, p.z)), p.y);
    real h = 0.5f * height;
    vec2 cap = vec2(max(q.x - pick(q.y, radius, radius2), 0.0f), abs(q.y) - h);

    vec2 side = vec2(radius2 - radius, height);
    vec2 from = vec2(q.x - radius, q.y + h);
    real along = (from.x * side.x + from.y * side.y) / (square(side.x) + square(side.y));
    real t = min(max(along, 0.0f), 1.0f);
    vec2 slant = from - side * t;

    real nearest = min(square(cap.x) + square(cap.y), square(slant.x) + square(slant.y));
    // Within, the nearest feature is the plane of a face; on it the root's slope would be lost.
    real beyond = max((from.x * side.y - from.y * side.x) / length(side), cap.y);
    return pick(-beyond, sqrt(nearest), beyond);
}
vec2 spanCone(vec3 o, vec3 d, real radius, real radius2, real height) {
    return spanUpright(o, d, max(radius, radius2) * wider(), height * (0.5f * wider()));
}

// A bound: the unit ball's distance in the stretched space, brought back by the least stretch. Its slope is at most 1.
real sdEllipsoid(vec3 p, vec3 radii) {
    return (length(p / radii) - 1.0f) * min(radii.x, min(radii.y, radii.z));
}
vec2 spanEllipsoid(vec3 o, vec3 d, vec3 radii) { return spanAround(o, d, radii * wider()); }

// The nearest feature is a face, unless the point lies over one of its three edges, where t runs along the edge.
real octahedronEdge(real a, real b, real c, real radius) {
    real t = min(max(0.5f * (c - b + radius), 0.0f), radius);
    return length(vec3(a, b - radius + t, c - t));
}
real sdOctahedron(vec3 p, real radius) {
    vec3 q = abs(p);
    real m = q.x + q.y + q.z - radius;
    return pick(3.0f * q.x - m, octahedronEdge(q.x, q.y, q.z, radius),
           pick(3.0f * q.y - m, octahedronEdge(q.y, q.z, q.x, radius),
           pick(3.0f * q.z - m, octahedronEdge(q.z, q.x, q.y, radius), m / sqrt(real(3.0f)))));
}
vec2 spanOctahedron(vec3 o, vec3 d, real radius) { return spanAround(o, d, vec3(radius * wider())); }

// Reflects p to the near side of the line through the origin in the direction (c, s), where `on` is negative.
vec2 foldAcross(vec2 p, real c, real s, real on) {
    real beyond = pick(on, 2.0f * max(p.y * c - p.x * s, 0.0f), 0.0f);
    return vec2(p.x + beyond * s, p.y - beyond * c);
}

// The mirrors of a regular polygon lie at the multiples of pi/sides; folding across the 8th, 4th, 2nd and 1st brings any
// point into the wedge between a side's middle (along x) and its corner. `apothem` is the distance of a side.
real sdPrism(vec3 p, real sides, real radius, real height, real apothem) {
    real c1 = apothem / radius;
    real s1 = sqrt(max(1.0f - square(c1), 0.0f));
    real c2 = 1.0f - 2.0f * square(s1);
    real s2 = 2.0f * c1 * s1;
    real c4 = 1.0f - 2.0f * square(s2);
    real s4 = 2.0f * c2 * s2;
    real c8 = 1.0f - 2.0f * square(s4);
    real s8 = 2.0f * c4 * s4;
    vec2 q = vec2(p.x, abs(p.z));
    q = foldAcross(q, c8, s8, 8.5f - sides);
    q = foldAcross(q, c4, s4, 4.5f - sides);
    q = foldAcross(q, c2, s2, real(-1.0f));
    q = foldAcross(q, c1, s1, real(-1.0f));

    vec2 side = vec2(q.x - apothem, max(abs(q.y) - radius * s1, 0.0f));
    real across = pick(-side.x, length(side), side.x);  // on a side the root's slope would be lost
    return outside(vec2(across, abs(p.y) - 0.5f * height));
}
vec2 spanPrism(vec3 o, vec3 d, real sides, real radius, real height, real apothem) { return spanUpright(o, d, radius * wider(), height * (0.5f * wider())); }
vec2 innerPrism(vec3 o, vec3 d, real sides, real radius, real height, real apothem) { return spanUpright(o, d, apothem * narrower(), height * (0.5f * narrower())); }
