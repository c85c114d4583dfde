#include "core/accuracy/reference.h"

#include "core/measure/parallel.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace mb {
namespace {

constexpr double kSmoothCosine = 0.9659258262890683;  // of 15°: what a smooth surface's normal turns by within a pixel at most
constexpr int kMiddleRays = 256;                      // to a lamp or the sky, from the one point of a pixel's middle
constexpr double kFloatUlps = 4 * 1.1920929e-7;       // four units in the last place, of 1

Ray rayAt(const Frame& frame, int x, int y, glm::dvec2 place) {
    const glm::dvec2 middle = (glm::dvec2(x, y) + 0.5) * static_cast<double>(frame.stride);
    return cameraRay(frame.camera, frame.size * frame.stride, middle + place);
}

/// Samples of a pixel's area, and what they add up to.
struct Area {
    glm::dvec3 sum{0}, halves[2]{glm::dvec3{0}, glm::dvec3{0}}, least{1e300}, most{-1e300};
    int n = 0;
    glm::dvec3 mean() const { return sum / static_cast<double>(n); }
};

double largest(glm::dvec3 v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

}  // namespace

TruePictureWork::TruePictureWork(Scene scene, const Frame& frame)
    : scene_(std::move(scene)), oracle_(scene_), radiance_(oracle_, scene_) {
    picture_.frame = frame;
    const std::size_t pixels = static_cast<std::size_t>(frame.size.x) * static_cast<std::size_t>(frame.size.y);
    picture_.depth.resize(pixels, std::numeric_limits<double>::infinity()), picture_.normal.resize(pixels, glm::dvec3{0});
    picture_.object.resize(pixels, -1), picture_.smooth.resize(pixels, 0), picture_.color.resize(pixels, glm::dvec3{0}), picture_.middle.resize(pixels, glm::dvec3{0});
    noise_.resize(static_cast<std::size_t>(frame.size.y), 0);
    for (const Leaf& leaf : oracle_.tree().leaves) {
        const Box box = leaf.primitive->extent(leaf.numbers);
        if (!isFinite(box)) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) largest_ = std::max({largest_, -box.lo[axis], box.hi[axis]});
    }
}

bool TruePictureWork::isSmooth(int x, int y, const TrueHit& middle) const {
    for (int k = 0; k < 9; ++k) {
        const glm::dvec2 place = 0.5 * glm::dvec2(k % 3 - 1, k / 3 - 1);
        const std::optional<TrueHit> hit = k == 4 ? middle : oracle_.firstHit(rayAt(picture_.frame, x, y, place), scene_.render.max_distance);
        if (!hit || hit->object != middle.object || glm::dot(hit->normal, middle.normal) <= kSmoothCosine) return false;
    }
    return true;
}

void TruePictureWork::pixel(int x, int y, double& io_noise) {
    const Frame& frame = picture_.frame;
    const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.size.x) + static_cast<std::size_t>(x);
    const Radiance::Seen at_middle = radiance_.along(rayAt(frame, x, y, {0, 0}), {kMiddleRays, 0.5});
    const std::optional<TrueHit>& middle = at_middle.hit;
    picture_.middle[i] = radiance_.shown(at_middle.color);
    if (middle) {
        picture_.depth[i] = middle->t, picture_.normal[i] = middle->normal, picture_.object[i] = middle->object;
        picture_.smooth[i] = isSmooth(x, y, *middle);
    }
    const auto halvesApart = [&](const Area& area) {
        const double half = 0.5 * area.n;
        return radiance_.shown(area.halves[0] / half) - radiance_.shown(area.halves[1] / half);
    };

    // Samples of the R2 sequence (Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018): an edge along a row of a
    // square of samples would be off by half a row. The first and the second half of them are each a picture of its own.
    const auto sampled = [&](int side) {
        Area area;
        for (int k = 0; k < side * side; ++k) {
            const glm::dvec2 place = glm::fract(0.5 + (k + 0.5) * glm::dvec2(0.75487766624669276, 0.56984029099805327)) - 0.5;
            const double turn = std::fmod((k + 0.5) * 0.61803398874989485 + static_cast<double>(i) * 0.75487766624669276, 1.0);
            const Radiance::Seen seen = radiance_.along(rayAt(frame, x, y, place), {16, turn});
            area.sum += seen.color, area.halves[2 * k / (side * side)] += seen.color;
            area.least = glm::min(area.least, seen.color), area.most = glm::max(area.most, seen.color);
            ++area.n;
        }
        return area;
    };
    // More of them where they differ, and more again where their two halves do.
    Area area = sampled(kFew);
    if (largest(radiance_.shown(area.most) - radiance_.shown(area.least)) > kDiffer) area = sampled(kMany);
    if (largest(halvesApart(area)) > kDiffer) area = sampled(kMost);
    picture_.color[i] = radiance_.shown(area.mean());
    const glm::dvec3 apart = 0.5 * halvesApart(area);  // the two halves are as far apart as twice the error of their mean
    io_noise += glm::dot(apart, apart) / 3;
}

void TruePictureWork::row(int y, double& io_noise) {
    for (int x = 0; x < picture_.frame.size.x; ++x) pixel(x, y, io_noise);
}

void TruePictureWork::conclude() {
    double sum = 0;
    for (const double n : noise_) sum += n;
    picture_.noise = picture_.pixels() > 0 ? std::sqrt(sum / static_cast<double>(picture_.pixels())) : 0;
}

double TruePictureWork::progress() const { return static_cast<double>(next_row_) / picture_.frame.size.y; }

bool TruePictureWork::step(double ms) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    while (next_row_ < picture_.frame.size.y && std::chrono::duration<double, std::milli>(Clock::now() - start).count() < ms) {
        row(next_row_, noise_[static_cast<std::size_t>(next_row_)]);
        if (++next_row_ == picture_.frame.size.y) conclude();
    }
    return next_row_ < picture_.frame.size.y;
}

void TruePictureWork::finish(const std::function<void(double)>& show) {
    const int rows = picture_.frame.size.y;
    inParallel(coresOf(), static_cast<std::size_t>(std::max(rows - next_row_, 0)), [&](std::size_t i, bool here) {
        const int y = next_row_ + static_cast<int>(i);
        row(y, noise_[static_cast<std::size_t>(y)]);
        if (here && show) show(static_cast<double>(y) / rows);
    });
    if (next_row_ < rows) next_row_ = rows, conclude();
}

bool TruePictureWork::isTooCloseToTell(std::size_t pixel) const {
    const Frame& frame = picture_.frame;
    const int x = static_cast<int>(pixel % static_cast<std::size_t>(frame.size.x)), y = static_cast<int>(pixel / static_cast<std::size_t>(frame.size.x));
    const Ray ray = rayAt(frame, x, y, {0, 0});
    const auto ends = [&](const Ray& near) { return oracle_.firstHit(near, scene_.render.max_distance); };
    const std::optional<TrueHit> middle = ends(ray);
    for (int k = 0; k < 8; ++k) {
        const double angle = k * 0.78539816339744831;
        const glm::dvec3 side = std::fabs(ray.direction.y) < 0.9 ? glm::dvec3{0, 1, 0} : glm::dvec3{1, 0, 0};
        const glm::dvec3 u = glm::normalize(glm::cross(ray.direction, side)), v = glm::cross(ray.direction, u);
        const glm::dvec3 off = kFloatUlps * (std::cos(angle) * u + std::sin(angle) * v);
        const std::optional<TrueHit> other = ends({ray.origin + largest_ * off, glm::normalize(ray.direction + off)});
        if (middle.has_value() != other.has_value()) return true;
        if (middle && std::fabs(other->t - middle->t) > 1e-3 * middle->t) return true;
    }
    return false;
}

}  // namespace mb
