#include "physics/ledger.h"

#include "core/measure/timing.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>

namespace mb {
namespace {

using Clock = std::chrono::steady_clock;

double msSince(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

double timeOfStep(PhysicsWorld& io_world) { return timeOf([&] { io_world.step(); }); }

/// The scene whose bodies are just those that move.
Scene asTheWorldHasIt(const Scene& scene, const PhysicsWorld& world) {
    Scene cast = scene;
    for (Object& o : cast.objects)
        if (std::ranges::find(world.bodies(), o.id, &Body::object) == world.bodies().end()) o.mass = o.density = 0;
    return cast;
}

}  // namespace

MotionLedger::MotionLedger(const Scene& scene, Plan plan) : scene_(scene), plan_(plan) {
    plan_.steps = std::max(plan_.steps, 1), plan_.rounds = std::max(plan_.rounds, 1);
    const PhysicsWorld world(scene);
    const Stages called = world.stages();
    const Scene cast = asTheWorldHasIt(scene, world);
    const Tree none;
    for (const Effect& effect : motionEffects()) {
        Calls calls(plan.records);
        effect.calls(effect, cast, none, calls);
        rows_.push_back({.effect = &effect, .called = called.has(effect.stage), .because = calls.found()});
    }
}

/// Composes the worlds of a row: a called stage is left out of the second, another is put into the first.
void MotionLedger::begin() {
    const StagePrice& row = rows_[row_];
    PhysicsWorld with(scene_, row.called ? StageChoice{} : StageChoice::with(row.effect->stage));
    PhysicsWorld without(scene_, StageChoice::without(row.effect->stage));
    trial_.emplace(Trial{with, without, with, without, 0, 0, 0, {}});
}

bool MotionLedger::step() {
    const Clock::time_point start = Clock::now();
    if (row_ == rows_.size()) return false;
    do {
        if (!trial_) begin();
        else stepBoth();
    } while (row_ < rows_.size() && msSince(start) < plan_.slice_ms);
    return row_ < rows_.size();
}

void MotionLedger::stepBoth() {
    Trial& t = *trial_;
    if (t.step % 2 == 0) t.with_ms += timeOfStep(t.with), t.without_ms += timeOfStep(t.without);
    else t.without_ms += timeOfStep(t.without), t.with_ms += timeOfStep(t.with);
    if (++t.step == plan_.steps) endRound();
}

void MotionLedger::endRound() {
    Trial& t = *trial_;
    if (t.differences.empty()) compareStates();  // each round's are the same
    StagePrice& row = rows_[row_];
    composed_ms_.push_back((row.called ? t.with_ms : t.without_ms) / plan_.steps);
    t.differences.push_back((t.with_ms - t.without_ms) / plan_.steps);
    if (static_cast<int>(t.differences.size()) < plan_.rounds) {
        t.with = t.with_start, t.without = t.without_start;
        t.with_ms = t.without_ms = 0, t.step = 0;
        return;
    }
    const auto [least, most] = std::ranges::minmax(t.differences);
    row.ms_per_step = median(t.differences), row.ms_least = least, row.ms_most = most;
    ms_per_step_ = median(composed_ms_);
    trial_.reset();
    ++row_;
}

void MotionLedger::compareStates() {
    const Trial& t = *trial_;
    StagePrice& row = rows_[row_];
    if (row.called) row.uses_per_step = static_cast<double>(t.with.counts().used(row.effect->stage)) / plan_.steps;
    row.changes = t.with.stateHash() != t.without.stateHash();
    std::size_t shared = 0;
    for (const Body& a : t.with.bodies()) {
        const auto b = std::ranges::find(t.without.bodies(), a.object, &Body::object);
        if (b == t.without.bodies().end()) continue;
        ++shared;
        row.moved_m = std::max(row.moved_m, glm::length(a.position - b->position));
    }
    row.lost = t.with.bodies().size() + t.without.bodies().size() - 2 * shared;
}

double MotionLedger::progress() const {
    const double round = trial_ ? static_cast<double>(trial_->differences.size()) + static_cast<double>(trial_->step) / plan_.steps : 0;
    return (static_cast<double>(row_) + round / plan_.rounds) / static_cast<double>(rows_.size());
}

}  // namespace mb
