// What accuracy costs in the open scene: the curves of its knobs, where it stands, a budget, and the view of its errors.
#include "core/accuracy/report.h"
#include "core/render/budget.h"
#include "gui/panels.h"
#include "gui/plot.h"
#include "gui/widgets.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {
namespace {

void begin(Ui& ui) {
    AccuracyMemory& a = ui.accuracy;
    a = {};
    ui.picture.sweep.reset(), ui.picture.sweep_wanted = true, ui.picture.sweep_why.clear();
}
void goOn(Ui& ui) {
    ui.accuracy.stopped = false;
    if (ui.accuracy.motions) ui.accuracy.sweeping_motion = true;
    else ui.picture.sweeping = true;
}
bool isMeasuring(const Ui& ui) { return ui.picture.sweep_wanted || ui.picture.sweeping || ui.accuracy.sweeping_motion; }

/// Sees whether the scene is still the measured one, and does the motion's share of a frame once the picture's sweep is done.
void follow(Ui& ui) {
    AccuracyMemory& a = ui.accuracy;
    const PictureState& picture = ui.picture;
    if (!picture.sweep) return;
    if (a.compared_revision != ui.editor.revision()) {
        a.compared_revision = ui.editor.revision();
        a.current = ui.editor.stillShows(picture.sweep->scene(), picture.sweep->frame().camera);
        if (!a.current) ui.stopMeasuring();
    }
    if (a.sweeping_motion) a.sweeping_motion = a.motions->step();
    if (picture.sweeping || a.stopped || a.asked_motion || !a.current) return;
    a.asked_motion = true;
    const Scene& scene = picture.sweep->scene();
    if (a.motion_knobs = knobsOf(scene, true); a.motion_knobs.empty() || PhysicsWorld(scene).bodies().empty()) return;
    a.motions.emplace(scene), a.sweeping_motion = true;
}

std::string whatIsDone(const Ui& ui) {
    if (!ui.picture.sweep || ui.picture.compiling) return "waiting for a program";
    if (ui.accuracy.sweeping_motion) return fmt::format("motion: {} settings", ui.accuracy.motions->runs().size());
    if (ui.picture.sweep->truth().progress() < 1) return "the true picture";
    return fmt::format("picture: {} settings", ui.picture.sweep->runs().size());
}

void drawMeasuring(Ui& ui) {
    AccuracyMemory& a = ui.accuracy;
    PictureState& picture = ui.picture;
    if (isMeasuring(ui)) {
        const double done = a.sweeping_motion ? a.motions->progress() : picture.sweep ? picture.sweep->progress() : 0;
        ImGui::ProgressBar(static_cast<float>(done), {ImGui::GetContentRegionAvail().x * 0.5f, 0}, whatIsDone(ui).c_str());
        ImGui::SameLine();
        if (ui::button("Stop", "keeps what was measured so far")) ui.stopMeasuring();
    } else {
        if (ui::button("Measure", "draws this view with many settings of the quality's knobs, and holds each picture against the true one: a minute or more")) begin(ui);
        if (a.stopped && a.current) {
            ImGui::SameLine();
            if (ui::button("Go on", "where it was stopped")) goOn(ui);
        }
    }
    ImGui::SameLine();
    ImGui::Checkbox("Show errors", &picture.errors_wanted);
    ui::note("Show errors");
    ui::tip("shows in the picture's place how far each pixel is from the true one");
    if (!picture.sweep_why.empty()) ui::remark(picture.sweep_why);
}

/// A swatch with its word behind it, on the same line as the last if there is room.
void drawTint(glm::vec3 tint, const char* word) {
    ImGui::SameLine();
    const float width = ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.x + ImGui::CalcTextSize(word).x;
    if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
    ui::swatch(word, tint);
    ImGui::SameLine();
    ImGui::TextUnformatted(word);
}

void drawErrorLegend(const PictureState& picture) {
    if (!picture.errors_note.empty()) ui::remark(picture.errors_note);
    if (!picture.errors_wanted) return;
    ImGui::TextUnformatted("Error:");
    const double middle = std::sqrt(kFaintest * kStrongest);
    drawTint(tintOf(kFaintest * 1.001).color, fmt::format("{:.2g}", kFaintest).c_str());
    drawTint(tintOf(middle).color, fmt::format("{:.2g}", middle).c_str());
    drawTint(tintOf(kStrongest).color, fmt::format("{:.2g} or more", kStrongest).c_str());
    drawTint(kWrongTint, "another surface");
    drawTint(kUndecidedTint, "undecided");
}

/// One slider: the largest color error that is allowed. What costs least within it is picked while it moves, and set when it is let go.
void drawBudget(Ui& ui) {
    AccuracyMemory& a = ui.accuracy;
    const std::vector<Run>& runs = ui.picture.sweep->runs();
    const std::vector<std::size_t> line = frontOf(runs, Error::color, Cost::evaluations);
    if (line.empty()) return;
    const double least = std::max(runs[line.back()].errors[Error::color], rowOf(Error::color).least), most = std::max(runs[line.front()].errors[Error::color], 1.01 * least);
    if (a.picked.empty()) a.most_error = runs[kOwnRun].failed() ? most : runs[kOwnRun].errors[Error::color];
    a.most_error = std::clamp(a.most_error, least, most);
    const bool moved = ui::numbers({"largest color error", "", "picks the cheapest setting whose picture is at most so wrong, and sets the knobs; 1 is from black to white", least, most, least, most, true}, &a.most_error, 1);
    const bool released = ImGui::IsItemDeactivatedAfterEdit();
    if (!moved && !released) return;
    const int stride = ui.picture.sweep->frame().stride;
    const Budget budget{Error::color, a.most_error, {}, stride > 1};
    const std::optional<Picked> picked = pick(runs, budget);
    if (!picked) return;
    a.picked = says(runs, *picked, budget, static_cast<double>(stride) * stride);
    if (released) ui.editor.setKnobs(runs[picked->run].setting, false);
}

/// The charts of what is chosen, made anew where there are more runs or the knobs were turned.
void makeCharts(Ui& ui) {
    AccuracyMemory& a = ui.accuracy;
    const std::vector<Run>& runs = a.motion ? a.motions->runs() : ui.picture.sweep->runs();
    if (a.charts_runs == runs.size() && a.charts_revision == ui.editor.revision()) return;
    a.charts_runs = runs.size(), a.charts_revision = ui.editor.revision();
    const Terms terms = a.motion ? a.motions->terms() : pictureTerms(ui.picture.sweep->truth().picture().noise);
    const Sweep sweep{runs, terms, a.motion, {}, withKnobs(settingOf(ui.picture.sweep->scene()), settingOf(ui.editor.scene()), a.motion)};
    a.charts = a.knob ? knobPanels(sweep, *a.knob) : overviewPanels(sweep);
    a.words = a.knob ? fmt::format("{} {}", a.knob->meaning, knobSays(sweep, *a.knob)) : "";
    if (!a.knob && std::ranges::none_of(runs, [&](const Run& run) { return sameKnobs(run.setting, *sweep.stands, a.motion); }))
        a.words = "The knobs as they are now were not tried: nothing is marked as the scene's own.";
    else if (!a.knob && sameKnobs(*sweep.stands, runs[kOwnRun].setting, a.motion) && runs.size() > kDefaultRun) a.words = frontSays(sweep);
}

void choose(AccuracyMemory& a, const Knob* knob, bool motion) { a.knob = knob, a.motion = motion, a.charts_revision = 0; }

void drawChoice(Ui& ui) {
    AccuracyMemory& a = ui.accuracy;
    const auto nameOf = [](const Knob* knob, bool motion) {
        if (knob) return fmt::format("{} ({})", knob->title, knob->key);
        return std::string(motion ? "All together: the motion" : "All together: the picture");
    };
    ImGui::SetNextItemWidth(-1);
    const bool open = ImGui::BeginCombo("##curves", nameOf(a.knob, a.motion).c_str(), ImGuiComboFlags_HeightLarge);
    ui::note("curves");
    if (!open) return;
    const auto offer = [&](const Knob* knob, bool motion) {
        if (ui::selectable(nameOf(knob, motion).c_str(), knob == a.knob && motion == a.motion)) choose(a, knob, motion);
    };
    offer(nullptr, false);
    for (const Knob* knob : ui.picture.sweep->knobs()) offer(knob, false);
    if (a.motions) {
        offer(nullptr, true);
        for (const Knob* knob : a.motion_knobs) offer(knob, true);
    }
    ImGui::EndCombo();
}

void drawCurves(Ui& ui) {
    AccuracyMemory& a = ui.accuracy;
    drawChoice(ui);
    makeCharts(ui);
    const std::optional<std::size_t> pressed = ui::plots(a.charts, !a.current);
    if (!a.words.empty()) ui::remark(a.words);
    if (pressed && a.current) {
        const Run& run = (a.motion ? a.motions->runs() : ui.picture.sweep->runs())[*pressed];
        ui.editor.setKnobs(run.setting, a.motion);
        const int stride = ui.picture.sweep->frame().stride;
        if (!a.motion) a.most_error = run.errors[Error::color], a.picked = says(ui.picture.sweep->runs(), {*pressed, true}, {}, static_cast<double>(stride) * stride);
    }
}

std::string describe(const PictureSweep& sweep) {
    const Frame& frame = sweep.frame();
    const std::string part = frame.stride == 1 ? "" : fmt::format(", every {}th of the picture's each way", frame.stride);
    return fmt::format("{} by {} pixels{}; {} settings.", frame.size.x, frame.size.y, part, sweep.runs().size());
}

}  // namespace

void drawAccuracy(Ui& ui) {
    follow(ui);
    drawMeasuring(ui);
    drawErrorLegend(ui.picture);
    if (!ui.picture.sweep) {
        ui::remark("Every number of a scene that trades error for time is a knob: how near is a hit, how many rays a pixel gets. Measure draws the scene as it is seen now with each knob turned, "
                   "and with many turned together, and shows what each setting is wrong by and what it costs.");
        return;
    }
    if (!ui.accuracy.current) ui::remark("The scene or the view has changed since it was measured: the curves are of what was.");
    else drawBudget(ui);
    if (!ui.accuracy.picked.empty() && ui.accuracy.current) ui::remark(ui.accuracy.picked);
    drawCurves(ui);
    ui::remark(describe(*ui.picture.sweep));
}

}  // namespace mb
