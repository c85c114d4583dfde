// map() and nearest() of a tree, as straight-line GLSL.
#include "core/render/compose.h"

#include <fmt/format.h>

namespace mb {
namespace {

constexpr std::string_view kNumbers[] = {"x_axis.w", "y_axis.w", "z_axis.w", "extra.x"};

/// ", box3.x_axis.w, …": a type's numbers as the library's functions take them, from the record of that name.
std::string numbersOf(std::string_view record, std::span<const Parameter> parameters, int all) {
    std::string text;
    const auto number = [&](int at) { return fmt::format("{}.{}", record, kNumbers[at]); };
    int at = 0;
    for (const Parameter& p : parameters) {
        if (p.size == 3) text += fmt::format(", vec3({}, {}, {})", number(at), number(at + 1), number(at + 2));
        else text += ", " + number(at);
        at += p.size;
    }
    for (; at < all; ++at) text += ", " + number(at);
    return text;
}

/// Writes the two functions side by side. The values on the tree's stack have names: d7 in map(), n7 in nearest().
struct Writer {
    const Tree& tree;
    std::string map, find;
    std::vector<std::string> stack, points{"p"};
    int next = 0;

    void leaf(std::size_t i) {
        const Leaf& leaf = tree.leaves[i];
        const std::string v = name(), record = fmt::format("leaf{}", i), &p = points[static_cast<std::size_t>(leaf.warps)];
        const std::string numbers = numbersOf(record, leaf.primitive->parameters, leaf.primitive->leafNumbers());
        const std::string at = leaf.primitive->turns ? fmt::format("local({}, {})", p, record) : fmt::format("{} - {}.position.xyz", p, record);
        map += fmt::format("    float d{} = {}({}{});\n", v, leaf.primitive->glsl, at, numbers);
        find += fmt::format("    float d{} = {}({}{});\n    Nearest n{} = foundLeaf(d{}, {}, local({}, {}));\n", v, leaf.primitive->glsl, at,
                            numbers, v, v, i, p, record);
        stack.push_back(v);
    }

    void join() {
        const auto [a, b] = operands();
        const std::string v = name();
        map += fmt::format("    float d{} = min(d{}, d{});\n", v, a, b);
        find += fmt::format("    Nearest n{} = nearer(n{}, n{});\n", v, a, b);
        stack.push_back(v);
    }

    /// Without a blend the plain function is called with a constant, which folds away.
    void fold(std::size_t i) {
        const Branch& branch = tree.branches[i];
        const auto [a, b] = operands();
        const std::string v = name(), k = branch.blend > 0 ? fmt::format("branch{}.position.w", i) : "0.0";
        map += fmt::format("    float d{} = {}(d{}, d{}, {});\n", v, branch.op->glsl, a, b, k);
        find += fmt::format("    Nearest n{0} = foundBoth({1}(n{3}.distance, n{4}.distance, {5}), {2}(n{3}.distance, n{4}.distance, {5}), n{3}, n{4});\n",
                            v, branch.op->glsl, branch.op->share, a, b, k);
        stack.push_back(v);
    }

    void enter(std::size_t i) {
        const Branch& branch = tree.branches[i];
        const std::string record = fmt::format("branch{}", i);
        const std::string line = fmt::format("    vec3 p{} = {}(local({}, {}){});\n", i, branch.op->warp, points.back(), record,
                                             numbersOf(record, branch.op->parameters, branch.op->wrapNumbers()));
        map += line, find += line;
        points.push_back(fmt::format("p{}", i));
    }

    void wrap(std::size_t i) {
        const Branch& branch = tree.branches[i];
        if (branch.op->warp_by) points.pop_back();
        const std::string a = stack.back(), v = name(), record = fmt::format("branch{}", i);
        const std::string point = branch.op->takes_point ? fmt::format(", local({}, {})", points.back(), record) : std::string();
        const std::string numbers = numbersOf(record, branch.op->parameters, branch.op->wrapNumbers());
        map += fmt::format("    float d{} = {}(d{}{}{});\n", v, branch.op->glsl, a, point, numbers);
        find += fmt::format("    Nearest n{0} = n{1};\n    n{0}.distance = {2}(n{1}.distance{3}{4});\n", v, a, branch.op->glsl, point, numbers);
        stack.back() = v;
    }

private:
    std::string name() { return std::to_string(next++); }
    std::pair<std::string, std::string> operands() {
        const std::string b = stack.back(), a = stack[stack.size() - 2];
        stack.resize(stack.size() - 2);
        return {a, b};
    }
};

bool readsRecord(const Branch& b) { return b.op->kind == Operator::Kind::wrap || b.blend > 0; }

}  // namespace

std::string sceneGlsl(const Tree& tree) {
    Writer w{tree, {}, {}, {}};
    for (const Instruction& step : tree.program) {
        switch (step.kind) {
        case Instruction::Kind::leaf: w.leaf(step.index); break;
        case Instruction::Kind::join: w.join(); break;
        case Instruction::Kind::fold: w.fold(step.index); break;
        case Instruction::Kind::enter: w.enter(step.index); break;
        case Instruction::Kind::wrap: w.wrap(step.index); break;
        }
    }
    // llvmpipe reads a block anew at every use, even by a constant index: the numbers are read once, before any loop.
    std::string held, read;
    for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
        held += fmt::format("Node leaf{};\n", i);
        read += fmt::format("    leaf{0} = leaves[{0}];\n", i);
    }
    for (std::size_t i = 0; i < tree.branches.size(); ++i) {
        if (!readsRecord(tree.branches[i])) continue;
        held += fmt::format("Node branch{};\n", i);
        read += fmt::format("    branch{0} = branches[{0}];\n", i);
    }
    const bool empty = w.stack.empty();
    return fmt::format("{}void readScene() {{\n{}}}\nfloat map(vec3 p) {{\n{}    touches += {};\n    return {};\n}}\n"
                       "Nearest nearest(vec3 p) {{\n{}    touches += {};\n    return {};\n}}\n",
                       held, read, w.map, tree.leaves.size(), empty ? fmt::format("{:.1f}", kEmptyDistance) : "d" + w.stack.back(), w.find,
                       tree.leaves.size(), empty ? fmt::format("foundLeaf({:.1f}, -1, p)", kEmptyDistance) : "n" + w.stack.back());
}

}  // namespace mb
