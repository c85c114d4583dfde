// How far a point is from each primitive, by the nearest point of the solid where it has one: other formulas than the shaders', of the
// same meaning.
#include "core/accuracy/solids.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>

namespace mb::accuracy {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Outside a rectangle or above its four sides' nearest: negative within. `over` is how far the point lies beyond each side.
double fromRectangle(double over_x, double over_y) {
    if (over_x <= 0 || over_y <= 0) return std::max(over_x, over_y);
    return std::hypot(over_x, over_y);
}

double fromSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 way = b - a;
    const double length = glm::dot(way, way), t = length > 0 ? std::clamp(glm::dot(p - a, way) / length, 0.0, 1.0) : 0;
    return glm::length(p - (a + t * way));
}

}  // namespace

double distanceOfSphere(glm::dvec3 p, const LeafNumbers& k) { return glm::length(p) - k[0]; }

double distanceOfBox(glm::dvec3 p, const LeafNumbers& k) {
    const glm::dvec3 half{k[0] / 2, k[1] / 2, k[2] / 2};
    const double round = std::min({k[3], half.x, half.y, half.z});
    const glm::dvec3 core = half - round, nearest = glm::clamp(p, -core, core), away = p - nearest;
    if (away != glm::dvec3(0)) return glm::length(away) - round;
    const glm::dvec3 within = core - glm::abs(p);
    return -std::min({within.x, within.y, within.z}) - round;
}

double distanceOfPlane(glm::dvec3 p, const LeafNumbers& k) { return glm::dot(glm::dvec3(k[0], k[1], k[2]), p) - k[3]; }

double distanceOfTorus(glm::dvec3 p, const LeafNumbers& k) {
    const double around = std::hypot(p.x, p.z);
    if (around == 0) return std::hypot(k[0], p.y) - k[1];
    return glm::length(p - glm::dvec3(p.x, 0, p.z) * (k[0] / around)) - k[1];
}

double distanceOfCylinder(glm::dvec3 p, const LeafNumbers& k) {
    const double half = k[1] / 2, round = std::min({k[2], k[0], half});
    return fromRectangle(std::hypot(p.x, p.z) - (k[0] - round), std::fabs(p.y) - (half - round)) - round;
}

double distanceOfCapsule(glm::dvec3 p, const LeafNumbers& k) {
    return glm::length(p - glm::dvec3(0, std::clamp(p.y, -k[1] / 2, k[1] / 2), 0)) - k[0];
}

// The outline in the half-plane of radius and height: base, side and top.
double distanceOfCone(glm::dvec3 p, const LeafNumbers& k) {
    const double half = k[2] / 2;
    const glm::dvec2 q{std::hypot(p.x, p.z), p.y}, base{k[0], -half}, top{k[1], half};
    const double nearest = std::min({fromSegment(q, {0, -half}, base), fromSegment(q, base, top), fromSegment(q, {0, half}, top)});
    const bool inside = std::fabs(q.y) < half && q.x < k[0] + (k[1] - k[0]) * (q.y + half) / k[2];
    return inside ? -nearest : nearest;
}

// The documented bound: the unit ball's distance in the stretched space, by the least radius.
double distanceOfEllipsoid(glm::dvec3 p, const LeafNumbers& k) {
    const double least = std::min({k[0], k[1], k[2]});
    return least * std::hypot(p.x / k[0], p.y / k[1], p.z / k[2]) - least;
}

// The octahedron is the ball of the sum of magnitudes. The nearest point of it lowers the coordinates by one amount, those that would
// become negative to 0 (Duchi, Shalev-Shwartz, Singer and Chandra, "Efficient Projections onto the l1-Ball", 2008).
double distanceOfOctahedron(glm::dvec3 p, const LeafNumbers& k) {
    const glm::dvec3 q = glm::abs(p);
    const double over = q.x + q.y + q.z - k[0];
    if (over <= 0) return over / std::sqrt(3.0);
    std::array<double, 3> sorted{q.x, q.y, q.z};
    std::ranges::sort(sorted, std::greater<>());
    double sum = 0, lower = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        sum += sorted[i];
        const double by = (sum - k[0]) / static_cast<double>(i + 1);
        if (sorted[i] > by) lower = by;
    }
    return glm::length(q - glm::max(q - lower, 0.0));
}

// Seen from above the point is turned to the side it lies before, which then faces along x.
double distanceOfPrism(glm::dvec3 p, const LeafNumbers& k) {
    const double turn = 2 * kPi / k[0], angle = std::atan2(p.z, p.x), from_middle = angle - turn * std::round(angle / turn);
    const double away = std::hypot(p.x, p.z), over = away * std::cos(from_middle) - k[1] * std::cos(kPi / k[0]);
    const double beside = std::max(std::fabs(away * std::sin(from_middle)) - k[1] * std::sin(kPi / k[0]), 0.0);
    return fromRectangle(over > 0 ? std::hypot(over, beside) : over, std::fabs(p.y) - k[2] / 2);
}

}  // namespace mb::accuracy
