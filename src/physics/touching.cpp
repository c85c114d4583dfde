// Which bodies touch at the start of a part, or will within it.
#include "core/effects/effect.h"
#include "physics/world.h"

#include <glm/geometric.hpp>

namespace mb {

/// Contacts at the start of a part of length h; the pairs behind the static ones. Of those that are met in flight, only what touches
/// now; of the others also what lies ahead.
std::span<Contact> PhysicsWorld::touching(double h) {
    std::vector<Contact>& contacts = scratch_.found;
    contacts.clear();
    memory_.begin();
    if (has(Stage::static_contacts)) touchStatics(contacts, h);
    if (has(Stage::broad_phase)) touchBodies(contacts, h);
    return contacts;
}

void PhysicsWorld::touchStatics(std::vector<Contact>& io_contacts, double h) {
    const FlightRules rules = rulesFor(h);
    const Collider collider(world_, field_, counts_, &memory_);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& b = bodies_[i];
        if (!b.awake) {
            memory_.keep(b.object.value, 0);
            continue;
        }
        const double travel = travelOf(b, rules);
        const bool flown = metInFlight(b, rules, travel);
        const double ahead = restDepth(b.inner) + (flown ? 0 : travel);
        const double margin = b.isBall() ? std::min(ahead, kNear * b.radius) : ahead;
        if (choice_.proofs && near_[i].roomAt(b.position, b.radius) > margin) continue;
        const std::size_t before = io_contacts.size();
        collider.withStatics(static_cast<int>(i), b, b.pose(), margin, near_[i], io_contacts);
        for (std::size_t k = before; k < io_contacts.size(); ++k) io_contacts[k].flown = flown;
    }
}

/// How far around its centre a body may come to be within a time, against bodies that drift, m.
Reach PhysicsWorld::reachOf(std::size_t i, glm::dvec3 drift, double pull, double time) const {
    const Body& b = bodies_[i];
    const double fastest = glm::length(b.velocity - drift) + turningSpeed(b) + std::max(pull, std::fabs(world_.gravity)) * time;
    return {b.position, b.radius + restDepth(b.inner) + fastest * time};
}

/// Sees to it that the list of pairs holds through the part. What is found anew is good for some
/// steps, unless something is made faster.
/// `accelerations`: of the bodies, if they are known.
void PhysicsWorld::coverPairs(double h, std::span<const Motion> accelerations) {
    const auto needs = [&](std::size_t i) {
        return reachOf(i, pairs_.drift(), accelerations.empty() ? 0 : glm::length(accelerations[i].velocity), h);
    };
    if (pairs_.holds(bodies_.size(), needs)) return;
    constexpr double kMore = 0.05, kAhead = 4;  // of the radius; steps
    glm::dvec3 drift{0};
    for (const Body& b : bodies_) drift += b.velocity / static_cast<double>(bodies_.size());
    std::vector<Reach> reach;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const double pull = accelerations.empty() ? 0 : glm::length(accelerations[i].velocity);
        reach.push_back(reachOf(i, drift, pull, kAhead * knobs_.dt));
        reach.back().reach += kMore * bodies_[i].radius;
    }
    pairs_.find(std::move(reach), drift);
    ++counts_.broad_phases, counts_.pairs += pairs_.pairs().size();
}

void PhysicsWorld::touchBodies(std::vector<Contact>& io_contacts, double h) {
    coverPairs(h);
    if (!has(Stage::body_contacts)) return;
    const FlightRules rules = rulesFor(h);
    std::vector<Reach> reach(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& b = bodies_[i];
        reach[i] = {b.position, b.radius + restDepth(b.inner) + (b.awake ? travelOf(b, rules) : 0)};
    }
    const Collider collider(world_, field_, counts_, &memory_);
    for (const auto& [i, j] : pairs_.pairs()) {
        const auto k = static_cast<std::size_t>(i), l = static_cast<std::size_t>(j);
        const glm::dvec3 apart = reach[k].centre - reach[l].centre;
        const double most = reach[k].reach + reach[l].reach;
        if (glm::dot(apart, apart) > most * most) continue;
        const Body &a = bodies_[k], &b = bodies_[l];
        const double travel = travelBetween(a, b, rules);
        const bool flown = metInFlight(a, b, rules, travel);
        const double margin = restDepth(std::min(a.inner, b.inner)) + (flown ? 0 : travel);
        const std::size_t before = io_contacts.size();
        collider.between(i, a, a.pose(), j, b, b.pose(), margin, io_contacts);
        for (std::size_t n = before; n < io_contacts.size(); ++n) io_contacts[n].flown = flown;
    }
}

}  // namespace mb
