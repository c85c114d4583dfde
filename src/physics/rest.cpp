// Bodies that lie on something: what sleeps, how overlaps are undone and approaches ended, and which impulses are kept.
#include "core/effects/effect.h"
#include "physics/world.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <numeric>

namespace mb {
/// Bodies that touch sleep and wake together: an island sleeps when each of them has been still for long enough.
void PhysicsWorld::wakeAndSleep(const Islands& islands) {
    ++counts_.islands;
    const int long_enough = static_cast<int>(std::ceil(kStillTime / (knobs_.dt / knobs_.substeps)));
    std::vector<char> restless(bodies_.size(), 0);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (bodies_[i].still < long_enough) restless[slot(islands.of(static_cast<int>(i)))] = 1;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        Body& b = bodies_[i];
        b.awake = restless[slot(islands.of(static_cast<int>(i)))];
        if (!b.awake) b.velocity = {}, b.spin = {};
    }
}

/// Moves and turns a body by the share of that which a part of length h allows; returns the share.
double PhysicsWorld::move(Body& io_body, const Motion& by, double h) {
    const double length = glm::length(by.velocity) + (io_body.isBall() ? 0 : io_body.radius * glm::length(by.spin));
    if (!io_body.awake || !(length > 0)) return 0;
    const double most = std::min(kPushOutSpeed * h, 0.25 * io_body.inner), share = length > most ? most / length : 1.0;
    io_body.position += share * by.velocity;
    if (!io_body.isBall()) io_body.orientation = turned(io_body.orientation, by.spin, share);
    return share;
}

/// The numbers of the bodies of contacts, each once; `scratch_.motion` has a place for each.
std::span<const int> PhysicsWorld::membersOf(std::span<const Contact> contacts) {
    Scratch& s = scratch_;
    s.motion.resize(bodies_.size()), s.used.resize(bodies_.size(), 0);
    s.members.clear();
    for (const Contact& c : contacts) s.addMembers(c);
    s.unmark();
    return s.members;
}

/// Moves overlapping bodies apart, without giving them velocity, the share `push_out` of the overlap a part and not faster than
/// kPushOutSpeed (the split impulses of Catto, "Modeling and Solving Constraints", 2009, as displacements). The contacts' gaps follow.
void PhysicsWorld::pushApart(std::span<Contact> io_contacts, double h) {
    // The displacements are solved for as velocities are, without friction.
    bool any = false;
    for (Contact& c : io_contacts) c.target = apartOf(c), any = any || c.target > 0;
    if (!any) return;
    const std::span<const int> members = membersOf(io_contacts);
    std::vector<Motion>& moved = scratch_.motion;
    for (const int i : members) moved[slot(i)] = {};
    solve(bodies_, io_contacts, moved, knobs_.iterations, stages_ - Stages{Stage::friction}, counts_);
    for (const int i : members) {
        const double share = move(bodies_[slot(i)], moved[slot(i)], h);
        moved[slot(i)].velocity *= share, moved[slot(i)].spin *= share;
    }
    for (Contact& c : io_contacts) {
        c.push = 0;
        c.gap += glm::dot(relativeVelocity(moved[slot(c.a)], c.b == kStatic ? nullptr : &moved[slot(c.b)], c, has(Stage::spin)), c.normal);
    }
}

/// Ends approaches, all at once: those too slow to bounce; and of what is not met in flight, those that would cross the gap
/// within the part, which part again with the restitution.
void PhysicsWorld::stopApproaches(std::span<Contact> contacts, double h) {
    bool any = false, bounced = false;
    const FlightRules rules = rulesFor(h);
    for (Contact& c : contacts) {
        const double approach = -glm::dot(relativeVelocity(bodies_, c, has(Stage::spin)), c.normal);
        c.target = 0;
        if (!c.flown) {
            const bool bounces = has(Stage::restitution) && c.pairing.restitution > 0 && approach > rules.bounce && c.gap < approach * h;
            if (bounces) ++counts_.bounces, bounced = true;
            c.target = bounces ? c.pairing.restitution * approach : -std::max(c.gap, 0.0) / h;
        }
        any = any || approach > 1e-12 - c.target;
    }
    if (!any) return;
    std::vector<Motion>& motion = scratch_.motion;
    for (const int i : membersOf(contacts)) motion[slot(i)] = motionOf(bodies_[slot(i)]);
    solve(bodies_, contacts, motion, knobs_.iterations, stages_, counts_);
    if (bounced) temperIslands(contacts);
    for (const int i : membersOf(contacts)) bodies_[slot(i)].velocity = motion[slot(i)].velocity, bodies_[slot(i)].spin = motion[slot(i)].spin;
}

/// Of each island where something bounced.
void PhysicsWorld::temperIslands(std::span<const Contact> contacts) {
    for (std::size_t begin = 0, end = 0; begin < contacts.size(); begin = end) {
        while (end < contacts.size() && contacts[end].island == contacts[begin].island) ++end;
        const std::span<const Contact> island = contacts.subspan(begin, end - begin);
        if (std::ranges::none_of(island, [](const Contact& c) { return c.target > 0; })) continue;
        const std::span<const int> members = membersOf(island);
        double energy = 0;
        for (const int i : members) energy += kineticEnergy(bodies_[slot(i)], motionOf(bodies_[slot(i)]));
        temper(bodies_, island, members, energy * (1 + 1e-9), scratch_.motion, knobs_.iterations, stages_, counts_);
    }
}

/// Whether an impulse kept from the last part is this contact's: found from the same point, or at about the same place. Of a ball
/// the normal alone tells.
bool PhysicsWorld::isOf(const Kept& kept, const Contact& c) const {
    if (allBalls() || bodies_[slot(c.a)].isBall()) return glm::dot(kept.normal, c.normal) >= 0.98;
    const bool same_place = glm::length(kept.arm - c.arm_a) <= 0.05 * bodies_[slot(c.a)].radius;
    return (kept.feature == c.feature || same_place) && glm::dot(kept.normal, c.normal) >= 0.9;
}

/// The impulses kept of the contact's pair.
PhysicsWorld::Range PhysicsWorld::keptOf(const Contact& c) const {
    const std::uint32_t b = c.b == kStatic ? 0 : scratch_.ids[slot(c.b)];
    Range range{kept_begin_[slot(c.a)], kept_begin_[slot(c.a) + 1]};
    while (range.begin < range.end && kept_[range.begin].b != b) ++range.begin;
    std::size_t end = range.begin;
    while (end < range.end && kept_[end].b == b) ++end;
    return range.end = end, range;
}

void PhysicsWorld::take(Contact& io_c, std::size_t kept, std::vector<char>& io_taken) const {
    io_taken[kept] = 1, io_c.push += kept_[kept].push, io_c.twist += kept_[kept].twist;
    if (io_c.pairing.friction != 0) io_c.drag += kept_[kept].drag - glm::dot(kept_[kept].drag, io_c.normal) * io_c.normal;
}

void PhysicsWorld::takeKept(Contact& io_c, bool same_feature, std::vector<char>& io_taken) const {
    if (io_c.push > 0) return;
    const Range range = keptOf(io_c);
    for (std::size_t k = range.begin; k < range.end; ++k) {
        if (io_taken[k] || (same_feature && kept_[k].feature != io_c.feature) || !isOf(kept_[k], io_c)) continue;
        return take(io_c, k, io_taken);
    }
}

void PhysicsWorld::takeKept(std::span<Contact> contacts) {
    std::vector<char>& taken = scratch_.taken;
    taken.assign(kept_.size(), 0);
    for (const bool same_feature : {true, false})
        for (Contact& c : contacts) takeKept(c, same_feature, taken);
    // What two shapes' lost points carried, the nearest of those they have now carry.
    for (std::size_t i = 0, end = 0; i < contacts.size(); i = end) {
        for (end = i + 1; end < contacts.size() && contacts[end].a == contacts[i].a && contacts[end].b == contacts[i].b;) ++end;
        if (bodies_[slot(contacts[i].a)].isBall()) continue;
        const Range range = keptOf(contacts[i]);
        for (std::size_t k = range.begin; k < range.end; ++k) {
            if (taken[k]) continue;
            const auto apart = [&](const Contact& c) {
                return glm::dot(kept_[k].normal, c.normal) < 0.9 ? INFINITY : glm::length(c.arm_a - kept_[k].arm);
            };
            Contact& nearest = *std::ranges::min_element(contacts.subspan(i, end - i), {}, apart);
            if (apart(nearest) < INFINITY) take(nearest, k, taken);
        }
    }
}

/// Keeps the impulses of contacts, those with one a together; of one pair in their order. `settled`: numbers among `contacts`.
void PhysicsWorld::keep(std::span<const Contact> carried, std::span<const Contact> contacts, std::span<const std::uint32_t> settled) {
    const auto each = [&](const auto& visit) {
        for (const Contact& c : carried)
            if (c.push > 0) visit(c);
        for (const std::uint32_t k : settled)
            if (contacts[k].push > 0) visit(contacts[k]);
    };
    kept_begin_.assign(bodies_.size() + 1, 0);
    each([&](const Contact& c) { ++kept_begin_[slot(c.a) + 1]; });
    std::partial_sum(kept_begin_.begin(), kept_begin_.end(), kept_begin_.begin());
    kept_.resize(kept_begin_.back());
    std::vector<std::uint32_t> next = kept_begin_;
    each([&](const Contact& c) {
        const std::uint32_t b = c.b == kStatic ? 0 : scratch_.ids[slot(c.b)];
        kept_[next[slot(c.a)]++] = {scratch_.ids[slot(c.a)], b, c.feature, c.normal, c.arm_a, c.push, c.drag, c.twist};
    });
}

/// Finds again where each body's begin, after some were taken out.
void PhysicsWorld::findKept() {
    kept_begin_.assign(bodies_.size() + 1, 0);
    std::size_t k = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        while (k < kept_.size() && kept_[k].a == bodies_[i].object.value) ++k;
        kept_begin_[i + 1] = static_cast<std::uint32_t>(k);
    }
}

/// Gravity's acceleration of every body.
std::vector<Motion> PhysicsWorld::falling() const {
    std::vector<Motion> accelerations(bodies_.size());
    const glm::dvec3 fall = world_.fall();
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (bodies_[i].awake) accelerations[i].velocity = fall;
    return accelerations;
}

/// Names those that have been deep in another for two seconds: pushing out does not part them.
void PhysicsWorld::noteStuck(std::span<const Contact> contacts, double h) {
    constexpr double kDeep = 0.1, kLong = 2;  // of half the thinner thickness; s
    std::vector<const Contact*> deep(bodies_.size(), nullptr);
    for (const Contact& c : contacts)
        if (-c.gap > kDeep * std::min(bodies_[slot(c.a)].inner, c.b == kStatic ? INFINITY : bodies_[slot(c.b)].inner)) deep[slot(c.a)] = &c;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        Body& b = bodies_[i];
        b.stuck = deep[i] ? b.stuck + 1 : 0;
        if (b.stuck != static_cast<int>(std::ceil(kLong / h))) continue;
        const int other = deep[i]->b;
        note(fmt::format("{}: is not parted from {}, in which it has been deep for {} s", b.name, other == kStatic ? "what does not move" : bodies_[slot(other)].name, kLong));
    }
}

/// Counts for how long each body that touches something has been still: slower than `sleep_speed`; without gravity only rest
/// itself is.
void PhysicsWorld::countStill(std::span<const Contact> contacts, double h) {
    std::vector<char> touches(bodies_.size(), world_.gravity == 0), deep(bodies_.size(), 0);
    for (const Contact& c : contacts) {
        const bool touching = c.gap <= c.depth, overlaps = c.gap < -2 * c.depth;
        touches[slot(c.a)] |= touching, deep[slot(c.a)] |= overlaps;
        if (c.b != kStatic) touches[slot(c.b)] |= touching, deep[slot(c.b)] |= overlaps;
    }
    const double limit = std::min(knobs_.sleep_speed, knobs_.sleep_speed / kWeakFall * (std::fabs(world_.gravity) * h));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        Body& b = bodies_[i];
        if (!b.awake) continue;
        const double speed = glm::length(b.velocity) + b.radius * glm::length(b.spin);
        b.still = touches[i] && !deep[i] && speed <= limit && knobs_.sleep_speed > 0 ? b.still + 1 : 0;
    }
}

}  // namespace mb
