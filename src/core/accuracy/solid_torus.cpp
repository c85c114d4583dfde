// A ray and a torus. Squaring the torus's equation twice gives a quartic in t, whose roots are those of the torus and, where the tube
// is wider than the ring, those of the lemon within it. Between two turning points of the quartic there is one root at most; which of
// them are the torus's, and where exactly, its true function says.
#include "core/accuracy/roots.h"
#include "core/accuracy/solids.h"

#include <glm/geometric.hpp>

namespace mb::accuracy {
namespace {

struct Tube {
    double major, minor;
    double around(glm::dvec3 p) const { return std::sqrt(p.x * p.x + p.z * p.z); }
    double operator()(glm::dvec3 p) const { return std::hypot(around(p) - major, p.y) - minor; }
    glm::dvec3 normal(glm::dvec3 p) const {
        const double r = around(p), out = r > 0 ? (r - major) / r : 0;
        return glm::normalize(glm::dvec3(p.x * out, p.y, p.z * out));
    }
};

/// The turning points of (|p|² + M² − m²)² − 4M²(x² + z²): the roots of its derivative, divided by 4.
Roots turningPoints(const LocalRay& ray, double major, double minor, double lo, double hi) {
    const glm::dvec3 o = ray.origin, d = ray.direction;
    const double b = glm::dot(o, d), k = glm::dot(o, o) + (major - minor) * (major + minor), m = 2 * major * major;
    const std::array<double, 4> derivative{b * k - m * (o.x * d.x + o.z * d.z), 2 * b * b + k - m * (d.x * d.x + d.z * d.z), 3 * b, 1};
    return realRoots(derivative, lo, hi);
}

}  // namespace

void insideTorus(const LocalRay& ray, double major, double minor, Inside& inside) {
    // All of it lies within a ball; a little more, so that the ends are outside for certain.
    const double b = -glm::dot(ray.origin, ray.direction), miss = glm::length(ray.at(b)), radius = 1.001 * (major + minor);
    if (miss >= radius) return;
    const double half = std::sqrt((radius - miss) * (radius + miss));
    const Tube tube{major, minor};
    const auto along = [&](double t) { return tube(ray.at(t)); };
    const Roots turns = turningPoints(ray, major, minor, b - half, b + half);

    Interval open;
    double from = b - half;
    bool within = false;
    for (std::size_t i = 0; i <= turns.count; ++i) {
        const double to = i < turns.count ? turns.at[i] : b + half;
        const bool now = i < turns.count && along(to) < 0;
        if (now != within) {
            const double t = halve(along, from, to, within);
            const End end{t, tube.normal(ray.at(t)), -1};  // on its own: g++ 12 assigns a braced list to a chosen one wrongly
            (now ? open.enter : open.leave) = end;
            if (!now) inside.add(open);
        }
        from = to, within = now;
    }
}

}  // namespace mb::accuracy
