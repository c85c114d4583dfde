#include "core/render/enlarge.h"

#include <glm/common.hpp>

#include <cmath>

namespace mb {
namespace {

/// The two pixels that a place lies between, held to the edge, and the second one's share.
struct Between {
    std::size_t first, second;
    float share;
};
Between between(int i, int few, int many) {
    const double at = std::clamp((i + 0.5) * few / many - 0.5, 0.0, few - 1.0), first = std::floor(at);
    return {static_cast<std::size_t>(first), static_cast<std::size_t>(std::min(first + 1, few - 1.0)), static_cast<float>(at - first)};
}

}  // namespace

Raster rasterOf(glm::ivec2 size, double scale, int stride) {
    const auto side = [&](int whole) { return std::max(static_cast<int>(std::lround(whole * scale)), std::min(whole, 1)); };
    return {size, {side(size.x), side(size.y)}, stride};
}

std::vector<glm::vec3> enlarged(std::vector<glm::vec3> picture, glm::ivec2 from, glm::ivec2 to) {
    if (from == to) return picture;
    const auto width = static_cast<std::size_t>(from.x);
    std::vector<glm::vec3> large;
    large.reserve(static_cast<std::size_t>(to.x) * static_cast<std::size_t>(to.y));
    for (int y = 0; y < to.y; ++y) {
        const Between row = between(y, from.y, to.y);
        for (int x = 0; x < to.x; ++x) {
            const Between column = between(x, from.x, to.x);
            const auto across = [&](std::size_t r) { return glm::mix(picture[r * width + column.first], picture[r * width + column.second], column.share); };
            large.push_back(glm::mix(across(row.first), across(row.second), row.share));
        }
    }
    return large;
}

}  // namespace mb
