#pragma once
// A tape as a value in double, by formulas of its own (solids.h, rules.h), for what has no lists of intervals; and the roots of that
// value along a ray.
#include "core/accuracy/oracle.h"
#include "core/accuracy/rules.h"
#include "core/accuracy/solids.h"

#include <span>
#include <vector>

namespace mb::accuracy {

/// A tree with the rows of its leaves and branches looked up. A row that is null here is one that only the program itself knows.
struct KnownTree {
    explicit KnownTree(Tree t);
    Tree tree;
    std::vector<const Solid*> solids;  // of tree.leaves
    std::vector<const Rule*> rules;    // of tree.branches
    std::vector<std::string> notes;    // a sentence for each row that is not known, or why there is no tree
};

class Implicit {
public:
    /// `tape` is of known.tree, which outlives this.
    Implicit(const KnownTree& known, std::span<const Instruction> tape);

    /// It rises by at most 1 a metre, and is negative inside.
    double value(glm::dvec3 p) const;
    /// Of unit length: the value's slope, by central differences.
    glm::dvec3 normal(glm::dvec3 p) const;
    /// The leaves that show at a point: each fold divides by the derivatives of its value. Values that differ by no more than `tie` are one.
    std::vector<LeafShare> shares(glm::dvec3 p, double tie) const;

    /// The stretches inside between two lengths of the ray, or the first alone, of which only the entrance is looked for. One that is open
    /// at the start or the end begins or ends there.
    void march(const Ray& ray, double from, double to, bool first, Intervals& found) const;

    const Box& box() const { return box_; }
    double size() const { return size_; }              // m, of what has bounds: the box's diagonal
    double resolution() const { return kResolution * size_; }

private:
    static constexpr double kResolution = 1e-5;        // of the size: steps are no shorter
    End endAt(const Ray& ray, double t) const;

    const KnownTree& known_;
    std::span<const Instruction> tape_;
    Box box_;
    double size_;
    bool finite_;
};

/// The stretch of a ray within a box; false where there is none at or after 0.
bool crossBox(const Box& box, const Ray& ray, double& enter, double& leave);

}  // namespace mb::accuracy
