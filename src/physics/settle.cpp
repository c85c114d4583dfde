// Balls that lie on one another. How exact the path of one of them is matters less than that all keep apart, for one pass over
// the contacts a part: the velocities at the end of the part are those the balls move with through it (the semi-implicit Euler
// rule), so that no contact comes nearer than its gap is.
#include "core/effects/effect.h"
#include "physics/world.h"

namespace mb {
/// Settles each island of balls. `numbers`: of the contacts, island by island.
void PhysicsWorld::settleCrowds(std::span<Contact> contacts, std::span<const std::uint32_t> numbers, double h, std::span<Motion> io_accelerations) {
    if (numbers.empty()) return;
    Scratch& s = scratch_;
    s.motions.resize(bodies_.size()), s.used.resize(bodies_.size(), 0), s.taken.assign(kept_.size(), 0), s.apart.resize(contacts.size());
    const FlightRules rules = rulesFor(h);
    for (std::size_t begin = 0, end = 0; begin < numbers.size(); begin = end) {
        while (end < numbers.size() && contacts[numbers[end]].island == contacts[numbers[begin]].island) ++end;
        settleCrowd(contacts, numbers.subspan(begin, end - begin), rules, io_accelerations);
    }
}

/// What a contact of a crowd has to reach: the impulse it begins with, and how far it is to part, which is returned.
double PhysicsWorld::aimCrowd(Contact& io_c, const FlightRules& rules) {
    const double apart = apartOf(io_c);
    if (isImpact(io_c, rules)) io_c.target = -INFINITY;
    else io_c.target = -std::max(io_c.gap, 0.0) / rules.duration, takeKept(io_c, true, scratch_.taken);
    return apart;
}

/// A ball that nothing pushes keeps falling, which is exact; the others move at the velocities found, without acceleration. What
/// overlaps is moved apart in the same rounds, as pushApart does.
void PhysicsWorld::settleCrowd(std::span<Contact> contacts, std::span<const std::uint32_t> island, const FlightRules& rules,
                               std::span<Motion> io_accelerations) {
    Scratch& s = scratch_;
    const double h = rules.duration;
    bool parts = false;
    std::uint64_t rough = 0;
    s.members.clear();
    for (const std::uint32_t k : island) {
        Contact& c = contacts[k];
        s.apart[k] = aimCrowd(c, rules), parts = parts || s.apart[k] > 0, rough += c.pairing.friction != 0;
        s.addMembers(c);
    }
    const glm::dvec3 fall = world_.fall() * h;
    for (const int i : s.members) s.motions.now[slot(i)].set(bodies_[slot(i)], {bodies_[slot(i)].velocity + fall, bodies_[slot(i)].spin}, has(Stage::spin));
    s.unmark();
    s.crowd.set(s.motions, contacts, island, s.apart, s.used);
    s.unmark();
    const int rounds = s.crowd.solve(s.members, s.motions, roundsFor(island.size(), knobs_.iterations), has(Stage::friction), parts);
    counts_.rounds += static_cast<std::uint64_t>(rounds);
    if (has(Stage::friction)) counts_.drags += rough * static_cast<std::uint64_t>(rounds);
    s.crowd.finish(contacts, s.used);
    for (const int i : s.members) {
        Body& b = bodies_[slot(i)];
        if (parts) move(b, {s.motions.now[slot(i)].getApart(), {}}, h);
        if (s.used[slot(i)] == 0) continue;
        const Motion m = s.motions.now[slot(i)].get();
        b.velocity = m.velocity;
        if (has(Stage::spin)) b.spin = m.spin;
        io_accelerations[slot(i)] = {};
    }
    s.unmark();
}

}  // namespace mb
