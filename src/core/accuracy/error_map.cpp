#include "core/accuracy/error_map.h"

#include "core/measure/srgb.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace mb {
namespace {

/// A dim grey picture under the tint of its error.
glm::vec3 tinted(const glm::vec3& c, double error) {
    const float grey = 0.25f * std::clamp(0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z, 0.0f, 1.0f);
    const Tint tint = tintOf(error);
    return glm::mix(glm::vec3(grey), tint.color, tint.share);
}

}  // namespace

Tint tintOf(double error) {
    if (!(error > kFaintest)) return {};
    const auto share = static_cast<float>(std::clamp(std::log(error / kFaintest) / std::log(kStrongest / kFaintest), 0.0, 1.0));
    const glm::vec3 yellow{1.0f, 0.75f, 0.05f}, red{0.85f, 0.02f, 0.0f};
    return {glm::mix(yellow, red, share), 0.15f + 0.85f * share};
}

std::vector<glm::vec3> errorMap(const DrawnPicture& drawn, const TruePicture& truth, Error error) {
    const bool shades = error == Error::shade;
    std::vector<glm::vec3> map(truth.pixels());
    for (std::size_t i = 0; i < map.size(); ++i) {
        if (drawn.channels.state[i] == 2) map[i] = kUndecidedTint;
        else if (isWrong(drawn, truth, i)) map[i] = kWrongTint;
        else map[i] = shades ? tinted(drawn.middle[i], shadeError(drawn, truth, i)) : tinted(drawn.shown[i], colorError(drawn, truth, i));
    }
    return map;
}

std::vector<glm::vec3> differenceMap(std::span<const glm::vec3> shown, std::span<const glm::vec3> truth) {
    std::vector<glm::vec3> map(shown.size());
    for (std::size_t i = 0; i < map.size(); ++i) {
        const glm::dvec3 light(truth[i]);
        map[i] = tinted(shown[i], difference(shown[i], {toSrgb(light.x), toSrgb(light.y), toSrgb(light.z)}));
    }
    return map;
}

}  // namespace mb
