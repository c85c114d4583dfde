#include "core/sdf/steepness.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <random>

namespace mb {
namespace {

/// A node that makes a value: its own tape, and how many warps its space lies behind.
struct Node {
    std::span<const Instruction> tape;
    std::size_t object;
    std::string_view type;
    int warps;
};

std::vector<Node> nodesOf(const Tree& tree) {
    std::vector<Node> nodes;
    std::vector<std::size_t> begins, entered;  // of the values on the stack; of the open warps
    const std::span<const Instruction> all(tree.program);
    std::size_t object = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Instruction& step = all[i];
        const Branch* const branch = step.kind == Instruction::Kind::leaf || step.kind == Instruction::Kind::join ? nullptr : &tree.branches[step.index];
        if (step.kind == Instruction::Kind::enter) {
            entered.push_back(i);
            continue;
        }
        if (step.kind == Instruction::Kind::leaf) begins.push_back(i);
        else if (step.kind != Instruction::Kind::wrap) begins.pop_back();
        if (branch && branch->op->warp_by) begins.back() = entered.back(), entered.pop_back();
        const std::size_t begin = begins.back();
        std::string_view type = "union";
        if (step.kind == Instruction::Kind::leaf) type = tree.leaves[step.index].primitive->name, object = tree.leaves[step.index].index;
        else if (branch) type = branch->op->name, object = branch->index;
        nodes.push_back({all.subspan(begin, i - begin + 1), object, type, static_cast<int>(entered.size())});
    }
    return nodes;
}

/// The generator is the standard's own; its distributions are not the same everywhere, so the numbers are made here.
class Points {
public:
    Points(Box box, std::uint64_t seed) : random_(seed) {
        for (int i = 0; i < 3; ++i) {
            const auto k = static_cast<std::size_t>(i);
            const double lo = std::clamp(box.lo[k], -10.0, 1e6), hi = std::clamp(box.hi[k], lo, std::max(lo, 1e6));
            centre_[i] = std::isfinite(lo + hi) ? 0.5 * (lo + hi) : 0;
            half_[i] = std::min(std::max(0.5 * (hi - lo), 1e-3), 10.0);
        }
    }
    double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
    glm::dvec3 inBox() { return centre_ + 2.0 * half_ * direction(); }
    /// From as far as the shape is wide to a ten-thousandth of that.
    glm::dvec3 beside(glm::dvec3 p) { return p + glm::length(half_) * std::pow(10.0, -4 * uniform()) * direction(); }

private:
    glm::dvec3 direction() { return {2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1}; }
    std::mt19937_64 random_;
    glm::dvec3 centre_{0}, half_{1};
};

}  // namespace

std::vector<Steepest> steepest(const Tree& tree, std::size_t pairs, std::uint64_t seed) {
    std::vector<Steepest> found;
    for (const Node& node : nodesOf(tree)) {
        Steepest s{node.object, node.type, 0, {}, {}};
        Points points(bounds(tree, node.tape), seed + found.size());
        const auto value = [&](glm::dvec3 p) { return distance<double>(tree, node.tape, {p.x, p.y, p.z}, node.warps); };
        for (std::size_t i = 0; i < pairs; ++i) {
            const glm::dvec3 p = points.inBox(), q = points.beside(p);
            const double apart = glm::length(q - p);
            if (!(apart > 1e-6)) continue;
            if (const double slope = std::fabs(value(p) - value(q)) / apart; slope > s.slope) s.slope = slope, s.p = p, s.q = q;
        }
        found.push_back(s);
    }
    return found;
}

}  // namespace mb
