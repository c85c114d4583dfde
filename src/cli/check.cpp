// marchbox check: reads and validates.
#include "cli/cli.h"

#include "core/effects/plan.h"

#include <fmt/format.h>

namespace mb::cli {
namespace {

/// What no single key shows: knobs that together ask for more than a shader may do. They stand in the render record, the
/// only one of the file.
void addPlanFault(LoadResult& loaded) {
    const Plan plan = makePlan(loaded.scene, makeTree(loaded.scene));
    if (!plan.refused.empty()) loaded.faults.push_back({loaded.render_line, 1, plan.refused});
}

std::function<void()> make(CLI::App& app, Common& common) {
    const auto paths = std::make_shared<std::vector<std::string>>();
    app.add_option("SCENE", *paths, "scene files")->required();
    return [paths, &common] {
        Exit worst = kDone;
        for (const std::string& path : *paths) {
            LoadResult loaded = loadScene(path);
            if (loaded.ok()) addPlanFault(loaded);
            const Exit code = reportFaults(loaded, path, common);
            worst = std::max(worst, code);
            if (code == kDone && !common.quiet)
                writeText("-", fmt::format("{}: sound: {} objects, {} materials, {} lights\n", path, loaded.scene.objects.size(),
                                           loaded.scene.materials.size(), loaded.scene.lights.size()));
        }
        if (worst != kDone) throw Failure{worst, {}};
    };
}

}  // namespace

const Command kCheck{"check", "reads and validates scenes, and does nothing else", "marchbox check saves/*.txt", make};

}  // namespace mb::cli
