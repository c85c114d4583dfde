#pragma once
// What a ray meets, by closed forms in double: a solid is the intervals of the ray that lie inside it; union and difference
// act on the intervals (Roth, "Ray Casting for Modeling Solids", 1982). No distance function is involved.
#include "bench/scenes.h"

#include <optional>

namespace mb::bench {

/// Where a ray enters and leaves.
struct Span {
    double enter, leave;
};
/// In order and apart from one another.
using Spans = std::vector<Span>;

Spans unite(Spans a, const Spans& b);
Spans subtract(const Spans& a, const Spans& b);
/// The intervals of the whole ray, behind its origin too. Blends are not known to it.
Spans spansOf(const Part& part, const Ray& ray);

struct Hit {
    double t = 0;     // m
    int object = -1;  // of Model::objects
};
/// The first surface from the origin as far as the model's rays go: of a ray that starts inside a solid, where it leaves.
std::optional<Hit> firstHit(const Model& model, const Ray& ray);

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
/// Takes intervals, and where the model blends, which has no closed form, the distance in double (core/sdf/raycast.h). The
/// stride grows with the number of primitives, so that it takes seconds.
TruthPicture truthOf(const Model& model, glm::ivec2 size);
TruthPicture truthOf(const Model& model, glm::ivec2 size, int stride);

}  // namespace mb::bench
