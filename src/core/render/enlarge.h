#pragma once
// A picture drawn with fewer pixels than it has, at its size.
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <vector>

namespace mb {

/// The pixels of a picture: it has `size`, and is drawn with `drawn` of them over the same view. It shows every `stride`-th
/// pixel, along x and y, of a picture that is so much larger: with the footprint of that one's pixels, each in the middle of
/// its field of stride by stride.
struct Raster {
    glm::ivec2 size{0}, drawn{0};
    int stride = 1;
};
/// Drawn at that share of its width and height, rounded, and at least a pixel.
Raster rasterOf(glm::ivec2 size, double scale = 1, int stride = 1);

/// The picture of linear colours at another size: bilinear between the pixels' centres, which stay where they are in the view.
std::vector<glm::vec3> enlarged(std::vector<glm::vec3> picture, glm::ivec2 from, glm::ivec2 to);

/// The same of what cannot be blended: the nearest pixel's.
template <class T> std::vector<T> enlargedByNearest(std::vector<T> picture, glm::ivec2 from, glm::ivec2 to) {
    if (from == to) return picture;
    const auto nearest = [](int i, int few, int many) { return std::min(static_cast<int>((i + 0.5) * few / many), few - 1); };
    std::vector<T> large;
    large.reserve(static_cast<std::size_t>(to.x) * static_cast<std::size_t>(to.y));
    for (int y = 0; y < to.y; ++y)
        for (int x = 0; x < to.x; ++x)
            large.push_back(picture[static_cast<std::size_t>(nearest(y, from.y, to.y)) * static_cast<std::size_t>(from.x) +
                                    static_cast<std::size_t>(nearest(x, from.x, to.x))]);
    return large;
}

}  // namespace mb
