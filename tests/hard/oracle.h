#pragma once
// What the hard cases are held to: solids along a ray as lists of intervals, cut and joined as the operators cut and join
// them, in double and with no distance function involved; and the small pieces that the files of this folder share.
#include "core/scene/text.h"
#include "render/closed_forms.h"
#include "render/headless.h"
#include "scenes.h"
#include "sdf/draw.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace mb::hard {

inline constexpr double kPi = 3.14159265358979323846;

/// The intervals of a ray that lie inside a solid: disjoint, in ascending order.
using Inside = std::vector<Span>;

inline Inside insideOf(const Span& span) { return span.empty() ? Inside{} : Inside{span}; }

inline Inside common(const Inside& a, const Inside& b) {
    Inside result;
    for (const Span& x : a)
        for (const Span& y : b)
            if (const Span z = both(x, y); !z.empty()) result.push_back(z);
    return result;
}
/// All that is not inside; the normals turn round.
inline Inside outsideOf(const Inside& a) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Inside result;
    Span gap{-infinity, infinity, {}, {}};
    for (const Span& x : a) {
        gap.leave = x.enter, gap.leave_normal = -x.enter_normal;
        if (!gap.empty()) result.push_back(gap);
        gap = {x.leave, infinity, -x.leave_normal, {}};
    }
    if (!gap.empty()) result.push_back(gap);
    return result;
}
inline Inside less(const Inside& a, const Inside& b) { return common(a, outsideOf(b)); }
inline Inside joined(const Inside& a, const Inside& b) { return outsideOf(common(outsideOf(a), outsideOf(b))); }

/// The first surface ahead: where the ray enters the solid, or leaves it if it starts inside; the normal against the ray.
inline std::optional<Hit> firstAhead(const Inside& solid, double reach) {
    for (const Span& s : solid) {
        if (s.enter > 0) return s.enter <= reach ? std::optional(Hit{s.enter, s.enter_normal}) : std::nullopt;
        if (s.leave > 0) return s.leave <= reach ? std::optional(Hit{s.leave, -s.leave_normal}) : std::nullopt;
    }
    return std::nullopt;
}

/// The ray through the middle of a picture of one pixel: what one ray alone becomes.
struct OneRay {
    int state;  // 0 miss, 1 hit, 2 undecided
    double t;
    int steps;
    glm::dvec3 normal;
};
inline OneRay shoot(HeadlessRenderer& headless, const Scene& scene, glm::dvec3 eye, glm::dvec3 direction) {
    const Channels c = headless.measure(scene, cameraAt(eye, eye + direction), {1, 1}).channels;
    return {static_cast<int>(c.state[0]), static_cast<double>(c.depth[0]), static_cast<int>(c.steps[0]), glm::dvec3(c.normal[0])};
}

/// A picture of states and depths against the truth of every pixel's ray.
struct Compared {
    std::size_t pixels = 0, hits = 0, false_hits = 0, false_misses = 0, undecided = 0;
    std::size_t lost = 0;    // of the truth's hits, all that are not hits here
    std::size_t deep = 0;    // of the hits, those that are off by more than 1e-3 of the way: another surface
    double worst_depth = 0;  // relative
    /// Pixels where both see the same surface, of those where either sees one; what is undecided counts as seeing none.
    double iou() const {
        const std::size_t either = hits + false_hits + lost;
        return either == 0 ? 1 : static_cast<double>(hits - deep) / static_cast<double>(either);
    }
};
using Truth = std::function<std::optional<Hit>(const DoubleRay&)>;

inline Compared compare(const Measured& m, const Camera& camera, const Truth& truth) {
    Compared r;
    const glm::ivec2 size = m.channels.size;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const std::size_t i = static_cast<std::size_t>(y * size.x + x);
            const std::optional<Hit> wanted = truth(pixelRay(camera, size, x, y));
            const int state = static_cast<int>(m.channels.state[i]);
            ++r.pixels;
            r.undecided += state == 2, r.false_hits += state == 1 && !wanted, r.false_misses += state == 0 && wanted;
            r.lost += state != 1 && wanted;
            if (state != 1 || !wanted) continue;
            ++r.hits;
            const double depth = std::fabs(static_cast<double>(m.channels.depth[i]) / wanted->t - 1);
            r.deep += depth > 1e-3, r.worst_depth = std::max(r.worst_depth, depth);
        }
    return r;
}

/// A material that shows its colour as it is, whatever the light; and one that shows diffuse light only.
inline Material plain(glm::dvec3 color) { return {"plain", color, {0, 0, 0}, Pattern::none, 1, 0, 0, 0, 1}; }
inline Material diffuse() { return {"diffuse", {1, 1, 1}, {0, 0, 0}, Pattern::none, 0, 1, 0, 0, 1}; }

/// Gives every top-level object the scene's only material.
inline void paint(Scene& scene, const Material& material) {
    scene.materials = {material};
    for (Object& o : scene.objects)
        if (o.parent == kNoParent) o.material = 0;
}

/// The first fault of a scene's text as "LINE:COLUMN: message", or nothing.
inline std::string firstFault(const std::string& text) {
    const ReadResult r = readScene(text);
    return r.faults.empty() ? "" : std::to_string(r.faults[0].line) + ":" + std::to_string(r.faults[0].column) + ": " + r.faults[0].message;
}

inline bool finite(const glm::vec3& c) { return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z); }
inline sdf::Vec3<double> vec(glm::dvec3 p) { return {p.x, p.y, p.z}; }

}  // namespace mb::hard
