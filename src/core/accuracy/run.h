#pragma once
// What a run of a sweep is: a setting of the knobs, what the picture or the motion was then wrong by, and what it cost. One list
// of errors and one of costs, which the reports, the charts and the panel walk.
#include "core/scene/scene.h"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mb {

/// Of pictures first, then of motions.
enum class Error { color, shade, state, depth, normal, position, energy, penetration, restitution, count };
enum class Cost { evaluations, ms, visits, step_ms, count };

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// A value for each row of a list; NaN where none was measured.
template <class Row> class Values {
public:
    Values() { values_.fill(kNotMeasured); }
    double& operator[](Row row) { return values_[static_cast<std::size_t>(row)]; }
    double operator[](Row row) const { return values_[static_cast<std::size_t>(row)]; }
    bool has(Row row) const { return !std::isnan((*this)[row]); }

private:
    std::array<double, static_cast<std::size_t>(Row::count)> values_;
};

/// One row of either list: how it is written, what it is, and what it means in a sentence for anybody.
template <class Row> struct Quantity {
    Row row;
    std::string_view name, unit, meaning;
    bool motion = false;      // of a motion; else of a picture
    double least = 0;         // a difference smaller than this is none
};
std::span<const Quantity<Error>> errorRows();
std::span<const Quantity<Cost>> costRows();
inline const Quantity<Error>& rowOf(Error e) { return errorRows()[static_cast<std::size_t>(e)]; }
inline const Quantity<Cost>& rowOf(Cost c) { return costRows()[static_cast<std::size_t>(c)]; }

/// The knobs of a picture and of a motion.
struct Setting {
    RenderKnobs render;
    PhysicsKnobs physics;
};

struct Run {
    std::string knob;         // that was turned alone; empty: several were, together
    double value = 0;         // it was turned to
    Setting setting;
    Values<Error> errors;
    Values<Cost> costs;
    Values<Error> off;        // what chance makes of each error: of a picture its standard error over the pixels; of a motion, how much it changed where
                              // the own setting's began a hair's breadth beside
    double undecided = 0;     // share of a picture's pixels whose ray had no answer
    bool aside = false;       // its knob is paid in another cost than the others: no part of a front
    std::string failure;      // why it is no point of a curve; empty: it is one

    bool failed() const { return !failure.empty(); }
};
/// One that is still to be made.
inline Run runOf(const Setting& setting, std::string_view knob = {}, double value = kNotMeasured) {
    Run run;
    run.knob = knob, run.value = value, run.setting = setting;
    return run;
}

}  // namespace mb
