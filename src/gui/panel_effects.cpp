// The ledger: what the scene calls for, because of which records, at what price; and what was left out.
#include "gui/panels.h"
#include "gui/widgets.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {
namespace {

constexpr ImGuiTableFlags kTable = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_BordersInnerV;
constexpr std::size_t kRecords = 8;         // a row names at most
constexpr glm::ivec2 kPricedSize{240, 135};  // small, so that one draw is not long

void cell(const std::string& text) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text.c_str());
}
/// The last column takes what is left.
void heads(std::initializer_list<const char*> names) {
    for (const char* const* name = names.begin(); name != names.end(); ++name)
        ImGui::TableSetupColumn(*name, name + 1 == names.end() ? ImGuiTableColumnFlags_WidthStretch : 0);
    ImGui::TableHeadersRow();
}

void wrappedCell(const std::string& text) {
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", text.c_str());
}

/// Shows the record where it can be changed.
void show(Ui& ui, const Because& because) {
    const int index = static_cast<int>(because.index);
    switch (because.record) {
    case Because::Record::object:
        if (because.index < ui.editor.scene().objects.size()) ui.editor.select(ui.editor.scene().objects[because.index].id);
        ui.show("Attributes"), ui.attributes_to_top = true;
        break;
    case Because::Record::material: ui.shown_material = index, ui.show("Materials"); break;
    case Because::Record::light: ui.shown_light = index, ui.show("Lights"); break;
    case Because::Record::render: ui.show("Picture"); break;
    default: ui.show("Constants");
    }
}
/// The records that call, each a button.
void records(Ui& ui, const Scene& scene, const std::vector<Because>& because, int row) {
    ImGui::TableNextColumn();
    for (std::size_t i = 0; i < because.size(); ++i) {
        ImGui::PushID(row * static_cast<int>(kRecords) + static_cast<int>(i));
        const std::string name = describe(scene, because[i]);
        const float width = ImGui::CalcTextSize(name.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
        if (i > 0) ImGui::SameLine();
        if (i > 0 && ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
        if (ui::button(name.c_str(), "shows the record")) show(ui, because[i]);
        ImGui::PopID();
    }
}

void priceCells(const Price& p, double pixels) {
    if (!p.measured) {
        for (int i = 0; i < 4; ++i) cell("");
        return;
    }
    cell(fmt::format("{:.2f}", p.ms));
    if (ImGui::IsItemHovered()) ui::tip(fmt::format("of {:.1f}; in turns from {:.2f} to {:.2f}", p.frame_ms, p.ms_least, p.ms_most));
    cell(fmt::format("{:.2f}", static_cast<double>(p.evaluations) / pixels));
    cell(fmt::format("{:.5f}", p.mean));
    cell(fmt::format("{:.3f}", p.largest));
}

void effectTable(Ui& ui, const std::vector<EffectPrice>& rows, bool called, double pixels) {
    if (!ImGui::BeginTable(called ? "called" : "left out", 6, kTable)) return;
    heads({"effect", "ms", "evals/px", "mean", "largest", called ? "called for by" : "what it would do"});
    for (const EffectPrice& row : rows) {
        if (row.called != called) continue;
        ImGui::TableNextRow();
        cell(std::string(row.effect->name));
        if (ImGui::IsItemHovered()) ui::tip(row.effect->tip);
        priceCells(row.price, pixels);
        if (called) records(ui, ui.editor.scene(), row.because, static_cast<int>(numberOf(*row.effect)));
        else wrappedCell(row.price.note.empty() ? std::string(row.effect->tip) : fmt::format("{}; {}", row.effect->tip, row.price.note));
    }
    ImGui::EndTable();
}

void recordTable(Ui& ui, const std::vector<RecordPrice>& rows, double pixels) {
    if (rows.empty() || !ImGui::BeginTable("records", 6, kTable)) return;
    heads({"object or light", "ms", "evals/px", "mean", "largest", ""});
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(rows.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const RecordPrice& row = rows[static_cast<std::size_t>(i)];
            ImGui::TableNextRow();
            records(ui, ui.editor.scene(), {row.record}, 1000 + i);
            priceCells(row.price, pixels);
            cell(!row.price.note.empty() ? row.price.note : row.price.measured && !row.seen() ? "never seen" : "");
        }
    ImGui::EndTable();
}

void motionTable(Ui& ui, const MotionLedger& ledger) {
    if (!ImGui::BeginTable("stages", 5, kTable)) return;
    heads({"stage", "uses/step", "ms/step", "moves, m", "called for by"});
    for (const StagePrice& row : ledger.rows()) {
        ImGui::TableNextRow();
        cell(std::string(row.effect->name));
        if (ImGui::IsItemHovered()) ui::tip(row.effect->tip);
        cell(fmt::format("{:.2f}", row.uses_per_step));
        cell(fmt::format("{:.5f}", row.ms_per_step));
        cell(fmt::format("{:.4g}", row.moved_m));
        if (row.called) records(ui, ui.editor.scene(), row.because, 500 + static_cast<int>(row.effect->stage));
        else cell("left out");
    }
    ImGui::EndTable();
}

/// Whether a record that a ledger names may no longer be what it was.
bool isStale(const Ui& ui) { return ui.priced_revision != ui.editor.revision(); }

void begin(Ui& ui, bool records) {
    const Editor& editor = ui.editor;
    PictureLedger::Plan plan;
    plan.size = kPricedSize, plan.rounds = 3, plan.records = kRecords, plan.effects = !records, plan.records_too = records;
    ui.picture.ledger.emplace(editor.scene(), editor.camera(), plan), ui.picture.pricing = true;
    ui.motion_ledger.reset(), ui.pricing_motion = false;
    if (!records && makeTree(editor.scene()).fault.empty() && PhysicsWorld(editor.scene()).stages().has(Stage::flight))
        ui.motion_ledger.emplace(editor.scene()), ui.pricing_motion = true;
    ui.priced_revision = editor.revision();
}

void drawProgress(Ui& ui) {
    const double done = ui.picture.pricing ? ui.picture.ledger->progress() : ui.motion_ledger->progress();
    ImGui::ProgressBar(static_cast<float>(done), {ImGui::GetContentRegionAvail().x * 0.6f, 0}, ui.picture.pricing ? "pricing the picture" : "pricing the physics");
    ImGui::SameLine();
    if (ui::button("Stop")) ui.picture.pricing = ui.pricing_motion = false, ui.picture.ledger.reset(), ui.motion_ledger.reset();
}

}  // namespace

void drawEffects(Ui& ui) {
    const Editor& editor = ui.editor;
    if (ui.pricing_motion && !ui.picture.pricing) ui.pricing_motion = ui.motion_ledger->step();
    if (ui.picture.pricing || ui.pricing_motion) {
        drawProgress(ui);
    } else {
        if (ui::button("Measure", "draws the picture with and without each effect: what it costs and what it shows")) begin(ui, false);
        ImGui::SameLine();
        if (ui::button("Price objects and lights", "the same for each object and light: what costs and is never seen comes first")) begin(ui, true);
    }
    const bool unfinished = ui.picture.ledger && !ui.picture.pricing && ui.picture.ledger->progress() < 1;
    if (unfinished) ui.picture.ledger.reset(), ui.motion_ledger.reset();  // the panel was closed meanwhile
    const bool priced = ui.picture.ledger && !isStale(ui);
    if (ui.picture.ledger && isStale(ui) && !ui.picture.pricing) ui::remark("The scene has changed since it was measured.");
    if (!priced && ui.called_revision != editor.revision() && !editor.playing()) {
        PictureLedger::Plan plan;
        plan.records = kRecords;
        ui.called = PictureLedger(editor.scene(), editor.camera(), plan).effects(), ui.called_revision = editor.revision();
    }
    const double pixels = static_cast<double>(kPricedSize.x) * kPricedSize.y;
    if (priced && !ui.picture.ledger->records().empty()) return recordTable(ui, ui.picture.ledger->records(), pixels);
    const std::vector<EffectPrice>& rows = priced ? ui.picture.ledger->effects() : ui.called;
    if (priced && ui.picture.ledger->saved().measured) {
        const Price& saved = ui.picture.ledger->saved();
        ui::remark(fmt::format("A frame of {}x{} takes {:.1f} ms; with everything there is in its program, {:.1f} ms.{}", kPricedSize.x, kPricedSize.y,
                               saved.frame_ms - saved.ms, saved.frame_ms,
                               ownIsSlower(saved) ? " The scene's own program measured slower and is dropped for that one." : ""));
    }
    ui::heading("Called for");
    effectTable(ui, rows, true, pixels);
    ui::heading("Left out: what its code would cost in the program");
    effectTable(ui, rows, false, pixels);
    if (!priced || !ui.motion_ledger) return;
    ui::heading("The physics");
    motionTable(ui, *ui.motion_ledger);
}

}  // namespace mb
