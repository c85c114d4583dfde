#include "core/render/compose.h"

#include "core/render/shader_texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <regex>
#include <set>

namespace mb {
namespace {

constexpr std::string_view kEffectsAt = "#effects ";

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
            if (text.starts_with(kEffectsAt)) {
                if (const std::string place(text.substr(0, text.find('\n'))); texts.contains(place)) add(place, {}), out.text += directive(line + 1);
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

/// The function through which the shader reads a key that an effect brings.
std::string accessor(const EffectKey& key) {
    const std::size_t slot = slotOf(key);
    const std::string_view type = key.whole ? "int" : "float";
    const auto body = [&](std::string_view parameter, std::string_view from) {
        const std::string value = fmt::format("{}[{}].{}", from, slot / 4, "xyzw"[slot % 4]);
        return fmt::format("{} {}({}) {{ return {}; }}\n", type, key.glsl, parameter, key.whole ? "int(" + value + ")" : value);
    };
    switch (key.carrier) {
    case Carrier::world: return body("", "frame.world_extra");
    case Carrier::render: return body("", "frame.render_extra");
    case Carrier::light: return body("int light", "lights[light].extra");
    case Carrier::material: break;
    }
    return body("Look look", "look.extra");
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

void putEffects(Texts& io_texts, const Plan& plan) {
    std::string keys, files;
    for (const Plan::Called& c : plan.called) {
        const Effect& effect = *c.effect;
        for (const EffectKey& key : effect.keys) keys += accessor(key);
        if (const std::string file = fmt::format("lib/effects/{}.glsl", fileNameOf(effect)); io_texts.contains(file))
            files += fmt::format("#include \"{}\"\n", file);
        if (effect.at.empty()) continue;
        std::string& text = io_texts[fmt::format("{}{}", kEffectsAt, effect.at)];
        if (!effect.counts.empty()) text += fmt::format("uses({}, 1);\n", numberOf(effect));
        text += fmt::format("{}\n", effect.statement);
    }
    io_texts[fmt::format("{}files", kEffectsAt)] = keys + files;
}

std::string head(const Plan& plan, const Sizes& sizes, bool counted, bool grid) {
    const auto define = [](std::string_view name, std::size_t size) { return fmt::format("#define {} {}\n", name, std::max<std::size_t>(size, 1)); };
    std::string text = define("LIGHTS", sizes.lights);
    if (plan.passes.size() > 1) text += "#define MANY_PASSES\n";
    if (sizes.lights == 1) text += "#define ONE_LIGHT\n";
    if (grid) text += "#define GRID\n";
    else text += define("LEAVES", sizes.leaves) + define("BRANCHES", sizes.branches) + define("MATERIALS", sizes.materials);
    bool materials = false, shaded = counted;
    for (const Plan::Called& c : plan.called) {
        if (!c.effect->ofPicture()) continue;
        std::string name = fileNameOf(*c.effect);
        std::ranges::transform(name, name.begin(), [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
        text += fmt::format("#define EFFECT_{} {}\n", name, numberOf(*c.effect));
        // What stands at a surface may ask for its normal.
        shaded |= !c.effect->at.empty() && c.effect->at != "air" && c.effect->at != "film";
        materials |= std::ranges::any_of(c.effect->keys, [](const EffectKey& key) { return key.carrier == Carrier::material; });
    }
    if (materials) text += "#define MATERIAL_EXTRA\n";
    if (shaded) text += "#define SHADED\n";
    if (plan.tetrahedron) text += "#define TETRAHEDRON\n";
    if (sizes.turned) text += "#define TURNED\n";
    if (sizes.carved) text += "#define CARVED\n";
    if (counted) text += "#define COUNTED\n";
    return text;
}

}  // namespace mb
