#include "physics/planes.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace mb {

glm::dvec3 stretchOf(glm::dvec3 sides) {
    const glm::dvec3 share = sides / std::max({sides.x, sides.y, sides.z});
    return share * share;
}

std::optional<Plane> planeNear(const Tree& tree, glm::dvec3 p, glm::dvec3 centre, glm::dvec3 reach, double on) {
    const glm::dvec3 stretch = stretchOf(reach);
    for (int i = 0; i < 8; ++i) {
        const Slope s = slope(tree, p);
        const double l2 = glm::dot(s.gradient, s.gradient);
        if (!(l2 > 1e-6)) return std::nullopt;
        if (std::fabs(s.distance) <= on) return Plane{p, s.gradient / std::sqrt(l2)};
        const glm::dvec3 way = stretch * s.gradient;
        p -= (s.distance / glm::dot(way, s.gradient)) * way;
        const glm::dvec3 off = glm::abs(p - centre);
        if (off.x > reach.x || off.y > reach.y || off.z > reach.z) return std::nullopt;
    }
    return std::nullopt;
}

glm::dvec3 meetingPoint(std::span<const Plane> planes, double drawn) {
    glm::dvec3 at{0};
    glm::dmat3 normal{0};
    for (const Plane& p : planes) at += p.point / static_cast<double>(planes.size()), normal += glm::outerProduct(p.normal, p.normal);
    const double draw = drawn * static_cast<double>(planes.size());
    for (int i = 0; i < 3; ++i) normal[i][i] += draw;
    const glm::dmat3 inverse = glm::inverse(normal);
    for (int round = 0; round < 4; ++round) {
        glm::dvec3 off{0};
        for (const Plane& p : planes) off += glm::dot(p.normal, p.point - at) * p.normal;
        at += inverse * off;
    }
    return at;
}

Round roundWithin(std::span<const Plane> planes) {
    glm::dvec3 mean{0};
    glm::dmat4 normal{0};
    for (const Plane& p : planes) {
        const glm::dvec4 row{p.normal, 1};
        mean += p.point / static_cast<double>(planes.size()), normal += glm::outerProduct(row, row);
    }
    const double draw = 1e-7 * static_cast<double>(planes.size());
    for (int i = 0; i < 4; ++i) normal[i][i] += draw;
    const glm::dmat4 inverse = glm::inverse(normal);
    glm::dvec4 found{0};
    for (int round = 0; round < 6; ++round) {
        glm::dvec4 off{0};
        for (const Plane& p : planes) {
            const glm::dvec4 row{p.normal, 1};
            off += (glm::dot(p.normal, p.point - mean) - glm::dot(row, found)) * row;
        }
        found += inverse * off;
    }
    return {mean + glm::dvec3{found}, found.w};
}

NormalCone coneOf(std::span<const Plane> planes) {
    NormalCone out;
    const auto farthest = [&] { return std::ranges::min_element(planes, {}, [&](const Plane& p) { return glm::dot(p.normal, out.normal); })->normal; };
    out.normal = planes[0].normal;
    for (int i = 1; i <= 40; ++i) {
        const glm::dvec3 middle = out.normal + (farthest() - out.normal) / (i + 1.0);
        if (glm::dot(middle, middle) > 1e-6) out.normal = glm::normalize(middle);
    }
    out.cosine = glm::dot(farthest(), out.normal);
    return out;
}

bool Depth::tryAt(const Tree& tree, glm::dvec3 p) {
    const double d = -distance<double>(tree, {p.x, p.y, p.z});
    if (!(d > depth)) return false;
    place = p, depth = d;
    return true;
}

void Depth::climb(const Tree& tree, glm::dvec3 step) {
    constexpr int kMost = 200;
    for (int tries = 0, halvings = 0; halvings < 10 && tries < kMost; ++tries) {
        bool deeper = false;
        for (int axis = 0; axis < 3; ++axis)
            for (const double way : {step[axis], -step[axis]}) {
                glm::dvec3 p = place;
                p[axis] += way;
                deeper = tryAt(tree, p) || deeper;
            }
        if (!deeper) step *= 0.5, ++halvings;
    }
}

}  // namespace mb
