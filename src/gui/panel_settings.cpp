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
std::string triple(glm::dvec3 v, int digits) { return fmt::format("{0:{4}.{3}f} {1:{4}.{3}f} {2:{4}.{3}f}", v.x, v.y, v.z, digits, digits + 4); }

/// What a body weighs in the simulation, whether the scene gives its mass or its density.
std::string massText(const PhysicsWorld* world, const Object& o) {
    if (world)
        for (const Body& b : world->bodies())
            if (b.object == o.id) return fmt::format("{:.4g} kg", b.mass());
    return o.mass > 0 ? fmt::format("{:.4g} kg", o.mass) : std::string("does not move");
}

void drawTotals(const Editor& editor, const PhysicsWorld* world) {
    if (!world) return ui::remark(makeTree(editor.scene()).fault);
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
    const PhysicsWorld* world = ui.editor.bodies();
    drawTotals(ui.editor, world);
    std::vector<std::size_t> bodies;
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        if (scene.objects[i].isBody()) bodies.push_back(i);
    if (bodies.empty()) return ui::remark("The scene has no body: no object has a mass or a density.");
    // No scrolling of its own: Dear ImGui 1.86 asserts on a scrolling table that its window leaves no room for.
    if (!ImGui::BeginTable("bodies", 6, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_BordersInnerV)) return;
    for (const char* head : {"body", "position, m", "rotation, degrees", "velocity, m/s", "spin, rad/s", "mass"}) ImGui::TableSetupColumn(head);
    ImGui::TableHeadersRow();
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(bodies.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const Object& o = scene.objects[bodies[static_cast<std::size_t>(i)]];
            row({label(scene, bodies[static_cast<std::size_t>(i)]), triple(o.pos, 3), triple(o.rot, 1), triple(o.vel, 2),
                 triple(o.spin, 2), massText(world, o)});
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
        ui.plan = makePlan(editor.scene(), makeTree(editor.scene()));
    }
    for (const Plan::Called& called : ui.plan.called) {
        ImGui::TextUnformatted(called.effect->name.data(), called.effect->name.data() + called.effect->name.size());
        ImGui::SameLine();
        ui::remark(fmt::format("{}; called for by {}", called.effect->tip, called.by));
    }
    if (!ui.plan.refused.empty()) ui::remark(ui.plan.refused);
    ui::remark(fmt::format("passes: {}, at most {} loop iterations a pixel", ui.plan.passes.size(), ui.plan.loop_iterations));
    if (ui::button("Count", "draws once more, smaller, with counters: what the picture takes and what it leaves undecided", -1))
        ui.picture.count_wanted = true;
    if (!ui.picture.counts.empty()) ui::remark(ui.picture.counts);
    if (!ui.picture.renderer.empty()) ui::remark(fmt::format("drawn by {}", ui.picture.renderer));
}

}  // namespace mb
