#include "core/sdf/tree.h"

#include <array>
#include <cassert>

namespace mb {
namespace {

constexpr std::size_t kStack = 40, kSpaces = 34;  // deeper than Limits::levels lets a program go

/// Runs a tape over values: leaf(leaf), fold(branch, a, b), join(a, b), enter(branch), wrap(branch, a).
template <class Value, class Visitor> Value run(const Tree& tree, std::span<const Instruction> tape, Value empty, Visitor visit) {
    if (tape.empty()) return empty;
    assert(tree.depth <= static_cast<int>(kStack));
    std::array<Value, kStack> stack;
    std::size_t top = 0;
    for (const Instruction& step : tape) {
        switch (step.kind) {
        case Instruction::Kind::leaf: stack[top++] = visit.leaf(step.index); break;
        case Instruction::Kind::fold: --top, stack[top - 1] = visit.fold(tree.branches[step.index], stack[top - 1], stack[top]); break;
        case Instruction::Kind::join: --top, stack[top - 1] = visit.join(stack[top - 1], stack[top]); break;
        case Instruction::Kind::enter: visit.enter(tree.branches[step.index]); break;
        case Instruction::Kind::wrap: stack[top - 1] = visit.wrap(tree.branches[step.index], stack[top - 1]); break;
        }
    }
    return stack[0];
}

/// The point in each of the spaces that are open.
template <class R> struct Spaces {
    const Tree& tree;
    std::array<sdf::Vec3<R>, kSpaces> points;

    Spaces(const Tree& t, const sdf::Vec3<R>& p, int warps) : tree(t) { at(warps) = p; }
    sdf::Vec3<R>& at(int warps) { return points[static_cast<std::size_t>(warps)]; }
    sdf::Vec3<R> in(const Branch& b) { return toFrame(b.rotation, b.position, at(b.warps)); }
    void enter(const Branch& b) { at(b.warps + 1) = b.op->warped<R>(in(b), b.numbers); }
    R leafDistance(std::size_t i) {
        const Leaf& leaf = tree.leaves[i];
        return leaf.primitive->distance<R>(toFrame(leaf.rotation, leaf.position, at(leaf.warps)), leaf.numbers);
    }
    R wrapped(const Branch& b, R d) { return b.op->wrap<R>(d, in(b), b.numbers); }
};

template <class R> struct DistanceVisitor {
    Spaces<R> spaces;
    R leaf(std::size_t i) { return spaces.leafDistance(i); }
    R fold(const Branch& b, R x, R y) { return b.op->fold<R>(x, y, b.blend); }
    R join(R x, R y) {
        using sdf::min;
        return min(x, y);
    }
    void enter(const Branch& b) { spaces.enter(b); }
    R wrap(const Branch& b, R x) { return spaces.wrapped(b, x); }
};

template <class R> struct NearestVisitor {
    using Found = Nearest<R>;
    Spaces<R> spaces;
    double tie = 0;
    Found leaf(std::size_t i) { return {spaces.leafDistance(i), static_cast<int>(i)}; }
    Found fold(const Branch& b, Found x, Found y) {
        const bool second = b.op->shareOfSecond<R>(x.distance, y.distance, b.blend, tie) > R(0.5);
        return {b.op->fold<R>(x.distance, y.distance, b.blend), second ? y.leaf : x.leaf};
    }
    Found join(Found x, Found y) {
        const bool second = y.distance < x.distance - static_cast<R>(tie);
        return {std::min(x.distance, y.distance), second ? y.leaf : x.leaf};
    }
    void enter(const Branch& b) { spaces.enter(b); }
    Found wrap(const Branch& b, Found x) { return {spaces.wrapped(b, x.distance), x.leaf}; }
};

/// Where the value is no more than e, a point lies within e/rises of the box: a blend's k/4 carries a bound's surface
/// further than a distance's.
struct Reach {
    Box box{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    double rises = 1;
};
Box either(Box a, const Box& b) {
    for (std::size_t i = 0; i < 3; ++i) a.lo[i] = std::min(a.lo[i], b.lo[i]), a.hi[i] = std::max(a.hi[i], b.hi[i]);
    return a;
}
Box both(Box a, const Box& b) {
    for (std::size_t i = 0; i < 3; ++i) a.lo[i] = std::max(a.lo[i], b.lo[i]), a.hi[i] = std::min(a.hi[i], b.hi[i]);
    return a;
}
Box grown(Box a, double by) {
    for (std::size_t i = 0; i < 3; ++i) a.lo[i] -= by, a.hi[i] += by;
    return a;
}
/// The box around a box of a frame, seen from the space the frame lies in.
Box placed(const Box& local, const glm::dmat3& rotation, glm::dvec3 position) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        double lo = position[axis], hi = lo;
        for (int k = 0; k < 3; ++k) {
            const double m = rotation[k][axis], a = local.lo[static_cast<std::size_t>(k)], b = local.hi[static_cast<std::size_t>(k)];
            if (m == 0) continue;  // 0·∞ is NaN
            lo += std::min(m * a, m * b), hi += std::max(m * a, m * b);
        }
        box.lo[static_cast<std::size_t>(axis)] = lo, box.hi[static_cast<std::size_t>(axis)] = hi;
    }
    return box;
}
bool isEmpty(const Box& b) { return b.lo[0] > b.hi[0] || b.lo[1] > b.hi[1] || b.lo[2] > b.hi[2]; }

struct BoundsVisitor {
    const Tree& tree;
    Reach leaf(std::size_t i) {
        const Leaf& l = tree.leaves[i];
        return {bounds(l), l.primitive->rises ? l.primitive->rises(l.numbers) : 1};
    }
    Reach fold(const Branch& b, const Reach& x, const Reach& y) {
        if (b.op->first_only) return x;  // a blend only takes away where it subtracts or intersects
        const double rises = std::min(x.rises, y.rises);
        if (b.op->intersects) return {both(x.box, y.box), rises};
        return {grown(either(x.box, y.box), b.op->blends ? b.blend / 4 / rises : 0), rises};
    }
    Reach join(const Reach& x, const Reach& y) { return {either(x.box, y.box), std::min(x.rises, y.rises)}; }
    void enter(const Branch&) {}
    Reach wrap(const Branch& b, const Reach& x) {
        if (isEmpty(x.box)) return x;
        const double steep = b.op->steepness ? b.op->steepness(b.numbers) : 1;
        const Box box = b.op->grows ? grown(x.box, b.op->grows(b.numbers) / x.rises) : x.box;
        if (!b.op->extent) return {box, x.rises};
        return {placed(b.op->extent(b.numbers, box), b.rotation, b.position), x.rises / steep};
    }
};

}  // namespace

template <class R> sdf::Vec3<R> toFrame(const glm::dmat3& m, glm::dvec3 position, const sdf::Vec3<R>& p) {
    const auto number = [](double x) { return static_cast<R>(x); };
    const sdf::Vec3<R> q{p.x - number(position.x), p.y - number(position.y), p.z - number(position.z)};
    // The matrix's columns are the frame's axes.
    const auto along = [&](int axis) { return number(m[axis].x) * q.x + number(m[axis].y) * q.y + number(m[axis].z) * q.z; };
    return {along(0), along(1), along(2)};
}

template <class R> R distance(const Tree& tree, std::span<const Instruction> tape, sdf::Vec3<R> p, int warps) {
    return run<R>(tree, tape, R(static_cast<R>(kEmptyDistance)), DistanceVisitor<R>{Spaces<R>(tree, p, warps)});
}
template <class R> R distance(const Tree& tree, sdf::Vec3<R> p) { return distance<R>(tree, tree.program, p); }
template <class R> Nearest<R> nearest(const Tree& tree, std::span<const Instruction> tape, sdf::Vec3<R> p, double tie) {
    return run<Nearest<R>>(tree, tape, {static_cast<R>(kEmptyDistance), -1}, NearestVisitor<R>{Spaces<R>(tree, p, 0), tie});
}
template <class R> Nearest<R> nearest(const Tree& tree, sdf::Vec3<R> p, double tie) { return nearest<R>(tree, tree.program, p, tie); }

#define MB_FOR(R)                                                                          \
    template sdf::Vec3<R> toFrame(const glm::dmat3&, glm::dvec3, const sdf::Vec3<R>&);     \
    template R distance(const Tree&, sdf::Vec3<R>);                                        \
    template R distance(const Tree&, std::span<const Instruction>, sdf::Vec3<R>, int);
MB_FOR(float)
MB_FOR(double)
MB_FOR(sdf::Dual)
MB_FOR(sdf::Interval)
#undef MB_FOR
template Nearest<float> nearest(const Tree&, sdf::Vec3<float>, double);
template Nearest<double> nearest(const Tree&, sdf::Vec3<double>, double);
template Nearest<float> nearest(const Tree&, std::span<const Instruction>, sdf::Vec3<float>, double);
template Nearest<double> nearest(const Tree&, std::span<const Instruction>, sdf::Vec3<double>, double);

Slope slope(const Tree& tree, glm::dvec3 p) {
    const sdf::Dual d = distance<sdf::Dual>(tree, {{p.x, 1, 0, 0}, {p.y, 0, 1, 0}, {p.z, 0, 0, 1}});
    return {d.v, {d.dx, d.dy, d.dz}};
}

Box bounds(const Leaf& leaf) { return placed(leaf.primitive->extent(leaf.numbers), leaf.rotation, leaf.position); }
Box bounds(const Tree& tree, std::span<const Instruction> tape) { return run<Reach>(tree, tape, {}, BoundsVisitor{tree}).box; }
Box bounds(const Tree& tree) { return bounds(tree, tree.program); }

bool staysWithinLeaves(const Branch& b) { return b.op->kind == Operator::Kind::fold && (!b.op->blends || b.blend == 0); }
bool staysWithinLeaves(const Tree& tree) {
    for (const Branch& b : tree.branches)
        if (!staysWithinLeaves(b)) return false;
    return true;
}

bool isFinite(const Box& box) {
    for (std::size_t i = 0; i < 3; ++i)
        if (!std::isfinite(box.lo[i]) || !std::isfinite(box.hi[i])) return false;
    return true;
}

}  // namespace mb
