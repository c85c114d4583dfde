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

/// The oracle against the program's double field followed by spheres. What that leaves undecided is counted and no more. A surface that
/// the march, whose steps are no shorter than a hundred thousandth of the way, has stepped over, or that the oracle's own march has, is
/// a touch: the field at the nearest approach is smaller than `touch`.
struct Tally {
    int rays = 0, hits = 0, undecided = 0, touches = 0, wrong = 0, off = 0;
    double worst = 0;  // m
    void add(const Oracle& oracle, const Ray& ray, double far, double size) {
        ++rays;
        const RayEnd march = raycast(oracle.tree(), ray.origin, ray.direction, far);
        const std::optional<TrueHit> truth = oracle.firstHit(ray, far);
        if (march.state == RayState::undecided) return void(++undecided);
        const bool hit = march.state == RayState::hit;
        if (hit && truth && std::fabs(march.t - truth->t) <= 1e-6 * size) {
            ++hits, worst = std::max(worst, std::fabs(march.t - truth->t));
            return;
        }
        if (!hit && !truth) return;
        if (isTouch(oracle, ray, hit ? march.t : far, truth ? truth->t : far, size)) return void(++touches);
        hit && truth ? ++off : ++wrong;
        MESSAGE("march " << (hit ? march.t : -1) << ", oracle " << (truth ? truth->t : -1) << " from " << ray.origin.x << ", " << ray.origin.y << ", " << ray.origin.z << " along "
                         << ray.direction.x << ", " << ray.direction.y << ", " << ray.direction.z);
    }

private:
    /// Around the nearer of the two surfaces the field, along the ray, reaches no deeper than a hair before it comes back.
    static bool isTouch(const Oracle& oracle, const Ray& ray, double a, double b, double size) {
        const double t = std::min(a, b), hair = 3e-5 * (size + t);
        const auto at = [&](double s) {
            const glm::dvec3 p = ray.origin + s * ray.direction;
            return distance<double>(oracle.tree(), {p.x, p.y, p.z});
        };
        // The first of the two is real if the sign lasts; a stretch a few hairs long is what a march may pass.
        const double before = at(t - hair / 1000);
        for (int i = 1; i <= 200; ++i) {
            const double s = t + hair * i / 10, f = at(s);
            if (std::fabs(f) > hair) return false;
            if (i > 2 && (f < 0) == (before < 0)) return true;
        }
        return false;
    }
};

}  // namespace mb
