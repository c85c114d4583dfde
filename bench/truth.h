#pragma once
// What a picture of a model truly shows: the oracle's rays (core/accuracy/oracle.h), which know no distance function.
#include "bench/scenes.h"

#include <optional>

namespace mb::bench {

struct Hit {
    double t = 0;     // m
    int object = -1;  // of Model::objects
};

/// The hits of every stride-th pixel of every stride-th row.
struct TruthPicture {
    glm::ivec2 size{0};
    int stride = 1;
    std::vector<std::optional<Hit>> hits;
    const char* reference = "intervals in double";
    /// The pixel a hit belongs to, as an index into the whole picture.
    std::size_t pixel(std::size_t i) const {
        const std::size_t across = static_cast<std::size_t>((size.x + stride - 1) / stride);
        return (i / across * static_cast<std::size_t>(size.x) + i % across) * static_cast<std::size_t>(stride);
    }
};
/// Where the model blends the surfaces are marched for, densely. The stride grows with the number of primitives, so that it takes
/// seconds.
TruthPicture truthOf(const Model& model, glm::ivec2 size);
TruthPicture truthOf(const Model& model, glm::ivec2 size, int stride);

}  // namespace mb::bench
