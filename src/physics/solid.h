#pragma once
// A solid as contacts see it, in a frame of its own: a static object in the world's, a body's shape about its centre of mass.
#include "core/sdf/grid.h"
#include "physics/surface.h"

#include <memory>

namespace mb {

struct Solid {
    Tree tree;
    Box box;
    double radius = 0;                 // of the ball about the frame's origin that holds the box, m; infinite where that is
    double inner = 0;                  // how deep the field is at its deepest among the samples, m: half the thickness
    std::vector<signed char> side;     // of each leaf: 1 as it is, -1 taken away, 0 where operators move its surface
    const Leaf* lone() const { return convex ? &tree.leaves[0] : nullptr; }  // all there is of it, if that is convex and exact

    bool convex = false;
    bool blended = false;              // the surface lies elsewhere than on the leaves' own, somewhere
    std::shared_ptr<const Grid> grid;  // of one of many leaves
    SurfacePoints points;              // none, where the box is infinite

    /// The field's bound at p, and with its gradient.
    double at(glm::dvec3 p) const { return grid ? grid->distance(p) : distance<double>(tree, {p.x, p.y, p.z}); }
    Slope slopeAt(glm::dvec3 p) const;
};

/// Whether a slope has a direction, and the way out of a solid along it: unit, upwards where there is none.
bool isSloping(const Slope& slope);
glm::dvec3 wayOutAlong(const Slope& slope);

/// `with_points`: something whose shape is no ball may meet it. `before`: what stood there, whose grid saves work.
Solid makeSolid(Tree tree, bool with_points, const Solid* before = nullptr);

/// The grid of a tree, made from that of what stood there before, if anything did. (Copies of a world share theirs.)
std::shared_ptr<const Grid> gridOf(const Tree& tree, Grid::Exact exact, const Grid* before);

inline constexpr std::size_t kMany = 32;  // solids, or leaves of one: fewer are asked one after the other

/// Where a solid is: from its frame to the world's.
struct Pose {
    glm::dvec3 position{0};
    glm::dmat3 rotation{1};
    glm::dvec3 toWorld(glm::dvec3 p) const { return position + rotation * p; }
    glm::dvec3 fromWorld(glm::dvec3 p) const { return (p - position) * rotation; }  // the transpose, times the vector
};

}  // namespace mb
