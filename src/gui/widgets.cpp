#include "gui/widgets.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

namespace mb::ui {

std::vector<Seen>* seen = nullptr;
const char* seen_panel = "";

namespace {

void noteAt(std::string_view label, ImVec2 min, ImVec2 max, bool visible) {
    const std::size_t hidden = label.find("##");
    if (seen) seen->push_back({seen_panel, std::string(label.substr(0, hidden == 0 ? label.size() : hidden)), min, max, visible});
}

}  // namespace

void note(std::string_view label) { noteAt(label, ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), ImGui::IsItemVisible()); }
void note(std::string_view label, ImVec2 min, ImVec2 max) { noteAt(label, min, max, ImGui::IsRectVisible(min, {max.x + 1, max.y + 1})); }

namespace {

constexpr float kNameWidth = 112;  // pixels at the font's first size; the rest of the line is the control's

/// The line's name on the left; leaves the cursor where the control comes.
void name(const Row& row) {
    const float scale = ImGui::GetFontSize() / 15;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(row.name.data(), row.name.data() + row.name.size());
    if (!row.tip.empty()) tip(row.tip);
    ImGui::SameLine(std::max(kNameWidth * scale, ImGui::CalcTextSize(row.name.data(), row.name.data() + row.name.size()).x + 12));
}

std::string format(const Row& row) {
    if (row.whole) return "%.0f";
    // A logarithmic slider takes its smallest step from the digits shown.
    return row.logarithmic && row.slider_lo < 1e-3 ? "%.6g" : "%.4g";
}

/// One slider; `value` changes only to a number in [lo, hi].
bool slider(const Row& row, const char* id, double& value, const std::string& shown) {
    double moved = value;
    const ImGuiSliderFlags flags = row.logarithmic ? ImGuiSliderFlags_Logarithmic : 0;
    if (!ImGui::SliderScalar(id, ImGuiDataType_Double, &moved, &row.slider_lo, &row.slider_hi, shown.c_str(), flags)) return false;
    if (!std::isfinite(moved)) return false;
    if (row.whole) moved = std::round(moved);
    moved = std::clamp(moved, row.lo, row.hi);
    if (moved == value) return false;
    value = moved;
    return true;
}

double encoded(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; }
double decoded(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
ImVec4 screen(glm::dvec3 linear) {
    const auto part = [](double c) { return static_cast<float>(std::clamp(encoded(c), 0.0, 1.0)); };
    return {part(linear.x), part(linear.y), part(linear.z), 1};
}

template <class Record> Row rowOf(const Key<Record>& key) {
    return {key.name, key.unit, key.tip, key.lo, key.hi, key.slider_lo, key.slider_hi, key.logarithmic, false};
}

/// Three numbers without a unit that a slider takes from 0 to 1 are a colour.
template <class Record> bool isColor(const Key<Record>& key) { return key.unit.empty() && key.lo == 0 && key.slider_hi == 1; }

}  // namespace

bool numbers(const Row& row, double* values, int count) {
    name(row);
    const std::string unit = row.unit.empty() || count > 1 ? "" : fmt::format(" {}", row.unit);
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - gap * static_cast<float>(count - 1)) / static_cast<float>(count);
    bool changed = false;
    for (int i = 0; i < count; ++i) {
        const std::string id = fmt::format("##{}{}", row.name, i);
        if (i > 0) ImGui::SameLine(0, gap);
        ImGui::SetNextItemWidth(std::max(width, 20.0f));
        changed |= slider(row, id.c_str(), values[i], format(row) + unit);
        note(count == 1 ? std::string(row.name) : fmt::format("{}.{}", row.name, "xyz"[i]));
        if (ImGui::IsItemHovered() && !ImGui::IsItemActive())
            tip(fmt::format("{}{}{} to {}{}{}; Ctrl+click to type", row.tip, row.tip.empty() ? "" : "; ", row.lo, row.hi,
                            row.unit.empty() ? "" : " ", row.unit));
    }
    return changed;
}

bool words(const Row& row, int& value, std::span<const std::string_view> choices) {
    name(row);
    ImGui::SetNextItemWidth(-1);
    bool changed = false;
    const bool open = ImGui::BeginCombo(fmt::format("##{}", row.name).c_str(), std::string(choices[static_cast<std::size_t>(value)]).c_str());
    note(row.name);
    if (!open) return false;
    for (std::size_t i = 0; i < choices.size(); ++i)
        if (selectable(std::string(choices[i]).c_str(), static_cast<int>(i) == value)) value = static_cast<int>(i), changed = true;
    ImGui::EndCombo();
    return changed;
}

bool check(const Row& row, bool& value) {
    name(row);
    const bool changed = ImGui::Checkbox(fmt::format("##{}", row.name).c_str(), &value);
    note(row.name);
    if (!row.tip.empty()) tip(row.tip);
    return changed;
}

bool text(const Row& row, std::string& value) {
    name(row);
    ImGui::SetNextItemWidth(-1);
    const bool changed = ImGui::InputText(fmt::format("##{}", row.name).c_str(), &value);
    note(row.name);
    return changed;
}

bool color(const Row& row, glm::dvec3& linear) {
    name(row);
    float shown[3];
    for (int i = 0; i < 3; ++i) shown[i] = static_cast<float>(encoded(linear[i]));
    ImGui::SetNextItemWidth(-1);
    const bool changed = ImGui::ColorEdit3(fmt::format("##{}", row.name).c_str(), shown, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
    note(row.name);
    if (!changed) return false;
    for (int i = 0; i < 3; ++i)
        if (std::isfinite(shown[i])) linear[i] = std::clamp(decoded(static_cast<double>(shown[i])), row.lo, row.hi);
    return true;
}

namespace {

template <class Record> bool field(const Key<Record>& key, Record& record) {
    struct Draw {
        const Key<Record>& key;
        Record& record;
        bool operator()(double Record::*m) const { return numbers(rowOf(key), &(record.*m), 1); }
        bool operator()(Slot slot) const {
            Row row = rowOf(key);
            row.whole = slot.whole;
            return numbers(row, &valueAt(record, slot), 1);
        }
        bool operator()(int Record::*m) const {
            Row row = rowOf(key);
            row.whole = true;
            double value = record.*m;
            if (!numbers(row, &value, 1)) return false;
            record.*m = static_cast<int>(value);
            return true;
        }
        bool operator()(bool Record::*m) const { return check(rowOf(key), record.*m); }
        bool operator()(glm::dvec3 Record::*m) const {
            return isColor(key) ? color(rowOf(key), record.*m) : numbers(rowOf(key), &(record.*m)[0], 3);
        }
        bool operator()(std::string Record::*m) const { return text(rowOf(key), record.*m); }
        bool operator()(std::optional<double> Record::*m) const {
            bool own = (record.*m).has_value();
            const bool switched = check(rowOf(key), own);
            if (switched) record.*m = own ? std::optional<double>(key.slider_hi / 2) : std::nullopt;
            ImGui::SameLine();
            if (!own) return remark("the world's"), switched;
            Row row = rowOf(key);
            double value = *(record.*m);
            ImGui::SetNextItemWidth(-1);
            const bool moved = slider(row, fmt::format("##own {}", key.name).c_str(), value, format(row));
            note(fmt::format("own {}", key.name));
            if (moved) record.*m = value;
            return switched || moved;
        }
        bool operator()(Pattern Record::*m) const {
            int value = static_cast<int>(record.*m);
            if (!words(rowOf(key), value, patternWords())) return false;
            record.*m = static_cast<Pattern>(value);
            return true;
        }
    };
    return std::visit(Draw{key, record}, key.member);
}

}  // namespace

template <class Record> bool fields(Record& record, const std::function<bool(const Key<Record>&)>& wanted) {
    bool changed = false;
    for (const Key<Record>& key : keys<Record>())
        if (!wanted || wanted(key)) changed |= field(key, record);
    return changed;
}
template bool fields(World&, const std::function<bool(const Key<World>&)>&);
template bool fields(Camera&, const std::function<bool(const Key<Camera>&)>&);
template bool fields(Light&, const std::function<bool(const Key<Light>&)>&);
template bool fields(Material&, const std::function<bool(const Key<Material>&)>&);
template bool fields(RenderKnobs&, const std::function<bool(const Key<RenderKnobs>&)>&);
template bool fields(PhysicsKnobs&, const std::function<bool(const Key<PhysicsKnobs>&)>&);
template bool fields(Object&, const std::function<bool(const Key<Object>&)>&);

bool parameters(const ShapeType& type, Numbers& values) {
    bool changed = false;
    double* at = values.data();
    for (const Parameter& p : type.parameters) {
        const Row row{p.name, p.unit, p.tip, p.lo, p.hi, p.slider_lo, p.slider_hi, false, p.kind == Parameter::Kind::whole};
        if (p.kind == Parameter::Kind::word) {
            int word = static_cast<int>(*at);
            if (words(row, word, p.words)) *at = word, changed = true;
        } else {
            changed |= numbers(row, at, p.size);
        }
        at += p.size;
    }
    return changed;
}

bool material(const Scene& scene, int& value, const char* none) {
    name({"material", "", "what the surface looks like"});
    ImGui::SetNextItemWidth(-1);
    const char* now = value == kNoMaterial ? none : scene.materials[static_cast<std::size_t>(value)].name.c_str();
    const bool open = ImGui::BeginCombo("##material", now);
    note("material");
    if (!open) return false;
    const int before = value;
    for (int i = kNoMaterial; i < static_cast<int>(scene.materials.size()); ++i) {
        const Material& m = materialOf(scene, i);
        ImGui::PushID(i);
        swatch("##swatch", m.color);
        ImGui::SameLine();
        if (selectable(i == kNoMaterial ? none : m.name.c_str(), i == value)) value = i;
        ImGui::PopID();
    }
    ImGui::EndCombo();
    return value != before;
}

bool button(const char* label, const char* why, float width) {
    const bool pressed = ImGui::Button(label, {width, 0});
    note(label);
    if (why) tip(why);
    return pressed;
}

bool selectable(const char* label, bool selected) {
    const bool pressed = ImGui::Selectable(label, selected);
    note(label);
    return pressed;
}

void swatch(const char* id, glm::dvec3 linear) {
    const float side = ImGui::GetTextLineHeight();
    ImGui::ColorButton(id, screen(linear), ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop, {side, side});
}

void tip(std::string_view text) {
    if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void heading(const char* text) {
    ImGui::Spacing();
    ImGui::TextDisabled("%s", text);
    ImGui::Separator();
}

void remark(std::string_view text) {
    ImGui::PushTextWrapPos(0);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
}

}  // namespace mb::ui
