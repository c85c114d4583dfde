#pragma once
// A ray against a tree or its grid, in double: what the shader's march finds, for picking and for tests. Three outcomes, as there: a
// hit is a change of sign, a miss is proved by spheres of emptiness that overlap all the way, all else is undecided.
#include "core/sdf/grid.h"

namespace mb {

enum class RayState { miss, hit, undecided };

struct RayEnd {
    RayState state = RayState::undecided;
    double t = 0;           // metres along the ray: of the hit, else of the closest approach
    double closest = 0;     // of a ray that did not hit: the distance there, to what it may have hit
    int leaf = -1;          // of Tree::leaves, whose surface is nearest at t; −1: the tree is empty
    std::size_t index = 0;  // that leaf's object in Scene::objects
    int evaluations = 0;
};

/// Follows the ray as far as max_distance. The direction may have any length but 0; a ray with a part that is not finite
/// is undecided. One that starts inside a solid meets its inside.
RayEnd raycast(const Tree& tree, glm::dvec3 origin, glm::dvec3 direction, double max_distance);
/// The same through a grid of the tree: a few primitives a step, however many there are. The closest approach of a ray that
/// did not hit may be a bound.
RayEnd raycast(const Grid& grid, glm::dvec3 origin, glm::dvec3 direction, double max_distance);

}  // namespace mb
