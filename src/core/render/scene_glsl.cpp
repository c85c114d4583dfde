// map() and nearest() of a tree, as straight-line GLSL.
#include "core/render/compose.h"
#include "core/render/glsl_calls.h"

#include <fmt/format.h>

#include <map>

namespace mb {
namespace {

/// Writes the two functions side by side. The values on the tree's stack have names: d7 in map(), n7 in nearest().
struct Writer {
    const Tree& tree;
    std::string map, ahead, find;
    std::vector<std::string> stack, points{"p"};
    int next = 0;

    void leaf(std::size_t i) {
        const Leaf& leaf = tree.leaves[i];
        const std::string v = name(), record = fmt::format("leaf{}", i), &p = points[static_cast<std::size_t>(leaf.warps)];
        const std::string numbers = numbersOf(record, leaf.primitive->parameters, leaf.primitive->leafNumbers());
        const std::string at = leaf.primitive->turns ? fmt::format("local({}, {})", p, record) : fmt::format("{} - {}.position.xyz", p, record);
        const std::string line = fmt::format("    float d{} = {}({}{});\n", v, leaf.primitive->glsl, at, numbers);
        map += line, ahead += line;
        const std::string along = fmt::format("{}, {}{}", at, leaf.primitive->turns ? fmt::format("turnedTo(d, {})", record) : "d", numbers);
        ahead += fmt::format("    Ahead a{} = {};\n", v, aheadCall(*leaf.primitive, along));
        find += fmt::format("    float d{} = {}({}{});\n    Nearest n{} = foundLeaf(d{}, {}, local({}, {}));\n", v, leaf.primitive->glsl, at,
                            numbers, v, v, i, p, record);
        stack.push_back(v);
    }

    void join() {
        const auto [a, b] = operands();
        const std::string v = name();
        const std::string line = fmt::format("    float d{} = min(d{}, d{});\n", v, a, b);
        map += line, ahead += line;
        ahead += fmt::format("    Ahead a{} = anyAhead(a{}, a{});\n", v, a, b);
        find += fmt::format("    Nearest n{} = nearer(n{}, n{});\n", v, a, b);
        stack.push_back(v);
    }

    /// Without a blend the plain function is called with a constant, which folds away.
    void fold(std::size_t i) {
        const Branch& branch = tree.branches[i];
        const auto [a, b] = operands();
        const std::string v = name(), k = branch.blend > 0 ? fmt::format("branch{}.position.w", i) : "0.0";
        const std::string line = fmt::format("    float d{} = {}(d{}, d{}, {});\n", v, branch.op->glsl, a, b, k);
        map += line, ahead += line;
        ahead += fmt::format("    Ahead a{} = {};\n", v, aheadFold(*branch.op, "a" + a, "a" + b));
        find += fmt::format("    Nearest n{0} = foundBoth({1}(n{3}.distance, n{4}.distance, {5}), {2}(n{3}.distance, n{4}.distance, {5}, tie), n{3}, n{4});\n",
                            v, branch.op->glsl, branch.op->share, a, b, k);
        stack.push_back(v);
    }

    void enter(std::size_t i) {
        const Branch& branch = tree.branches[i];
        const std::string record = fmt::format("branch{}", i);
        // Else the driver may regroup the sum that the leaf's place is next taken from.
        const std::string line = fmt::format("    AS_WRITTEN vec3 p{} = {}(local({}, {}){});\n", i, branch.op->warp, points.back(), record,
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

/// How often the tree evaluates each operator, by its row in the table of effects.
std::map<std::size_t, int> operatorsOf(const Tree& tree) {
    std::map<std::size_t, int> times;
    for (const Instruction& step : tree.program)
        if (step.kind == Instruction::Kind::fold || step.kind == Instruction::Kind::wrap)
            ++times[numberOf(effectNamed(tree.branches[step.index].op->name))];
    return times;
}

bool readsRecord(const Branch& b) { return b.op->kind == Operator::Kind::wrap || b.blend > 0; }

}  // namespace

std::string sceneGlsl(const Tree& tree) {
    Writer w{tree, {}, {}, {}, {}};
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
    const std::string value = empty ? fmt::format("{:.1f}", kEmptyDistance) : "d" + w.stack.back();
    std::string count = fmt::format("    touch({});\n", tree.leaves.size());
    for (const auto& [row, times] : operatorsOf(tree)) count += fmt::format("    uses({}, {});\n", row, times);
    // What lies where its primitives do can be looked ahead for; what swells or warps them cannot.
    const std::string ahead = staysWithinLeaves(tree)
                                  ? fmt::format("vec3 mapAhead(vec3 p, vec3 d, out int leaf) {{\n    leaf = -1;\n{}{}    return vec3({}, {}, 1.0);\n}}\n",
                                                w.ahead, count, value, empty ? "EMPTY" : fmt::format("min(a{}.span.x, EMPTY)", w.stack.back()))
                                  : std::string("#define RELAXED\nvec3 mapAhead(vec3 p, vec3 d, out int leaf) {\n    leaf = -1;\n    return vec3(map(p), 0.0, 0.0);\n}\n");
    return fmt::format("#include \"lib/ahead.glsl\"\n{}void readScene() {{\n{}}}\nfloat enterScene(vec3 o, vec3 d) {{ return 0.0; }}\nfloat map(vec3 p) {{\n{}{}    return {};\n}}\n{}Nearest nearest(vec3 p) {{\n{}{}    return {};\n}}\n", held,
                       read, w.map, count, value, ahead, w.find, count, empty ? fmt::format("foundLeaf({:.1f}, -1, p)", kEmptyDistance) : "n" + w.stack.back());
}

}  // namespace mb
