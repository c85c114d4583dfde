// The mouse on the picture and the keys, where Dear ImGui does not want them for a panel.
#include "gui/panels.h"

#include <GLFW/glfw3.h>
#include <imgui_internal.h>

#include <cstring>

namespace mb {
namespace {

constexpr double kTurn = 0.008;  // rad a pixel

void handleMouse(Ui& ui) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool holds = handleHand(ui);
    if (io.WantCaptureMouse || !ImGui::IsMousePosValid()) return;
    const auto began = [&](int b) { return overPicture(ui, io.MouseClickedPos[b]) && ImGui::IsMouseDown(b) && !ImGui::IsMouseClicked(b); };
    const bool moved = io.MouseDelta.x != 0 || io.MouseDelta.y != 0;
    const double height = static_cast<double>(ui.picture_size.y) + 1;
    const double dx = static_cast<double>(io.MouseDelta.x), dy = static_cast<double>(io.MouseDelta.y);
    if (moved && !holds && began(ImGuiMouseButton_Left)) ui.editor.turn(-kTurn * dx, kTurn * dy);
    if (moved && began(ImGuiMouseButton_Middle)) ui.editor.pan(-dx / height, dy / height);
    if (!overPicture(ui, io.MousePos)) return;
    if (io.MouseWheel != 0) ui.editor.zoom(static_cast<double>(io.MouseWheel));
    if (!ImGui::IsMouseClicked(ImGuiMouseButton_Right)) return;
    if (ui.editor.pick(pictureSize(ui), inPicture(ui, io.MousePos), ui.picture.grid))
        ui.show("Attributes"), ui.attributes_to_top = true;
    else
        ui.editor.select({});
}

/// Closes the floating panel that has the focus; says whether there was one.
bool closeFocused(Ui& ui) {
    const ImGuiWindow* window = ImGui::GetCurrentContext()->NavWindow;
    if (!window) return false;
    for (std::size_t i = 0; i < entries().size(); ++i)
        if (ui.open[i] && entries()[i].place == Place::floating && std::strcmp(entries()[i].name, window->RootWindow->Name) == 0)
            return ui.open[i] = false, true;
    return false;
}

}  // namespace

void handleInput(Ui& ui) {
    handleMouse(ui);
    const std::vector<KeyPress> pressed = std::move(ui.pressed);
    ui.pressed.clear();
    // While a control is held, a text is typed or a question waits, keys are theirs.
    if (ImGui::GetIO().WantTextInput || ImGui::IsAnyItemActive() || ui.after) return;
    for (const KeyPress& press : pressed) {
        if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) {
            if (press.key == GLFW_KEY_ESCAPE) ImGui::ClosePopupToLevel(0, true);
            continue;
        }
        if (press.key == GLFW_KEY_ESCAPE && !press.ctrl && !press.repeated && closeFocused(ui)) continue;
        for (std::size_t i = 0; i < entries().size(); ++i) {
            const Entry& entry = entries()[i];
            if (entry.shortcut.key != press.key || entry.shortcut.ctrl != press.ctrl) continue;
            if ((press.repeated && !entry.shortcut.repeats) || (entry.enabled && !entry.enabled(ui))) continue;
            if (entry.run) entry.run(ui);
            else ui.open[i] = !ui.open[i];
        }
    }
}

}  // namespace mb
