// Materials, lights and the camera: what decides how the scene looks.
#include "gui/panels.h"
#include "gui/widgets.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {
namespace {

/// A list of named records with swatches; returns the row chosen.
template <class Record> int list(const char* id, const std::vector<Record>& records, int chosen) {
    const int shown = std::clamp(static_cast<int>(records.size()), 2, 6);
    ImGui::BeginChild(id, {0, ImGui::GetTextLineHeightWithSpacing() * static_cast<float>(shown) + 8}, true);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(records.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const Record& r = records[static_cast<std::size_t>(i)];
            ImGui::PushID(i);
            ui::swatch("##swatch", r.color);
            ImGui::SameLine();
            const std::string name = r.name.empty() ? fmt::format("light {}", i) : r.name;
            if (ui::selectable(name.c_str(), i == chosen)) chosen = i;
            ImGui::PopID();
        }
    ImGui::EndChild();
    return std::clamp(chosen, 0, std::max(static_cast<int>(records.size()) - 1, 0));
}

}  // namespace

void drawMaterials(Ui& ui) {
    Editor& editor = ui.editor;
    const std::vector<Material>& all = editor.scene().materials;
    ui.shown_material = list("materials", all, ui.shown_material);
    if (!all.empty()) {
        const std::size_t i = static_cast<std::size_t>(ui.shown_material);
        Material m = all[i];
        ImGui::PushID(ui.shown_material);
        if (ui::fields(m)) editor.setMaterial(i, m);
        ImGui::PopID();
    } else {
        ui::remark("No materials: every object shows the default one.");
    }
    ImGui::Separator();
    ui::seen_panel = "Materials: new";
    if (!ImGui::CollapsingHeader("Another material")) return ui::note("Another material");
    ImGui::PushID("new");
    ui::fields(ui.new_material);
    if (ui::button("Add", "to the list", -1)) ui.shown_material = static_cast<int>(editor.addMaterial(ui.new_material));
    ImGui::PopID();
}

void drawLights(Ui& ui) {
    Editor& editor = ui.editor;
    const std::vector<Light>& all = editor.scene().lights;
    ui.shown_light = list("lights", all, ui.shown_light);
    if (!all.empty()) {
        const std::size_t i = static_cast<std::size_t>(ui.shown_light);
        Light light = all[i];
        ImGui::PushID(ui.shown_light);
        if (ui::fields(light)) editor.setLight(i, light);
        ImGui::PopID();
        if (ui::button("Remove", "this light", -1)) editor.removeLight(i);
    } else {
        ui::remark("No lights: only ambient colours are seen.");
    }
    ImGui::Separator();
    ui::seen_panel = "Lights: new";
    if (!ImGui::CollapsingHeader("Another light")) return ui::note("Another light");
    ImGui::PushID("new");
    ui::fields(ui.new_light);
    if (ui::button("Add", "to the list", -1)) ui.shown_light = static_cast<int>(editor.addLight(ui.new_light));
    ImGui::PopID();
}

void drawCamera(Ui& ui) {
    Editor& editor = ui.editor;
    ui::remark("Where you look from now. The scene's own camera stays where it is until it is told to come here.");
    Camera camera = editor.camera();
    if (ui::fields<Camera>(camera, [](const Key<Camera>& key) { return key.name != "name"; })) editor.lookThrough(camera);
    if (ui::button("Use this view", "as the scene's camera", -1)) editor.keepView();
    if (ui::button("Back to the scene's camera", nullptr, -1)) editor.resetView();
}

}  // namespace mb
