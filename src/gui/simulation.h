#pragma once
// Time in the editor: what it takes to run the physics beside a picture. Wall time becomes whole steps; what a slow
// machine cannot make is dropped, and said.
#include "physics/world.h"

#include <optional>

namespace mb {

class Simulation {
public:
    static constexpr int kMostSteps = 24;         // at one call of advance()
    static constexpr double kMostSeconds = 0.04;  // of wall time at one call, after the first step

    static constexpr double kThrowSpeed = 6;       // m/s

    bool playing = false;
    std::uint64_t throws = 1;                     // the next throw's seed: the same session throws the same way

    /// Makes as many steps as `seconds` of wall time hold and writes the bodies back; says whether any was made. Where every
    /// body sleeps, time stands still.
    bool advance(Scene& scene, double seconds);
    /// Makes one step.
    void step(Scene& scene);
    void throwAbout(Scene& scene);
    /// The bodies, made from the scene if they are not yet.
    PhysicsWorld& ready(const Scene& scene);
    /// The scene's bodies were changed by hand: the next step starts from the scene as it then is.
    void rebuild() { world_.reset(); }
    void stop() { playing = false, owed_ = 0, steps_ = 0, ratio_ = 1, world_.reset(); }

    std::uint64_t steps() const { return steps_; }
    /// Nothing moves until something wakes a body: a throw, an edit.
    bool asleep() const { return world_ && world_->awake() == 0; }
    /// Simulated seconds a second of wall time: 1, or less where the machine is too slow.
    double ratio() const { return ratio_; }
    const PhysicsWorld* world() const { return world_ ? &*world_ : nullptr; }

private:
    std::optional<PhysicsWorld> world_;
    double owed_ = 0, ratio_ = 1;
    std::uint64_t steps_ = 0;
};

}  // namespace mb
