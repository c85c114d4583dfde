#include "physics/solid.h"

#include "physics/closest.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace mb {
namespace {

/// Whether the surface lies elsewhere than on its leaves' own: the tree wraps, warps or morphs.
bool movesSurfaces(const Tree& tree) {
    return std::ranges::any_of(tree.branches, [](const Branch& b) { return b.op->kind == Operator::Kind::wrap || !b.op->blends; });
}

/// 1 for a leaf that adds, −1 for one that is taken away: walks the program with the leaves each value is made of. Where an
/// operator moves the surface off its leaves' own, all are 0.
std::vector<signed char> sidesOf(const Tree& tree) {
    struct Range { std::size_t begin, end; };
    std::vector<signed char> side(tree.leaves.size(), 0);
    if (movesSurfaces(tree)) return side;
    std::vector<Range> stack;
    for (const Instruction& step : tree.program) {  // of leaves, folds and joins
        if (step.kind == Instruction::Kind::leaf) {
            side[step.index] = 1;
            stack.push_back({step.index, step.index + 1});
            continue;
        }
        const Range second = stack.back();
        stack.pop_back();
        if (step.kind == Instruction::Kind::fold && tree.branches[step.index].op->first_only)
            for (std::size_t i = second.begin; i < second.end; ++i) side[i] = static_cast<signed char>(-side[i]);
        stack.back().end = second.end;
    }
    return side;
}

/// The farthest corner from the origin.
double radiusOf(const Box& box) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double far = std::max(std::fabs(box.lo[k]), std::fabs(box.hi[k]));
        sum += far * far;
    }
    return std::sqrt(sum);
}

}  // namespace

/// Where hard operators alone join the leaves, the value is one leaf's, and so is the slope.
bool isSloping(const Slope& slope) { return glm::length(slope.gradient) > 1e-6; }

glm::dvec3 wayOutAlong(const Slope& slope) { return isSloping(slope) ? slope.gradient / glm::length(slope.gradient) : glm::dvec3{0, 1, 0}; }

Slope Solid::slopeAt(glm::dvec3 p) const {
    if (blended) return slope(tree, p);
    const std::span<const Instruction> near = grid ? grid->tapeAt(p) : std::span<const Instruction>{};
    const Nearest<double> found = nearest<double>(tree, near.empty() ? std::span<const Instruction>(tree.program) : near, {p.x, p.y, p.z});
    if (found.leaf < 0) return slope(tree, p);
    const auto leaf = static_cast<std::size_t>(found.leaf);
    const Slope own = slope(tree.leaves[leaf], p);
    return {found.distance, static_cast<double>(side[leaf]) * own.gradient};
}

std::shared_ptr<const Grid> gridOf(const Tree& tree, Grid::Exact exact, const Grid* before) {
    const auto grid = before ? std::make_shared<Grid>(*before) : std::make_shared<Grid>(exact);
    grid->follow(tree);
    return grid;
}

Solid makeSolid(Tree tree, bool with_points, const Solid* before) {
    Solid solid;
    solid.tree = std::move(tree);
    solid.box = bounds(solid.tree);
    solid.radius = radiusOf(solid.box);
    solid.side = sidesOf(solid.tree);
    solid.convex = solid.tree.program.size() == 1 && solid.tree.leaves.size() == 1 && solid.side[0] > 0 && solid.tree.leaves[0].primitive->convex &&
                   solid.tree.leaves[0].primitive->exact;
    solid.blended = movesSurfaces(solid.tree) || std::ranges::any_of(solid.tree.branches, [](const Branch& b) { return b.blend > 0; });
    if (solid.tree.leaves.size() > kMany) solid.grid = gridOf(solid.tree, Grid::Exact::everywhere, before ? before->grid.get() : nullptr);
    if (with_points && isFinite(solid.box)) solid.points = surfacePoints(solid.tree, solid.box, solid.inner);
    return solid;
}

}  // namespace mb
