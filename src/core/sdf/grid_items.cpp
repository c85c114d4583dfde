// Tapes as the GPU runs them.
#include "core/sdf/grid.h"

namespace mb {
namespace {

std::uint32_t rowOf(const Primitive* p) { return static_cast<std::uint32_t>(p - primitives().data()); }
std::uint32_t rowOf(const Operator* o) { return static_cast<std::uint32_t>(o - operators().data()); }

/// The branches' records follow the leaves'.
std::uint32_t branchRecord(const Tree& tree, std::uint32_t branch) { return static_cast<std::uint32_t>(tree.leaves.size()) + branch; }

/// How the value that a step leaves is joined with the one under it: by the step behind it, if that joins two.
struct Joined {
    std::uint32_t how = kItemPush, branch = 0;
    bool taken = false;
};
Joined joinedBy(const Tree& tree, std::span<const Instruction> tape, std::size_t next) {
    if (next >= tape.size()) return {};
    const Instruction& step = tape[next];
    if (step.kind == Instruction::Kind::join) return {kItemJoin, 0, true};
    if (step.kind == Instruction::Kind::fold) return {kItemFolds + rowOf(tree.branches[step.index].op), branchRecord(tree, step.index), true};
    return {};
}
GridItem item(std::uint32_t code, std::uint32_t how, std::size_t record, std::uint32_t branch = 0) {
    return {code | how << 6 | static_cast<std::uint32_t>(record) << 12, branch};
}

}  // namespace

void appendItems(const Tree& tree, std::span<const Instruction> tape, std::vector<GridItem>& out) {
    for (std::size_t i = 0; i < tape.size(); ++i) {
        const Instruction& step = tape[i];
        switch (step.kind) {
        case Instruction::Kind::leaf: {
            const Joined joined = joinedBy(tree, tape, i + 1);
            out.push_back(item(rowOf(tree.leaves[step.index].primitive), joined.how, step.index, joined.branch));
            i += joined.taken;
            break;
        }
        case Instruction::Kind::join: out.push_back(item(kItemPop, kItemJoin, 0)); break;
        case Instruction::Kind::fold: {
            const std::uint32_t how = kItemFolds + rowOf(tree.branches[step.index].op);
            out.push_back(item(kItemPop, how, 0, branchRecord(tree, step.index)));
            break;
        }
        case Instruction::Kind::enter: out.push_back(item(kItemEnter + rowOf(tree.branches[step.index].op), kItemPush, branchRecord(tree, step.index))); break;
        case Instruction::Kind::wrap: out.push_back(item(kItemWrap + rowOf(tree.branches[step.index].op), kItemPush, branchRecord(tree, step.index))); break;
        }
    }
    if (!tape.empty()) out.back().word |= kItemLast;
    static_assert(kMostLeaves < (1u << 19), "a record's number has 20 bits");
}

int itemStack(const Tree& tree, std::span<const Instruction> tape) {
    int now = 0, most = 1;
    for (std::size_t i = 0; i < tape.size(); ++i) {
        if (tape[i].kind == Instruction::Kind::leaf) {
            const bool taken = joinedBy(tree, tape, i + 1).taken;
            now += taken ? 0 : 1, i += taken;
        } else if (tape[i].kind == Instruction::Kind::join || tape[i].kind == Instruction::Kind::fold) {
            --now;
        }
        most = std::max(most, now);
    }
    return most;
}

}  // namespace mb
