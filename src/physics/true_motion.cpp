#include "physics/true_motion.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace mb {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::uint64_t visitsOf(const StepCounts& c) {
    return c.evaluations + c.integrations + c.static_queries + c.body_gaps + c.searches + c.rounds + c.drags + c.bounces;
}

/// The same motion whose parts are steps: what happens between them can then be seen.
Scene inParts(Scene scene) {
    scene.physics.dt /= scene.physics.substeps, scene.physics.substeps = 1;
    return scene;
}

}  // namespace

Tracker::Tracker(const Scene& scene, double seconds, double every_s) : world_(inParts(scene)), seconds_(seconds) {
    track_.every_s = every_s;
    for (const Body& b : world_.bodies()) track_.bodies.push_back(b.object), last_.push_back(b.position);
    energy_ = world_.energy(), track_.deepest = world_.maxPenetration();
    note(1);
}

/// Calls visit(number, body) for those that are left, by their number at the start: the world keeps their order.
template <class F> void Tracker::eachBody(F visit) const {
    std::size_t i = 0;
    for (const Body& b : world_.bodies()) {
        while (track_.bodies[i] != b.object) ++i;
        visit(i, b);
    }
}

/// Notes the moment that lies this share of the last step after its beginning.
void Tracker::note(double share) {
    std::vector<glm::dvec3> places(track_.bodies.size(), glm::dvec3{kNan});
    eachBody([&](std::size_t i, const Body& b) { places[i] = share == 1 ? b.position : last_[i] + share * (b.position - last_[i]); });
    track_.places.push_back(std::move(places));
    track_.energy.push_back(energy_.total()), track_.kinetic.push_back(energy_.kinetic);
    track_.lost = world_.removed() + static_cast<int>(world_.frozen().size());
    track_.visits = visitsOf(world_.counts());
}

bool Tracker::step() {
    const double before = world_.time_s(), close = 1e-9 * world_.dt_s();
    const auto moments = static_cast<std::size_t>(std::llround(seconds_ / track_.every_s)) + 1;
    if (track_.places.size() >= moments) return false;
    eachBody([&](std::size_t i, const Body& b) { last_[i] = b.position; });
    world_.step();
    energy_ = world_.energy();
    track_.deepest = std::max(track_.deepest, world_.maxPenetration());
    while (track_.places.size() < moments) {
        const double due = static_cast<double>(track_.places.size()) * track_.every_s;
        if (due > world_.time_s() + close) break;
        const double share = (due - before) / world_.dt_s();
        note(share > 1 - 1e-6 ? 1 : share);
    }
    return track_.places.size() < moments;
}

Scene referenceScene(const Scene& scene, int finer) {
    constexpr int kTurns = 100;
    Scene fine = scene;
    fine.physics.dt = std::max(scene.physics.dt / finer, 1e-6);
    fine.physics.iterations = std::max(scene.physics.iterations, kTurns);
    fine.physics.sleep_speed = 0;
    return fine;
}

}  // namespace mb
