#include "physics/closest.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace mb {
namespace {

constexpr int kIterations = 40;
constexpr double kPull = 1e-4;  // how far towards c the surfaces are linearised: a box has no gradient on its very edge

Slope slopeOf(const Surface& s, glm::dvec3 p) { return s.leaf ? slope(*s.leaf, p) : slope(*s.tree, p); }

/// The surfaces' planes near a point: value + gradient·(z − point).
struct Planes {
    std::size_t count = 0;
    std::array<glm::dvec3, 3> gradient{};
    std::array<double, 3> value{};
};

/// Solves (J·Jᵀ) y = b for one to three rows by Cramer's rule; false where the rows do not span.
bool solveRows(const Planes& p, const std::array<double, 3>& b, std::array<double, 3>& out) {
    const auto g = [&](std::size_t i, std::size_t j) { return glm::dot(p.gradient[i], p.gradient[j]); };
    double scale = 1;
    for (std::size_t i = 0; i < p.count; ++i) scale *= g(i, i);
    if (!(scale > 1e-16)) return false;
    if (p.count == 1) return out[0] = b[0] / g(0, 0), true;
    if (p.count == 2) {
        const double det = g(0, 0) * g(1, 1) - g(0, 1) * g(0, 1);
        if (!(det > 1e-8 * scale)) return false;
        out[0] = (b[0] * g(1, 1) - b[1] * g(0, 1)) / det;
        out[1] = (b[1] * g(0, 0) - b[0] * g(0, 1)) / det;
        return true;
    }
    // With three independent rows (J·Jᵀ)⁻¹ is made of the dual basis e_i: J·e_j = δ_ij.
    const auto [a0, a1, a2] = p.gradient;
    const double det = glm::dot(a0, glm::cross(a1, a2));
    if (!(det * det > 1e-10 * scale)) return false;
    const std::array<glm::dvec3, 3> e{glm::cross(a1, a2) / det, glm::cross(a2, a0) / det, glm::cross(a0, a1) / det};
    for (std::size_t i = 0; i < 3; ++i) {
        out[i] = 0;
        for (std::size_t j = 0; j < 3; ++j) out[i] += glm::dot(e[i], e[j]) * b[j];
    }
    return true;
}

glm::dvec3 combine(const Planes& p, const std::array<double, 3>& shares) {
    glm::dvec3 sum{0};
    for (std::size_t i = 0; i < p.count; ++i) sum += shares[i] * p.gradient[i];
    return sum;
}

/// One evaluation of each surface, a little off x towards c.
Planes linearise(std::span<const Surface> surfaces, glm::dvec3 x, glm::dvec3 c, std::uint64_t& io_evaluations) {
    const glm::dvec3 at = x + kPull * (c - x);
    Planes planes{surfaces.size()};
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const Slope s = slopeOf(surfaces[i], at);
        planes.gradient[i] = s.gradient;
        planes.value[i] = s.distance + glm::dot(s.gradient, x - at);
    }
    ++io_evaluations;
    return planes;
}

/// The foot of c on one surface of exact distance, in one step. No point of a surface is nearer than the value at c, so
/// a point of it at just that distance is proven to be the nearest.
std::optional<ClosestPoint> footInOneStep(const Surface& surface, glm::dvec3 c, std::uint64_t& io_evaluations) {
    const Slope s = slopeOf(surface, c);
    const glm::dvec3 x = c - s.distance * s.gradient;
    const double there = slopeOf(surface, x).distance;
    io_evaluations += 2;
    const double d = std::fabs(s.distance), n2 = glm::dot(s.gradient, s.gradient);
    if (!(n2 > 0.5) || std::fabs(there) > 1e-12 * (1 + d + glm::length(c)) || glm::length(x - c) > d * (1 + 1e-9)) return std::nullopt;
    return ClosestPoint{x, {s.distance}};
}

/// Newton's steps onto the surfaces and, if `towards`, along them towards c.
std::optional<ClosestPoint> descend(std::span<const Surface> surfaces, glm::dvec3 c, glm::dvec3 start, double scale, bool towards,
                                    std::uint64_t& io_evaluations, bool* parallel) {
    // The length of the step along the surfaces follows the last two (Barzilai,
    // Borwein, "Two-Point Step Size Gradient Methods", 1988): near a strongly curved edge a full step overshoots.
    // Neither may leave the place where the gradients mean something: a stride is limited.
    glm::dvec3 x = start, last_x{0}, last_along{0};
    double step = 0.5, most = 0.25 * scale;
    for (int i = 0; i < kIterations; ++i) {
        const Planes planes = linearise(surfaces, x, c, io_evaluations);
        std::array<double, 3> onto{}, shares{}, apart{};
        for (std::size_t k = 0; k < planes.count; ++k) apart[k] = glm::dot(planes.gradient[k], c - x);
        if (!solveRows(planes, planes.value, onto) || !solveRows(planes, apart, shares)) {
            if (parallel) *parallel = true;
            return std::nullopt;
        }
        const glm::dvec3 normal = combine(planes, onto), along = c - x - combine(planes, shares);
        const double d = glm::length(c - x), off = glm::length(normal), slant = glm::length(along);
        if (!(off < 1e9) || !(slant < 1e9)) return std::nullopt;
        // Where the distance hardly changes along an edge, as around a hole that the ball is right above, one point is as
        // good as the next: after some rounds a slant of 1e-4 will do, whose gap errs by less than a resting depth.
        const bool straight = !towards || slant <= (i < 10 ? 1e-8 : 1e-4) * d + 1e-12;
        if (off <= 1e-11 * (1 + d) && straight) return ClosestPoint{x, shares};
        if (i > 0) {
            const glm::dvec3 moved = x - last_x, change = last_along - along;
            const double curve = glm::dot(moved, change);
            step = curve > 0 ? std::clamp(glm::dot(moved, moved) / curve, 0.02, 10.0) : 1.0;
        }
        last_x = x, last_along = along;
        const glm::dvec3 stride = (straight ? 0.0 : step) * along - normal;
        if (i == 0)
            for (std::size_t k = 0; k < planes.count; ++k) most = std::max(most, 0.25 * std::fabs(planes.value[k]));
        const double length = glm::length(stride);
        x += stride * (length > most ? most / length : 1.0);
    }
    return std::nullopt;
}

}  // namespace

Slope slope(const Leaf& leaf, glm::dvec3 p) {
    const glm::dvec3 q = (p - leaf.position) * leaf.rotation;  // the transpose, times the vector
    const sdf::Dual d = leaf.primitive->distance<sdf::Dual>({{q.x, 1, 0, 0}, {q.y, 0, 1, 0}, {q.z, 0, 0, 1}}, leaf.numbers);
    return {d.v, leaf.rotation * glm::dvec3{d.dx, d.dy, d.dz}};
}

std::optional<ClosestPoint> closestPoint(std::span<const Surface> surfaces, glm::dvec3 c, glm::dvec3 start, double scale,
                                         std::uint64_t& io_evaluations, bool* parallel) {
    if (surfaces.size() == 1 && start == c)
        if (const auto foot = footInOneStep(surfaces[0], c, io_evaluations)) return foot;

    return descend(surfaces, c, start, scale, true, io_evaluations, parallel);
}

std::optional<ClosestPoint> pointOn(std::span<const Surface> surfaces, glm::dvec3 c, glm::dvec3 start, double scale,
                                    std::uint64_t& io_evaluations) {
    return descend(surfaces, c, start, scale, false, io_evaluations, nullptr);
}

}  // namespace mb
