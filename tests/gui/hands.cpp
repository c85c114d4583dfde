#include "hands.h"

#include <doctest/doctest.h>
#include <imgui_internal.h>

namespace mb {

namespace {

/// The keys Dear ImGui itself asks for, by GLFW's numbers, as its GLFW back end gives them.
constexpr struct { ImGuiKey key; int number; } kKeys[] = {
    {ImGuiKey_Tab, GLFW_KEY_TAB}, {ImGuiKey_LeftArrow, GLFW_KEY_LEFT}, {ImGuiKey_RightArrow, GLFW_KEY_RIGHT}, {ImGuiKey_UpArrow, GLFW_KEY_UP},
    {ImGuiKey_DownArrow, GLFW_KEY_DOWN}, {ImGuiKey_Home, GLFW_KEY_HOME}, {ImGuiKey_End, GLFW_KEY_END}, {ImGuiKey_Delete, GLFW_KEY_DELETE},
    {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE}, {ImGuiKey_Space, GLFW_KEY_SPACE}, {ImGuiKey_Enter, GLFW_KEY_ENTER},
    {ImGuiKey_Escape, GLFW_KEY_ESCAPE}, {ImGuiKey_A, GLFW_KEY_A}, {ImGuiKey_Z, GLFW_KEY_Z}};

}  // namespace

ImVec2 middle(const ui::Seen& seen, float part) { return {seen.min.x + part * (seen.max.x - seen.min.x), (seen.min.y + seen.max.y) / 2}; }

Hands::Hands(ImVec2 screen) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr, io.DisplaySize = screen, io.DeltaTime = 1.0f / 60, io.ConfigInputTextCursorBlink = false;
    for (const auto& [key, number] : kKeys) io.KeyMap[key] = number;
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    frame(3);
}

Hands::~Hands() {
    ui::seen = nullptr;
    ImGui::DestroyContext();
}

void Hands::frame(int count) {
    for (int i = 0; i < count; ++i) {
        seen.clear();
        ui::seen = &seen;
        editor.advance(1.0 / 60);
        ImGui::NewFrame();
        handleInput(ui);
        drawInterface(ui);
        ImGui::Render();
        ImGui::GetIO().MouseWheel = 0;
    }
}

const ui::Seen* Hands::find(const std::string& panel, const std::string& label) const {
    for (const ui::Seen& s : seen)
        if (s.panel == panel && s.label == label) return &s;
    return nullptr;
}

ui::Seen Hands::get(const std::string& panel, const std::string& label) {
    const ui::Seen* found = find(panel, label);
    if (!found) FAIL("no '", label, "' in '", panel, "'");
    const ImGuiWindow* window = ImGui::FindWindowByName(panel.c_str());
    for (int i = 0; window && !found->visible && i < 60; ++i) {
        const bool below = found->min.y > window->Pos.y + window->Size.y / 2;
        moveTo({window->Pos.x + 4, window->Pos.y + window->Size.y / 2});
        wheel(below ? -1.0f : 1.0f);
        frame();
        found = find(panel, label);
    }
    if (!found || !found->visible) FAIL("'", label, "' in '", panel, "' cannot be seen");
    return *found;
}

void Hands::click(const std::string& panel, const std::string& label) { clickAt(middle(get(panel, label))); }

void Hands::drag(const std::string& panel, const std::string& label, float from, float to) {
    const ui::Seen s = get(panel, label);
    moveTo(middle(s, from));
    press(0, true);
    for (int i = 1; i <= 8; ++i) moveTo(middle(s, from + (to - from) * static_cast<float>(i) / 8));
    press(0, false);
    frame();
}

void Hands::key(int key, bool ctrl) {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyCtrl = ctrl, io.KeysDown[key] = true;
    frame();
    io.KeyCtrl = false, io.KeysDown[key] = false;
    frame();
}

void Hands::type(const std::string& text) { ImGui::GetIO().AddInputCharactersUTF8(text.c_str()), frame(); }

void Hands::typeInto(const std::string& panel, const std::string& label, const std::string& text) {
    moveTo(middle(get(panel, label)));
    ImGui::GetIO().KeyCtrl = true;
    press(0, true), press(0, false);
    ImGui::GetIO().KeyCtrl = false;
    key(GLFW_KEY_A, true), type(text), key(GLFW_KEY_ENTER);
}

void Hands::fill(const std::string& panel, const std::string& label, const std::string& text) {
    click(panel, label);
    key(GLFW_KEY_A, true), type(text), key(GLFW_KEY_ENTER);
}

}  // namespace mb
