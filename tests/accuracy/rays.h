#pragma once
// What the tests of the oracle share: random rays, and a tally of how two routes to the first surface compare.
#include "core/accuracy/oracle.h"
#include "core/sdf/raycast.h"
#include "scenes.h"
#include "sdf/draw.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

namespace mb {

inline glm::dvec3 drawPoint(Draw& draw, double reach) {
    return {draw.uniform(-reach, reach), draw.uniform(-reach, reach), draw.uniform(-reach, reach)};
}
inline glm::dvec3 drawDirection(Draw& draw) {
    for (;;)
        if (const glm::dvec3 d = drawPoint(draw, 1); glm::length(d) > 0.01 && glm::length(d) <= 1) return glm::normalize(d);
}
/// From within three times `size` of the origin, towards a point within `size`: some start inside.
inline Ray drawRay(Draw& draw, double size) {
    const glm::dvec3 from = drawPoint(draw, 3 * size), to = drawPoint(draw, size);
    return {from, glm::normalize(to - from)};
}

/// The oracle against the program's double field followed by spheres, which share only the tree. What the march leaves undecided is
/// counted and no more. Either may step over what is as thin along the ray as its shortest steps, some 1e-5 m; so few rays are
/// such touches that none is forgiven here.
struct Tally {
    int rays = 0, hits = 0, undecided = 0, wrong = 0, off = 0;
    double worst = 0;  // m
    void add(const Oracle& oracle, const Ray& ray, double far, double size) {
        ++rays;
        const RayEnd march = raycast(oracle.tree(), ray.origin, ray.direction, far);
        const std::optional<TrueHit> truth = oracle.firstHit(ray, far);
        if (march.state == RayState::undecided) return void(++undecided);
        const bool hit = march.state == RayState::hit;
        if (hit != truth.has_value()) return void(++wrong);
        if (!hit) return;
        ++hits, worst = std::max(worst, std::fabs(march.t - truth->t));
        off += std::fabs(march.t - truth->t) > 1e-6 * size;
    }
};

}  // namespace mb
