#pragma once
// What does not move, as the balls meet it: for a ball, the points of the static shapes it touches. One way for every
// shape; a floor is a shape like any other.
#include "core/sdf/tree.h"

namespace mb {

/// A point of a static surface near a ball.
struct Touch {
    glm::dvec3 point{0};
    glm::dvec3 normal{0, 1, 0};  // unit, out of the solid, towards the ball's centre
    double gap = 0;              // m between the ball's surface and the point; negative: overlap
};

class StaticField {
public:
    StaticField() = default;
    /// The top-level objects `wanted` says yes to. Those that cannot be evaluated are left out, and named in notes.
    StaticField(const Scene& scene, const std::function<bool(std::size_t)>& wanted, std::vector<std::string>& io_notes);

    /// The points that are local minima of the distance to the ball's centre, nearer than `margin` to its surface,
    /// nearest first; one that a nearer point's tangent plane hides is left out, so that a ball rolls over the seam of
    /// two tiles as over one. A ball in a corner gets one for each wall. For a centre inside a solid, the way out.
    /// Returns a gap that is certain to be free: at most that of the nearest point.
    double touches(glm::dvec3 centre, double radius, double margin, std::vector<Touch>& out) const;

    std::uint64_t evaluations() const { return evaluations_; }
    bool empty() const { return solids_.empty(); }

private:
    struct Solid {
        Tree tree;
        Box box;
        std::vector<signed char> side;  // of each leaf: 1 as it is, −1 taken away, 0 unused
        bool blended = false;
    };
    struct Search;

    std::vector<Solid> solids_;
    mutable std::uint64_t evaluations_ = 0;  // of a solid's whole tree, or as much work
};

}  // namespace mb
