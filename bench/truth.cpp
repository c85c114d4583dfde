#include "bench/truth.h"

#include "core/accuracy/oracle.h"

#include <algorithm>
#include <cmath>

namespace mb::bench {

TruthPicture truthOf(const Model& model, glm::ivec2 size) {
    const double spans = model.blends ? 4e6 : 2e8;  // a marched ray takes some ten times as long
    const double asked = static_cast<double>(size.x) * size.y * model.n;
    return truthOf(model, size, std::max(1, static_cast<int>(std::ceil(std::sqrt(asked / spans)))));
}

TruthPicture truthOf(const Model& model, glm::ivec2 size, int stride) {
    TruthPicture truth{size, stride, {}};
    const Oracle oracle(sceneOf(model));
    if (!oracle.isExact()) truth.reference = "formulas in double, marched densely";
    for (int y = 0; y < size.y; y += stride)
        for (int x = 0; x < size.x; x += stride) {
            const std::optional<TrueHit> hit = oracle.firstHit(cameraRay(model.camera, size, {x + 0.5, y + 0.5}), model.far);
            truth.hits.push_back(hit ? std::optional(Hit{hit->t, hit->object}) : std::nullopt);
        }
    return truth;
}

}  // namespace mb::bench
