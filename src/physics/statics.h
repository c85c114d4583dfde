#pragma once
// What does not move, as the balls meet it: for a ball, the points of the static shapes it touches. One way for every
// shape; a floor is a shape like any other. Many shapes, and shapes of many leaves, are found through grids.
#include "core/sdf/grid.h"

#include <memory>

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
    /// The top-level objects `wanted` says yes to. Those that cannot be evaluated are left out, and named in notes. What was
    /// there before saves work where little has changed.
    StaticField(const Scene& scene, const std::function<bool(std::size_t)>& wanted, std::vector<std::string>& io_notes, const StaticField* before = nullptr);

    /// The points that are local minima of the distance to the ball's centre, nearer than `margin` to its surface,
    /// nearest first; one that a nearer point's tangent plane hides is left out, so that a ball rolls over the seam of
    /// two tiles as over one. A ball in a corner gets one for each wall. For a centre inside a solid, the way out.
    /// Returns a gap that is certain to be free: at most that of the nearest point. `out_room`, if asked for, is what the
    /// distances alone prove to be free, whatever the search for points found: negative in an overlap.
    double touches(glm::dvec3 centre, double radius, double margin, std::vector<Touch>& out, double* out_room = nullptr) const;

    std::uint64_t evaluations() const { return evaluations_; }
    bool empty() const { return solids_.empty(); }

private:
    struct Solid {
        Tree tree;
        Box box;
        std::vector<signed char> side;  // of each leaf: 1 as it is, −1 taken away, 0 unused
        bool blended = false;
        std::shared_ptr<const Grid> grid;  // of one of many leaves
    };
    struct Search;
    std::vector<std::size_t> solidsNear(glm::dvec3 centre, double reach) const;

    std::vector<Solid> solids_;
    std::shared_ptr<const Grid> grid_;       // of them all together, where they are many
    std::vector<std::size_t> solid_of_;      // by a leaf's number in that grid
    mutable std::uint64_t evaluations_ = 0;  // of a solid's whole tree, or as much work
};

}  // namespace mb
