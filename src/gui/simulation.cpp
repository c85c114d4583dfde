#include "gui/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace mb {

PhysicsWorld& Simulation::ready(const Scene& scene) {
    if (!world_) world_.emplace(scene);
    return *world_;
}

bool Simulation::advance(Scene& scene, double seconds) {
    if (!playing) return false;
    using Clock = std::chrono::steady_clock;
    const double dt = scene.physics.dt;
    owed_ += std::clamp(seconds, 0.0, 1.0);
    int made = 0;
    const Clock::time_point start = Clock::now();
    const auto late = [&] { return std::chrono::duration<double>(Clock::now() - start).count() > kMostSeconds; };
    ready(scene);
    while (owed_ >= dt && made < kMostSteps && !asleep() && (made == 0 || !late())) {
        world_->step();
        owed_ -= dt, ++made;
    }
    if (asleep()) owed_ = 0;
    // What is left of a step waits for the next call; whole steps that could not be made are dropped.
    const double dropped = owed_ >= dt ? owed_ - std::fmod(owed_, dt) : 0;
    owed_ -= dropped;
    const double reached = made * dt / std::max(made * dt + dropped, 1e-9);
    if (made > 0) ratio_ += 0.2 * (reached - ratio_), steps_ += static_cast<std::uint64_t>(made), world_->writeTo(scene);
    return made > 0;
}

void Simulation::step(Scene& scene) {
    ready(scene).step();
    ++steps_;
    world_->writeTo(scene);
}

void Simulation::throwAbout(Scene& scene) {
    ready(scene).throwAbout(throws++, kThrowSpeed);
    world_->writeTo(scene);
}

}  // namespace mb
