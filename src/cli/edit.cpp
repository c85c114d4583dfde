// marchbox edit: opens the editor.
#include "cli/cli.h"

#include "gui/window.h"

namespace mb::cli {
namespace {

std::function<void()> make(CLI::App& app, Common& common) {
    const auto path = std::make_shared<std::string>();
    app.add_option("SCENE", *path, "scene file; without one, an empty scene");
    return [path, &common] {
        EditorOptions options;
        options.path = *path;
        options.seed = common.seed;
        if (!path->empty()) options.scene = readSceneFile(*path, {}, common);
        if (const int code = runEditor(std::move(options)); code != kDone) throw Failure{static_cast<Exit>(code), {}};
    };
}

}  // namespace

const Command kEdit{"edit", "opens the editor", "marchbox edit saves/welcome.txt", make};

}  // namespace mb::cli
