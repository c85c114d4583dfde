#include "physics/mass_properties.h"

#include "physics/cut_cell.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace mb {
namespace {

double distanceAt(const Tree& tree, const glm::dvec3& p) { return distance<double>(tree, {p.x, p.y, p.z}); }

struct Cell {
    glm::dvec3 centre{0}, half{0};
    double volume() const { return 8 * half.x * half.y * half.z; }
    Cell child(int corner) const {
        const glm::dvec3 sign{corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1};
        return {centre + 0.5 * sign * half, 0.5 * half};
    }
};

sdf::Interval distanceIn(const Tree& tree, const Cell& c) {
    const auto range = [&](int i) { return sdf::Interval(c.centre[i] - c.half[i], c.centre[i] + c.half[i]); };
    return distance<sdf::Interval>(tree, {range(0), range(1), range(2)});
}

/// What of a cell is solid. The line through its centre, along the slope, leaves the solid at one plane. Where an end of
/// the line is on the other side of the surface than that plane says, it meets the surface once more: by the slope of 1 that
/// distances have on both sides of a crease, at twice as far as the crease is deep.
Cut solidPart(const Tree& tree, const Cell& c, std::uint64_t& io_evaluations) {
    const Slope s = slope(tree, c.centre);
    const glm::dvec3 rise = s.gradient * c.half;
    const double d = s.distance, reach = std::fabs(rise.x) + std::fabs(rise.y) + std::fabs(rise.z);
    ++io_evaluations;
    if (!(reach > 0)) return {d < 0 ? 1.0 : 0.0, {}};
    Cut part = behindPlane(rise, -d);
    if (std::fabs(d) >= reach) return part;

    const glm::dvec3 end = s.gradient * (reach / glm::dot(s.gradient, s.gradient));
    const double inner = distanceAt(tree, c.centre - end), outer = distanceAt(tree, c.centre + end);
    io_evaluations += 2;
    if (inner > 0) part -= behindPlane(rise, -d + std::min(d + inner - reach, 0.0));
    if (outer < 0) part += Cut{1, {}}, part -= behindPlane(rise, -d + std::max(d + outer + reach, 0.0));
    return part;
}

/// The integrals of 1, of the place and of its products, about the middle of the bounds.
struct Moments {
    double volume = 0;
    glm::dvec3 first{0};
    glm::dmat3 second{0};

    void add(double part, const glm::dvec3& at, const glm::dvec3& spread) {
        volume += part, first += part * at;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) second[i][k] += part * (at[i] * at[k] + (i == k ? spread[i] : 0));
    }
    void addWhole(const Cell& c, const glm::dvec3& middle) { add(c.volume(), c.centre - middle, c.half * c.half / 3.0); }
    /// Its spread is that of a box around its centroid as far as the nearest sides.
    void addCut(const Cell& c, const glm::dvec3& middle, const Cut& cut) {
        if (!(cut.part > 0)) return;
        const glm::dvec3 place = glm::clamp(cut.first / cut.part, -1.0, 1.0), free = c.half * (1.0 - glm::abs(place));
        add(c.volume() * cut.part, c.centre - middle + c.half * place, free * free / 3.0);
    }
    /// About the centre of mass.
    void centre() {
        first /= volume;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) second[i][k] -= volume * (first[i] * first[k]);
    }
};

/// From errors four times as large at twice the size of a cell, the value at none.
/// Source: Richardson, "The Approximate Arithmetical Solution by Finite Differences" (1911).
template <class T> T extrapolated(const T& coarse, const T& fine) { return fine + (fine - coarse) / 3.0; }

bool isNear(double a, double b, double tolerance) { return std::fabs(a - b) <= tolerance; }

/// Of the mean moment of inertia, or of the radius of gyration: what is symmetric but for the error.
constexpr double kSymmetric = 1e-4;

void symmetrize(glm::dmat3& io_inertia) {
    const double small = kSymmetric * (io_inertia[0][0] + io_inertia[1][1] + io_inertia[2][2]) / 3;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            if (i != k && isNear(io_inertia[i][k], 0, small)) io_inertia[i][k] = 0;
    double &x = io_inertia[0][0], &y = io_inertia[1][1], &z = io_inertia[2][2];
    if (isNear(x, y, small) && isNear(y, z, small) && isNear(z, x, small)) x = y = z = (x + y + z) / 3;
    else if (isNear(x, y, small)) x = y = (x + y) / 2;
    else if (isNear(y, z, small)) y = z = (y + z) / 2;
    else if (isNear(z, x, small)) z = x = (z + x) / 2;
}

MassProperties fromCentred(const Moments& m, const glm::dvec3& middle) {
    MassProperties p;
    const double trace = m.second[0][0] + m.second[1][1] + m.second[2][2], small = kSymmetric * std::sqrt(trace / m.volume);
    p.volume = m.volume;
    for (int i = 0; i < 3; ++i) {
        p.centre[i] = isNear(m.first[i], 0, small) ? middle[i] : middle[i] + m.first[i];
        if (isNear(p.centre[i], 0, small)) p.centre[i] = 0;
        for (int k = 0; k < 3; ++k) p.inertia[i][k] = (i == k ? trace : 0) - m.second[i][k];
    }
    symmetrize(p.inertia);
    return p;
}

/// A primitive's closed form, turned and moved to where it lies.
MassProperties placed(const Matter& matter, const Leaf& leaf) {
    MassProperties p;
    p.volume = matter.volume;
    p.centre = leaf.position + leaf.rotation[1] * matter.centre_y;
    const auto& s = matter.spread;
    const glm::dvec3 moment = matter.volume * glm::dvec3{s[1] + s[2], s[2] + s[0], s[0] + s[1]};
    if (moment.x == moment.y && moment.y == moment.z) return p.inertia = glm::dmat3(moment.x), p;
    for (int axis = 0; axis < 3; ++axis) p.inertia += moment[axis] * glm::outerProduct(leaf.rotation[axis], leaf.rotation[axis]);
    return p;
}

/// The integral by the open cells of one level; `whole` is of those inside.
struct Level {
    std::vector<Cell> open;
    Moments whole;

    Moments total(const Tree& tree, const glm::dvec3& middle, std::uint64_t& io_evaluations) const {
        Moments all = whole;
        for (const Cell& c : open) all.addCut(c, middle, solidPart(tree, c, io_evaluations));
        if (all.volume > 0) all.centre();
        return all;
    }
    Level cut(const Tree& tree, const glm::dvec3& middle, std::uint64_t& io_evaluations) const {
        Level next{{}, whole};
        for (const Cell& parent : open) {
            for (int corner = 0; corner < 8; ++corner) {
                const Cell c = parent.child(corner);
                const double d = distanceAt(tree, c.centre), least = std::min({c.half.x, c.half.y, c.half.z});
                const bool clear = std::fabs(d) > glm::length(c.half);
                const bool crossed = std::fabs(d) < least;  // as good as certainly: of a bound the surface may be further off
                const sdf::Interval f = clear ? sdf::Interval(d) : crossed ? sdf::Interval(-1, 1) : distanceIn(tree, c);
                io_evaluations += clear || crossed ? 1 : 2;
                if (f.hi < 0) next.whole.addWhole(c, middle);
                else if (f.lo <= 0) next.open.push_back(c);
            }
        }
        return next;
    }
};

}  // namespace

MassProperties integrateMass(const Tree& tree, std::size_t cells) {
    MassProperties nothing;
    const Box box = bounds(tree);
    Cell all;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (!(box.lo[k] < box.hi[k])) return nothing;
        if (!std::isfinite(box.lo[k]) || !std::isfinite(box.hi[k])) return nothing.volume = INFINITY, nothing;
        all.centre[i] = 0.5 * (box.lo[k] + box.hi[k]), all.half[i] = 0.5 * (box.hi[k] - box.lo[k]);
    }

    // A level has about four times the open cells of the one before.
    std::uint64_t evaluations = 0;
    Level level{{all}, {}}, before;
    do before = std::move(level), level = before.cut(tree, all.centre, evaluations);
    while (!level.open.empty() && 4 * level.open.size() <= cells);

    const Moments coarse = before.total(tree, all.centre, evaluations), fine = level.total(tree, all.centre, evaluations);
    double uncertain = 0;
    for (const Cell& c : level.open) uncertain += c.volume();
    // The rule holds where the cells are finer than the shape.
    const bool resolved = uncertain <= fine.volume && isNear(coarse.volume, fine.volume, 0.2 * fine.volume);
    Moments best = fine;
    if (resolved) {
        best.volume = extrapolated(coarse.volume, fine.volume);
        best.first = extrapolated(coarse.first, fine.first), best.second = extrapolated(coarse.second, fine.second);
    }
    MassProperties p = best.volume > 0 ? fromCentred(best, all.centre) : nothing;
    p.uncertain = uncertain, p.evaluations = evaluations;
    return p;
}

MassProperties massProperties(const Tree& tree, std::size_t cells) {
    const bool alone = tree.program.size() == 1;
    const Leaf* leaf = alone ? &tree.leaves[tree.program[0].index] : nullptr;
    const std::optional<Matter> matter = leaf && leaf->primitive->matter ? leaf->primitive->matter(leaf->numbers) : std::nullopt;
    return matter ? placed(*matter, *leaf) : integrateMass(tree, cells);
}

}  // namespace mb
