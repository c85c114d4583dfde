// A primitive's span never leaves out what is solid: outside it, nothing of the ray has a negative distance. Within its inner
// span nothing has a positive one. And what operators make of their children's spans keeps both promises.
#include "sdf/draw.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <functional>
#include <vector>

using namespace mb;

namespace {

struct Span {
    double begin, end;
};
struct Ray {
    glm::dvec3 origin, direction;
    glm::dvec3 at(double t) const { return origin + t * direction; }
};

/// A unit direction; one in three along an axis, with exact zeros of either sign or next to nothing, and one in three within a
/// plane of axes.
glm::dvec3 drawDirection(Draw& draw) {
    glm::dvec3 d{0};
    do {
        const int zeros = draw.below(3), first = draw.below(3);
        for (int i = 0; i < 3; ++i) d[i] = draw.uniform(-1, 1);
        for (int i = 0; i < zeros; ++i) d[(first + i) % 3] = draw.oneIn(3) ? draw.logUniform(1e-18, 1e-3) : draw.oneIn(2) ? 0.0 : -0.0;
    } while (glm::length(d) < 0.05);
    return glm::normalize(d);
}

/// A ray of a shape of about that size: from within or beside it anywhere, or from far away at a point beside it.
Ray drawRay(Draw& draw, double size) {
    const auto near = [&] { return draw.oneIn(6) ? 0 : draw.uniform(-1.5, 1.5) * size; };
    const glm::dvec3 beside{near(), near(), near()}, d = drawDirection(draw);
    return {draw.oneIn(2) ? beside : beside - d * size * draw.logUniform(2, 1e4), d};
}

enum class Kind { outer, inner };

/// How far the ray breaks the span's promise: the most negative distance outside of an outer one, the largest within an inner
/// one; at least 0, less what rounding may hide.
struct Broken {
    const Primitive& row;
    const LeafNumbers& numbers;
    const Ray& ray;
    Span span;
    Kind kind;
    double scale, rounding;  // m, and of that and of how far along the ray: by so much a point may lie outside
    double depth = 0;
    int negative = 0, asked = 0;

    double ask(double t) {
        const glm::dvec3 p = ray.at(t);
        const double f = row.distance<double>({p.x, p.y, p.z}, numbers);
        const bool within = t >= span.begin && t <= span.end;
        ++asked, negative += f < 0;
        if (within == (kind == Kind::inner)) depth = std::max(depth, (kind == Kind::inner ? f : -f) - rounding * (scale + std::fabs(t)));
        return f;
    }
    /// Evenly, at the ends, and from surface to surface.
    void askAll(double size) {
        constexpr int kEven = 100;
        const double middle = -glm::dot(ray.origin, ray.direction), reach = 4 * size, least = reach / 200;
        for (int i = 0; i <= kEven; ++i) ask(middle + reach * (2.0 * i / kEven - 1));
        for (const double beyond : {1e-7, 1e-5, 1e-3, 1e-2, 0.1}) for (const double sign : {-1, 1}) ask(span.begin + sign * beyond * size), ask(span.end + sign * beyond * size);
        for (double t = middle - reach; t < middle + reach;) t += std::max(std::fabs(ask(t)), least);
    }
};

struct Found {
    double depth = 0;
    long asked = 0, negative = 0, empty = 0, rays = 0;
};

/// Span functions of float lose what their origins do: the march keeps 2 noise, of 4 ulps each, from a span's end.
constexpr double kFloatRounding = 8 * 0x1p-23;
/// Of double: the numbers themselves, a few operations each.
constexpr double kDoubleRounding = 16 * 0x1p-52;

Span asked(const Primitive& row, Kind kind, const LeafNumbers& k, const Ray& r, bool in_float) {
    const bool outer = kind == Kind::outer;
    if (!in_float) {
        const sdf::Vec2<double> s = (outer ? row.span_f64 : row.inner_f64)({r.origin.x, r.origin.y, r.origin.z}, {r.direction.x, r.direction.y, r.direction.z}, k.data());
        return {s.x, s.y};
    }
    const auto f = [](double x) { return static_cast<float>(x); };
    const sdf::Vec2<float> s = (outer ? row.span_f32 : row.inner_f32)({f(r.origin.x), f(r.origin.y), f(r.origin.z)}, {f(r.direction.x), f(r.direction.y), f(r.direction.z)}, k.data());
    return {static_cast<double>(s.x), static_cast<double>(s.y)};
}

/// `changed` makes another span of the row's own.
Found lookAt(const Primitive& row, Kind kind, bool in_float, int rays, const std::function<Span(Span)>& changed = {}) {
    Draw draw(streamOf(row.name) + in_float);
    Found found;
    while (found.rays < rays) {
        const double size = draw.logUniform(0.01, 100);
        const auto k = cooked(row, drawNumbers(draw, row, size, 3));
        if (!k) continue;
        Ray ray = drawRay(draw, size);
        // Of the same ray: what float rounds away of it is not the span's fault.
        if (in_float) ray = {glm::dvec3(glm::vec3(ray.origin)), glm::dvec3(glm::vec3(ray.direction))};
        Span span = asked(row, kind, *k, ray, in_float);
        if (changed) span = changed(span);
        const double scale = glm::length(ray.origin) + 4 * size + (row.name == "plane" ? std::fabs((*k)[3]) : 0);
        Broken broken{row, *k, ray, span, kind, scale, in_float ? kFloatRounding : kDoubleRounding};
        broken.askAll(size);
        ++found.rays, found.asked += broken.asked, found.negative += broken.negative, found.empty += !(span.begin <= span.end);
        if (broken.depth > 0 && broken.depth / size > found.depth && !changed)
            MESSAGE(row.name << (in_float ? " in float" : "") << ": " << broken.depth << " m deep, size " << size << ", origin " << ray.origin.x << "," << ray.origin.y << ","
                             << ray.origin.z << " direction " << ray.direction.x << "," << ray.direction.y << "," << ray.direction.z << " span " << span.begin << " "
                             << span.end);
        found.depth = std::max(found.depth, broken.depth / size);
    }
    return found;
}

}  // namespace

TEST_CASE("nothing outside a primitive's span is solid") {
    for (const Primitive& row : primitives()) {
        REQUIRE_MESSAGE(!row.span.empty(), row.name);
        for (const bool in_float : {false, true}) {
            const Found f = lookAt(row, Kind::outer, in_float, times(2'000));
            CHECK_MESSAGE(f.depth == 0, row.name << (in_float ? " in float" : ""));
            CHECK(f.negative > f.asked / 100);  // the rays did meet the shape
            CHECK(f.empty > f.rays / 200);      // and some spans said that they do not: of a plane, those of parallel rays
            CHECK(f.empty < f.rays);
            if (!in_float) MESSAGE(row.name << ": " << f.rays << " rays, " << f.asked << " points, " << f.negative << " of them inside; " << f.empty << " spans are empty");
        }
    }
}

TEST_CASE("a span that is a little short, late or early is caught") {
    constexpr double kEndless = 1e17;
    // Of a half-space, whose span has one end, the end is moved.
    const auto inwards = [&](Span s, double share) {
        if (s.begin < -kEndless || s.end > kEndless) return s.begin < -kEndless ? Span{s.begin, s.end - share} : Span{s.begin + share, s.end};
        const double off = share * (s.end - s.begin);
        return Span{s.begin + off, s.end - off};
    };
    for (const Primitive& row : primitives()) {
        CAPTURE(row.name);
        CHECK(lookAt(row, Kind::outer, false, 500, [&](Span s) { return inwards(s, 0.05); }).depth > 1e-3);
        CHECK(lookAt(row, Kind::outer, true, 500, [&](Span s) { return inwards(s, 0.05); }).depth > 1e-3);
        CHECK(lookAt(row, Kind::outer, false, 500, [&](Span s) { return Span{inwards(s, 0.1).begin, s.end}; }).depth > 1e-3);
        CHECK(lookAt(row, Kind::outer, false, 500, [&](Span s) { return Span{s.begin, inwards(s, 0.1).end}; }).depth > 1e-3);
        CHECK(lookAt(row, Kind::outer, false, 500, [](Span) { return Span{1, -1}; }).depth > 1e-3);
    }
}

TEST_CASE("all within a primitive's inner span is solid") {
    int rows = 0;
    for (const Primitive& row : primitives()) {
        if (row.inner.empty()) continue;
        ++rows;
        for (const bool in_float : {false, true}) {
            const Found f = lookAt(row, Kind::inner, in_float, times(2'000));
            CHECK_MESSAGE(f.depth == 0, row.name << (in_float ? " in float" : ""));
            CHECK(f.empty < f.rays * 9 / 10);  // some spans said that there is something
            if (!in_float) MESSAGE(row.name << ": " << f.rays << " rays, " << f.empty << " inner spans are empty");
        }
        // A span a little longer at either end is caught; of a half-space's, the end there is.
        const auto longer = [](Span s) { return s.begin <= s.end ? Span{s.begin - 0.05 * std::min(s.end - s.begin, 1.0), s.end + 0.05 * std::min(s.end - s.begin, 1.0)} : s; };
        CHECK(lookAt(row, Kind::inner, false, 500, longer).depth > 1e-3);
    }
    CHECK(rows >= 6);
}

namespace {

/// A solid on a line as whether each of a few sections is in it; and spans of it, outer and inner ones.
struct Sections {
    std::vector<bool> in;
    sdf::Vec2<double> outer{1e18, -1e18}, inner{1e18, -1e18};

    bool keepsPromise() const {
        for (std::size_t i = 0; i < in.size(); ++i) {
            const double middle = static_cast<double>(i) + 0.5;
            if (in[i] && !(middle > outer.x && middle < outer.y)) return false;
            if (!in[i] && middle > inner.x && middle < inner.y) return false;
        }
        return true;
    }
};
/// One piece, or nothing; the outer span a little larger, or not, and the inner one smaller or missing.
Sections drawPiece(Draw& draw, int n) {
    Sections s{std::vector<bool>(static_cast<std::size_t>(n))};
    const int begin = draw.below(n), end = draw.below(n + 1);
    for (int i = begin; i < end; ++i) s.in[static_cast<std::size_t>(i)] = true;
    if (begin >= end) return s;
    s.outer = {begin - 1.0 * draw.below(2), end + 1.0 * draw.below(2)};
    if (!draw.oneIn(3)) s.inner = {begin + 0.4 * draw.below(2), end - 0.4 * draw.below(2)};
    return s;
}

}  // namespace

TEST_CASE("what a fold makes of its children's spans holds the result, and is held by it") {
    Draw draw(91);
    constexpr int kSections = 9;
    for (const Operator& o : operators()) {
        if (o.kind != Operator::Kind::fold) {
            CHECK(o.span.empty());
            continue;
        }
        REQUIRE_MESSAGE(!o.span.empty(), o.name);
        long outer = 0, inner = 0, cut = 0;
        for (int i = 0; i < times(20'000); ++i) {
            Sections a = drawPiece(draw, kSections);
            // Of a chain of them, as trees have.
            for (int more = draw.below(4); more >= 0; --more) {
                const Sections b = drawPiece(draw, kSections);
                Sections both{std::vector<bool>(a.in.size())};
                for (std::size_t k = 0; k < a.in.size(); ++k) both.in[k] = o.fold<double>(a.in[k] ? -1 : 1, b.in[k] ? -1 : 1, o.name == "morph" ? 0.3 : 0) < 0;
                both.outer = o.span_by(a.outer, a.inner, b.outer, b.inner), both.inner = o.inner_by(a.outer, a.inner, b.outer, b.inner);
                REQUIRE(both.keepsPromise());
                outer += both.outer.x < both.outer.y, inner += both.inner.x < both.inner.y, cut += both.outer.x > a.outer.x && both.outer.x < both.outer.y;
                a = both;
            }
        }
        MESSAGE(o.name << ": " << outer << " outer spans, " << inner << " inner ones, " << cut << " begin later than the first child's");
        CHECK(outer > 1000);
        CHECK(inner > 1000);
        if (o.intersects || o.first_only) CHECK(cut > 1000);
    }
}
