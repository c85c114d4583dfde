#pragma once
// Shortens a tape to what can matter within a distance of a point.
#include "core/sdf/tree.h"

namespace mb {

/// The parts of a plain union: tapes side by side, none with the joins between them.
struct PartList {
    Tape tape;
    std::vector<Tree::Part> parts;
    void clear() { tape.clear(), parts.clear(); }
};

/// All of a tree.
PartList partsOf(const Tree& tree);
/// The whole list as one tape, joins included.
Tape joined(const PartList& list);

class Pruner {
public:
    explicit Pruner(const Tree& tree) : tree_(tree) {}
    /// Keeps of `from` what can decide the value anywhere within `radius` of `centre`: there `out` has the same value to the
    /// bit. Returns the value at the centre.
    double prune(const PartList& from, glm::dvec3 centre, double radius, PartList& out);
    std::uint64_t evaluations() const { return evaluations_; }  // of primitives

private:
    struct Value {
        double v;
        std::size_t begin;  // of its tape
    };
    double pruneTape(std::span<const Instruction> from, Tape& out);
    void fold(const Instruction& step, Tape& out);

    const Tree& tree_;
    std::uint64_t evaluations_ = 0;
    std::vector<Value> stack_;
    std::size_t depth_ = 0;                                     // of open warps
    std::vector<double> values_;
    PartList kept_;
    std::array<glm::dvec3, 34> points_{};
    std::array<double, 34> radii_{};
};

}  // namespace mb
