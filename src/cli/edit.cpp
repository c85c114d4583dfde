// marchbox edit: opens the editor.
#include "cli/cli.h"

#include "gui/window.h"

namespace mb::cli {
namespace {

std::function<void()> make(CLI::App& app, Common& common) {
    const auto options = std::make_shared<EditorOptions>();
    app.add_option("SCENE", options->scene, "scene file; without one, an empty scene");
    return [options, &common] {
        options->seed = common.seed;
        if (const int code = runEditor(*options); code != kDone) throw Failure{static_cast<Exit>(code), {}};
    };
}

}  // namespace

const Command kEdit{"edit", "opens the editor", "marchbox edit saves/welcome.txt", make};

}  // namespace mb::cli
