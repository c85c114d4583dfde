#pragma once
// The table of knobs: every number of a scene that trades error for time, one row each. The sweeps, the charts, the reports,
// the budgets and the panel walk it.
#include "core/accuracy/run.h"
#include "core/effects/plan.h"

namespace mb {

struct Knob {
    std::string_view key;               // of the scene's render or physics record
    std::string_view title;
    std::string_view meaning;           // two sentences for a reader with little mathematics
    std::span<const double> values;     // from cheap to dear
    std::span<const Error> moves;       // the first is what its chart shows
    Cost cost = Cost::evaluations;      // what it is paid in
    bool (*matters)(const Scene&, const Plan&) = nullptr;  // whether it can change anything in that scene; null: in any

    bool ofMotion() const { return rowOf(moves.front()).motion; }
};
std::span<const Knob> knobs();
const Knob& knobNamed(std::string_view key);   // it must exist

/// The knobs of a picture, or of a motion, that matter in the scene, in the order of the table.
std::vector<const Knob*> knobsOf(const Scene& scene, bool motion);

/// What a setting has a knob at, and the same setting with it turned.
double valueOf(const Setting& setting, const Knob& knob);
Setting turned(Setting setting, const Knob& knob, double value);

Setting settingOf(const Scene& scene);
/// The setting with the knobs of a picture, or of a motion, at what another has them at; and whether two have them at the same.
Setting withKnobs(Setting setting, const Setting& of, bool motion);
bool sameKnobs(const Setting& a, const Setting& b, bool motion);
/// Whether two scenes show and move the same things, whatever the knobs are at and wherever their cameras stand.
bool sameButKnobs(const Scene& a, const Scene& b);
/// The setting with every knob of a picture, or of a motion, at the program's default.
Setting defaultsOf(Setting setting, bool motion);
Scene withSetting(Scene scene, const Setting& setting);
/// What differs from another setting, as `--set` takes it: "samples=4 march_epsilon=0.001"; empty: nothing.
std::string differences(const Setting& setting, const Setting& from);

/// A knob's values with more where they belong: what the scene has it at.
std::vector<double> valuesWith(const Knob& knob, std::initializer_list<double> more);

}  // namespace mb
