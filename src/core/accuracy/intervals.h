#pragma once
// A solid as a ray sees it: the stretches of the ray that lie inside, and what union, intersection and difference make of two
// such lists (Roth, "Ray Casting for Modeling Solids", 1982).
#include <glm/vec3.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace mb::accuracy {

/// One end of a stretch: the surface there.
struct End {
    double t = 0;            // m along the ray
    glm::dvec3 normal{0};    // of unit length, out of the solid
    int leaf = -1;
};
struct Interval {
    End enter, leave;
    bool isEmpty() const { return !(enter.t < leave.t); }
};
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline Interval wholeLine() { return {{-kInfinity, {}, -1}, {kInfinity, {}, -1}}; }
inline Interval nothing() { return {{kInfinity, {}, -1}, {-kInfinity, {}, -1}}; }

/// Disjoint and in ascending order.
using Intervals = std::vector<Interval>;

enum class SetOperation { unite, intersect, subtract };

/// Surfaces nearer to one another along the ray than this are one: the first leaf's. `reach` is how far the ray's start is from the
/// origin.
inline double tieAt(double t, double reach) { return std::isfinite(t) ? 1e-9 * (reach + std::fabs(t)) : 0; }

/// result = a ∘ b; it may be neither of them. All of b's leaves come after a's. What would be left between two surfaces that are one is
/// nothing: neither a skin of no thickness nor a slit of no width.
void combine(SetOperation operation, const Intervals& a, const Intervals& b, double reach, Intervals& result);

}  // namespace mb::accuracy
