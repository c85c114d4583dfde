#pragma once
// One row for each key of each record: its name, where its value lives, its range and its tip. The text format, the
// panels' sliders, `--set` and the tests walk these rows. (An object's type adds its own: core/sdf/shape.h.)
#include "core/scene/scene.h"

#include <span>
#include <string_view>
#include <variant>

namespace mb {

/// The number of that place in a record's `extra`.
struct Slot {
    std::size_t at = 0;
    bool whole = false;
};

template <class Record> struct Key {
    using Member = std::variant<double Record::*, int Record::*, bool Record::*, glm::dvec3 Record::*, std::string Record::*,
                                std::optional<double> Record::*, Pattern Record::*, Slot>;
    std::string_view name;
    Member member;
    std::string_view unit = {}, tip = {};
    double lo = 0, hi = 0;               // the range a file may use, of each component; not for text and words
    double slider_lo = 0, slider_hi = 0; // the range a slider offers
    bool required = false;               // a record that leaves it out is at fault
    bool logarithmic = false;            // the slider's scale
    bool body = false;                   // of a body: only an object at the top level takes it
    bool direction = false;              // a vector of any length but 0
};

/// The value a row's member stands for.
template <class Record, class Member> auto& valueAt(Record& record, Member member) {
    if constexpr (!std::is_same_v<Member, Slot>) return record.*member;
    else if constexpr (requires { record.extra; }) return record.extra[member.at];
    else {
        static std::conditional_t<std::is_const_v<Record>, const double, double> none{};  // no row of such a record has a slot
        return none;
    }
}

/// The rows of a record: World, Camera, Light, Material, RenderKnobs, PhysicsKnobs or Object. `type`, `material` and an
/// object's own keys are not among Object's: the reader and the panels know them. Those that the table of effects brings
/// stand behind the others.
template <class Record> std::span<const Key<Record>> keys();
template <> std::span<const Key<World>> keys();
template <> std::span<const Key<Camera>> keys();
template <> std::span<const Key<Light>> keys();
template <> std::span<const Key<Material>> keys();
template <> std::span<const Key<RenderKnobs>> keys();
template <> std::span<const Key<PhysicsKnobs>> keys();
template <> std::span<const Key<Object>> keys();

/// The words a Pattern is spelt with, in the order of the enumeration.
std::span<const std::string_view> patternWords();

/// Where a file's limits stand: bytes, records and levels.
struct Limits {
    static constexpr std::size_t line_bytes = 4096, file_bytes = 64u << 20;
    static constexpr std::size_t objects = 100'000, materials = 4096, lights = 1024, cameras = 1024, levels = 32;
};

}  // namespace mb
