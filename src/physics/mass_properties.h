#pragma once
// How much matter a shape holds, where its centre is, and how it resists being turned.
#include "core/sdf/tree.h"

namespace mb {

struct MassProperties {
    double volume = 0;             // m³
    glm::dvec3 centre{0};          // of mass, in the tree's frame, m
    glm::dmat3 inertia{0};         // about the centre of mass, along the tree's axes, for density 1: m⁵, which is kg·m² per kg/m³
    double uncertain = 0;          // m³: the volume is within this of the truth, and in practice far nearer; 0: a closed form
    std::uint64_t evaluations = 0;
};

/// Of a bounded tree. A single primitive's are its row's closed form; all others' are integrated, in at most about that many
/// cells. A tree that holds nothing has no volume and the centre 0; the volume is infinite, and all else 0, where the bounds are.
MassProperties massProperties(const Tree& tree, std::size_t cells = 30'000);

/// The same by the integral alone, an octree over the bounds: the distance at a cell's centre (whose slope is at most 1), or else
/// its interval bounds, tell which cells are wholly inside or outside. The others are cut, level by level. Of the last ones counts
/// what lies behind the plane of the centre's distance and slope; a wall or a gap thinner than a cell is two planes. That errs by
/// the square of a cell's size, and so the last two levels give a third value nearer than both.
/// With the default a solid of one to a few primitives whose lengths are within 1:4 has its volume within 1e-3, its inertia (of the
/// mean moment) within 2e-3 and its centre (of the radius of gyration) within 1e-3; without edges, within a tenth of that.
/// What is symmetric but for that error is made so: a centre that close to the bounds' middle, or to the frame's origin, lies
/// there, along each axis on its own; a product of inertia that small is 0; moments that close to one another are equal.
MassProperties integrateMass(const Tree& tree, std::size_t cells = 30'000);

}  // namespace mb
