#include "core/sdf/raycast.h"

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

/// The field along the ray: all of a tree, or what a grid keeps of it where the ray is.
struct Marcher {
    const Tree& tree;
    const Grid* grid;
    glm::dvec3 origin, direction;
    int evaluations = 0;

    glm::dvec3 at(double t) const { return origin + t * direction; }
    double operator()(double t) {
        ++evaluations;
        const glm::dvec3 p = at(t);
        return grid ? grid->distance(p) : distance<double>(tree, {p.x, p.y, p.z});
    }
    int leafAt(double t, double tie) const {
        const glm::dvec3 p = at(t);
        const std::span<const Instruction> tape = grid ? grid->tapeAt(p) : std::span<const Instruction>(tree.program);
        return nearest<double>(tree, tape.empty() ? std::span<const Instruction>(tree.program) : tape, {p.x, p.y, p.z}, tie).leaf;
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

bool finite(glm::dvec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

RayEnd follow(const Tree& tree, const Grid* grid, glm::dvec3 origin, glm::dvec3 direction, double max_distance) {
    RayEnd end;
    const double length = glm::length(direction);
    if (!finite(origin) || !std::isfinite(length) || length == 0 || !(max_distance >= 0)) return end;
    if (tree.program.empty()) return end.state = RayState::miss, end.t = max_distance, end.closest = kEmptyDistance, end;

    Marcher march{tree, grid, origin, direction / length};
    const double reach = glm::length(origin);
    double side = 1, t = 0, before = 0, f_before = 0;
    bool proved = true, on_surface = false;
    end.closest = std::numeric_limits<double>::infinity();
    while (march.evaluations < kBudget) {
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
    end.leaf = march.leafAt(end.t, kTie * (reach + end.t));
    if (end.leaf >= 0) end.index = tree.leaves[static_cast<std::size_t>(end.leaf)].index;
    end.evaluations = march.evaluations;
    return end;
}

}  // namespace

RayEnd raycast(const Tree& tree, glm::dvec3 origin, glm::dvec3 direction, double max_distance) {
    return follow(tree, nullptr, origin, direction, max_distance);
}
RayEnd raycast(const Grid& grid, glm::dvec3 origin, glm::dvec3 direction, double max_distance) {
    return follow(grid.tree(), &grid, origin, direction, max_distance);
}

}  // namespace mb
