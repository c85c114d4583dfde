// map() and nearest() of a grid: they run the items of the cell that a point lies in.
#include "core/render/compose.h"
#include "core/render/glsl_calls.h"
#include "core/sdf/grid.h"

#include <algorithm>
#include <set>

namespace mb {
namespace {

std::size_t firstOperatorRow() { return numberOf(effectNamed(operators().front().name)); }

/// The rows of both tables that a tree uses, by number.
struct Used {
    std::set<std::size_t> leaves, folds, wraps, warps;
    bool blends = false;  // some fold has a number that is not 0
    bool plain() const { return folds.empty() && wraps.empty(); }
};
/// Those a tree uses, and all operators that are chosen beside.
Used usedBy(const Tree& tree, const EffectSet& chosen) {
    Used used;
    for (std::size_t row = 0; row < operators().size(); ++row) {
        const Operator& op = operators()[row];
        if (!chosen[firstOperatorRow() + row] || op.kind == Operator::Kind::copies) continue;
        (op.kind == Operator::Kind::fold ? used.folds : used.wraps).insert(row);
        if (op.warp_by) used.warps.insert(row);
        used.blends = used.blends || op.blends;
    }
    for (const Instruction& step : tree.program) {
        if (step.kind == Instruction::Kind::leaf) {
            used.leaves.insert(static_cast<std::size_t>(tree.leaves[step.index].primitive - primitives().data()));
        } else if (step.kind != Instruction::Kind::join) {
            const Operator* op = tree.branches[step.index].op;
            const auto row = static_cast<std::size_t>(op - operators().data());
            (step.kind == Instruction::Kind::fold ? used.folds : used.wraps).insert(row);
            if (op->warp_by) used.warps.insert(row);
            used.blends = used.blends || (op->kind == Operator::Kind::fold && tree.branches[step.index].blend != 0);
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
    // What no rotation changes is asked at `unturned`, as straight-line code asks it.
    std::string text = chooser("float leafDistance(int code, vec3 at, vec3 unturned, Node node)", "float result = EMPTY", "code", used.leaves, 0, [](std::size_t row) {
        const Primitive& p = primitives()[row];
        return fmt::format("{}({}{})", p.glsl, p.turns ? "at" : "unturned", numbersOf("node", p.parameters, p.leafNumbers()));
    });
    text += chooser("Ahead leafAhead(int code, vec3 o, vec3 d, Node node)", "Ahead result = UNKNOWN_AHEAD", "code", used.leaves, 0, [](std::size_t row) {
        const Primitive& p = primitives()[row];
        return aheadCall(p, "o, d" + numbersOf("node", p.parameters, p.leafNumbers()));
    });
    if (!used.folds.empty())
        text += chooser("Ahead foldAhead(int how, Ahead a, Ahead b)", "Ahead result = a", "how", used.folds, kItemFolds,
                        [](std::size_t row) { return aheadFold(operators()[row], "a", "b"); });
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
    int spaces = 1;  // within one another, at most
};
#define MB_LEAF "leafDistance(item.code, at, q - node.position.xyz, node)"
#define MB_FOLD "foldDistances(item.how, top, value, k)"
#define MB_FOLD_FOUND                                                                                                     \
    "foundBoth(foldDistances(item.how, top.distance, value.distance, k), "                                               \
    "shareOfSecond(item.how, top.distance, value.distance, k), top, value)"
constexpr std::string_view kAheadHead = "float lookAhead(vec3 p, vec3 d, Cell cell, out int leaf, out Ahead ahead)";
constexpr Flavour kMap{"float", "float map(vec3 p)", "EMPTY", MB_LEAF, "min(top, value)", MB_FOLD,
                       "top = wrapDistance(item.code, top, at, node)", "min(top, cell.safe)"};
constexpr Flavour kAhead{"float", kAheadHead, kMap.empty, kMap.leaf, kMap.join, kMap.fold, kMap.wrap, kMap.result, true};
/// Where every surface is one leaf's own, the march keeps whose.
constexpr Flavour kLead{"Lead", kAheadHead, "Lead(EMPTY, -1)", "Lead(" MB_LEAF ", item.record)", "nearer(top, value)", MB_FOLD_FOUND,
                        "", "min(top.distance, cell.safe)", true};
constexpr Flavour kNearest{"Nearest", "Nearest nearest(vec3 p)", "foundLeaf(EMPTY, -1, p)", "foundLeaf(" MB_LEAF ", item.record, at)", "nearer(top, value)",
                           MB_FOLD_FOUND, "top.distance = wrapDistance(item.code, top.distance, at, node)", "nearer(top, foundLeaf(cell.safe, -1, p))"};
#undef MB_LEAF
#undef MB_FOLD
#undef MB_FOLD_FOUND

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

/// What an item does to the values: a leaf makes one, which is joined with those so far.
std::string plainStep(const Flavour& f) {
    std::string text = fmt::format("        {} value = {};\n        top = {};\n        touch(1);\n", f.type, f.leaf, f.join);
    if (f.looks_ahead) text += "        ahead = anyAhead(ahead, leafAhead(item.code, at, turnedTo(d, node), node));\n";
    return text;
}
/// The same where there are folds and wraps, and so a stack.
std::string foldStep(const Flavour& f, const Used& used, int stack) {
    const auto shift = [&](bool up) { return shifted("top", stack, up) + (f.looks_ahead ? shifted("ahead", stack, up) : ""); };
    const auto seen = [&f](std::string_view text) { return f.looks_ahead ? text : std::string_view(); };
    std::string text = fmt::format("        {} value = top;\n{}        bool is_leaf = item.code < {};\n        if (is_leaf) {{ value = {};{} touch(1); }}\n", f.type,
                                   seen("        Ahead seen = ahead;\n"), kItemEnter, f.leaf, seen(" seen = leafAhead(item.code, at, turnedTo(d, node), node);"));
    if (stack > 1) text += fmt::format("        if (item.code == {}) {{{} }}\n", kItemPop, shift(false));
    if (!used.wraps.empty()) {
        // A wrap that closes a space is asked in the one around it.
        if (!used.warps.empty()) {
            std::string closes, opens = fmt::format("item.code >= {} && item.code < {}", kItemEnter, kItemWrap);
            for (const std::size_t row : used.warps) closes += fmt::format("{}item.code == {}", closes.empty() ? "" : " || ", kItemWrap + row);
            text += fmt::format("        if ({}) {{{} at = local(q, node); }}\n", closes, shifted("q", f.spaces, false));
            text += fmt::format("        if ({}) {{{} q = warpPoint(item.code, at, node); }}\n", opens, shifted("q", f.spaces, true));
        }
        // What is warped, or swells, is not where its leaves are.
        text += fmt::format("        if (item.code >= {} && item.code < {}) {{ {};{} uses({} + item.code, 1); }}\n", kItemWrap, kItemPop, f.wrap,
                            seen(" ahead = UNKNOWN_AHEAD;"), static_cast<int>(firstOperatorRow()) - static_cast<int>(kItemWrap));
    }
    text += fmt::format("        if (item.how == {}) {{ if (is_leaf) {{{} top = value;{} }} }}\n        else if (item.how == {}) {{ top = {};{} }}\n", kItemPush, shift(true),
                        seen(" ahead = seen;"), kItemJoin, f.join, seen(" ahead = anyAhead(ahead, seen);"));
    if (!used.folds.empty())
        text += fmt::format("        else {{ float k = {}; top = {};{} uses({} + item.how, 1); }}\n", used.blends ? "recordTexel(item.joined * NODE_TEXELS).w" : "0.0", f.fold,
                            seen(" ahead = foldAhead(item.how, ahead, seen); if (k > 0.0) ahead = UNKNOWN_AHEAD;"),
                            static_cast<int>(firstOperatorRow()) - static_cast<int>(kItemFolds));
    return text;
}

/// llvmpipe masks what an `if` encloses and skips nothing: whatever no item of the scene can ask for is not written.
std::string runner(const Flavour& f, const Used& used, int stack) {
    std::string text = fmt::format("{} {{\n{}    {} top = {};\n{}{}    vec3 q = p;\n{}", f.head, f.looks_ahead ? "" : "    Cell cell = cellAt(p);\n", f.type, f.empty,
                                   registers(f.type, "top", stack), f.looks_ahead ? "    ahead = NOTHING_AHEAD;\n" + registers("Ahead", "ahead", stack) : "",
                                   registers("vec3", "q", f.spaces));
    text += "    int i = cell.first;\n    bool more = i >= 0;\n    while (more) {\n        Item item = itemAt(i);\n        Node node = recordAt(item.record);\n"
            "        vec3 at = local(q, node);\n";
    text += used.plain() ? plainStep(f) : foldStep(f, used, stack);
    return text + fmt::format("        more = !item.last;\n        ++i;\n    }}\n    if (more) cut_short = true;\n{}    return {};\n}}\n",
                              !f.looks_ahead ? "" : f.type == "Lead" ? "    leaf = top.leaf;\n" : "    leaf = -1;\n", f.result);
}

}  // namespace

std::string gridGlsl(const Tree& tree, const EffectSet& chosen) {
    const Used used = usedBy(tree, chosen);
    const int stack = itemStack(tree, tree.program);
    const bool own = staysWithinLeaves(tree) && std::ranges::all_of(tree.branches, [](const Branch& b) { return b.op->blends; });
    std::string text = fmt::format("#define {}\n#include \"lib/grid.glsl\"\nvoid readScene() {{}}\n", own ? "LEAF_SURFACE" : "RELAXED") + choosers(used);
    for (Flavour f : {kMap, own ? kLead : kAhead, kNearest}) {
        f.spaces = tree.warps + 1;
        text += runner(f, used, stack);
    }
    return text;
}

}  // namespace mb
