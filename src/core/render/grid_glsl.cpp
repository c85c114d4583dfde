// map() and nearest() of a grid: they run the items of the cell that a point lies in.
#include "core/render/compose.h"
#include "core/render/glsl_calls.h"
#include "core/sdf/grid.h"

#include <algorithm>
#include <set>

namespace mb {
namespace {

/// The rows of both tables that a tree uses, by number.
struct Used {
    std::set<std::size_t> leaves, folds, wraps, warps;
    bool plain() const { return folds.empty() && wraps.empty(); }
};
Used usedBy(const Tree& tree) {
    Used used;
    for (const Instruction& step : tree.program) {
        if (step.kind == Instruction::Kind::leaf) {
            used.leaves.insert(static_cast<std::size_t>(tree.leaves[step.index].primitive - primitives().data()));
        } else if (step.kind != Instruction::Kind::join) {
            const Operator* op = tree.branches[step.index].op;
            const auto row = static_cast<std::size_t>(op - operators().data());
            (step.kind == Instruction::Kind::fold ? used.folds : used.wraps).insert(row);
            if (op->warp_by) used.warps.insert(row);
        }
    }
    return used;
}

/// `TYPE NAME(ARGUMENTS)` that chooses among calls by a number; with one row there is nothing to choose.
template <class Call> std::string chooser(std::string_view head, std::string_view result, std::string_view by, const std::set<std::size_t>& rows,
                                          std::size_t first, Call call) {
    std::string text = fmt::format("{} {{\n", head);
    if (rows.size() == 1) return text + fmt::format("    return {};\n}}\n", call(*rows.begin()));
    text += fmt::format("    {};\n", result);
    for (const std::size_t row : rows) text += fmt::format("    if ({} == {}) result = {};\n", by, first + row, call(row));
    return text + "    return result;\n}\n";
}

std::string choosers(const Used& used) {
    const auto wrapNumbers = [](const Operator& o) { return numbersOf("node", o.parameters, o.wrapNumbers()); };
    std::string text = chooser("float leafDistance(int code, vec3 at, Node node)", "float result = EMPTY", "code", used.leaves, 0, [](std::size_t row) {
        const Primitive& p = primitives()[row];
        return fmt::format("{}(at{})", p.glsl, numbersOf("node", p.parameters, p.leafNumbers()));
    });
    text += chooser("vec2 leafSpan(int code, vec3 o, vec3 d, Node node)", "vec2 result = vec2(-EMPTY, EMPTY)", "code", used.leaves, 0, [](std::size_t row) {
        const Primitive& p = primitives()[row];
        return p.span.empty() ? std::string("vec2(-EMPTY, EMPTY)") : fmt::format("{}(o, d{})", p.span, numbersOf("node", p.parameters, p.leafNumbers()));
    });
    for (const bool share : {false, true})
        if (!used.folds.empty())
            text += chooser(fmt::format("float {}(int how, float a, float b, float k)", share ? "shareOfSecond" : "foldDistances"), "float result = a", "how",
                            used.folds, kItemFolds, [share](std::size_t row) {
                                const Operator& o = operators()[row];
                                return share ? fmt::format("{}(a, b, k, tie)", o.share) : fmt::format("{}(a, b, k)", o.glsl);
                            });
    if (!used.wraps.empty())
        text += chooser("float wrapDistance(int code, float d, vec3 at, Node node)", "float result = d", "code", used.wraps, kItemWrap, [&](std::size_t row) {
            const Operator& o = operators()[row];
            return fmt::format("{}(d{}{})", o.glsl, o.takes_point ? ", at" : "", wrapNumbers(o));
        });
    if (!used.warps.empty())
        text += chooser("vec3 warpPoint(int code, vec3 at, Node node)", "vec3 result = at", "code", used.warps, kItemEnter, [&](std::size_t row) {
            const Operator& o = operators()[row];
            return fmt::format("{}(at{})", o.warp, wrapNumbers(o));
        });
    return text;
}

/// What differs between the two functions: the type of a value and how it is made and joined.
struct Flavour {
    std::string_view type, head, empty, leaf, join, fold, wrap, result;
    bool looks_ahead = false;
};
constexpr Flavour kMap{"float", "float map(vec3 p)", "EMPTY", "leafDistance(item.code, at, node)", "min(top, value)", "foldDistances(item.how, top, value, k)",
                       "top = wrapDistance(item.code, top, at, node)", "min(top, cell.safe)"};
constexpr std::string_view kAheadHead = "vec3 mapAhead(vec3 p, vec3 d, Cell cell, out int leaf)";
constexpr Flavour kAhead{"float", kAheadHead, kMap.empty, kMap.leaf, kMap.join, kMap.fold, kMap.wrap, "vec3(min(top, cell.safe), free, free < exit ? 1.0 : 0.0)", true};
/// Where every surface is one leaf's own, the march keeps whose.
constexpr Flavour kLead{"Lead", kAheadHead, "Lead(EMPTY, -1)", "Lead(leafDistance(item.code, at, node), item.record)", "nearer(top, value)",
                        "foundBoth(foldDistances(item.how, top.distance, value.distance, k), shareOfSecond(item.how, top.distance, value.distance, k), top, value)",
                        "", "vec3(min(top.distance, cell.safe), free, free < exit ? 1.0 : 0.0)", true};
constexpr Flavour kNearest{"Nearest", "Nearest nearest(vec3 p)", "foundLeaf(EMPTY, -1, p)", "foundLeaf(leafDistance(item.code, at, node), item.record, at)",
                           "nearer(top, value)",
                           "foundBoth(foldDistances(item.how, top.distance, value.distance, k), shareOfSecond(item.how, top.distance, value.distance, k), top, value)",
                           "top.distance = wrapDistance(item.code, top.distance, at, node)", "nearer(top, foundLeaf(cell.safe, -1, p))"};

/// Registers NAME, NAME1, NAME2 … as a stack: what moves them up, or down.
std::string shifted(std::string_view name, int depth, bool up) {
    std::string text;
    const auto reg = [&](int i) { return i == 0 ? std::string(name) : fmt::format("{}{}", name, i); };
    for (int i = 0; i + 1 < depth; ++i)
        text += up ? fmt::format(" {} = {};", reg(depth - 1 - i), reg(depth - 2 - i)) : fmt::format(" {} = {};", reg(i), reg(i + 1));
    return text;
}
std::string registers(std::string_view type, std::string_view name, int depth) {
    std::string text;
    for (int i = 1; i < depth; ++i) text += fmt::format("    {0} {1}{2} = {1};\n", type, name, i);
    return text;
}

/// llvmpipe masks what an `if` encloses and skips nothing: whatever no item of the scene can ask for is not written.
std::string runner(const Flavour& f, const Used& used, int stack, int warps) {
    std::string text = fmt::format("{1} {{\n{5}    {0} top = {2};\n{3}    vec3 q = p;\n{4}    int i = cell.first;\n"
                                   "    bool more = i >= 0;\n    while (more) {{\n        Item item = itemAt(i);\n        Node node = recordAt(item.record);\n"
                                   "        vec3 at = local(q, node);\n",
                                   f.type, f.head, f.empty, registers(f.type, "top", stack),
                                   registers("vec3", "q", warps + 1) + (f.looks_ahead ? "    float exit = freeIn(cell, p, d), free = exit;\n" : ""),
                                   f.looks_ahead ? "" : "    Cell cell = cellAt(p);\n");
    const std::string span = f.looks_ahead ? " free = freeBefore(free, leafSpan(item.code, at, turnedTo(d, node), node));" : "";
    if (used.plain()) {
        text += fmt::format("        {} value = {};\n        top = {};\n       {} touches += 1;\n", f.type, f.leaf, f.join, span);
    } else {
        text += fmt::format("        {} value = top;\n        bool is_leaf = item.code < {};\n", f.type, kItemEnter);
        text += fmt::format("        if (is_leaf) {{ value = {};{} touches += 1; }}\n", f.leaf, span);
        if (f.looks_ahead && !used.wraps.empty())  // what is warped, or swells, is not where its leaves are
            text += fmt::format("        if (item.code >= {} && item.code < {}) free = 0.0;\n", kItemEnter, kItemPop);
        if (stack > 1) text += fmt::format("        if (item.code == {}) {{{} }}\n", kItemPop, shifted("top", stack, false));
        if (!used.wraps.empty()) {
            // A wrap that closes a space is asked in the one around it.
            if (!used.warps.empty()) {
                std::string closes, opens = fmt::format("item.code >= {} && item.code < {}", kItemEnter, kItemWrap);
                for (const std::size_t row : used.warps) closes += fmt::format("{}item.code == {}", closes.empty() ? "" : " || ", kItemWrap + row);
                text += fmt::format("        if ({}) {{{} at = local(q, node); }}\n", closes, shifted("q", warps + 1, false));
                text += fmt::format("        if ({}) {{{} q = warpPoint(item.code, at, node); }}\n", opens, shifted("q", warps + 1, true));
            }
            text += fmt::format("        if (item.code >= {} && item.code < {}) {};\n", kItemWrap, kItemPop, f.wrap);
        }
        text += fmt::format("        if (item.how == {}) {{ if (is_leaf) {{{} top = value; }} }}\n        else if (item.how == {}) top = {};\n", kItemPush,
                            shifted("top", stack, true), kItemJoin, f.join);
        if (!used.folds.empty())
            text += fmt::format("        else {{ float k = recordTexel(item.joined * NODE_TEXELS).w;{} top = {}; }}\n", f.looks_ahead ? " if (k > 0.0) free = 0.0;" : "", f.fold);
    }
    return text + fmt::format("        more = !item.last;\n        ++i;\n    }}\n    if (more) cut_short = true;\n{}    return {};\n}}\n",
                              !f.looks_ahead ? "" : f.type == "Lead" ? "    leaf = top.leaf;\n" : "    leaf = -1;\n", f.result);
}

}  // namespace

std::string gridGlsl(const Tree& tree) {
    const Used used = usedBy(tree);
    const int stack = itemStack(tree, tree.program);
    if (used.leaves.empty()) return sceneGlsl(tree);
    const bool own = staysWithinLeaves(tree) && std::ranges::all_of(tree.branches, [](const Branch& b) { return b.op->blends; });
    return fmt::format("#define {}\n#include \"lib/grid.glsl\"\nvoid readScene() {{}}\n", own ? "LEAF_SURFACE" : "RELAXED") + choosers(used) + runner(kMap, used, stack, tree.warps) +
           runner(own ? kLead : kAhead, used, stack, tree.warps) + runner(kNearest, used, stack, tree.warps);
}

}  // namespace mb
