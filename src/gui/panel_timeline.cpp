// The strip below the picture that goes back and forth through the steps made.
#include "gui/panels.h"
#include "gui/widgets.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {
namespace {

void drawSlider(Editor& editor, const Timeline& timeline) {
    const auto last = static_cast<double>(timeline.last());
    double step = static_cast<double>(timeline.target().value_or(timeline.step()));
    ImGui::BeginDisabled(last == 0);
    const ui::Row row{"step", "", "of all steps made: the bodies are shown as they were", 0, last, 0, std::max(last, 1.0), false, true};
    if (ui::numbers(row, &step, 1)) editor.seek(static_cast<std::uint64_t>(step));
    ImGui::EndDisabled();
}

/// A button that is greyed where it would do nothing.
bool button(const char* label, const char* tip, bool enabled, float width) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ui::button(label, tip, width);
    ImGui::EndDisabled();
    ImGui::SameLine();
    return pressed && enabled;
}

void drawButtons(Editor& editor, const Timeline& timeline) {
    const float narrow = ImGui::GetFontSize() * 2, wide = ImGui::GetFontSize() * 3.6f;
    if (button("|<", "to the start", timeline.step() > 0, narrow)) editor.seek(0);
    if (button("<", "one step back (,)", editor.canStepBack(), narrow)) editor.stepBack();
    if (button(editor.playing() ? "Pause" : "Play", "on from here: the same steps again, then new ones (Space)", true, wide))
        editor.playing() ? editor.pause() : editor.play();
    if (button(">", "one step on (.)", true, narrow)) editor.step();
    if (button(">|", "to the last step made", !timeline.atEnd(), narrow)) editor.seek(timeline.last());
}

std::string momentText(const Timeline& timeline) {
    const PhysicsWorld& world = timeline.world();
    std::string moment = fmt::format("step {} of {}   {:.3f} s   state {}", timeline.step(), timeline.last(), world.time_s(),
                                     world.stateText());
    if (timeline.divergence()) moment += fmt::format("   not as recorded from step {} on", timeline.divergence()->step);
    if (!timeline.target()) return moment;
    return fmt::format("going to step {}: {} are left   {}", *timeline.target(), *timeline.target() - timeline.step(), moment);
}

}  // namespace

void drawTimeline(Ui& ui) {
    Editor& editor = ui.editor;
    if (!editor.bodies()) return ui::remark(makeTree(editor.scene()).fault);
    drawSlider(editor, *editor.timeline());
    drawButtons(editor, *editor.timeline());
    const Timeline& timeline = *editor.timeline();
    ImGui::TextUnformatted(momentText(timeline).c_str());
    if (timeline.divergence()) ui::tip(describe(*timeline.divergence()));
    const std::string memory = fmt::format("{:.1f} MB, {} moments kept", static_cast<double>(timeline.bytes()) / (1 << 20), timeline.snapshots());
    const float room = ImGui::CalcTextSize(memory.c_str()).x + 12;
    if (ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + room > ImGui::GetWindowWidth()) return;
    ImGui::SameLine(ImGui::GetWindowWidth() - room);
    ImGui::TextDisabled("%s", memory.c_str());
    ui::tip("what going back takes: copies of all bodies, a hash of each state, and what was done");
}

}  // namespace mb
