// Balls that lie on one another. How exact the path of one of them is matters less than that all keep apart, for one pass over
// the contacts a part: the velocities at the end of the part are those the balls move with through it (the semi-implicit Euler
// rule), so that no contact comes nearer than its gap is.
#include "core/effects/effect.h"
#include "physics/world.h"

namespace mb {
namespace {
std::size_t at(int i) { return static_cast<std::size_t>(i); }
}  // namespace

/// Settles each island of balls, which are pushed apart first as any bodies are. `numbers`: of the contacts, island by island.
void PhysicsWorld::settleCrowds(std::span<Contact> contacts, std::span<const std::uint32_t> numbers, double h, std::span<Motion> io_accelerations) {
    if (numbers.empty()) return;
    Scratch& s = scratch_;
    s.motion.assign(bodies_.size() + 1, {}), s.used.assign(bodies_.size(), 0), s.taken.assign(kept_.size(), 0);
    const FlightRules rules = rulesFor(h);
    for (std::size_t begin = 0, end = 0; begin < numbers.size(); begin = end) {
        while (end < numbers.size() && contacts[numbers[end]].island == contacts[numbers[begin]].island) ++end;
        const std::span<const std::uint32_t> island = numbers.subspan(begin, end - begin);
        s.balls.clear();
        for (const std::uint32_t k : island)
            for (const int i : {contacts[k].a, contacts[k].b})
                if (i != kStatic && s.used[at(i)] == 0) s.used[at(i)] = 1, s.balls.push_back(i);
        for (const int i : s.balls) s.used[at(i)] = 0;
        s.crowd.set(bodies_, contacts, island, stages_, s.used);
        pushCrowd(contacts, island, h);
        settleCrowd(contacts, island, rules, io_accelerations);
    }
}

/// As pushApart does, of the crowd that was set.
void PhysicsWorld::pushCrowd(std::span<Contact> contacts, std::span<const std::uint32_t> island, double h) {
    Scratch& s = scratch_;
    bool any = false;
    for (const std::uint32_t k : island) any = aimApart(contacts[k]) || any;
    if (!any) return;
    s.crowd.aim(contacts);
    counts_.rounds += static_cast<std::uint64_t>(s.crowd.solve(s.motion, roundsFor(island.size(), knobs_.iterations), false));
    for (const int i : s.balls) move(bodies_[at(i)], s.motion[at(i)].get(), h);
}

/// A ball that nothing pushes keeps falling, which is exact; the others move at the velocities found, without acceleration.
void PhysicsWorld::settleCrowd(std::span<Contact> contacts, std::span<const std::uint32_t> island, const FlightRules& rules,
                               std::span<Motion> io_accelerations) {
    Scratch& s = scratch_;
    const double h = rules.duration;
    for (const std::uint32_t k : island) {
        Contact& c = contacts[k];
        if (isImpact(c, rules)) {
            c.target = -INFINITY;
            continue;
        }
        c.target = -std::max(c.gap, 0.0) / h;
        takeKept(c, true, s.taken);
    }
    for (const int i : s.balls) s.motion[at(i)].set({bodies_[at(i)].velocity + world_.fall() * h, bodies_[at(i)].spin});
    s.crowd.aim(contacts);
    const int rounds = s.crowd.solve(s.motion, roundsFor(island.size(), knobs_.iterations), has(Stage::friction));
    s.crowd.finish(contacts);
    counts_.rounds += static_cast<std::uint64_t>(rounds);
    for (const std::uint32_t k : island) {
        const Contact& c = contacts[k];
        if (has(Stage::friction) && c.pairing.friction != 0) counts_.drags += static_cast<std::uint64_t>(rounds);
        if (c.push == 0) continue;
        s.used[at(c.a)] = 1;
        if (c.b != kStatic) s.used[at(c.b)] = 1;
    }
    for (const int i : s.balls) {
        if (s.used[at(i)] == 0) continue;
        s.used[at(i)] = 0;
        const Motion m = s.motion[at(i)].get();
        bodies_[at(i)].velocity = m.velocity;
        if (has(Stage::spin)) bodies_[at(i)].spin = m.spin;
        io_accelerations[at(i)] = {};
    }
}

}  // namespace mb
