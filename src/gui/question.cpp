// What is asked before unsaved work is dropped.
#include "gui/panels.h"
#include "gui/widgets.h"

#include <GLFW/glfw3.h>

#include <fmt/format.h>

namespace mb {
namespace {

constexpr const char* kTitle = "Unsaved work";

void answered(Ui& ui, bool goes_on) {
    const std::function<void()> after = std::move(ui.after);
    ui.after = nullptr;
    ImGui::CloseCurrentPopup();
    if (goes_on) after();
}

}  // namespace

void drawQuestion(Ui& ui) {
    if (!ui.after) return;
    if (!ImGui::IsPopupOpen(kTitle)) ui.save_name.clear(), ImGui::OpenPopup(kTitle);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ui::seen_panel = "question";
    if (!ImGui::BeginPopupModal(kTitle, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings)) return;

    const bool has_file = !ui.editor.path().empty();
    ImGui::Text("The scene has changes that are in no file.");
    if (!has_file) {
        ui::text({"file name", "", ""}, ui.save_name);
        ui::remark(fmt::format("in {}", ui.editor.savesFolder().string()));
    }
    if (ui.editor.message().error) ImGui::TextColored({1, 0.5f, 0.4f, 1}, "%s", ui.editor.message().text.c_str());
    ImGui::Spacing();

    ImGui::BeginDisabled(!has_file && ui.save_name.empty());
    const bool saves = ui::button("Save", "and go on", 110);
    ImGui::EndDisabled();
    ImGui::SameLine();
    const bool discards = ui::button("Discard", "go on, and lose the changes", 110);
    ImGui::SameLine();
    const bool cancels = ui::button("Cancel", "go back to the scene", 110) ||
                         (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false) && !ImGui::IsWindowAppearing());
    if (saves && (has_file ? ui.editor.save() : ui.editor.saveAs(ui.editor.savesFolder() / ui.save_name))) answered(ui, true);
    else if (discards) answered(ui, true);
    else if (cancels) answered(ui, false);
    ImGui::EndPopup();
}

}  // namespace mb
