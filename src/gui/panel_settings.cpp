// The settings: controls, the live state of every body, constants, and the picture's quality.
#include "gui/panels.h"
#include "gui/widgets.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace mb {
namespace {

void row(std::initializer_list<std::string> cells) {
    ImGui::TableNextRow();
    for (const std::string& cell : cells) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(cell.c_str());
    }
}
std::string triple(glm::dvec3 v) { return fmt::format("{:8.3f} {:8.3f} {:8.3f}", v.x, v.y, v.z); }

void drawTotals(const Editor& editor) {
    const PhysicsWorld* world = editor.simulation().world();
    if (!world) return ui::remark("Not moving yet: play, step or throw to see the totals.");
    const Energy energy = world->energy();
    ImGui::Text("step %llu   awake %d of %zu   contacts %d   removed %d", static_cast<unsigned long long>(editor.simulation().steps()),
                world->awake(), world->bodies().size(), world->contacts(), world->removed());
    ImGui::Text("energy %.4g J = %.4g kinetic + %.4g potential   state %s", energy.total(), energy.kinetic, energy.potential,
                world->stateText().c_str());
    for (const std::string& note : world->notes()) ui::remark(note);
}

}  // namespace

void drawControls(Ui&) {
    if (!ImGui::BeginTable("controls", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return;
    for (const MouseControl& control : mouseControls()) row({control.what, control.does});
    for (const Entry& entry : entries())
        if (entry.shortcut.key) row({entry.shortcut.shown, fmt::format("{}: {}", entry.name, entry.tip)});
    ImGui::EndTable();
}

void drawDebug(Ui& ui) {
    const Scene& scene = ui.editor.scene();
    drawTotals(ui.editor);
    std::vector<std::size_t> bodies;
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        if (scene.objects[i].isBody()) bodies.push_back(i);
    if (bodies.empty()) return ui::remark("The scene has no body: no object has a mass or a density.");
    const ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_ScrollX | ImGuiTableFlags_SizingFixedFit |
                                  ImGuiTableFlags_BordersInnerV;
    if (!ImGui::BeginTable("bodies", 6, flags)) return;
    ImGui::TableSetupScrollFreeze(1, 1);
    for (const char* head : {"body", "position, m", "rotation, degrees", "velocity, m/s", "spin, rad/s", "mass"}) ImGui::TableSetupColumn(head);
    ImGui::TableHeadersRow();
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(bodies.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const Object& o = scene.objects[bodies[static_cast<std::size_t>(i)]];
            row({label(scene, bodies[static_cast<std::size_t>(i)]), triple(o.pos), triple(o.rot), triple(o.vel), triple(o.spin),
                 o.mass > 0 ? fmt::format("{:.4g} kg", o.mass) : fmt::format("{:.4g} kg/m³", o.density)});
        }
    ImGui::EndTable();
}

void drawConstants(Ui& ui) {
    Editor& editor = ui.editor;
    ui::heading("World");
    World world = editor.scene().world;
    if (ui::fields(world)) editor.setWorld(world);
    ui::heading("Steps of time");
    PhysicsKnobs physics = editor.scene().physics;
    if (ui::fields(physics)) editor.setPhysics(physics);
}

void drawPicture(Ui& ui) {
    Editor& editor = ui.editor;
    ui::heading("Quality");
    RenderKnobs render = editor.scene().render;
    if (ui::fields(render)) editor.setRender(render);

    ui::heading("What the scene calls for");
    if (ui.planned_revision != editor.revision() && !editor.playing()) {
        ui.planned_revision = editor.revision(), ui.plan = {};
        if (!firstUnevaluated(editor.scene())) ui.plan = makePlan(editor.scene(), makeTree(editor.scene()));
    }
    if (ImGui::BeginTable("plan", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) {
        for (const Plan::Called& called : ui.plan.called)
            row({std::string(called.effect->name), fmt::format("{} (by {})", called.effect->what, called.by)});
        ImGui::EndTable();
    }
    if (!ui.plan.refused.empty()) ui::remark(ui.plan.refused);
    ui::remark(fmt::format("passes: {}, at most {} loop iterations a pixel", ui.plan.passes.size(), ui.plan.loop_iterations));
    if (!ui.picture.renderer.empty()) ui::remark(fmt::format("drawn by {}", ui.picture.renderer));
}

}  // namespace mb
