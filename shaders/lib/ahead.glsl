// What lies ahead of a point on a ray: within which lengths it may be inside something, and within which it is for certain.
// The spans of primitives and operators (shaders/sdf/), less what is behind.

struct Ahead {
    vec2 span, inner;
};
const Ahead NOTHING_AHEAD = Ahead(vec2(EMPTY, -EMPTY), vec2(EMPTY, -EMPTY));
const Ahead UNKNOWN_AHEAD = Ahead(vec2(0.0, EMPTY), vec2(EMPTY, -EMPTY));

vec2 aheadOnly(vec2 span) { return spanOrNone(max(span.x, 0.0), span.y); }
Ahead onlyAhead(vec2 span, vec2 inner) { return Ahead(aheadOnly(span), aheadOnly(inner)); }
Ahead anyAhead(Ahead a, Ahead b) { return Ahead(spanEither(a.span, b.span), joinedSpan(a.inner, b.inner)); }
