// Lays a scene's objects out as a tree: frames multiplied down, copies made, warps given the size of what they warp.
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

/// A type's own numbers, scaled.
Numbers scaled(const Object& o, double scale) {
    Numbers numbers = o.numbers;
    std::size_t at = 0;
    for (const Parameter& p : o.type->parameters)
        for (int k = 0; k < p.size; ++k, ++at) numbers[at] = p.scaled(numbers[at], scale);
    return numbers;
}
LeafNumbers leading(const Numbers& numbers) {
    LeafNumbers k{};
    std::copy_n(numbers.begin(), k.size(), k.begin());
    return k;
}

struct Builder {
    const Scene& scene;
    Tree tree;
    int on_stack = 0, warps = 0, object = 0;
    double eased = 1;      // what a metre at the surface is in the value last left: a warp divides by its stretch. Of several, the greatest
    bool in_part = false;  // below an operator that is not a plain union

    void push(Instruction::Kind kind, std::size_t index) {
        using Kind = Instruction::Kind;
        tree.program.push_back({kind, static_cast<std::uint32_t>(index)});
        on_stack += kind == Kind::leaf ? 1 : kind == Kind::fold || kind == Kind::join ? -1 : 0;
        tree.depth = std::max(tree.depth, on_stack);
    }

    /// Appends the program of the object and its children; says whether it left a value.
    bool add(std::size_t i, const Frame& parent) {  // at most Limits::levels deep
        const Object& o = scene.objects[i];
        if (o.hidden || !tree.fault.empty()) return false;
        const Frame frame = below(parent, o);
        if (!o.type->isOperator()) return addPart([&] { return addLeaf(i, frame); });
        const Operator& op = asOperator(*o.type);
        switch (op.kind) {
        case Operator::Kind::copies: return addCopies(i, op, frame);
        case Operator::Kind::wrap: return addPart([&] { return addWrap(i, op, frame); });
        case Operator::Kind::fold: break;
        }
        const bool plain = op.blends && !op.intersects && !op.first_only && o.numbers[0] == 0;
        return plain ? addUnion(i, frame) : addPart([&] { return addFold(i, op, frame); });
    }

    /// Joins what `add_it` appends to the parts before it; inside a part it is no part of its own.
    template <class F> bool addPart(F add_it) {
        if (in_part) return add_it();
        const auto begin = static_cast<std::uint32_t>(tree.program.size());
        in_part = true;
        const bool left_value = add_it();
        in_part = false;
        if (!left_value) return false;
        tree.parts.push_back({begin, static_cast<std::uint32_t>(tree.program.size())});
        if (tree.parts.size() > 1) push(Instruction::Kind::join, 0);
        return true;
    }
    /// Between two values of a plain union inside a part; outside, each part has joined itself.
    void join(bool any) {
        if (any && in_part) push(Instruction::Kind::join, 0);
    }

    bool addUnion(std::size_t i, const Frame& frame) {
        bool any = false;
        double greatest = 0;
        for (std::size_t child = i + 1, end = subtreeEnd(scene, i); child < end; child = subtreeEnd(scene, child)) {
            if (!add(child, frame)) continue;
            join(any);
            any = true;
            greatest = std::max(greatest, eased);
        }
        eased = greatest;
        return any;
    }

    bool addFold(std::size_t i, const Operator& op, const Frame& frame) {
        const Mark start = mark();
        const std::size_t branch = tree.branches.size();
        tree.branches.push_back({&op, scaled(scene.objects[i], frame.scale)[0], i, {}, frame.rotation, frame.position, warps});
        bool any = false;
        double greatest = 0;
        for (std::size_t child = i + 1, end = subtreeEnd(scene, i); child < end; child = subtreeEnd(scene, child)) {
            const bool left_value = add(child, frame);
            if (left_value && any) push(Instruction::Kind::fold, branch);
            // A hidden first child is an empty set: nothing can be subtracted from it. Nothing is shared with an empty set,
            // and no shape lies between it and another.
            const bool needed = op.intersects || op.min_children > 1 || (op.first_only && child == i + 1);
            if (!left_value && needed) return rewind(start), false;
            any = any || left_value;
            if (left_value) greatest = std::max(greatest, eased);
        }
        eased = greatest;
        if (op.parameters[0].isLength()) tree.branches[branch].blend *= eased;
        return any;
    }

    bool addWrap(std::size_t i, const Operator& op, const Frame& frame) {
        const bool warps_space = static_cast<bool>(op.warp_by);
        const Mark start = mark();
        const std::size_t branch = tree.branches.size();
        tree.branches.push_back({&op, 0, i, leading(scaled(scene.objects[i], frame.scale)), frame.rotation, frame.position, warps});
        if (warps_space) {
            push(Instruction::Kind::enter, branch);
            tree.warps = std::max(tree.warps, ++warps);
        }
        const std::size_t begin = tree.program.size();
        // The children of a warp are placed in its own frame, scaled like it.
        const bool left_value = i + 1 < subtreeEnd(scene, i) && add(i + 1, warps_space ? Frame{glm::dmat3(1), glm::dvec3(0), frame.scale} : frame);
        if (warps_space) --warps;
        if (!left_value) return rewind(start), false;

        LeafNumbers& numbers = tree.branches[branch].numbers;
        std::size_t at = 0;
        for (const Parameter& p : op.parameters)
            for (int k = 0; k < p.size; ++k, ++at)
                if (p.isLength()) numbers[at] *= eased;
        if (op.cook) op.cook(numbers, bounds(tree, std::span(tree.program).subspan(begin)));
        for (const double x : numbers)
            if (!std::isfinite(x)) return refuse(i, "a shape without bounds: put it into an intersect with one that has them"), false;
        for (const std::string_view name : op.derived) {
            if (name == "ease") eased *= numbers[at];
            ++at;
        }
        push(Instruction::Kind::wrap, branch);
        return true;
    }

    bool addCopies(std::size_t i, const Operator& op, const Frame& frame) {
        const Numbers numbers = scaled(scene.objects[i], frame.scale);
        const double count = op.count(numbers);
        bool any = false;
        for (double n = 0; n < count && tree.fault.empty(); ++n) {
            if (tree.leaves.size() > kMostLeaves || n > static_cast<double>(kMostLeaves))
                return refuse(i, fmt::format("{} copies: a scene may hold {} primitives", count, kMostLeaves)), false;
            const Copy copy = op.copy(numbers, static_cast<std::size_t>(n));
            const glm::dmat3 mirror{copy.mirror[0], 0, 0, 0, copy.mirror[1], 0, 0, 0, copy.mirror[2]};
            const glm::dvec3 offset{copy.offset[0], copy.offset[1], copy.offset[2]};
            if (!add(i + 1, {frame.rotation * mirror, frame.position + frame.rotation * offset, frame.scale})) break;
            join(any);
            any = true;
        }
        return any;
    }

    bool addLeaf(std::size_t i, const Frame& frame) {
        const Object& o = scene.objects[i];
        const Primitive& primitive = asPrimitive(*o.type);
        Leaf leaf{&primitive, frame.rotation, frame.position, leading(scaled(o, frame.scale)), object, effectiveMaterial(scene, i), i, warps};
        if (primitive.cook) primitive.cook(leaf.numbers);
        eased = 1;
        tree.leaves.push_back(leaf);
        push(Instruction::Kind::leaf, tree.leaves.size() - 1);
        return true;
    }

    struct Mark {
        std::size_t program, leaves, branches;
        int on_stack;
    };
    Mark mark() const { return {tree.program.size(), tree.leaves.size(), tree.branches.size(), on_stack}; }
    /// Takes back all that was appended since.
    void rewind(const Mark& m) {
        tree.program.resize(m.program), tree.leaves.resize(m.leaves), tree.branches.resize(m.branches);
        on_stack = m.on_stack;
    }
    void refuse(std::size_t i, std::string_view why) {
        if (!tree.fault.empty()) return;
        tree.fault_object = i;
        tree.fault = fmt::format("object '{}' ({}) holds {}", label(scene, i), scene.objects[i].type->name, why);
    }
};

}  // namespace

namespace {

Tree orRefused(Tree tree) {
    if (tree.fault.empty()) return tree;
    Tree refused;
    refused.fault = std::move(tree.fault), refused.fault_object = tree.fault_object;
    return refused;
}

}  // namespace

Tree makeTree(const Scene& scene, const std::function<bool(std::size_t)>& wanted) {
    Builder builder{scene, {}};
    for (std::size_t i = 0; i < scene.objects.size(); i = subtreeEnd(scene, i), ++builder.object)
        if (!wanted || wanted(i)) builder.add(i, {});
    return orRefused(std::move(builder.tree));
}

Tree makeTreeOf(const Scene& scene, std::size_t object) {
    Builder builder{scene, {}};
    builder.add(object, {});
    return orRefused(std::move(builder.tree));
}

}  // namespace mb
