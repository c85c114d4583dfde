// What can be read off the bodies: energy, momentum, overlap and contacts, now and over the last steps.
#include "gui/panels.h"
#include "gui/widgets.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {
namespace {

/// Notes the moment the world is at. Of those ahead, after going back, nothing is known any more.
void watch(Meters& io_meters, const PhysicsWorld& world, double deepest) {
    std::vector<Meters::Moment>& moments = io_meters.moments;
    while (!moments.empty() && moments.back().step >= world.steps()) moments.pop_back();
    if (moments.size() == Meters::kMost) moments.erase(moments.begin());
    const Energy energy = world.energy();
    moments.push_back({world.steps(), static_cast<float>(energy.total()), static_cast<float>(energy.kinetic), static_cast<float>(deepest)});
}

std::string vectorText(glm::dvec3 v) { return fmt::format("{:.4g}  {:.4g}  {:.4g}", v.x, v.y, v.z); }

void line(const char* name, const std::string& value, const char* tip) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name);
    ui::tip(tip);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value.c_str());
    ui::note(name);
}

/// A number over the steps, from the least to the most there was.
void history(const Meters& meters, const char* name, float Meters::Moment::*of, const char* unit) {
    const std::vector<Meters::Moment>& moments = meters.moments;
    const auto [least, most] = std::ranges::minmax_element(moments, {}, of);
    const std::string words = fmt::format("{}: {:.3g} to {:.3g} {}, steps {} to {}", name, (*least).*of, (*most).*of, unit, moments.front().step,
                                          moments.back().step);
    struct View {
        const std::vector<Meters::Moment>& moments;
        float Meters::Moment::*of;
    } view{moments, of};
    const auto value = [](void* data, int i) {
        const View& v = *static_cast<const View*>(data);
        return v.moments[static_cast<std::size_t>(i)].*v.of;
    };
    ImGui::TextUnformatted(words.c_str());
    const ImVec2 size{ImGui::GetContentRegionAvail().x, 3.2f * ImGui::GetFontSize()};
    ImGui::PlotLines(fmt::format("##{}", name).c_str(), value, &view, static_cast<int>(moments.size()), 0, nullptr, (*least).*of, (*most).*of, size);
    ui::note(name);
}

}  // namespace

void drawMeters(Ui& ui) {
    const PhysicsWorld* world = ui.editor.bodies();
    if (!world) return ui::remark(makeTree(ui.editor.scene()).fault);
    const double deepest = world->maxPenetration();
    watch(ui.meters, *world, deepest);
    const Energy energy = world->energy();
    if (ImGui::BeginTable("meters", 2)) {
        ImGui::TableSetupColumn("meter", ImGuiTableColumnFlags_WidthFixed);
        ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
        line("energy", fmt::format("{:.6g} J", energy.total()), "kinetic and potential");
        line("kinetic", fmt::format("{:.6g} J", energy.kinetic), "of moving and turning");
        line("potential", fmt::format("{:.6g} J", energy.potential), "of weight; 0 at the origin");
        line("momentum", vectorText(world->momentum()) + " kg m/s", "of all bodies together");
        line("angular momentum", vectorText(world->angularMomentum()) + " kg m2/s", "of all bodies together, about the origin");
        line("deepest overlap", fmt::format("{:.3g} mm", 1e3 * deepest), "of any two that touch");
        line("awake", fmt::format("{} of {}", world->awake(), world->bodies().size()), "bodies that are not asleep");
        line("contacts", fmt::format("{}", world->contacts()), "that carried something in the last part of a step");
        line("frozen", fmt::format("{}", world->frozen().size()), "bodies whose state was no number; Debug names them");
        ImGui::EndTable();
    }
    history(ui.meters, "energy history", &Meters::Moment::energy, "J");
    history(ui.meters, "kinetic history", &Meters::Moment::kinetic, "J");
    history(ui.meters, "overlap history", &Meters::Moment::deepest, "m");
}

}  // namespace mb
