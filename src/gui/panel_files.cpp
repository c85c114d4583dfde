// Opening and saving.
#include "gui/panels.h"
#include "gui/widgets.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {
namespace {

/// What is opened and saved: scenes, or recordings of runs.
struct Kind {
    const char *many, *none, *ending;
    std::vector<std::string> (Editor::*list)() const;
    bool (Editor::*save)(const std::filesystem::path&);
};
constexpr Kind kScenes{"Scenes", "There is no scene here.", ".txt", &Editor::saves, &Editor::saveAs};
constexpr Kind kRecordings{"Recordings", "There is no recording here.", ".rec", &Editor::recordings, &Editor::saveRecording};

/// The files of the folder; whether one was chosen, which is then in `name`.
bool fileList(Ui& ui, const Kind& kind, FileChoice& choice, std::string& name) {
    if (ImGui::IsWindowAppearing()) choice.files = (ui.editor.*kind.list)();
    bool chosen = false;
    ImGui::BeginChild("files", {0, ImGui::GetTextLineHeightWithSpacing() * 9}, true);
    if (choice.files.empty()) ui::remark(kind.none);
    for (const std::string& file : choice.files)
        if (ui::selectable(file.c_str(), file == name)) name = file, chosen = true;
    ImGui::EndChild();
    return chosen;
}

/// Says whether the chosen file is to be opened.
bool opens(Ui& ui, const Kind& kind, FileChoice& choice) {
    ui::remark(fmt::format("{} in {}", kind.many, ui.editor.savesFolder().string()));
    fileList(ui, kind, choice, choice.file);
    ImGui::BeginDisabled(std::ranges::find(choice.files, choice.file) == choice.files.end());
    const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    const bool pressed = ui::button("Open", nullptr, half);
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ui::button("Look again", "reads the folder anew", half)) choice.files = (ui.editor.*kind.list)();
    return pressed;
}

/// Says whether it was saved.
bool saves(Ui& ui, const Kind& kind, FileChoice& choice) {
    ui::remark(fmt::format("In {}", ui.editor.savesFolder().string()));
    std::string chosen = choice.name;
    if (fileList(ui, kind, choice, chosen)) choice.name = chosen;
    const std::string tip = fmt::format("\"{}\" is added if it has no ending", kind.ending);
    ui::text({"file name", "", tip}, choice.name);
    const std::string full = choice.name.find('.') == std::string::npos ? choice.name + kind.ending : choice.name;
    const bool there = std::ranges::find(choice.files, full) != choice.files.end();
    ImGui::BeginDisabled(choice.name.empty());
    const bool pressed = ui::button(there ? "Replace" : "Save", there ? "the file that is there" : nullptr, -1);
    ImGui::EndDisabled();
    return pressed && (ui.editor.*kind.save)(ui.editor.savesFolder() / choice.name);
}

void openUnlessUnsaved(Ui& ui, bool (Editor::*open)(const std::filesystem::path&), const std::string& file, const char* panel) {
    const std::filesystem::path path = ui.editor.savesFolder() / file;
    ui.unlessUnsaved([&ui, open, path, panel] {
        if (!(ui.editor.*open)(path)) return;
        ui.show(panel, false);
        ui.folded.clear(), ui.shown_material = ui.shown_light = 0, ui.draft.material = kNoMaterial;
    });
}

}  // namespace

void drawOpen(Ui& ui) {
    if (opens(ui, kScenes, ui.scenes)) openUnlessUnsaved(ui, &Editor::open, ui.scenes.file, "Open");
}

void drawSaveAs(Ui& ui) {
    if (saves(ui, kScenes, ui.scenes)) ui.show("Save as", false);
}

void drawOpenRecording(Ui& ui) {
    if (!opens(ui, kRecordings, ui.recordings)) return;
    openUnlessUnsaved(ui, &Editor::openRecording, ui.recordings.file, "Open recording");
    if (ui.editor.timeline()) ui.show("Timeline");
}

void drawSaveRecording(Ui& ui) {
    const Timeline* timeline = ui.editor.timeline();
    const std::uint64_t steps = timeline ? timeline->last() : 0;
    ui::remark(steps > 0 ? fmt::format("{} steps, a hash of the state after each, and what was done between them", steps) : "No step was made yet.");
    if (saves(ui, kRecordings, ui.recordings)) ui.show("Save recording", false);
}

}  // namespace mb
