#pragma once
// Where a ball touches a solid: the one way for every shape.
#include "physics/solid.h"

namespace mb {

struct Ball {
    glm::dvec3 centre{0};
    double radius = 0;           // m
};

/// A point of a solid's surface near a ball, in the solid's frame.
struct Touch {
    glm::dvec3 point{0};
    glm::dvec3 normal{0, 1, 0};  // unit, out of the solid, towards the ball's centre
    double gap = 0;              // m between the ball's surface and the point; negative: overlap
};

struct FreeGap {
    double free = INFINITY;      // m from the ball's surface on that are certain to hold no point besides those found
    double room = INFINITY;      // what the distances alone prove to be free, whatever the search found; negative in an overlap
};

/// Appends the points of the solid that are local minima of the distance to the ball's centre, nearer than `margin` to its
/// surface. A ball in a corner gets one for each wall. For a centre inside the solid, the way out.
FreeGap addTouches(const Solid& solid, const Ball& ball, double margin, std::vector<Touch>& io_touches, std::uint64_t& io_evaluations);

/// Sorts them, the nearest first, and leaves out those that a nearer one's tangent plane hides, so that a ball rolls over the
/// seam of two tiles as over one.
void keepUnhidden(std::vector<Touch>& io_touches, double radius);

}  // namespace mb
