#include "core/sdf/tree.h"

#include <fmt/format.h>

#include <cassert>

namespace mb {
namespace {

/// A frame of the scene's tree: world = position + scale·rotation·local.
struct Frame {
    glm::dmat3 rotation{1};
    glm::dvec3 position{0};
    double scale = 1;
};

Frame below(const Frame& parent, const Object& o) {
    return {parent.rotation * rotationFromDegrees(o.rot), parent.position + parent.scale * (parent.rotation * o.pos),
            parent.scale * o.scale};
}

struct Builder {
    const Scene& scene;
    Tree tree;
    int on_stack = 0;

    void push(Instruction::Kind kind, std::size_t index) {
        tree.program.push_back({kind, static_cast<std::uint32_t>(index)});
        on_stack += kind == Instruction::Kind::leaf ? 1 : -1;
        tree.depth = std::max(tree.depth, on_stack);
    }

    /// Appends the program of the object and its children; says whether it left a value.
    bool add(std::size_t i, const Frame& parent, int object) {  // at most Limits::levels deep
        const Object& o = scene.objects[i];
        if (o.hidden) return false;
        const Frame frame = below(parent, o);
        if (!o.type->isOperator()) return addLeaf(i, frame, object), true;

        const Operator& op = asOperator(*o.type);
        assert(op.evaluated());
        const std::size_t branch = tree.branches.size();
        tree.branches.push_back({&op, o.numbers[0] * frame.scale, i});
        bool any = false;
        for (std::size_t child = i + 1, end = subtreeEnd(scene, i); child < end; child = subtreeEnd(scene, child)) {
            const bool left_value = add(child, frame, object);
            if (left_value && any) push(Instruction::Kind::fold, branch);
            // A hidden first child is an empty set: nothing can be subtracted from it, nothing shared with it.
            if (!left_value && !any && child == i + 1 && op.first_only) return false;
            if (!left_value && op.intersects) return drop(any), false;
            any = any || left_value;
        }
        return any;
    }

    void addLeaf(std::size_t i, const Frame& frame, int object) {
        const Object& o = scene.objects[i];
        const Primitive& primitive = asPrimitive(*o.type);
        Leaf leaf{&primitive, frame.rotation, frame.position, {}, object, effectiveMaterial(scene, i), i};
        std::size_t at = 0;
        for (const Parameter& p : primitive.parameters)
            for (int k = 0; k < p.size; ++k, ++at) leaf.numbers[at] = o.numbers[at] * (p.isLength() ? frame.scale : 1);
        if (primitive.cook) primitive.cook(leaf.numbers);
        tree.leaves.push_back(leaf);
        push(Instruction::Kind::leaf, tree.leaves.size() - 1);
    }

    /// Takes back what the last value on the stack was made by.
    void drop(bool any) {
        if (!any) return;
        int values = 0;
        while (values != 1) {
            values += tree.program.back().kind == Instruction::Kind::leaf ? 1 : -1;
            tree.program.pop_back();
        }
        --on_stack;
    }
};

template <class R> sdf::Vec3<R> toLeaf(const Leaf& leaf, const sdf::Vec3<R>& p) {
    const auto number = [](double x) { return static_cast<R>(x); };
    const sdf::Vec3<R> q{p.x - number(leaf.position.x), p.y - number(leaf.position.y), p.z - number(leaf.position.z)};
    const glm::dmat3& m = leaf.rotation;  // its columns are the leaf's axes
    const auto along = [&](int axis) { return number(m[axis].x) * q.x + number(m[axis].y) * q.y + number(m[axis].z) * q.z; };
    return {along(0), along(1), along(2)};
}

/// Runs the program over values made by `leaf` and joined by `fold` and `join`.
template <class Value, class LeafFn, class FoldFn, class JoinFn>
Value run(const Tree& tree, Value empty, LeafFn leaf, FoldFn fold, JoinFn join) {
    if (tree.program.empty()) return empty;
    constexpr int kInPlace = 40;  // deeper than Limits::levels lets a program go
    assert(tree.depth <= kInPlace);
    std::array<Value, kInPlace> stack;
    stack.fill(empty);
    std::size_t top = 0;
    for (const Instruction& step : tree.program) {
        if (step.kind == Instruction::Kind::leaf) {
            stack[top++] = leaf(step.index);
            continue;
        }
        --top;
        stack[top - 1] = step.kind == Instruction::Kind::join ? join(stack[top - 1], stack[top])
                                                              : fold(tree.branches[step.index], stack[top - 1], stack[top]);
    }
    return stack[0];
}

}  // namespace

Tree makeTree(const Scene& scene, const std::function<bool(std::size_t)>& wanted) {
    Builder builder{scene, {}, 0};
    int object = 0;
    bool any = false;
    for (std::size_t i = 0; i < scene.objects.size(); i = subtreeEnd(scene, i), ++object) {
        if ((wanted && !wanted(i)) || !builder.add(i, {}, object)) continue;
        if (any) builder.push(Instruction::Kind::join, 0);
        any = true;
    }
    return std::move(builder.tree);
}

std::optional<std::size_t> firstUnevaluated(const Scene& scene) {
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& o = scene.objects[i];
        if (o.type->isOperator() && !asOperator(*o.type).evaluated()) return i;
    }
    return std::nullopt;
}

std::string whyUnevaluated(const Scene& scene) {
    const auto object = firstUnevaluated(scene);
    return object ? fmt::format("object '{}' is of type '{}', which this version can neither draw nor touch", label(scene, *object),
                                scene.objects[*object].type->name)
                  : std::string();
}

template <class R> R distance(const Tree& tree, sdf::Vec3<R> p) {
    return run<R>(
        tree, R(static_cast<R>(kEmptyDistance)),
        [&](std::size_t i) { return tree.leaves[i].primitive->distance<R>(toLeaf<R>(tree.leaves[i], p), tree.leaves[i].numbers); },
        [](const Branch& b, R x, R y) { return b.op->fold<R>(x, y, b.blend); },
        [](R x, R y) {
            using sdf::min;
            return min(x, y);
        });
}
template float distance(const Tree&, sdf::Vec3<float>);
template double distance(const Tree&, sdf::Vec3<double>);
template sdf::Dual distance(const Tree&, sdf::Vec3<sdf::Dual>);
template sdf::Interval distance(const Tree&, sdf::Vec3<sdf::Interval>);

template <class R> Nearest<R> nearest(const Tree& tree, sdf::Vec3<R> p) {
    using Found = Nearest<R>;
    return run<Found>(
        tree, Found{static_cast<R>(kEmptyDistance), -1},
        [&](std::size_t i) {
            const Leaf& leaf = tree.leaves[i];
            return Found{leaf.primitive->distance<R>(toLeaf<R>(leaf, p), leaf.numbers), static_cast<int>(i)};
        },
        [](const Branch& b, Found x, Found y) {
            const bool second = b.op->takesSecond(static_cast<double>(x.distance), static_cast<double>(y.distance));
            return Found{b.op->fold<R>(x.distance, y.distance, b.blend), second ? y.leaf : x.leaf};
        },
        [](Found x, Found y) { return y.distance < x.distance ? y : x; });
}
template Nearest<float> nearest(const Tree&, sdf::Vec3<float>);
template Nearest<double> nearest(const Tree&, sdf::Vec3<double>);

Slope slope(const Tree& tree, glm::dvec3 p) {
    const sdf::Dual d = distance<sdf::Dual>(tree, {{p.x, 1, 0, 0}, {p.y, 0, 1, 0}, {p.z, 0, 0, 1}});
    return {d.v, {d.dx, d.dy, d.dz}};
}

Box bounds(const Leaf& leaf) {
    const Box local = leaf.primitive->extent(leaf.numbers);
    Box box{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int axis = 0; axis < 3; ++axis) {
        double lo = leaf.position[axis], hi = lo;
        for (int k = 0; k < 3; ++k) {
            const double m = leaf.rotation[k][axis], a = local.lo[static_cast<std::size_t>(k)], b = local.hi[static_cast<std::size_t>(k)];
            if (m == 0) continue;  // 0·∞ is NaN
            lo += std::min(m * a, m * b), hi += std::max(m * a, m * b);
        }
        box.lo[static_cast<std::size_t>(axis)] = lo, box.hi[static_cast<std::size_t>(axis)] = hi;
    }
    return box;
}

Box bounds(const Tree& tree) {
    const Box empty{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    const auto either = [](Box a, const Box& b) {
        for (std::size_t i = 0; i < 3; ++i) a.lo[i] = std::min(a.lo[i], b.lo[i]), a.hi[i] = std::max(a.hi[i], b.hi[i]);
        return a;
    };
    const auto both = [](Box a, const Box& b) {
        for (std::size_t i = 0; i < 3; ++i) a.lo[i] = std::max(a.lo[i], b.lo[i]), a.hi[i] = std::min(a.hi[i], b.hi[i]);
        return a;
    };
    // Where the value is no more than e, a point lies within e/rises of the box: a blend's k/4 carries a bound's surface
    // further than a distance's.
    struct Reach {
        Box box;
        double rises = 1;
    };
    return run<Reach>(
               tree, Reach{empty},
               [&](std::size_t i) {
                   const Leaf& leaf = tree.leaves[i];
                   return Reach{bounds(leaf), leaf.primitive->rises ? leaf.primitive->rises(leaf.numbers) : 1};
               },
               [&](const Branch& b, const Reach& x, const Reach& y) {
                   if (b.op->first_only) return x;  // a blend only takes away where it subtracts or intersects
                   const double rises = std::min(x.rises, y.rises);
                   if (b.op->intersects) return Reach{both(x.box, y.box), rises};
                   Reach r{either(x.box, y.box), rises};
                   for (std::size_t i = 0; i < 3; ++i) r.box.lo[i] -= b.blend / 4 / rises, r.box.hi[i] += b.blend / 4 / rises;
                   return r;
               },
               [&](const Reach& x, const Reach& y) { return Reach{either(x.box, y.box), std::min(x.rises, y.rises)}; })
        .box;
}

}  // namespace mb
