#include "core/accuracy/implicit.h"

#include "core/accuracy/roots.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>

namespace mb::accuracy {
namespace {

constexpr std::size_t kStack = 40, kSpaces = 34;  // deeper than Limits::levels lets a tape go

sdf::Vec3<double> programs(glm::dvec3 p) { return {p.x, p.y, p.z}; }

/// A point in each space that is open, and what leaves and branches are at it.
struct Spaces {
    const KnownTree& known;
    std::array<glm::dvec3, kSpaces> points;

    Spaces(const KnownTree& k, glm::dvec3 p) : known(k) { points[0] = p; }
    glm::dvec3 inFrame(const glm::dmat3& rotation, glm::dvec3 position, int warps) const {
        return glm::transpose(rotation) * (points[static_cast<std::size_t>(warps)] - position);
    }
    glm::dvec3 inLeaf(std::size_t i) const {
        const Leaf& leaf = known.tree.leaves[i];
        return inFrame(leaf.rotation, leaf.position, leaf.warps);
    }
    double leaf(std::size_t i) const {
        const Leaf& l = known.tree.leaves[i];
        const glm::dvec3 p = inLeaf(i);
        return known.solids[i] ? known.solids[i]->distance(p, l.numbers) : l.primitive->distance<double>(programs(p), l.numbers);
    }
    double fold(std::size_t i, double a, double b) const {
        const Branch& branch = known.tree.branches[i];
        return known.rules[i] ? known.rules[i]->fold(a, b, branch.blend) : branch.op->fold<double>(a, b, branch.blend);
    }
    double share(std::size_t i, double a, double b, double tie) const {
        const Branch& branch = known.tree.branches[i];
        return known.rules[i] ? shareOfSecond(*known.rules[i], a, b, branch.blend, tie)
                              : branch.op->shareOfSecond<double>(a, b, branch.blend, tie);
    }
    void enter(std::size_t i) {
        const Branch& b = known.tree.branches[i];
        const glm::dvec3 p = inFrame(b.rotation, b.position, b.warps);
        glm::dvec3& inner = points[static_cast<std::size_t>(b.warps + 1)];
        if (known.rules[i]) inner = known.rules[i]->warp(p, b.numbers);
        else {
            const sdf::Vec3<double> q = b.op->warped<double>(programs(p), b.numbers);
            inner = {q.x, q.y, q.z};
        }
    }
    double wrap(std::size_t i, double d) const {
        const Branch& b = known.tree.branches[i];
        const glm::dvec3 p = inFrame(b.rotation, b.position, b.warps);
        return known.rules[i] ? known.rules[i]->wrap(d, p, b.numbers) : b.op->wrap<double>(d, programs(p), b.numbers);
    }
};

/// A value with the leaves that show in it.
struct Shown {
    double value = kEmptyDistance;
    std::vector<LeafShare> shares;
};
/// b joins a, b's share being `share`.
void mix(Shown& a, const Shown& b, double value, double share) {
    a.value = value;
    for (LeafShare& s : a.shares) s.share *= 1 - share;
    for (const LeafShare& s : b.shares) a.shares.push_back({s.leaf, s.share * share, s.at});
    std::erase_if(a.shares, [](const LeafShare& s) { return s.share == 0; });
}

double largestFinite(const Box& box) {
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (const double x : {box.lo[i], box.hi[i]})
            if (std::isfinite(x)) largest = std::max(largest, std::fabs(x));
    return largest;
}
double diagonal(const Box& b) { return glm::length(glm::dvec3(b.hi[0] - b.lo[0], b.hi[1] - b.lo[1], b.hi[2] - b.lo[2])); }

/// The largest leaf with bounds, of a tape without; a metre where there is none.
double largestLeaf(const Tree& tree, std::span<const Instruction> tape) {
    double size = 0;
    for (const Instruction& step : tape)
        if (step.kind == Instruction::Kind::leaf)
            if (const Box box = bounds(tree.leaves[step.index]); isFinite(box)) size = std::max(size, diagonal(box));
    return size > 0 ? size : 1;
}

}  // namespace

KnownTree::KnownTree(Tree t) : tree(std::move(t)) {
    const auto note = [&](std::string_view kind, std::string_view name) {
        std::string sentence = fmt::format("{} '{}' has no form of its own here: its values are the program's", kind, name);
        if (std::ranges::find(notes, sentence) == notes.end()) notes.push_back(std::move(sentence));
    };
    if (!tree.fault.empty()) notes.push_back(tree.fault);
    for (const Leaf& leaf : tree.leaves)
        if (!solids.emplace_back(findSolid(leaf.primitive->name))) note("primitive", leaf.primitive->name);
    for (const Branch& branch : tree.branches)
        if (!rules.emplace_back(findRule(branch.op->name))) note("operator", branch.op->name);
}

Implicit::Implicit(const KnownTree& known, std::span<const Instruction> tape)
    : known_(known), tape_(tape), box_(bounds(known.tree, tape)), finite_(isFinite(box_)) {
    size_ = finite_ ? diagonal(box_) : largestLeaf(known.tree, tape);
    const double hair = 1e-9 * (size_ + largestFinite(box_));
    for (std::size_t i = 0; i < 3; ++i) box_.lo[i] -= hair, box_.hi[i] += hair;
}

double Implicit::value(glm::dvec3 p) const {
    Spaces spaces(known_, p);
    std::array<double, kStack> stack;
    std::size_t top = 0;
    for (const Instruction& step : tape_) {
        switch (step.kind) {
        case Instruction::Kind::leaf: stack[top++] = spaces.leaf(step.index); break;
        case Instruction::Kind::fold: --top, stack[top - 1] = spaces.fold(step.index, stack[top - 1], stack[top]); break;
        case Instruction::Kind::join: --top, stack[top - 1] = std::min(stack[top - 1], stack[top]); break;
        case Instruction::Kind::enter: spaces.enter(step.index); break;
        case Instruction::Kind::wrap: stack[top - 1] = spaces.wrap(step.index, stack[top - 1]); break;
        }
    }
    return top > 0 ? stack[0] : kEmptyDistance;
}

std::vector<LeafShare> Implicit::shares(glm::dvec3 p, double tie) const {
    Spaces spaces(known_, p);
    std::vector<Shown> stack;
    for (const Instruction& step : tape_) {
        Shown last;
        if (step.kind == Instruction::Kind::fold || step.kind == Instruction::Kind::join) last = std::move(stack.back()), stack.pop_back();
        const double b = last.value;
        switch (step.kind) {
        case Instruction::Kind::leaf:
            stack.push_back({spaces.leaf(step.index), {{static_cast<int>(step.index), 1, spaces.inLeaf(step.index)}}});
            break;
        case Instruction::Kind::fold: {
            const double a = stack.back().value;
            mix(stack.back(), last, spaces.fold(step.index, a, b), spaces.share(step.index, a, b, tie));
            break;
        }
        case Instruction::Kind::join: {
            const double a = stack.back().value;
            mix(stack.back(), last, std::min(a, b), b < a - tie ? 1 : 0);
            break;
        }
        case Instruction::Kind::enter: spaces.enter(step.index); break;
        case Instruction::Kind::wrap: stack.back().value = spaces.wrap(step.index, stack.back().value); break;
        }
    }
    return stack.empty() ? std::vector<LeafShare>{} : std::move(stack.front().shares);
}

glm::dvec3 Implicit::normal(glm::dvec3 p) const {
    const double h = std::max(1e-6 * size_, 1e-9 * glm::length(p));
    glm::dvec3 slope{0};
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 aside{0};
        aside[axis] = h;
        slope[axis] = value(p + aside) - value(p - aside);
    }
    const double length = glm::length(slope);
    return length > 0 ? slope / length : glm::dvec3(0);
}

bool crossBox(const Box& box, const Ray& ray, double& enter, double& leave) {
    enter = 0, leave = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const double rate = ray.direction[axis], to_lo = box.lo[i] - ray.origin[axis], to_hi = box.hi[i] - ray.origin[axis];
        if (rate == 0) {
            if (to_lo > 0 || to_hi < 0) return false;
            continue;
        }
        const double inverse = 1 / rate, a = to_lo * inverse, b = to_hi * inverse;
        enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

End Implicit::endAt(const Ray& ray, double t) const {
    const glm::dvec3 p = ray.origin + t * ray.direction;
    End end{t, normal(p), -1};
    double most = 0;
    for (const LeafShare& s : shares(p, tieAt(t, glm::length(ray.origin))))
        if (s.share > most) most = s.share, end.leaf = s.leaf;
    return end;
}

// A step as long as the value passes no surface, since the value rises by at most 1 a metre; near a surface steps are short, and what
// is thinner than one of those may be missed.
void Implicit::march(const Ray& ray, double from, double to, bool first, Intervals& found) const {
    double enter = 0, leave = 0;
    if (!crossBox(box_, ray, enter, leave)) return;
    const double begin = std::max(from, enter), end = std::min({to, leave, kEmptyDistance});
    if (!(begin < end)) return;

    const double longest = (end - begin) / 64, noise = 1e-15 * glm::length(ray.origin);
    const auto along = [&](double t) { return value(ray.origin + t * ray.direction); };
    double t = begin, v = along(t);
    bool inside = v < 0;
    Interval open{{begin, -ray.direction, -1}, {kInfinity, {}, -1}};
    if (inside && first) return void(found.push_back(open));
    while (t < end) {
        const double shortest = noise + resolution() * (finite_ ? 1 : std::max(1.0, t / size_));
        const double next = std::min(t + std::max(std::min(std::fabs(v), longest), shortest), end), w = along(next);
        if ((w < 0) != inside) {
            (inside ? open.leave : open.enter) = endAt(ray, halve(along, t, next, inside));
            if (inside || first) found.push_back(open);
            if (first) return;
            inside = !inside;
        }
        t = next, v = w;
    }
    if (inside) open.leave = {end, ray.direction, -1}, found.push_back(open);
}

}  // namespace mb::accuracy
