#pragma once
// Rays against shapes by closed forms in double: what a marched picture is held to. A solid is the set of intervals of a
// ray that lie inside it; union, intersection and difference act on the intervals, so no distance function is involved.
#include "core/scene/scene.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <limits>
#include <optional>

namespace mb {

struct DoubleRay {
    glm::dvec3 origin, direction;
};

/// The ray of a pixel, written from the command line's formula and from nothing else.
inline DoubleRay pixelRay(const Camera& c, glm::ivec2 size, int x, int y) {
    const double tangent = std::tan(glm::radians(c.fov) / 2), aspect = static_cast<double>(size.x) / size.y;
    const double u = ((x + 0.5) / size.x * 2 - 1) * aspect * tangent, v = (1 - (y + 0.5) / size.y * 2) * tangent;
    const glm::dvec3 f = glm::normalize(c.target - c.eye), r = glm::normalize(glm::cross(f, {0, 1, 0})), up = glm::cross(r, f);
    if (c.ortho > 0) {
        const double h = c.ortho;
        return {c.eye + r * (((x + 0.5) / size.x - 0.5) * h * aspect) + up * ((0.5 - (y + 0.5) / size.y) * h), f};
    }
    return {c.eye, glm::normalize(f + u * r + v * up)};
}

/// Where a ray is inside a convex solid, with the outward normals at both ends; empty where enter > leave.
struct Span {
    double enter = std::numeric_limits<double>::infinity(), leave = -std::numeric_limits<double>::infinity();
    glm::dvec3 enter_normal{0}, leave_normal{0};
    bool empty() const { return !(enter < leave); }
};

inline Span sphereSpan(const DoubleRay& ray, glm::dvec3 centre, double radius) {
    // Kahan's form of the quadratic: the distance of the centre from the ray, with no difference of near equals.
    const glm::dvec3 m = ray.origin - centre;
    const double b = glm::dot(m, ray.direction);
    const glm::dvec3 nearest = m - b * ray.direction;
    const double d = radius * radius - glm::dot(nearest, nearest);
    if (d <= 0) return {};
    const double half = std::sqrt(d), t0 = -b - half, t1 = -b + half;
    return {t0, t1, glm::normalize(m + t0 * ray.direction), glm::normalize(m + t1 * ray.direction)};
}

inline Span halfSpaceSpan(const DoubleRay& ray, glm::dvec3 normal, double offset) {
    const double height = glm::dot(normal, ray.origin) - offset, rate = glm::dot(normal, ray.direction);
    const double infinity = std::numeric_limits<double>::infinity();
    if (rate == 0) return height <= 0 ? Span{-infinity, infinity, normal, normal} : Span{};
    const double t = -height / rate;
    return rate < 0 ? Span{t, infinity, normal, normal} : Span{-infinity, t, normal, normal};
}

inline Span both(const Span& a, const Span& b) {
    if (a.empty() || b.empty()) return {};
    const Span& late = a.enter > b.enter ? a : b;
    const Span& early = a.leave < b.leave ? a : b;
    return {late.enter, early.leave, late.enter_normal, early.leave_normal};
}

inline Span boxSpan(const DoubleRay& ray, glm::dvec3 centre, glm::dvec3 size) {
    Span span{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 n{0};
        n[axis] = 1;
        span = both(span, both(halfSpaceSpan(ray, n, centre[axis] + size[axis] / 2), halfSpaceSpan(ray, -n, size[axis] / 2 - centre[axis])));
    }
    return span;
}

/// The first surface a ray from outside meets within reach.
struct Hit {
    double t = 0;
    glm::dvec3 normal{0};
    int object = 0;
};
inline std::optional<Hit> firstOf(const Span& span, double reach, int object = 0) {
    if (span.empty() || span.enter < 0 || span.enter > reach) return std::nullopt;
    return Hit{span.enter, span.enter_normal, object};
}

}  // namespace mb
