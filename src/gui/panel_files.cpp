// Opening and saving.
#include "gui/panels.h"
#include "gui/widgets.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {
namespace {

/// The scenes of the folder; returns whether one was chosen, which is then in `name`.
bool fileList(const std::vector<std::string>& files, std::string& name) {
    bool chosen = false;
    ImGui::BeginChild("files", {0, ImGui::GetTextLineHeightWithSpacing() * 9}, true);
    if (files.empty()) ui::remark("There is no scene here.");
    for (const std::string& file : files)
        if (ui::selectable(file.c_str(), file == name)) name = file, chosen = true;
    ImGui::EndChild();
    return chosen;
}

}  // namespace

void drawOpen(Ui& ui) {
    ui::remark(fmt::format("Scenes in {}", ui.editor.savesFolder().string()));
    if (ImGui::IsWindowAppearing()) ui.files = ui.editor.saves();
    fileList(ui.files, ui.file);
    ImGui::BeginDisabled(std::ranges::find(ui.files, ui.file) == ui.files.end());
    const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    const bool opens = ui::button("Open", nullptr, half);
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ui::button("Look again", "reads the folder anew", half)) ui.files = ui.editor.saves();
    if (!opens) return;
    const std::filesystem::path path = ui.editor.savesFolder() / ui.file;
    ui.unlessUnsaved([&ui, path] {
        if (!ui.editor.open(path)) return;
        ui.show("Open", false);
        ui.folded.clear(), ui.shown_material = ui.shown_light = 0, ui.draft.material = kNoMaterial;
    });
}

void drawSaveAs(Ui& ui) {
    ui::remark(fmt::format("In {}", ui.editor.savesFolder().string()));
    if (ImGui::IsWindowAppearing()) ui.files = ui.editor.saves();
    std::string chosen = ui.file_name;
    if (fileList(ui.files, chosen)) ui.file_name = chosen;
    ui::text({"file name", "", "\".txt\" is added if it has no ending"}, ui.file_name);
    std::string full = ui.file_name.find('.') == std::string::npos ? ui.file_name + ".txt" : ui.file_name;
    const bool there = std::ranges::find(ui.files, full) != ui.files.end();
    ImGui::BeginDisabled(ui.file_name.empty());
    const bool saves = ui::button(there ? "Replace" : "Save", there ? "the file that is there" : nullptr, -1);
    ImGui::EndDisabled();
    if (saves && ui.editor.saveAs(ui.editor.savesFolder() / ui.file_name)) ui.show("Save as", false);
}

}  // namespace mb
