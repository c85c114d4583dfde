// The objects: their tree, one new one, and the selected one's attributes.
#include "gui/panels.h"
#include "gui/widgets.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {
namespace {

struct TreeLine {
    std::size_t index;
    int level;
};

/// The objects of the tree that are not folded away, in order.
std::vector<TreeLine> lines(const Ui& ui) {
    const std::vector<Object>& objects = ui.editor.scene().objects;
    std::vector<TreeLine> out;
    std::vector<int> levels(objects.size(), 0);
    for (std::size_t i = 0; i < objects.size();) {
        if (objects[i].parent != kNoParent) levels[i] = levels[static_cast<std::size_t>(objects[i].parent)] + 1;
        out.push_back({i, levels[i]});
        i = ui.folded.contains(objects[i].id.value) ? subtreeEnd(ui.editor.scene(), i) : i + 1;
    }
    return out;
}

void drawLine(Ui& ui, const TreeLine& line) {
    const Scene& scene = ui.editor.scene();
    const Object& o = scene.objects[line.index];
    ImGui::PushID(static_cast<int>(o.id.value));
    const float indent = ImGui::GetFontSize() * 1.1f;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + indent * static_cast<float>(line.level));
    if (o.type->isOperator()) {
        const bool folded = ui.folded.contains(o.id.value);
        const ImVec2 at = ImGui::GetCursorPos();
        if (ImGui::InvisibleButton("fold", {indent, ImGui::GetTextLineHeight()})) folded ? void(ui.folded.erase(o.id.value)) : void(ui.folded.insert(o.id.value));
        ui::note(label(scene, line.index) + " fold");
        ImGui::SetCursorPos(at);
        ImGui::TextDisabled(folded ? "+" : "-");
        ImGui::SameLine(at.x + indent);
    } else {
        ui::swatch("##swatch", materialOf(scene, effectiveMaterial(scene, line.index)).color);
        ImGui::SameLine();
    }
    const std::string name = label(scene, line.index);
    if (o.hidden) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    if (ImGui::Selectable(fmt::format("{}##line", name).c_str(), ui.editor.selected() == o.id)) ui.editor.select(o.id), ui.listed = o.id;
    ui::note(name);
    if (o.hidden) ImGui::PopStyleColor();

    // The type, on the right, unless the name says it.
    if (!name.starts_with(o.type->name)) {
        const std::string type(o.type->name);
        ImGui::SameLine(std::max(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(type.c_str()).x, ImGui::GetCursorPosX()));
        ImGui::TextDisabled("%s", type.c_str());
    }
    ImGui::PopID();
}

/// Unfolds what hides a selection made elsewhere, and scrolls to it.
void followSelection(Ui& ui) {
    if (ui.listed == ui.editor.selected()) return;
    ui.listed = ui.editor.selected();
    const Scene& scene = ui.editor.scene();
    const std::optional<std::size_t> selected = ui.editor.selection();
    if (!selected) return;
    for (int i = scene.objects[*selected].parent; i != kNoParent; i = scene.objects[static_cast<std::size_t>(i)].parent)
        ui.folded.erase(scene.objects[static_cast<std::size_t>(i)].id.value);
    const std::vector<TreeLine> all = lines(ui);
    const auto line = std::ranges::find(all, *selected, &TreeLine::index);
    const float high = ImGui::GetTextLineHeightWithSpacing(), y = high * static_cast<float>(line - all.begin()), room = ImGui::GetWindowHeight();
    if (y < ImGui::GetScrollY() || y + high > ImGui::GetScrollY() + room) ImGui::SetScrollY(std::max(y - room / 2, 0.0f));
}

/// Every type that can be drawn, in two groups. Returns the one chosen.
const ShapeType* typeList(const ShapeType* now) {
    const ShapeType* chosen = nullptr;
    const auto line = [&](const ShapeType& type) {
        if (ui::selectable(std::string(type.name).c_str(), &type == now)) chosen = &type;
        ui::tip(type.tip);
    };
    ImGui::TextDisabled("shapes");
    for (const Primitive& p : primitives()) line(p);
    ImGui::Separator();
    ImGui::TextDisabled("operators on shapes");
    for (const Operator& o : operators()) line(o);
    return chosen;
}

/// The operator a new object can go under: the selected one, or the one above the selected.
std::optional<std::size_t> operatorAtHand(const Editor& editor) {
    const std::optional<std::size_t> i = editor.selection();
    if (!i) return std::nullopt;
    const Object& o = editor.scene().objects[*i];
    if (o.type->isOperator()) return i;
    return o.parent == kNoParent ? std::nullopt : std::optional<std::size_t>(o.parent);
}

/// The keys every object has, its place if asked for; a body's further ones only where there is a body.
bool generalFields(Object& o, bool place, bool body_keys) {
    bool changed = ui::fields<Object>(o, [&](const Key<Object>& key) { return !key.body && key.name != "name" && (place || key.name != "pos"); });
    if (!body_keys) return changed;
    ui::heading("Body");
    const bool body = o.isBody();
    changed |= ui::fields<Object>(o, [&](const Key<Object>& key) {
        const bool makes_one = key.name == "mass" || key.name == "density";
        return key.body && (body || makes_one);
    });
    if (!body) ui::remark("It never moves. Give it a mass or a density and it falls.");
    return changed;
}

}  // namespace

void drawObjects(Ui& ui) {
    Editor& editor = ui.editor;
    if (ui::button("Add...", "an object of any type")) ui.show("Add object");
    ImGui::SameLine();
    ImGui::BeginDisabled(!editor.selection());
    if (ui::button("Delete", "the selected object, with its children")) editor.removeSelected();
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(editor.scene().objects.empty());
    if (ui::button("Remove last", "the object added last")) editor.removeLast();
    ImGui::SameLine();
    if (ui::button("Clear", "removes every object")) editor.clear();
    ImGui::EndDisabled();

    const float unit = (ImGui::GetContentRegionAvail().x - 3 * ImGui::GetStyle().ItemSpacing.x) / 4;
    if (ui::button(editor.playing() ? "Pause" : "Play", "lets time pass, or stops it (Space)", unit)) editor.playing() ? editor.pause() : editor.play();
    ImGui::SameLine();
    if (ui::button("Step", "one step of the physics (.)", unit)) editor.step();
    ImGui::SameLine();
    ImGui::BeginDisabled(!editor.canReset());
    if (ui::button("Reset", "the bodies go back to where they started (R)", unit)) editor.reset();
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ui::button("Throw", "gives every body a push (J)", unit)) editor.throwAbout();
    ImGui::Separator();

    ImGui::BeginChild("tree");
    if (editor.scene().objects.empty()) ui::remark("No objects. Add one with the button above.");
    followSelection(ui);
    const std::vector<TreeLine> all = lines(ui);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(all.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) drawLine(ui, all[static_cast<std::size_t>(i)]);
    ImGui::EndChild();
}

void drawAddObject(Ui& ui) {
    Editor& editor = ui.editor;
    Object& draft = ui.draft;
    ImGui::SetNextItemWidth(-1);
    const bool open = ImGui::BeginCombo("##type", std::string(draft.type->name).c_str(), ImGuiComboFlags_HeightLarge);
    ui::note("type");
    if (open) {
        if (const ShapeType* chosen = typeList(draft.type)) {
            draft.type = chosen, draft.numbers = initialNumbers(*chosen);
            if (chosen->name == "plane") draft.pos = {0, 0, 0}, draft.mass = draft.density = 0;
        }
        ImGui::EndCombo();
    }
    ui::remark(draft.type->tip);
    ui::text({"name", "", "left empty: called by its type"}, draft.name);
    if (draft.material >= static_cast<int>(editor.scene().materials.size())) draft.material = kNoMaterial;
    ui::material(editor.scene(), draft.material, "(default)");
    if (!draft.type->parameters.empty()) ui::heading("Shape");
    ui::parameters(*draft.type, draft.numbers);
    ui::heading("Place");

    const std::optional<std::size_t> under = operatorAtHand(editor);
    const bool below = under && ui.draft_below;
    if (!below) {
        ImGui::Checkbox("stands on what is below the view###stands", &ui.draft_stands);
        ui::note("stands");
        ui::tip("else it comes where its pos says");
    }
    const bool stands = !below && ui.draft_stands;
    generalFields(draft, !stands, !below);
    ImGui::Separator();
    if (under) {
        ImGui::Checkbox(fmt::format("put it under {}###below", label(editor.scene(), *under)).c_str(), &ui.draft_below);
        ui::note("below");
    }
    if (!ui::button("Create", nullptr, -1)) return;
    Object made = draft;
    if (made.name.empty()) made.name = draft.type->name;
    if (stands) made.pos = editor.standing(made);
    if (editor.addObject(made, below ? editor.scene().objects[*under].id : ObjectId{})) draft.name.clear(), ui.show("Attributes");
}

void drawAttributes(Ui& ui) {
    Editor& editor = ui.editor;
    const std::optional<std::size_t> index = editor.selection();
    if (!index) return ui::remark("Right click on an object in the picture, or choose one in the list above.");
    if (ui.attributes_to_top) ImGui::SetScrollY(0), ui.attributes_to_top = false;

    // The controls work on a copy, which the editor takes or refuses. The id keeps one object's half-typed text from another.
    Object o = editor.scene().objects[*index];
    ImGui::PushID(static_cast<int>(o.id.value));
    bool changed = ui::fields<Object>(o, [](const Key<Object>& key) { return key.name == "name"; });
    changed |= ui::material(editor.scene(), o.material, o.parent == kNoParent ? "(default)" : "(as above it)");
    ui::heading(fmt::format("Shape: {}", o.type->name).c_str());
    changed |= ui::parameters(*o.type, o.numbers);
    ui::heading("Place");
    changed |= generalFields(o, true, o.parent == kNoParent);
    if (changed) editor.setObject(*index, o);
    if (o.type->isOperator()) {
        ImGui::Separator();
        if (ui::button("Add a child...", "an object of any type, under this one", -1)) ui.show("Add object"), ui.draft_below = true;
    }
    ImGui::PopID();
}

}  // namespace mb
