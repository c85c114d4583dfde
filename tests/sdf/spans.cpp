// A primitive's span never leaves out what is solid: outside it, nothing of the ray has a negative distance.
#include "sdf/draw.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <functional>

using namespace mb;

namespace {

struct Span {
    double begin, end;
};
struct Ray {
    glm::dvec3 origin, direction;
    glm::dvec3 at(double t) const { return origin + t * direction; }
};

/// A unit direction; one in three along an axis, with exact zeros of either sign, and one in three within a plane of axes.
glm::dvec3 drawDirection(Draw& draw) {
    glm::dvec3 d{0};
    do {
        const int zeros = draw.below(3), first = draw.below(3);
        for (int i = 0; i < 3; ++i) d[i] = draw.uniform(-1, 1);
        for (int i = 0; i < zeros; ++i) d[(first + i) % 3] = draw.oneIn(2) ? 0.0 : -0.0;
    } while (glm::length(d) < 0.05);
    return glm::normalize(d);
}

/// A ray of a shape of about that size: from within or beside it anywhere, or from far away at a point beside it.
Ray drawRay(Draw& draw, double size) {
    const auto near = [&] { return draw.oneIn(6) ? 0 : draw.uniform(-1.5, 1.5) * size; };
    const glm::dvec3 beside{near(), near(), near()}, d = drawDirection(draw);
    return {draw.oneIn(2) ? beside : beside - d * size * draw.logUniform(2, 1e4), d};
}

/// The most negative distance on the ray outside the span, at least 0, less what rounding may hide.
struct Outside {
    const Primitive& row;
    const LeafNumbers& numbers;
    const Ray& ray;
    Span span;
    double scale, rounding;  // m, and of that and of how far along the ray: by so much a point may lie outside
    double depth = 0;
    int negative = 0, asked = 0;

    double ask(double t) {
        const glm::dvec3 p = ray.at(t);
        const double f = row.distance<double>({p.x, p.y, p.z}, numbers);
        const bool outside = !(t >= span.begin && t <= span.end);
        ++asked, negative += f < 0;
        if (outside) depth = std::max(depth, -f - rounding * (scale + std::fabs(t)));
        return f;
    }
    /// Evenly, at the ends, and from surface to surface.
    void askAll(double size) {
        constexpr int kEven = 100;
        const double middle = -glm::dot(ray.origin, ray.direction), reach = 4 * size, least = reach / 200;
        for (int i = 0; i <= kEven; ++i) ask(middle + reach * (2.0 * i / kEven - 1));
        for (const double beyond : {1e-7, 1e-5, 1e-3, 1e-2, 0.1}) ask(span.begin - beyond * size), ask(span.end + beyond * size);
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

Span asked(const Primitive& row, const LeafNumbers& k, const Ray& r, bool in_float) {
    if (!in_float) {
        const sdf::Vec2<double> s = row.span_f64({r.origin.x, r.origin.y, r.origin.z}, {r.direction.x, r.direction.y, r.direction.z}, k.data());
        return {s.x, s.y};
    }
    const auto f = [](double x) { return static_cast<float>(x); };
    const sdf::Vec2<float> s = row.span_f32({f(r.origin.x), f(r.origin.y), f(r.origin.z)}, {f(r.direction.x), f(r.direction.y), f(r.direction.z)}, k.data());
    return {static_cast<double>(s.x), static_cast<double>(s.y)};
}

/// `changed` makes another span of the row's own.
Found lookOutside(const Primitive& row, bool in_float, int rays, const std::function<Span(Span)>& changed = {}) {
    Draw draw(streamOf(row.name) + in_float);
    Found found;
    while (found.rays < rays) {
        const double size = draw.logUniform(0.01, 100);
        const auto k = cooked(row, drawNumbers(draw, row, size, 3));
        if (!k) continue;
        Ray ray = drawRay(draw, size);
        // Of the same ray: what float rounds away of it is not the span's fault.
        if (in_float) ray = {glm::dvec3(glm::vec3(ray.origin)), glm::dvec3(glm::vec3(ray.direction))};
        Span span = asked(row, *k, ray, in_float);
        if (changed) span = changed(span);
        const double scale = glm::length(ray.origin) + 4 * size + (row.name == "plane" ? std::fabs((*k)[3]) : 0);
        Outside outside{row, *k, ray, span, scale, in_float ? kFloatRounding : kDoubleRounding};
        outside.askAll(size);
        ++found.rays, found.asked += outside.asked, found.negative += outside.negative, found.empty += !(span.begin <= span.end);
        if (outside.depth > 0 && outside.depth / size > found.depth && !changed)
            MESSAGE(row.name << (in_float ? " in float" : "") << ": " << outside.depth << " m deep, size " << size << ", origin " << ray.origin.x << "," << ray.origin.y << ","
                             << ray.origin.z << " direction " << ray.direction.x << "," << ray.direction.y << "," << ray.direction.z << " span " << span.begin << " "
                             << span.end);
        found.depth = std::max(found.depth, outside.depth / size);
    }
    return found;
}

}  // namespace

TEST_CASE("nothing outside a primitive's span is solid") {
    for (const Primitive& row : primitives()) {
        REQUIRE_MESSAGE(!row.span.empty(), row.name);
        for (const bool in_float : {false, true}) {
            const Found f = lookOutside(row, in_float, times(2'000));
            CHECK_MESSAGE(f.depth == 0, row.name << (in_float ? " in float" : ""));
            CHECK(f.negative > f.asked / 100);  // the rays did meet the shape
            CHECK(f.empty > f.rays / 50);       // and some spans said that they do not
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
        CHECK(lookOutside(row, false, 500, [&](Span s) { return inwards(s, 0.05); }).depth > 1e-3);
        CHECK(lookOutside(row, true, 500, [&](Span s) { return inwards(s, 0.05); }).depth > 1e-3);
        CHECK(lookOutside(row, false, 500, [&](Span s) { return Span{inwards(s, 0.1).begin, s.end}; }).depth > 1e-3);
        CHECK(lookOutside(row, false, 500, [&](Span s) { return Span{s.begin, inwards(s, 0.1).end}; }).depth > 1e-3);
        CHECK(lookOutside(row, false, 500, [](Span) { return Span{1, -1}; }).depth > 1e-3);
    }
}
