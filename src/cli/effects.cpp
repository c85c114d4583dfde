// marchbox effects: what a scene calls for, why, and what it costs.
#include "cli/cli.h"

#include "core/effects/plan.h"
#include "core/render/renderer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mb::cli {
namespace {

struct Options {
    std::string scene;
    std::vector<std::string> settings;
    bool json = false;
};

/// The evaluations of the scene's distance that a 640x360 picture takes, by what asked for them.
Counts countsOf(const Scene& scene) {
    const auto context = headlessContext();
    Renderer renderer;
    Measured measured;
    if (const std::string why = renderer.measure(scene, defaultCamera(scene), {640, 360}, measured); !why.empty())
        throw Failure{kInputFault, why};
    return measured.counts;
}

void run(const Options& options, const Common& common) {
    const Scene scene = readSceneFile(options.scene, options.settings, common);
    const Plan plan = makePlan(scene, treeOf(scene));
    const auto evaluations = countsOf(scene).evaluations;
    const auto cost = [&](std::string_view effect) -> std::uint64_t {
        return effect == "shadow" ? evaluations.shadow : effect == "reflection" ? evaluations.reflection : 0;
    };

    nlohmann::ordered_json json;
    json["evaluations"] = {{"primary", evaluations.primary}, {"normal", evaluations.normal}, {"shadow", evaluations.shadow},
                           {"reflection", evaluations.reflection}};
    json["effects"] = nlohmann::ordered_json::array();
    for (const Effect& effect : effects()) {
        std::string by;
        for (const Plan::Called& c : plan.called)
            if (c.effect == &effect) by = c.by;
        json["effects"].push_back({{"name", effect.name}, {"called", !by.empty()}, {"by", by}, {"evaluations", cost(effect.name)},
                                   {"what", effect.tip}});
    }
    if (options.json) return writeText("-", json.dump() + '\n');

    const double pixels = 640.0 * 360.0;
    std::string table = fmt::format("{:<12}{:<8}{:>16}  {}\n", "effect", "called", "evaluations/px", "by, or what it would do");
    for (const auto& e : json["effects"]) {
        const bool called = e["called"];
        table += fmt::format("{:<12}{:<8}{:>16}  {}\n", e["name"].get<std::string>(), called ? "yes" : "no",
                             e["evaluations"] == 0 ? "" : fmt::format("{:.2f}", e["evaluations"].get<double>() / pixels),
                             e[called ? "by" : "what"].get<std::string>());
    }
    table += fmt::format("{:<20}{:>16.2f}  the picture's own rays\n", "primary", static_cast<double>(evaluations.primary) / pixels);
    table += fmt::format("{:<20}{:>16.2f}  and look-ups of what was hit\n", "normals", static_cast<double>(evaluations.normal) / pixels);
    writeText("-", table);
}

std::function<void()> make(CLI::App& app, Common& common) {
    const auto options = std::make_shared<Options>();
    app.add_option("SCENE", options->scene, "scene file")->required();
    app.add_flag("--json", options->json, "print JSON");
    addSettings(app, options->settings);
    return [options, &common] { run(*options, common); };
}

}  // namespace

const Command kEffects{"effects", "what a scene calls for, why, and what it costs", "marchbox effects saves/mirrors.txt", make};

}  // namespace mb::cli
