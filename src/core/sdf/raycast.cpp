#include "core/sdf/raycast.h"

#include "core/sdf/prune.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mb {
namespace {

constexpr int kBudget = 4096;         // evaluations
constexpr double kClose = 1e-5;       // of the distance travelled: nearer, single distances are not trusted
constexpr double kNoise = 4 * std::numeric_limits<double>::epsilon();
constexpr int kNarrowingSteps = 100;
constexpr double kTie = 1e-9;         // of the distance from the origin: surfaces nearer to one another are one, the first's

struct Marcher {
    const Tree& tree;
    std::span<const Instruction> tape;
    glm::dvec3 origin, direction;
    int evaluations = 0;

    glm::dvec3 at(double t) const { return origin + t * direction; }
    double operator()(double t) {
        ++evaluations;
        const glm::dvec3 p = at(t);
        return distance<double>(tree, tape, {p.x, p.y, p.z});
    }
};

/// Where the distance crosses zero between `lo`, where it is not negative, and `hi`, where it is: halving, until the
/// two are neighbours or the distance is exactly 0.
double narrow(Marcher& march, double side, double lo, double hi) {
    for (int i = 0; i < kNarrowingSteps; ++i) {
        const double middle = lo + (hi - lo) / 2;
        if (middle <= lo || middle >= hi) break;
        const double f = side * march(middle);
        if (f == 0) return middle;
        (f < 0 ? hi : lo) = middle;
    }
    return hi;
}

constexpr std::size_t kManyParts = 64;  // fewer are asked all

/// Whether the line ahead of the origin meets the box, grown a little for rounding (Kay and Kajiya, "Ray Tracing Complex
/// Scenes", 1986: slabs).
bool meets(const Box& box, glm::dvec3 origin, glm::dvec3 direction) {
    double from = 0, to = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double slack = 1e-9 * (1 + std::fabs(origin[i])), lo = box.lo[k] - slack - origin[i], hi = box.hi[k] + slack - origin[i];
        if (direction[i] == 0) {
            if (lo > 0 || hi < 0) return false;
            continue;
        }
        const double a = lo / direction[i], b = hi / direction[i];
        from = std::max(from, std::min(a, b)), to = std::min(to, std::max(a, b));
    }
    return from <= to;
}

/// Of a tree of many parts, those whose boxes the ray meets: it can meet no other.
Tape partsAhead(const Tree& tree, glm::dvec3 origin, glm::dvec3 direction) {
    PartList list;
    for (const Tree::Part& part : tree.parts) {
        const std::span<const Instruction> tape = std::span(tree.program).subspan(part.begin, part.end - part.begin);
        if (!meets(bounds(tree, tape), origin, direction)) continue;
        const auto begin = static_cast<std::uint32_t>(list.tape.size());
        list.tape.insert(list.tape.end(), tape.begin(), tape.end());
        list.parts.push_back({begin, static_cast<std::uint32_t>(list.tape.size())});
    }
    return joined(list);
}

bool finite(glm::dvec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

RayEnd raycast(const Tree& tree, glm::dvec3 origin, glm::dvec3 direction, double max_distance) {
    RayEnd end;
    const double length = glm::length(direction);
    if (!finite(origin) || !std::isfinite(length) || length == 0 || !(max_distance >= 0)) return end;
    if (tree.program.empty()) return end.state = RayState::miss, end.t = max_distance, end.closest = kEmptyDistance, end;

    const bool many = tree.parts.size() > kManyParts;
    const Tape ahead = many ? partsAhead(tree, origin, direction / length) : Tape{};
    if (many && ahead.empty()) end.state = RayState::miss, end.t = max_distance, end.closest = kEmptyDistance;
    Marcher march{tree, many ? ahead : tree.program, origin, direction / length};
    const double reach = glm::length(origin);
    double side = 1, t = 0, before = 0, f_before = 0;
    bool proved = true, on_surface = false;
    if (!many || !ahead.empty()) end.closest = std::numeric_limits<double>::infinity();
    while (end.state != RayState::miss && march.evaluations < kBudget) {
        double f = side * march(t);
        if (std::isnan(f)) break;
        const double noise = kNoise * (reach + t);
        // Of a start on a surface, the next point says on which side the way leads.
        if (f < 0 && (march.evaluations == 1 || (march.evaluations == 2 && on_surface))) side = -side, f = -f;
        if (march.evaluations == 1) on_surface = f <= noise;
        if (f < -noise) {
            end.state = RayState::hit;
            end.t = narrow(march, side, before, t);
            end.closest = 0;
            break;
        }
        // A step longer than the spheres at its two ends reach leaves a gap that nobody looked into.
        if (t > before && f_before + std::max(f, 0.0) + noise < t - before) proved = false;
        if (f <= noise && t > 0) proved = false;
        if (f < end.closest) end.closest = f, end.t = t;
        if (t + f >= max_distance) {
            end.state = proved ? RayState::miss : RayState::undecided;
            break;
        }
        before = t, f_before = std::max(f, 0.0);
        t += std::max(f, std::max(kClose * t, 4 * kNoise * (reach + 1)));
    }
    const glm::dvec3 p = march.at(end.t);
    end.leaf = nearest<double>(tree, {p.x, p.y, p.z}, kTie * (reach + end.t)).leaf;
    if (end.leaf >= 0) end.index = tree.leaves[static_cast<std::size_t>(end.leaf)].index;
    end.evaluations = march.evaluations;
    return end;
}

}  // namespace mb
