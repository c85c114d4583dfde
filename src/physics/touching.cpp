// Which bodies touch at the start of a part, or will within it.
#include "core/effects/effect.h"
#include "physics/world.h"

#include <glm/geometric.hpp>

namespace mb {

/// Contacts at the start of a part of length h; the pairs behind the static ones. Of those that are met in flight, only what touches
/// now; of the others also what lies ahead.
std::vector<Contact> PhysicsWorld::touching(double h) {
    std::vector<Contact> contacts;
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
        const double ahead = restDepth(b.inner) + (metInFlight(b, rules) ? 0 : travelOf(b, rules));
        const double margin = b.isBall() ? std::min(ahead, kNear * b.radius) : ahead;
        if (choice_.proofs && near_[i].roomAt(b.position, b.radius) > margin) continue;
        collider.withStatics(static_cast<int>(i), b, b.pose(), margin, near_[i], io_contacts);
    }
}

void PhysicsWorld::touchBodies(std::vector<Contact>& io_contacts, double h) {
    const FlightRules rules = rulesFor(h);
    std::vector<double> travel(bodies_.size());
    std::vector<Reach> reach(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& b = bodies_[i];
        travel[i] = b.awake ? travelOf(b, rules) : 0;
        reach[i] = {b.position, b.radius + restDepth(b.inner) + travel[i]};
    }
    const std::vector<std::pair<int, int>> pairs = overlappingPairs(reach);
    ++counts_.broad_phases, counts_.pairs += pairs.size();
    if (!has(Stage::body_contacts)) return;
    const Collider collider(world_, field_, counts_, &memory_);
    for (const auto& [i, j] : pairs) {
        const auto k = static_cast<std::size_t>(i), l = static_cast<std::size_t>(j);
        const Body &a = bodies_[k], &b = bodies_[l];
        if (!a.isBall() || !b.isBall()) {
            if (glm::length(a.position - b.position) > reach[k].reach + reach[l].reach) continue;
        }
        const double margin = restDepth(std::min(a.inner, b.inner)) + (metInFlight(a, b, rules) ? 0 : travelBetween(a, b, rules));
        collider.between(i, a, a.pose(), j, b, b.pose(), margin, io_contacts);
    }
}

}  // namespace mb
