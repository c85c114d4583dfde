// marchbox check: reads and validates.
#include "cli/cli.h"

#include "core/effects/plan.h"

#include <fmt/format.h>

namespace mb::cli {
namespace {

std::function<void()> make(CLI::App& app, Common& common) {
    const auto paths = std::make_shared<std::vector<std::string>>();
    app.add_option("SCENE", *paths, "scene files")->required();
    return [paths, &common] {
        Exit worst = kDone;
        for (const std::string& path : *paths) {
            const LoadResult loaded = loadScene(path);
            const Exit code = reportFaults(loaded, path, common);
            worst = std::max(worst, code);
            if (code == kDone && !common.quiet)
                fmt::print("{}: sound: {} objects, {} materials, {} lights\n", path, loaded.scene.objects.size(),
                           loaded.scene.materials.size(), loaded.scene.lights.size());
        }
        if (worst != kDone) throw Failure{worst, {}};
    };
}

}  // namespace

const Command kCheck{"check", "reads and validates scenes, and does nothing else", "marchbox check saves/*.txt", make};

}  // namespace mb::cli
