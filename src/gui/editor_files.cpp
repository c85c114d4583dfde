// The editor's files: opening, saving, and the list of what could be opened.
#include "core/scene/text.h"
#include "gui/editor.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {

namespace fs = std::filesystem;

bool Editor::open(const fs::path& path) {
    LoadResult loaded = loadScene(path);
    if (!loaded.ok()) {
        std::string text = loaded.disk_fault;
        for (const Fault& fault : loaded.faults) text.append(text.empty() ? "" : "\n").append(describe(fault, path.filename().string()));
        return refuse(std::move(text));
    }
    simulation_.stop();
    before_.reset();
    scene_ = std::move(static_cast<ReadResult&>(loaded).scene);
    path_ = path, selected_ = {};
    saved_ = scene_, saved_edits_ = edits_, ++revision_;
    orbit_ = Orbit::around(defaultCamera(scene_));
    std::string text = fmt::format("Opened {}.", path.filename().string());
    for (const Fault& warning : loaded.warnings) text.append("\n").append(describe(warning, path.filename().string(), "warning"));
    say(false, std::move(text));
    return true;
}

bool Editor::save() {
    if (path_.empty()) return refuse("the scene has no file yet: use Save as");
    return saveAs(path_);
}

bool Editor::saveAs(const fs::path& path) {
    if (path.filename().empty()) return refuse("a file needs a name");
    fs::path full = path;
    if (path != path_ && !full.has_extension()) full += ".txt";
    if (const auto why = saveScene(full, scene_)) return refuse(*why);
    path_ = full, saved_ = scene_, saved_edits_ = edits_;
    say(false, fmt::format("Saved {}.", full.filename().string()));
    return true;
}

fs::path Editor::savesFolder() const {
    if (path_.empty()) return "saves";
    return path_.has_parent_path() ? path_.parent_path() : ".";
}

std::vector<std::string> Editor::saves() const {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator it(savesFolder(), error), end; !error && it != end; it.increment(error)) {
        std::error_code ignored;
        if (it->path().extension() == ".txt" && it->is_regular_file(ignored)) names.push_back(it->path().filename().string());
    }
    std::ranges::sort(names);
    return names;
}

}  // namespace mb
