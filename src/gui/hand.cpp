// The mouse as a hand in the picture.
#include "core/scene/camera.h"
#include "gui/panels.h"
#include "gui/widgets.h"

namespace mb {
namespace {

constexpr ImU32 kLine = IM_COL32(255, 210, 90, 230);

/// On the screen, in a picture's place.
std::optional<ImVec2> onScreen(const Ui& ui, glm::dvec3 place) {
    const glm::ivec2 size = pictureSize(ui);
    if (size.x < 1 || size.y < 1) return {};
    const std::optional<glm::dvec2> at = pictureOf(ui.editor.camera(), size, place);
    if (!at || !(glm::abs(at->x) < 1e5 && glm::abs(at->y) < 1e5)) return {};
    return ImVec2{ui.picture_corner.x + static_cast<float>(at->x), ui.picture_corner.y + static_cast<float>(at->y)};
}

}  // namespace

bool overPicture(const Ui& ui, ImVec2 at) {
    const ImVec2 corner = ui.picture_corner, size = ui.picture_size;
    return at.x >= corner.x && at.y >= corner.y && at.x < corner.x + size.x && at.y < corner.y + size.y;
}

glm::dvec2 inPicture(const Ui& ui, ImVec2 at) { return glm::dvec2{at.x - ui.picture_corner.x, at.y - ui.picture_corner.y} + 0.5; }
glm::ivec2 pictureSize(const Ui& ui) { return {static_cast<int>(ui.picture_size.x), static_cast<int>(ui.picture_size.y)}; }

bool handleHand(Ui& ui) {
    const ImGuiIO& io = ImGui::GetIO();
    if (ui.holding && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) ui.editor.letGo(), ui.holding = false;
    if (!ImGui::IsMousePosValid()) return ui.holding;
    const bool pressed = ImGui::IsMouseClicked(ImGuiMouseButton_Left) && io.KeyShift && !io.WantCaptureMouse && overPicture(ui, io.MousePos);
    if (pressed) ui.holding = ui.editor.grab(pictureSize(ui), inPicture(ui, io.MousePos), ui.picture.grid);
    else if (ui.holding) ui.editor.drag(pictureSize(ui), inPicture(ui, io.MousePos));
    return ui.holding;
}

void drawHand(const Ui& ui) {
    const std::optional<Editor::Held> held = ui.editor.held();
    if (!held) return;
    const std::optional<ImVec2> from = onScreen(ui, held->place), to = onScreen(ui, held->hand);
    if (!from || !to) return;
    const float scale = ImGui::GetFontSize() / 15;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImVec2 corner = ui.picture_corner;
    list.PushClipRect(corner, {corner.x + ui.picture_size.x, corner.y + ui.picture_size.y});
    list.AddLine(*from, *to, kLine, 1.5f * scale);
    list.AddCircleFilled(*from, 3 * scale, kLine);
    list.PopClipRect();
    if (ui::seen) ui::seen->push_back({"picture", "held", *from, *to, overPicture(ui, *from) && overPicture(ui, *to)});
}

void explodeThere(Ui& ui) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const bool there = ImGui::IsMousePosValid() && overPicture(ui, mouse) && !ImGui::GetIO().WantCaptureMouse;
    const glm::dvec2 middle{0.5 * ui.picture_size.x, 0.5 * ui.picture_size.y};
    ui.editor.explode(pictureSize(ui), there ? inPicture(ui, mouse) : middle, ui.picture.grid);
}

}  // namespace mb
