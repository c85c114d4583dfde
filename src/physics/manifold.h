#pragma once
// Where two shapes touch: the surface points of each in the field of the other, refined to the deepest places, and of those the
// few that hold the rest.
#include "physics/solid.h"

#include <span>

namespace mb {

/// A solid and where it is; `number` tells it from the others a body may meet.
struct Placed {
    const Solid* solid = nullptr;
    Pose pose;
    std::uint32_t number = 0;
};

struct ManifoldPoint {
    glm::dvec3 point{0};        // on the one whose surface point it is, in the world
    glm::dvec3 normal{0};       // unit, out of the other solid, towards a
    double gap = 0;             // m; negative: overlap
    std::uint64_t feature = 0;  // the surface point it was found from: the same from step to step while that lasts
    std::size_t other = 0;      // which of `others`
};

struct Manifold {
    std::vector<ManifoldPoint> points;
    double room = 0;            // m: where there are no points, how far apart the shapes are at least
};

/// The points where `a` is nearer than `margin` to one of the others, or overlaps it: of each group of like normals the
/// outermost ones and the deepest. Of a point of a's that several others are near to, the nearest counts, so that it slides
/// over the seam of two tiles as over one. An overlap deeper than half the thinner one's thickness may be pushed out the wrong way.
Manifold manifold(const Placed& a, std::span<const Placed> others, double margin, std::uint64_t& io_evaluations);

}  // namespace mb
