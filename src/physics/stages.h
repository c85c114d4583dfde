#pragma once
// The stages a step is made of: those that the table of effects calls for, and how often each did its work.
#include "core/scene/scene.h"

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>

namespace mb {

enum class Stage;  // core/effects/effect.h

class Stages {
public:
    constexpr Stages() = default;
    constexpr Stages(std::initializer_list<Stage> stages) {
        for (const Stage s : stages) bits_ |= bit(s);
    }
    static Stages all();

    constexpr bool has(Stage s) const { return (bits_ & bit(s)) != 0; }
    friend constexpr Stages operator|(Stages a, Stages b) { return Stages(a.bits_ | b.bits_); }
    friend constexpr Stages operator-(Stages a, Stages b) { return Stages(a.bits_ & ~b.bits_); }
    friend constexpr bool operator==(Stages, Stages) = default;

private:
    explicit constexpr Stages(unsigned bits) : bits_(bits) {}
    static constexpr unsigned bit(Stage s) { return 1u << static_cast<unsigned>(s); }
    unsigned bits_ = 0;
};

/// The stages whose rows the scene's records call for.
Stages calledFor(const Scene& scene);

/// What a world is composed of instead of just what its scene calls for: to price a stage, and to test that leaving one out
/// that is not called for changes nothing.
struct StageChoice {
    Stages on, off;
    bool proofs = true;     // work that is proved to find nothing is left out, body by body

    Stages from(Stages called) const { return (called | on) - off; }
    /// Every stage, and all of its work, whatever the scene.
    static StageChoice general() { return {Stages::all(), {}, false}; }
    static StageChoice with(Stage s) { return {{s}, {}, true}; }
    static StageChoice without(Stage s) { return {{}, {s}, true}; }
};

/// Work done since the world was made.
struct StepCounts {
    std::uint64_t integrations = 0;     // bodies brought forward
    std::uint64_t static_queries = 0;   // the static field was asked what a body touches
    std::uint64_t static_contacts = 0;
    std::uint64_t evaluations = 0;      // of the static field
    std::uint64_t broad_phases = 0;     // sweeps over the bodies
    std::uint64_t pairs = 0;            // that they found
    std::uint64_t body_gaps = 0;        // pairs measured
    std::uint64_t body_contacts = 0;
    std::uint64_t turned = 0;           // bodies turned
    std::uint64_t drags = 0;            // turns of a contact's drag
    std::uint64_t bounces = 0;          // contacts parted with restitution
    std::uint64_t searches = 0;         // for an impact along a path
    std::uint64_t rounds = 0;           // of the solver
    std::uint64_t islands = 0;          // passes that wake and put to sleep
    std::uint64_t torques = 0;          // turns of a contact's torque against rolling and spinning

    void add(const StepCounts& more);
    /// How often the stage did its work.
    std::uint64_t used(Stage stage) const;
    friend bool operator==(const StepCounts&, const StepCounts&) = default;
};

/// One row a counter; the first of a stage's is the one it is priced by.
struct Counter {
    std::string_view name;
    std::uint64_t StepCounts::*of;
    Stage stage;
};
std::span<const Counter> counters();

}  // namespace mb
