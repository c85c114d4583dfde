#pragma once
// The panels' own controls over Dear ImGui: a name on the left, the control on the right, a tip when the mouse rests on
// either. What the tables of keys say of a value (range, unit, scale) is all a control needs to know.
#include "core/scene/keys.h"

#include <imgui.h>

#include <functional>
#include <string>
#include <vector>

namespace mb::ui {

/// Where a control was drawn, for whoever wants to press it: the tests.
struct Seen {
    std::string panel, label;
    ImVec2 min, max;        // on the screen
    bool visible = false;   // not scrolled or clipped away
};
/// Where the controls of a frame are noted, if anywhere; and the panel they are drawn in.
extern std::vector<Seen>* seen;
extern const char* seen_panel;
/// Notes the control drawn last.
void note(std::string_view label);
/// Notes a place in the current window.
void note(std::string_view label, ImVec2 min, ImVec2 max);

/// One line of numbers, as a row of the tables has it.
struct Row {
    std::string_view name, unit, tip;
    double lo = 0, hi = 0, slider_lo = 0, slider_hi = 0;
    bool logarithmic = false, whole = false;
};

/// Each draws one line and says whether the value changed. Typed values are kept within [lo, hi]; what is no number
/// changes nothing.
bool numbers(const Row& row, double* values, int count);
bool words(const Row& row, int& value, std::span<const std::string_view> words);
bool check(const Row& row, bool& value);
bool text(const Row& row, std::string& value);
bool color(const Row& row, glm::dvec3& linear);

/// The lines of a record's keys that `wanted` says yes to, or all.
template <class Record> bool fields(Record& record, const std::function<bool(const Key<Record>&)>& wanted = {});
/// The lines of a type's own parameters.
bool parameters(const ShapeType& type, Numbers& numbers);
/// The material an object is given, from a list with swatches; `none` is what to call no material.
bool material(const Scene& scene, int& value, const char* none);

bool button(const char* label, const char* tip = nullptr, float width = 0);
bool selectable(const char* label, bool selected);
/// A small square of a linear colour, as the picture shows it.
void swatch(const char* id, glm::dvec3 linear);
void tip(std::string_view text);
void heading(const char* text);
/// Greyed text that wraps.
void remark(std::string_view text);

}  // namespace mb::ui
