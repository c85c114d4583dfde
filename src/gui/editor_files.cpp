// The editor's files: opening, saving, and the list of what could be opened.
#include "core/scene/text.h"
#include "gui/editor.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {

namespace fs = std::filesystem;

namespace {

template <class Loaded> std::string faultsOf(const Loaded& loaded, const fs::path& path) {
    std::string text = loaded.disk_fault;
    for (const Fault& fault : loaded.faults) text.append(text.empty() ? "" : "\n").append(describe(fault, path.filename().string()));
    return text;
}
/// Each on a line of its own, behind what was said before.
template <class Loaded> std::string warningsOf(const Loaded& loaded, const fs::path& path) {
    std::string text;
    for (const Fault& warning : loaded.warnings) text.append("\n").append(describe(warning, path.filename().string(), "warning"));
    return text;
}

fs::path withEnding(fs::path path, const char* ending) { return path.has_extension() ? path : path += ending; }

}  // namespace

bool Editor::open(const fs::path& path) {
    LoadResult loaded = loadScene(path);
    if (!loaded.ok()) return refuse(faultsOf(loaded, path));
    begin(std::move(static_cast<ReadResult&>(loaded).scene), path);
    say(false, fmt::format("Opened {}.", path.filename().string()) + warningsOf(loaded, path));
    return true;
}

bool Editor::openRecording(const fs::path& path) {
    RecordingResult loaded = loadRecording(path);
    if (!loaded.ok()) return refuse(faultsOf(loaded, path));
    if (const std::string why = makeTree(*loaded.recording.start).fault; !why.empty()) return refuse(why);
    begin(*loaded.recording.start, {});
    folder_ = path.has_parent_path() ? path.parent_path() : ".";
    const std::size_t steps = loaded.recording.steps.size();
    simulation_.load(std::move(loaded.recording));
    before_ = scene_.objects;
    const std::string opened = fmt::format("Opened {}: {} steps. Playing makes them again and compares each.", path.filename().string(), steps);
    say(false, opened + warningsOf(loaded, path));
    return true;
}

/// What is edited from now on.
void Editor::begin(Scene scene, const fs::path& path) {
    simulation_.stop();
    before_.reset();
    scene_ = std::move(scene);
    path_ = path, selected_ = {};
    saved_ = scene_, saved_edits_ = edits_, ++revision_;
    orbit_ = Orbit::around(defaultCamera(scene_));
}

bool Editor::save() {
    if (path_.empty()) return refuse("the scene has no file yet: use Save as");
    return saveAs(path_);
}

bool Editor::saveAs(const fs::path& path) {
    if (path.filename().empty()) return refuse("a file needs a name");
    const fs::path full = path == path_ ? path : withEnding(path, ".txt");
    if (const auto why = saveScene(full, scene_)) return refuse(*why);
    path_ = full, saved_ = scene_, saved_edits_ = edits_;
    say(false, fmt::format("Saved {}.", full.filename().string()));
    return true;
}

bool Editor::saveRecording(const fs::path& path) {
    if (path.filename().empty()) return refuse("a file needs a name");
    if (!timeline() || timeline()->last() == 0) return refuse("no step was made yet: there is nothing to record");
    const fs::path full = withEnding(path, ".rec");
    if (const auto why = mb::saveRecording(full, timeline()->recording())) return refuse(*why);
    say(false, fmt::format("Saved {}: {} steps.", full.filename().string(), timeline()->last()));
    return true;
}

fs::path Editor::savesFolder() const {
    if (path_.empty()) return folder_;
    return path_.has_parent_path() ? path_.parent_path() : ".";
}

std::vector<std::string> Editor::saves() const { return filesEndingIn(".txt"); }
std::vector<std::string> Editor::recordings() const { return filesEndingIn(".rec"); }

std::vector<std::string> Editor::filesEndingIn(std::string_view ending) const {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator it(savesFolder(), error), end; !error && it != end; it.increment(error)) {
        std::error_code ignored;
        if (it->path().extension() == ending && it->is_regular_file(ignored)) names.push_back(it->path().filename().string());
    }
    std::ranges::sort(names);
    return names;
}

}  // namespace mb
