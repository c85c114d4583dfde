// Contacts that last: what holds a resting ball up, makes a rolling one roll, and puts a still one to sleep.
//
// A resting contact's impulse over a part of length h is found with its normal where the ball will be half-way through:
// the mean of the velocities before and after shall not approach. That is the implicit midpoint rule: the mean velocity
// moves the ball along a chord of a curved surface, whose ends both lie on it, and the normal impulse does no work
// (Hairer, Lubich, Wanner, "Geometric Numerical Integration", 2006, section IV.1). With the normal at the start instead, a
// ball in a bowl would gain energy at every part.
#include "core/effects/effect.h"
#include "physics/world.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <numeric>

namespace mb {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Contact staticContact(const World& world, std::span<const Body> bodies, int a, const Touch& touch) {
    return {a, kStatic, touch.normal, touch.gap, pairing(world, bodies[at(a)]), 0, {}, 0, {}};
}

double depthOf(std::span<const Body> bodies, const Contact& c) {
    const double a = restDepth(bodies[at(c.a)].radius);
    return c.b == kStatic ? a : std::min(a, restDepth(bodies[at(c.b)].radius));
}

}  // namespace

/// Contacts of balls that touch now and do not approach faster than what bounces; the pairs behind the static ones.
std::vector<Contact> PhysicsWorld::touching() {
    std::vector<Contact> contacts;
    if (has(Stage::static_contacts)) touchStatics(contacts);
    if (has(Stage::broad_phase)) touchBodies(contacts);
    return contacts;
}

void PhysicsWorld::touchStatics(std::vector<Contact>& io_contacts) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& b = bodies_[i];
        if (!b.awake || (choice_.proofs && near_[i].roomAt(b.position, b.radius) > restDepth(b.radius))) continue;
        near_[i].moveTo(field_, b.position, b.radius, counts_);
        for (const Touch& touch : near_[i].touches()) {
            if (touch.gap > restDepth(b.radius)) continue;
            ++counts_.static_contacts;
            io_contacts.push_back(staticContact(world_, bodies_, static_cast<int>(i), touch));
        }
    }
}

void PhysicsWorld::touchBodies(std::vector<Contact>& io_contacts) {
    std::vector<Reach> reach(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) reach[i] = {bodies_[i].position, bodies_[i].radius + restDepth(bodies_[i].radius)};
    const std::vector<std::pair<int, int>> pairs = overlappingPairs(reach);
    ++counts_.broad_phases, counts_.pairs += pairs.size();
    if (!has(Stage::body_contacts)) return;
    for (const auto& [i, j] : pairs) {
        const Body &a = bodies_[at(i)], &b = bodies_[at(j)];
        const double gap = glm::length(a.position - b.position) - a.radius - b.radius;
        ++counts_.body_gaps;
        if (gap > restDepth(std::min(a.radius, b.radius))) continue;
        ++counts_.body_contacts;
        io_contacts.push_back({i, j, directionApart(a, b), gap, pairing(world_, a, b), 0, {}, 0, {}});
    }
}

/// Balls that touch sleep and wake together: an island sleeps when each of its balls has been still for long enough.
void PhysicsWorld::wakeAndSleep(std::span<const Contact> contacts) {
    ++counts_.islands;
    std::vector<int> island(bodies_.size());
    std::iota(island.begin(), island.end(), 0);
    const auto root = [&](int i) {
        while (island[at(i)] != i) i = island[at(i)] = island[at(island[at(i)])];
        return i;
    };
    for (const Contact& c : contacts) {
        if (c.b == kStatic) continue;
        const int a = root(c.a), b = root(c.b);
        island[at(std::max(a, b))] = std::min(a, b);
    }
    const int long_enough = static_cast<int>(std::ceil(kStillTime / (knobs_.dt / knobs_.substeps)));
    std::vector<char> restless(bodies_.size(), 0);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (bodies_[i].still < long_enough) restless[at(root(static_cast<int>(i)))] = 1;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        Body& b = bodies_[i];
        b.awake = restless[at(root(static_cast<int>(i)))];
        if (!b.awake) b.velocity = {}, b.spin = {};
    }
}

/// Moves overlapping balls apart, without giving them velocity, the share `push_out` of the overlap a part and not faster than
/// kPushOutSpeed (the split impulses of Catto, "Modeling and Solving Constraints", 2009, as displacements).
void PhysicsWorld::pushApart(std::span<const Contact> contacts, double h) {
    std::vector<glm::dvec3> moved(bodies_.size(), glm::dvec3{0});
    bool any = false;
    for (int round = 0; round < knobs_.iterations; ++round) {
        for (const Contact& c : contacts) {
            if (!bodies_[at(c.a)].awake) continue;
            const bool pair = c.b != kStatic;
            const glm::dvec3 apart = moved[at(c.a)] - (pair ? moved[at(c.b)] : glm::dvec3{0});
            const double deep = -c.gap - 0.5 * depthOf(bodies_, c), left = knobs_.push_out * deep - glm::dot(apart, c.normal);
            if (deep <= 0 || left <= 0) continue;
            const double ma = bodies_[at(c.a)].inverse_mass, mb = pair ? bodies_[at(c.b)].inverse_mass : 0;
            moved[at(c.a)] += (left * ma / (ma + mb)) * c.normal;
            if (pair) moved[at(c.b)] -= (left * mb / (ma + mb)) * c.normal;
            any = true;
        }
        if (!any) return;
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const double length = glm::length(moved[i]), most = std::min(kPushOutSpeed * h, 0.25 * bodies_[i].radius);
        if (length > 0) bodies_[i].position += moved[i] * (length > most ? most / length : 1.0);
    }
}

/// Ends the approaches too slow to bounce, all at once and without restitution.
void PhysicsWorld::stopSlowApproaches(std::span<Contact> contacts) {
    std::vector<Motion> motion(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) motion[i] = {bodies_[i].velocity, bodies_[i].spin};
    bool any = false;
    for (const Contact& c : contacts) {
        const glm::dvec3 v = relativeVelocity(bodies_, motion[at(c.a)], c.b == kStatic ? nullptr : &motion[at(c.b)], c, has(Stage::spin));
        any = any || glm::dot(v, c.normal) < -1e-12;
    }
    if (!any) return;
    solve(bodies_, contacts, motion, 4 * knobs_.iterations, stages_, counts_);
    for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].velocity = motion[i].velocity, bodies_[i].spin = motion[i].spin;
}

/// The same contacts with the normals they will have half-way through the part; those that will have parted are left out.
std::vector<Contact> PhysicsWorld::atMidway(std::span<const Contact> contacts, double h) {
    std::vector<Contact> midway;
    std::vector<Touch> touches;
    int of = -1;
    for (const Contact& c : contacts) {
        const Body& a = bodies_[at(c.a)];
        const glm::dvec3 x = a.position + (0.5 * h) * a.velocity;
        Contact m{c.a, c.b, c.normal, c.gap, c.pairing, 0, {}, 0, {}};
        if (c.b != kStatic) {
            const Body& b = bodies_[at(c.b)];
            const glm::dvec3 apart = x - b.position - (0.5 * h) * b.velocity;
            if (const double d = glm::length(apart); d > 0.5 * (a.radius + b.radius)) m.normal = apart / d;
            midway.push_back(m);
            continue;
        }
        if (of != c.a) {
            field_.touches(x, a.radius, kNear * a.radius, touches), of = c.a;
            ++counts_.static_queries;
        }
        const Touch* best = nullptr;
        for (const Touch& t : touches)
            if (!best || glm::dot(t.normal, c.normal) > glm::dot(best->normal, c.normal)) best = &t;
        if (!best || glm::dot(best->normal, c.normal) < 0.7 || best->gap > restDepth(a.radius)) continue;
        m.normal = best->normal;
        midway.push_back(m);
    }
    return midway;
}

/// What the velocities after the part shall be: in mean no approach; no slip, unless it would turn round on the way: then
/// the mean slip is none, so that friction never does work on the ball.
void PhysicsWorld::setTargets(std::span<Contact> contacts, double h) const {
    const glm::dvec3 fall{0, -world_.gravity * h, 0};
    for (Contact& c : contacts) {
        const Body& a = bodies_[at(c.a)];
        const Motion before{a.velocity, a.spin};
        const Motion other = c.b == kStatic ? Motion{} : Motion{bodies_[at(c.b)].velocity, bodies_[at(c.b)].spin};
        const glm::dvec3 v = relativeVelocity(bodies_, before, c.b == kStatic ? nullptr : &other, c, has(Stage::spin));
        const double away = glm::dot(v, c.normal);
        c.target = -away;
        if (!has(Stage::friction)) continue;
        const glm::dvec3 slip = v - away * c.normal;
        const glm::dvec3 pulled = c.b == kStatic ? fall - glm::dot(fall, c.normal) * c.normal : glm::dvec3{0};
        c.slip = glm::dot(slip, slip + pulled) < 0 ? -slip : glm::dvec3{0};
    }
}

void PhysicsWorld::takeKept(std::span<Contact> contacts) const {
    for (Contact& c : contacts) {
        const std::uint32_t a = bodies_[at(c.a)].object.value, b = c.b == kStatic ? 0 : bodies_[at(c.b)].object.value;
        auto k = std::lower_bound(kept_.begin(), kept_.end(), std::pair{a, b},
                                  [](const Kept& x, const std::pair<std::uint32_t, std::uint32_t>& y) { return std::pair{x.a, x.b} < y; });
        for (; k != kept_.end() && k->a == a && k->b == b; ++k) {
            if (glm::dot(k->normal, c.normal) < 0.98) continue;
            c.push = k->push;
            if (c.pairing.friction != 0) c.drag = k->drag - glm::dot(k->drag, c.normal) * c.normal;
            break;
        }
    }
}

void PhysicsWorld::keep(std::span<const Contact> contacts) {
    kept_.clear();
    for (const Contact& c : contacts)
        if (c.push > 0)
            kept_.push_back({bodies_[at(c.a)].object.value, c.b == kStatic ? 0 : bodies_[at(c.b)].object.value, c.normal, c.push, c.drag});
    std::stable_sort(kept_.begin(), kept_.end(), [](const Kept& x, const Kept& y) { return std::pair{x.a, x.b} < std::pair{y.a, y.b}; });
}

/// Gravity's acceleration of every ball.
std::vector<Motion> PhysicsWorld::falling() const {
    std::vector<Motion> accelerations(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (bodies_[i].awake) accelerations[i].velocity = {0, -world_.gravity, 0};
    return accelerations;
}

/// Adds what the contacts a ball rests on do to it through the part. Of a ball that nothing carries the acceleration stays
/// gravity itself: the quotient would round it.
void PhysicsWorld::carry(std::span<const Contact> contacts, double h, std::span<Motion> io_accelerations) {
    std::vector<Contact> midway = atMidway(contacts, h);
    setTargets(midway, h);
    takeKept(midway);
    std::vector<Motion> after(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (bodies_[i].awake) after[i] = {bodies_[i].velocity + glm::dvec3{0, -world_.gravity * h, 0}, bodies_[i].spin};
    std::vector<char> carried(bodies_.size(), 0);
    for (const Contact& c : midway) {
        carried[at(c.a)] = 1;
        if (c.b != kStatic) carried[at(c.b)] = 1;
    }
    solve(bodies_, midway, after, knobs_.iterations, stages_, counts_);
    keep(midway);
    contacts_ = static_cast<int>(std::count_if(midway.begin(), midway.end(), [](const Contact& c) { return c.push > 0; }));

    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (!bodies_[i].awake || !carried[i]) continue;
        io_accelerations[i] = {(after[i].velocity - bodies_[i].velocity) / h, (after[i].spin - bodies_[i].spin) / h};
    }
}

/// Counts for how long each ball that touches something has been still: slower than `sleep_speed`; without gravity only rest
/// itself is.
void PhysicsWorld::countStill(std::span<const Contact> contacts, double h) {
    std::vector<char> touches(bodies_.size(), world_.gravity == 0), deep(bodies_.size(), 0);
    for (const Contact& c : contacts) {
        const bool overlaps = c.gap < -2 * depthOf(bodies_, c);
        touches[at(c.a)] = 1, deep[at(c.a)] |= overlaps;
        if (c.b != kStatic) touches[at(c.b)] = 1, deep[at(c.b)] |= overlaps;
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
