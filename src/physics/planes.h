#pragma once
// Planes that touch a surface, and what several of them tell of it: where they meet, the round they lie on, the cone of their normals.
#include "core/sdf/tree.h"

#include <optional>
#include <span>

namespace mb {

/// A plane that touches the surface.
struct Plane {
    glm::dvec3 point{0}, normal{0};
};

/// The squares of a box's sides, as shares of its longest.
glm::dvec3 stretchOf(glm::dvec3 sides);

/// The surface's plane next to p, if Newton's steps reach the surface within `reach` of the centre, and there the distance is at most
/// `on`: steps along the gradient of a frame in which the reach is a cube, so that of a needle the side is found from beside it and the tip
/// from above.
std::optional<Plane> planeNear(const Tree& tree, glm::dvec3 p, glm::dvec3 centre, glm::dvec3 reach, double on);

/// Where the planes meet, or of the points where they nearly do the one next to the mean of theirs: least squares, drawn to the
/// mean a little, the mean then moved there.
glm::dvec3 meetingPoint(std::span<const Plane> planes, double drawn = 1e-5);

/// A ball that touches planes from within.
struct Round {
    glm::dvec3 middle{0};
    double radius = 0;
};
/// The one that touches all of them as nearly as it can: n·(p − middle) = radius by least squares, as in meetingPoint(). Along a
/// rounded edge it is the one next to the mean of the points.
Round roundWithin(std::span<const Plane> planes);

struct NormalCone {
    glm::dvec3 normal{0};  // unit, its middle
    double cosine = 1;     // of its half angle
};
/// A narrow cone that holds the planes' normals: its middle goes ever less far towards the one that is farthest from it
/// (Bădoiu, Clarkson, "Smaller Core-Sets for Balls", 2003).
NormalCone coneOf(std::span<const Plane> planes);

/// The deepest place found inside, and how deep it lies, m.
struct Depth {
    glm::dvec3 place{0};
    double depth = 0;

    bool tryAt(const Tree& tree, glm::dvec3 p);
    /// Goes on to deeper places nearby, by ever shorter steps along the axes (Hooke, Jeeves, "Direct Search Solution of Numerical and
    /// Statistical Problems", 1961).
    void climb(const Tree& tree, glm::dvec3 step);
};

}  // namespace mb
