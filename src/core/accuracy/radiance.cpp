#include "core/accuracy/radiance.h"

#include "core/effects/effect.h"
#include "core/measure/srgb.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace mb {
namespace {

/// Where the key that a row of the table brings stands among a record's extra numbers.
std::size_t slotNamed(std::string_view key) {
    for (const Effect& effect : effects())
        for (const EffectKey& k : effect.keys)
            if (k.name == key) return slotOf(k);
    assert(false);
    return 0;
}
double numberNamed(const Extra& extra, std::string_view key) { return extra[slotNamed(key)]; }

/// Two directions of unit length across a third.
struct Across {
    glm::dvec3 x, y;
};
Across across(glm::dvec3 way) {
    const glm::dvec3 least = std::fabs(way.x) < 0.6 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 1, 0};
    const glm::dvec3 x = glm::normalize(glm::cross(least, way));
    return {x, glm::cross(way, x)};
}

/// Point i of n of a disc of radius 1, each for the same area (Vogel, "A Better Way to Construct the Sunflower Head", 1979).
glm::dvec2 onDisc(int i, TrueRays rays) {
    constexpr double kGoldenAngle = std::numbers::pi * (3 - 2.23606797749978969641);
    const double r = std::sqrt((i + 0.5) / rays.rays), angle = kGoldenAngle * i + 2 * std::numbers::pi * rays.turn;
    return {r * std::cos(angle), r * std::sin(angle)};
}

/// A checkerboard of one metre, moved by a millimetre so that a floor at height 0 is not on a border (SCENE_FORMAT: checker).
bool isSecondField(glm::dvec3 p) {
    constexpr double kInset = 1e-3;
    const double sum = std::floor(p.x - kInset) + std::floor(p.y - kInset) + std::floor(p.z - kInset);
    return std::fabs(std::remainder(sum, 2.0)) > 0.5;
}

}  // namespace

Radiance::Radiance(const Oracle& oracle, const Scene& scene) : oracle_(oracle), scene_(scene) {
    fog_ = numberNamed(scene.world.extra, "fog");
    exposure_ = numberNamed(scene.render.extra, "exposure");
    shadows_ = scene.render.shadow_steps > 0, mirrors_ = scene.render.reflections > 0;
    ao_ = shadows_ ? numberNamed(scene.render.extra, "ao") : 0;
    emission_ = slotNamed("emission"), light_size_ = slotNamed("size");
}

Radiance::Look Radiance::lookAt(const TrueHit& hit, glm::dvec3 at) const {
    Look sum;
    for (const LeafShare& s : oracle_.sharesAt(hit, at)) {
        const Material& m = materialOf(scene_, oracle_.tree().leaves[static_cast<std::size_t>(s.leaf)].material);
        sum.color += s.share * (m.pattern == Pattern::checker && isSecondField(s.at) ? m.color2 : m.color);
        sum.ka += s.share * m.ka, sum.kd += s.share * m.kd, sum.ks += s.share * m.ks;
        sum.kr += s.share * m.kr, sum.c += s.share * m.c, sum.emission += s.share * m.extra[emission_];
    }
    return sum;
}

/// The share of the light's disc, which faces the point, that nothing hides.
double Radiance::visible(const Light& light, double size, const Point& p, TrueRays rays) const {
    if (!shadows_) return 1;
    const glm::dvec3 middle = light.pos - p.position;
    const double far = glm::length(middle);
    if (far <= 0) return 1;
    if (size <= 0) return oracle_.isBlocked({p.position, middle / far}, far) ? 0 : 1;
    const Across disc = across(middle / far);
    int seen = 0;
    for (int i = 0; i < rays.rays; ++i) {
        const glm::dvec2 at = 0.5 * size * onDisc(i, rays);
        const glm::dvec3 way = middle + at.x * disc.x + at.y * disc.y;
        const double length = glm::length(way);
        seen += length <= 0 || !oracle_.isBlocked({p.position, way / length}, length);
    }
    return static_cast<double>(seen) / rays.rays;
}

glm::dvec3 Radiance::fromLight(const Light& light, const Point& p, TrueRays rays) const {
    const glm::dvec3 way = light.pos - p.position;
    const double far = glm::length(way);
    const glm::dvec3 to_light = far > 0 ? way / far : p.normal;
    const double facing = glm::dot(p.normal, to_light);
    if (facing <= 0) return glm::dvec3{0};
    glm::dvec3 shine = p.look.kd * facing * p.look.color;
    const double mirrored = glm::dot(2 * facing * p.normal - to_light, -p.direction);
    if (mirrored > 0) shine += p.look.ks * std::pow(mirrored, p.look.c);
    return visible(light, light.extra[light_size_], p, rays) * light.intensity * (light.color * shine);
}

/// The share of the sky, each direction weighed by its cosine, that nothing nearer than `ao` hides.
double Radiance::openness(const Point& p, TrueRays rays) const {
    if (ao_ <= 0) return 1;
    const Across sky = across(p.normal);
    int open = 0;
    for (int i = 0; i < rays.rays; ++i) {
        const glm::dvec2 at = onDisc(i, rays);
        const double up = std::sqrt(std::max(1 - at.x * at.x - at.y * at.y, 0.0));
        open += !oracle_.isBlocked({p.position, glm::normalize(at.x * sky.x + at.y * sky.y + up * p.normal)}, ao_);
    }
    return static_cast<double>(open) / rays.rays;
}

glm::dvec3 Radiance::sentBack(const Point& p, TrueRays rays) const {
    glm::dvec3 sum = (p.look.ka * openness(p, rays) + p.look.emission) * p.look.color;
    for (const Light& light : scene_.lights) sum += fromLight(light, p, rays);
    return sum;
}

Radiance::Seen Radiance::along(const Ray& ray, TrueRays rays) const {
    Seen seen;
    Ray stretch = ray;
    double weight = 1;
    for (int bounce = 0; bounce <= kMostBounces && weight >= kLeastWeight; ++bounce) {
        const std::optional<TrueHit> hit = oracle_.firstHit(stretch, scene_.render.max_distance);
        if (bounce == 0) seen.hit = hit;
        if (!hit) {
            seen.color += weight * scene_.world.background;
            break;
        }
        // The air takes its part of what comes from the surface and from behind it.
        const double clear = std::exp(-fog_ * hit->t);
        seen.color += weight * (1 - clear) * scene_.world.background;
        weight *= clear;
        const glm::dvec3 at = stretch.origin + hit->t * stretch.direction;
        const Point p{at, hit->normal, stretch.direction, lookAt(*hit, at)};
        seen.color += weight * sentBack(p, rays);
        weight *= mirrors_ ? p.look.kr : 0;
        stretch = {at, glm::normalize(stretch.direction - 2 * glm::dot(stretch.direction, hit->normal) * hit->normal)};
    }
    return seen;
}

glm::dvec3 Radiance::shown(glm::dvec3 light) const {
    const auto developed = [&](double x) { return exposure_ > 0 ? exposure_ * x / (1 + exposure_ * x) : x; };
    return {toSrgb(developed(light.x)), toSrgb(developed(light.y)), toSrgb(developed(light.z))};
}

}  // namespace mb
