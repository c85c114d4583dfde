#pragma once
// Which balls may meet: the pairs whose boxes overlap.
#include <glm/vec3.hpp>

#include <span>
#include <utility>
#include <vector>

namespace mb {

/// A ball and how far around its centre it may reach.
struct Reach {
    glm::dvec3 centre{0};
    double reach = 0;
};

/// Every pair (i < j) whose boxes overlap, sorted: by sweeping along the axis the centres are spread most widely on.
/// The same set as comparing each with each. Source: Baraff, "Dynamic Simulation of Non-Penetrating Rigid Bodies" (1992).
std::vector<std::pair<int, int>> overlappingPairs(std::span<const Reach> balls);

inline bool overlap(const Reach& a, const Reach& b) {
    const double r = a.reach + b.reach;
    const glm::dvec3 d = a.centre - b.centre;
    return d.x <= r && -d.x <= r && d.y <= r && -d.y <= r && d.z <= r && -d.z <= r;
}

}  // namespace mb
