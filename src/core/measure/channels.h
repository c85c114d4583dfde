#pragma once
// What a picture says beside its colors.
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace mb {

/// A picture's other channels, size.x · size.y of each, the top row first; what the command line calls its AOVs.
struct Channels {
    glm::ivec2 size{0};
    std::vector<float> depth;      // metres along the ray; +inf where nothing was hit
    std::vector<glm::vec3> normal; // world; 0 where nothing was hit
    std::vector<float> object;     // the top-level object's number; −1 for none
    std::vector<float> steps;      // evaluations of the primary ray
    std::vector<float> state;      // 0 miss, 1 hit, 2 undecided
};

}  // namespace mb
