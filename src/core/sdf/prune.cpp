#include "core/sdf/prune.h"

#include <algorithm>

namespace mb {

PartList partsOf(const Tree& tree) {
    PartList list;
    for (const Tree::Part& part : tree.parts) {
        const auto begin = static_cast<std::uint32_t>(list.tape.size());
        list.tape.insert(list.tape.end(), tree.program.begin() + part.begin, tree.program.begin() + part.end);
        list.parts.push_back({begin, static_cast<std::uint32_t>(list.tape.size())});
    }
    return list;
}

Tape joined(const PartList& list) {
    Tape tape;
    for (std::size_t i = 0; i < list.parts.size(); ++i) {
        tape.insert(tape.end(), list.tape.begin() + list.parts[i].begin, list.tape.begin() + list.parts[i].end);
        if (i > 0) tape.push_back({Instruction::Kind::join, 0});
    }
    return tape;
}

double Pruner::prune(const PartList& from, glm::dvec3 centre, double radius, PartList& out) {
    points_[0] = centre, radii_[0] = radius;
    values_.clear(), kept_.clear();
    double least = kEmptyDistance;
    for (const Tree::Part& part : from.parts) {
        const auto begin = static_cast<std::uint32_t>(kept_.tape.size());
        values_.push_back(pruneTape(std::span(from.tape).subspan(part.begin, part.end - part.begin), kept_.tape));
        kept_.parts.push_back({begin, static_cast<std::uint32_t>(kept_.tape.size())});
        least = std::min(least, values_.back());
    }

    // No two values differ by more than the points they are asked at.
    out.clear();
    for (std::size_t i = 0; i < values_.size(); ++i) {
        if (values_[i] > least + 2 * radius) continue;
        const auto begin = static_cast<std::uint32_t>(out.tape.size());
        out.tape.insert(out.tape.end(), kept_.tape.begin() + kept_.parts[i].begin, kept_.tape.begin() + kept_.parts[i].end);
        out.parts.push_back({begin, static_cast<std::uint32_t>(out.tape.size())});
    }
    return least;
}

double Pruner::pruneTape(std::span<const Instruction> from, Tape& out) {
    std::array<std::size_t, 34> entered{};
    const auto in = [&](const Branch& b) {
        const glm::dvec3& p = points_[static_cast<std::size_t>(b.warps)];
        return toFrame<double>(b.rotation, b.position, {p.x, p.y, p.z});
    };
    stack_.clear(), depth_ = 0;
    for (const Instruction& step : from) {
        switch (step.kind) {
        case Instruction::Kind::leaf: {
            const Leaf& leaf = tree_.leaves[step.index];
            const glm::dvec3& p = points_[static_cast<std::size_t>(leaf.warps)];
            stack_.push_back({leaf.primitive->distance<double>(toFrame<double>(leaf.rotation, leaf.position, {p.x, p.y, p.z}), leaf.numbers), out.size()});
            ++evaluations_;
            out.push_back(step);
            break;
        }
        case Instruction::Kind::enter: {
            const Branch& b = tree_.branches[step.index];
            const std::size_t inner = ++depth_;
            const sdf::Vec3<double> q = b.op->warped<double>(in(b), b.numbers);
            points_[inner] = {q.x, q.y, q.z}, radii_[inner] = radii_[inner - 1] * b.op->steepness(b.numbers);
            entered[inner] = out.size();
            out.push_back(step);
            break;
        }
        case Instruction::Kind::wrap: {
            const Branch& b = tree_.branches[step.index];
            stack_.back().v = b.op->wrap<double>(stack_.back().v, in(b), b.numbers);
            if (b.op->warp_by) stack_.back().begin = entered[depth_--];
            out.push_back(step);
            break;
        }
        default: fold(step, out);
        }
    }
    return stack_.back().v;
}

/// Drops the side that shows nowhere within the radius, or keeps both.
void Pruner::fold(const Instruction& step, Tape& out) {
    const Value b = stack_.back();
    stack_.pop_back();
    Value& a = stack_.back();
    const bool plain = step.kind == Instruction::Kind::join;
    static const Operator& unite = asOperator(*findShapeType("union"));
    const Operator& op = plain ? unite : *tree_.branches[step.index].op;
    const double k = plain ? 0 : tree_.branches[step.index].blend;
    const double r = radii_[depth_];

    const sdf::Interval share = op.shareOfSecond<sdf::Interval>({a.v - r, a.v + r}, {b.v - r, b.v + r}, k);
    if (share.hi <= 0) {
        out.resize(b.begin);
    } else if (share.lo >= 1 && !op.first_only) {  // what is taken away shows with its sign changed: both stay
        out.erase(out.begin() + static_cast<std::ptrdiff_t>(a.begin), out.begin() + static_cast<std::ptrdiff_t>(b.begin));
        a.v = b.v;
    } else {
        a.v = op.fold<double>(a.v, b.v, k);
        out.push_back(step);
    }
}

}  // namespace mb
