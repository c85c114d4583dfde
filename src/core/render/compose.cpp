#include "core/render/compose.h"

#include "core/render/shader_texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <regex>
#include <set>

namespace mb {
namespace {

struct Resolver {
    const Texts& texts;
    Composed out;
    std::set<std::string, std::less<>> seen;

    void add(std::string_view path, std::string_view head) {
        const auto file = texts.find(path);
        if (file == texts.end()) {
            out.text += fmt::format("#error there is no shader file {}\n", path);
            return;
        }
        seen.emplace(path);
        const std::size_t number = out.files.size();
        out.files.emplace_back(path);
        const auto directive = [&](int line) { return fmt::format("#line {}\n", static_cast<int>(number) * kFileLines + line); };
        if (number > 0) out.text += directive(1);

        std::string_view rest = file->second;
        for (int line = 1; !rest.empty(); ++line) {
            const std::size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
            const std::string_view text = rest.substr(0, end);
            rest.remove_prefix(end);
            if (const std::string_view included = includedBy(text); !included.empty()) {
                if (!seen.contains(included)) add(included, {});
                out.text += directive(line + 1);
                continue;
            }
            out.text += text;
            if (text.starts_with("#version")) out.text += std::string(head) + directive(line + 1);
        }
        if (!out.text.empty() && out.text.back() != '\n') out.text += '\n';
    }

    static std::string_view includedBy(std::string_view line) {
        constexpr std::string_view kInclude = "#include \"";
        if (!line.starts_with(kInclude)) return {};
        line.remove_prefix(kInclude.size());
        return line.substr(0, line.find('"'));
    }
};

/// The call of a leaf's function: sdBox(local(p, leaf3), vec3(…), …); a ball needs no rotation.
std::string leafCall(const Leaf& leaf, std::size_t i) {
    static constexpr std::string_view kNumbers[] = {"x_axis.w", "y_axis.w", "z_axis.w", "extra.x"};
    std::string call = leaf.primitive->turns ? fmt::format("{}(local(p, leaf{})", leaf.primitive->glsl, i)
                                             : fmt::format("{}(p - leaf{}.position.xyz", leaf.primitive->glsl, i);
    const auto number = [&](int at) { return fmt::format("leaf{}.{}", i, kNumbers[at]); };
    int at = 0;
    for (const Parameter& p : leaf.primitive->parameters) {
        if (p.size == 3) call += fmt::format(", vec3({}, {}, {})", number(at), number(at + 1), number(at + 2));
        else call += ", " + number(at);
        at += p.size;
    }
    if (!leaf.primitive->derived.empty()) call += ", " + number(at);
    return call + ")";
}

/// The call of an operator on two distances. Without a blend the plain function is called with a constant, which folds away.
std::string foldCall(const Branch& branch, std::size_t i, std::string_view a, std::string_view b) {
    return fmt::format("{}({}, {}, {})", branch.op->glsl, a, b, branch.blend > 0 ? fmt::format("blend{}", i) : "0.0");
}

/// Which operand's surface shows, as Operator::takesSecond says it.
std::string takesSecond(const Operator& op, std::string_view a, std::string_view b) {
    if (op.intersects) return fmt::format("{} > {}", b, a);
    if (op.first_only) return fmt::format("-{} > {}", b, a);
    return fmt::format("{} < {}", b, a);
}

}  // namespace

const Texts& shaderLibrary() {
    static const Texts texts = [] {
        Texts all;
        for (const ShaderText& t : shaderTexts()) all.emplace(t.path, t.text);
        return all;
    }();
    return texts;
}

Composed resolve(const Texts& texts, std::string_view path, std::string_view head) {
    Resolver resolver{texts, {}, {}};
    resolver.add(path, head);
    return std::move(resolver.out);
}

std::string readablePlace(const Composed& composed, long line) {
    const auto file = static_cast<std::size_t>(line / kFileLines);
    return file < composed.files.size() ? fmt::format("{}:{}", composed.files[file], line % kFileLines) : fmt::format("line {}", line);
}

std::string readableLog(const Composed& composed, std::string_view log) {
    // Mesa writes "0:14(7): error: …", others "0(14) : error" or "ERROR: 0:14: …"; the first number is of no use.
    static const std::regex kPlace(R"((^|\s)\d{1,4}[:(](\d{1,9})(\(\d{1,6}\)|\))?)");
    std::string readable;
    while (!log.empty()) {
        const std::size_t end = std::min(log.find('\n'), log.size());
        const std::string line(log.substr(0, std::min<std::size_t>(end, 1000)));
        log.remove_prefix(std::min(end + 1, log.size()));
        std::smatch place;
        if (std::regex_search(line, place, kPlace))
            readable += fmt::format("{}{}{}{}\n", std::string(place.prefix()), place[1].str(), readablePlace(composed, std::stol(place[2])),
                                    std::string(place.suffix()));
        else
            readable += line + '\n';
    }
    return readable;
}

std::string sceneGlsl(const Tree& tree) {
    std::string map, find;
    std::vector<std::string> stack;  // names of the values on the tree's stack: d7 in map(), n7 in nearest()
    auto name = [next = 0]() mutable { return std::to_string(next++); };
    for (const Instruction& step : tree.program) {
        const std::string v = name();
        if (step.kind == Instruction::Kind::leaf) {
            const std::string call = leafCall(tree.leaves[step.index], step.index);
            map += fmt::format("    float d{} = {};\n", v, call);
            find += fmt::format("    Nearest n{} = Nearest({}, {});\n", v, call, step.index);
            stack.push_back(v);
            continue;
        }
        const std::string b = stack.back();
        stack.pop_back();
        const std::string a = stack.back();
        if (step.kind == Instruction::Kind::join) {
            map += fmt::format("    float d{} = min(d{}, d{});\n", v, a, b);
            find += fmt::format("    Nearest n{} = nearer(n{}, n{});\n", v, a, b);
        } else {
            const Branch& branch = tree.branches[step.index];
            const std::string na = "n" + a + ".distance", nb = "n" + b + ".distance";
            map += fmt::format("    float d{} = {};\n", v, foldCall(branch, step.index, "d" + a, "d" + b));
            find += fmt::format("    Nearest n{} = Nearest({}, {} ? n{}.leaf : n{}.leaf);\n", v, foldCall(branch, step.index, na, nb),
                                takesSecond(*branch.op, na, nb), b, a);
        }
        stack.back() = v;
    }
    // llvmpipe reads a block anew at every use, even by a constant index: the numbers are read once, before any loop.
    std::string held, read;
    for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
        held += fmt::format("Leaf leaf{};\n", i);
        read += fmt::format("    leaf{0} = leaves[{0}];\n", i);
    }
    for (std::size_t i = 0; i < tree.branches.size(); ++i) {
        if (!(tree.branches[i].blend > 0)) continue;
        held += fmt::format("float blend{};\n", i);
        read += fmt::format("    blend{0} = branches[{0}].x;\n", i);
    }
    const bool empty = stack.empty();
    return held + fmt::format("void readScene() {{\n{}}}\n", read) + fmt::format("float map(vec3 p) {{\n{}    return {};\n}}\nNearest nearest(vec3 p) {{\n{}    return {};\n}}\n", map,
                       empty ? fmt::format("{:.1f}", kEmptyDistance) : "d" + stack.back(), find,
                       empty ? fmt::format("Nearest({:.1f}, -1)", kEmptyDistance) : "n" + stack.back());
}

std::string head(const Plan& plan, const Sizes& sizes, bool counted) {
    std::string text = fmt::format("#define LEAVES {}\n#define BRANCHES {}\n#define MATERIALS {}\n#define LIGHTS {}\n",
                                   std::max<std::size_t>(sizes.leaves, 1), std::max<std::size_t>(sizes.branches, 1),
                                   std::max<std::size_t>(sizes.materials, 1), std::max<std::size_t>(sizes.lights, 1));
    for (const Plan::Called& c : plan.called)
        if (!c.effect->define.empty()) text += fmt::format("#define {}\n", c.effect->define);
    if (counted) text += "#define COUNTED\n";
    return text;
}

}  // namespace mb
