#include "physics/volume.h"

#include <glm/geometric.hpp>

namespace mb {
namespace {

struct Cell {
    glm::dvec3 centre{0}, half{0};
    double volume() const { return 8 * half.x * half.y * half.z; }
};

sdf::Interval distanceIn(const Tree& tree, const Cell& c) {
    const auto range = [&](int i) { return sdf::Interval(c.centre[i] - c.half[i], c.centre[i] + c.half[i]); };
    return distance<sdf::Interval>(tree, {range(0), range(1), range(2)});
}

/// The part of a cell behind the plane that the distance and its gradient at the centre describe, as if the cell were
/// stretched along the gradient only: right on average, and exact for a plane along the cell's sides.
double insidePart(const Tree& tree, const Cell& c) {
    const Slope s = slope(tree, c.centre);
    const double width = 2 * (std::fabs(s.gradient.x) * c.half.x + std::fabs(s.gradient.y) * c.half.y + std::fabs(s.gradient.z) * c.half.z);
    if (!(width > 0)) return s.distance < 0 ? 1 : 0;
    return std::clamp(0.5 - s.distance / width, 0.0, 1.0);
}

}  // namespace

Volume volume(const Tree& tree, std::size_t cells) {
    Volume v;
    const Box box = bounds(tree);
    Cell whole;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (!(box.lo[k] < box.hi[k])) return v;
        if (!std::isfinite(box.lo[k]) || !std::isfinite(box.hi[k])) return v.value = INFINITY, v;
        whole.centre[i] = 0.5 * (box.lo[k] + box.hi[k]), whole.half[i] = 0.5 * (box.hi[k] - box.lo[k]);
    }

    // Cut the undecided cells level by level.
    std::vector<Cell> open{whole};
    while (!open.empty() && open.size() <= cells) {
        std::vector<Cell> cut;
        for (const Cell& parent : open) {
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 sign{corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1};
                const Cell child{parent.centre + 0.5 * sign * parent.half, 0.5 * parent.half};
                const double at_centre = distance<double>(tree, {child.centre.x, child.centre.y, child.centre.z});
                const bool clear = std::fabs(at_centre) > glm::length(child.half);
                const sdf::Interval f = clear ? sdf::Interval(at_centre) : distanceIn(tree, child);
                v.evaluations += clear ? 1 : 2;
                if (f.hi < 0) v.value += child.volume();
                else if (f.lo <= 0) cut.push_back(child);
            }
        }
        open = std::move(cut);
    }
    for (const Cell& c : open) {
        v.value += c.volume() * insidePart(tree, c);
        v.uncertain += c.volume();
        ++v.evaluations;
    }
    return v;
}

}  // namespace mb
