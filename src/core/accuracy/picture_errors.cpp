#include "core/accuracy/picture_errors.h"

#include "core/measure/srgb.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace mb {
namespace {

constexpr int kHit = 1, kUndecided = 2;  // of Channels::state
int stateOf(const Channels& c, std::size_t i) { return static_cast<int>(c.state[i]); }

/// The angle between two directions of unit length; its small values are not lost to a cosine.
double degreesBetween(glm::dvec3 a, glm::dvec3 b) { return glm::degrees(2 * std::atan2(glm::length(a - b), glm::length(a + b))); }

struct MeanSquare {
    double sum = 0, squares = 0, n = 0;
    void add(double x) { sum += x * x, squares += x * x * x * x, ++n; }
    double root() const { return n > 0 ? std::sqrt(sum / n) : 0; }
    /// The standard error of the root: its square's, over twice the root.
    double off() const {
        if (n < 2 || sum <= 0) return 0;
        const double mean = sum / n, variance = std::max(squares / n - mean * mean, 0.0);
        return std::sqrt(variance / n) / (2 * std::sqrt(mean));
    }
};

}  // namespace

double difference(const glm::vec3& light, const glm::dvec3& shown) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
        const double d = toSrgb(static_cast<double>(light[c])) - shown[c];
        sum += d * d;
    }
    return std::sqrt(sum / 3);
}

bool isWrong(const DrawnPicture& drawn, const TruePicture& truth, std::size_t i) {
    const bool hit = truth.object[i] >= 0;
    const int state = stateOf(drawn.channels, i);
    if (state == kUndecided || (state == kHit) != hit) return true;
    if (!hit) return false;
    if (static_cast<int>(drawn.channels.object[i]) != truth.object[i]) return true;
    return !(std::fabs(static_cast<double>(drawn.channels.depth[i]) - truth.depth[i]) <= kOtherSurface * truth.depth[i]);
}

double colorError(const DrawnPicture& drawn, const TruePicture& truth, std::size_t i) { return difference(drawn.shown[i], truth.color[i]); }
double shadeError(const DrawnPicture& drawn, const TruePicture& truth, std::size_t i) { return difference(drawn.middle[i], truth.middle[i]); }

Values<Error> errorsOf(const DrawnPicture& drawn, const TruePicture& truth, Values<Error>* out_off) {
    MeanSquare color, shade, depth, normal, wrong;
    for (std::size_t i = 0; i < truth.pixels(); ++i) {
        color.add(colorError(drawn, truth, i)), shade.add(shadeError(drawn, truth, i));
        const bool is_wrong = isWrong(drawn, truth, i);
        wrong.add(is_wrong ? 1 : 0);
        if (is_wrong || !truth.smooth[i]) continue;
        depth.add(static_cast<double>(drawn.channels.depth[i]) / truth.depth[i] - 1);
        normal.add(degreesBetween(glm::dvec3(drawn.channels.normal[i]), truth.normal[i]));
    }
    const std::pair<Error, const MeanSquare*> all[] = {{Error::color, &color}, {Error::shade, &shade}, {Error::depth, &depth}, {Error::normal, &normal}};
    Values<Error> errors;
    for (const auto& [error, mean] : all) {
        errors[error] = mean->root();
        if (out_off) (*out_off)[error] = mean->off();
    }
    // A share is a mean, not the root of one.
    const double share = wrong.n > 0 ? wrong.sum / wrong.n : 0;
    errors[Error::state] = share;
    if (out_off) (*out_off)[Error::state] = wrong.n > 0 ? std::sqrt(share * (1 - share) / wrong.n) : 0;
    return errors;
}

std::string failureOf(const DrawnPicture& drawn, const TruePictureWork& truth) {
    const auto broken = [](const glm::vec3& c) { return !std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z); };
    if (const auto n = std::ranges::count_if(drawn.shown, broken); n > 0) return fmt::format("the color of {} pixels is no number", n);
    const std::size_t pixels = truth.picture().pixels(), most = std::max<std::size_t>(1, static_cast<std::size_t>(kMostUndecided * static_cast<double>(pixels)));
    std::size_t undecided = 0;
    for (std::size_t i = 0; i < pixels && undecided <= most; ++i)
        undecided += stateOf(drawn.channels, i) == kUndecided && !truth.isTooCloseToTell(i);
    if (undecided <= most) return {};
    const auto all = std::ranges::count(drawn.channels.state, static_cast<float>(kUndecided));
    return fmt::format("{} of {} pixels are undecided ({:.3f} %)", all, pixels, 100 * static_cast<double>(all) / static_cast<double>(pixels));
}

}  // namespace mb
