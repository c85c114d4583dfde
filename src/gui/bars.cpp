// What surrounds the panels: the menu bar, the status bar, and the strip that says what went wrong.
#include "gui/panels.h"
#include "gui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace mb {
namespace {

constexpr double kMessageSeconds = 6;  // a good message goes by itself; an error stays

void drawMenuItem(Ui& ui, std::size_t i) {
    const Entry& entry = entries()[i];
    const bool enabled = !entry.enabled || entry.enabled(ui), was_open = entry.draw && ui.open[i];
    const bool pressed = ImGui::MenuItem(entry.name, entry.shortcut.shown, was_open, enabled);
    ui::note(entry.name);
    ui::tip(entry.tip);
    if (!pressed) return;
    if (was_open) ui.open[i] = false;
    else if (entry.run) entry.run(ui);
    else ui.open[i] = true;
}

ImGuiWindowFlags barFlags() {
    return ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
           ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBringToFrontOnFocus;
}

std::string motionText(const Ui& ui) {
    const Simulation& s = ui.editor.simulation();
    if (!s.playing) return s.steps() > 0 ? fmt::format("Paused at step {}", s.steps()) : "Paused";
    if (s.asleep()) return fmt::format("Playing; the world sleeps, step {}", s.steps());
    return s.ratio() > 0.95 ? fmt::format("Playing, step {}", s.steps())
                            : fmt::format("Playing at {:.0f} % of real time, step {}", 100 * s.ratio(), s.steps());
}

std::string pictureText(const PictureState& p) {
    if (p.drawn.x == 0) return p.compiling ? "compiling" : "no picture yet";
    const std::string size = p.drawn == p.full ? fmt::format("{}x{}", p.full.x, p.full.y)
                                               : fmt::format("{}x{} of {}x{}", p.drawn.x, p.drawn.y, p.full.x, p.full.y);
    return fmt::format("{}, {:.0f} ms{}", size, p.ms, p.compiling ? ", compiling" : p.refining ? ", refining" : "");
}

}  // namespace

void drawMenuBar(Ui& ui) {
    ui::seen_panel = "menu";
    if (!ImGui::BeginMainMenuBar()) return;
    const char* menu = "";
    bool open = false;
    for (std::size_t i = 0; i < entries().size(); ++i) {
        if (std::strcmp(entries()[i].menu, menu) != 0) {
            if (open) ImGui::EndMenu();
            menu = entries()[i].menu;
            open = ImGui::BeginMenu(menu);
            if (!open) ui::note(menu);
        }
        if (open) drawMenuItem(ui, i);
    }
    if (open) ImGui::EndMenu();

    const std::string name = ui.editor.path().empty() ? "no file yet" : ui.editor.path().filename().string();
    const std::string shown = ui.editor.unsaved() ? name + " (not saved)" : name;
    ImGui::SameLine(std::max(ImGui::GetWindowWidth() - ImGui::CalcTextSize(shown.c_str()).x - 12, ImGui::GetCursorPosX()));
    ImGui::TextDisabled("%s", shown.c_str());
    ImGui::EndMainMenuBar();
}

void drawStatusBar(Ui& ui) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float height = ImGui::GetFrameHeight();
    ImGui::SetNextWindowPos({0, std::max(screen.y - height, 0.0f)});
    ImGui::SetNextWindowSize({std::max(screen.x, 1.0f), height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ui::seen_panel = "status";
    if (ImGui::Begin("##status", nullptr, barFlags())) {
        ImGui::AlignTextToFramePadding();
        const std::string rate = ui.frames_per_second > 0 ? fmt::format("{:.0f} frames/s", ui.frames_per_second) : "at rest";
        ImGui::Text("%s   |   %s   |   %s", motionText(ui).c_str(), rate.c_str(), pictureText(ui.picture).c_str());
        const char* hint = "Left drag: turn   Shift + drag: hold   Wheel: nearer   Right click: attributes   Space: play   F1: controls";
        const float room = ImGui::CalcTextSize(hint).x + 16;
        ImGui::SameLine();
        if (ImGui::GetCursorPosX() + room < screen.x) {
            ImGui::SameLine(screen.x - room);
            ImGui::TextDisabled("%s", hint);
        }
    }
    ImGui::End();
    ImGui::PopStyleVar(3);
}

void drawMessage(Ui& ui) {
    Message message = ui.editor.message();
    if (message.text.empty() && !ui.picture.why.empty()) message = {true, ui.picture.why};
    const bool several = message.text.find('\n') != std::string::npos;
    if (message.text != ui.message_shown) {
        const bool stays = message.error || message.text.empty();
        ui.message_shown = message.text;
        ui.message_until = stays ? kForever : ImGui::GetTime() + (several ? 3 * kMessageSeconds : kMessageSeconds);
    }
    if (message.text.empty()) return;
    if (ImGui::GetTime() >= ui.message_until) return ui.editor.say(false, {});

    // Above the status bar, as wide as the picture.
    const float width = std::max(ui.picture_size.x - 24, 60.0f);
    ImGui::SetNextWindowPos({12, ui.picture_corner.y + ui.picture_size.y - 10}, 0, {0, 1});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {width, std::max(ui.picture_size.y / 2, 40.0f)});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, message.error ? ImVec4{0.35f, 0.08f, 0.08f, 0.95f} : ImVec4{0.08f, 0.22f, 0.12f, 0.95f});
    ui::seen_panel = "message";
    const ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing |
                                   ImGuiWindowFlags_AlwaysAutoResize;
    if (ImGui::Begin("##message", nullptr, flags)) {
        if (ui::button("x", "dismiss")) ui.editor.say(false, {});
        ImGui::SameLine();
        ImGui::PushTextWrapPos(width - 24);
        ImGui::TextUnformatted(message.text.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
    ImGui::PopStyleColor();
}

}  // namespace mb
