#include "gui/look.h"

#include <imgui.h>

#include <filesystem>

namespace mb {
namespace {

constexpr float kFontPixels = 15;

/// A proportional font that most systems with a screen have. Dear ImGui's own, with Latin letters alone, does as well.
constexpr const char* kFonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                  "/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"};

/// Latin, Greek, Cyrillic, punctuation, arrows and mathematical signs: what names and tips are likely to hold.
constexpr ImWchar kGlyphs[] = {0x20, 0x24f, 0x370, 0x52f, 0x2010, 0x2027, 0x2190, 0x21ff, 0x2200, 0x22ff, 0};

void setFont(float scale) {
    ImGuiIO& io = ImGui::GetIO();
    for (const char* path : kFonts) {
        std::error_code error;
        if (std::filesystem::is_regular_file(path, error) && io.Fonts->AddFontFromFileTTF(path, kFontPixels * scale, nullptr, kGlyphs)) return;
    }
    ImFont* font = io.Fonts->AddFontDefault();
    io.FontGlobalScale = scale;
    io.Fonts->Build();
    font->AddRemapChar(0x2212, '-');  // the minus sign
    font->AddRemapChar(0x2019, '\'');
}

}  // namespace

void setLook(float scale) {
    setFont(scale);
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 4, style.FrameRounding = 3, style.GrabRounding = 3, style.PopupRounding = 3, style.ScrollbarRounding = 3;
    style.WindowBorderSize = 1, style.FramePadding = {6, 3}, style.ItemSpacing = {6, 5}, style.ItemInnerSpacing = {4, 4};
    style.ScrollbarSize = 12, style.GrabMinSize = 9;
    ImVec4* c = style.Colors;
    c[ImGuiCol_WindowBg] = {0.11f, 0.12f, 0.14f, 1};
    c[ImGuiCol_PopupBg] = {0.13f, 0.14f, 0.17f, 1};
    c[ImGuiCol_MenuBarBg] = {0.15f, 0.16f, 0.19f, 1};
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgCollapsed] = {0.15f, 0.16f, 0.19f, 1};
    c[ImGuiCol_TitleBgActive] = {0.19f, 0.22f, 0.28f, 1};
    c[ImGuiCol_FrameBg] = {0.20f, 0.22f, 0.26f, 1};
    c[ImGuiCol_FrameBgHovered] = {0.26f, 0.29f, 0.35f, 1};
    c[ImGuiCol_FrameBgActive] = {0.30f, 0.34f, 0.42f, 1};
    c[ImGuiCol_SliderGrab] = {0.36f, 0.52f, 0.78f, 0.65f};
    c[ImGuiCol_SliderGrabActive] = {0.45f, 0.65f, 0.95f, 0.85f};
    c[ImGuiCol_Button] = {0.24f, 0.30f, 0.40f, 1};
    c[ImGuiCol_PlotHistogram] = {0.26f, 0.40f, 0.62f, 1};  // what is done of a progress bar
    c[ImGuiCol_TextDisabled] = {0.60f, 0.62f, 0.66f, 1};
    style.ScaleAllSizes(scale);
}

}  // namespace mb
