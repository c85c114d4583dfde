#include "physics/stages.h"

#include "core/effects/effect.h"

#include <algorithm>
#include <array>

namespace mb {
namespace {

constexpr std::array kCounters{
    Counter{"integrations", &StepCounts::integrations, Stage::flight},
    Counter{"static_queries", &StepCounts::static_queries, Stage::static_contacts},
    Counter{"static_contacts", &StepCounts::static_contacts, Stage::static_contacts},
    Counter{"evaluations", &StepCounts::evaluations, Stage::static_contacts},
    Counter{"broad_phases", &StepCounts::broad_phases, Stage::broad_phase},
    Counter{"pairs", &StepCounts::pairs, Stage::broad_phase},
    Counter{"body_gaps", &StepCounts::body_gaps, Stage::body_contacts},
    Counter{"body_contacts", &StepCounts::body_contacts, Stage::body_contacts},
    Counter{"turned", &StepCounts::turned, Stage::spin},
    Counter{"drags", &StepCounts::drags, Stage::friction},
    Counter{"bounces", &StepCounts::bounces, Stage::restitution},
    Counter{"searches", &StepCounts::searches, Stage::continuous},
    Counter{"rounds", &StepCounts::rounds, Stage::count},
    Counter{"islands", &StepCounts::islands, Stage::sleeping},
    Counter{"torques", &StepCounts::torques, Stage::rolling},
};

}  // namespace

Stages Stages::all() { return Stages(bit(Stage::count) - 1); }

Stages calledFor(const Scene& scene) {
    Stages called;
    const Tree none;
    for (const Effect& row : motionEffects()) {
        Calls calls(1);
        row.calls(row, scene, none, calls);
        if (calls.any()) called = called | Stages{row.stage};
    }
    return called;
}

void StepCounts::add(const StepCounts& more) {
    for (const Counter& counter : kCounters) this->*counter.of += more.*counter.of;
}

std::uint64_t StepCounts::used(Stage stage) const {
    const auto row = std::ranges::find(kCounters, stage, &Counter::stage);
    return row == kCounters.end() ? 0 : this->*row->of;
}

std::span<const Counter> counters() { return kCounters; }

}  // namespace mb
