#pragma once
// The point of a surface that is nearest to a given one. A tree's value is only a bound on its distance (near the rim of
// an intersection it is less than half of it), so contacts are measured to points that lie on the surface.
#include "core/sdf/tree.h"

#include <span>

namespace mb {

/// Distance and gradient of one leaf alone.
Slope slope(const Leaf& leaf, glm::dvec3 p);

/// One smooth surface among those that must all be 0 at the point looked for: a leaf's, or the whole tree's.
struct Surface {
    const Leaf* leaf = nullptr;
    const Tree* tree = nullptr;
};

struct ClosestPoint {
    glm::dvec3 point{0};
    /// How c − point is made of the surfaces' gradients. On a convex edge each pushes outwards.
    std::array<double, 3> shares{};
};

/// A point where all of one to three surfaces are 0 and whose distance to c is a local minimum of theirs: on a face, on
/// the curve where two cut one another, or at the corner of three. Nothing where the search finds none, or where two of
/// the gradients are parallel on its way (`parallel`, if not null, says so). `scale` is the size of what asks, a ball's radius: strides are of its order.
std::optional<ClosestPoint> closestPoint(std::span<const Surface> surfaces, glm::dvec3 c, glm::dvec3 start, double scale,
                                         std::uint64_t& io_evaluations, bool* parallel = nullptr);

/// Some point near `start` where all of the surfaces are 0.
std::optional<ClosestPoint> pointOn(std::span<const Surface> surfaces, glm::dvec3 c, glm::dvec3 start, double scale,
                                    std::uint64_t& io_evaluations);

}  // namespace mb
