#pragma once
// Every value of a tree promises that no two points' values differ by more than the points' distance. This looks for a pair
// that breaks the promise, at every node by itself.
#include "core/sdf/tree.h"

namespace mb {

/// The steepest pair found at one node: |f(p) − f(q)| / |p − q|, p and q in the node's own space.
struct Steepest {
    std::size_t object = 0;    // of the node, in Scene::objects
    std::string_view type;     // its type; "union" for the plain union of two parts
    double slope = 0;
    glm::dvec3 p{0}, q{0};
};

/// One for each node that makes a value, in the order of the tape. The pairs are drawn within and around the node's shape,
/// from far apart to neighbours, and are the same for the same seed. Rounding adds at most 1e-9 to a slope.
std::vector<Steepest> steepest(const Tree& tree, std::size_t pairs, std::uint64_t seed);

}  // namespace mb
