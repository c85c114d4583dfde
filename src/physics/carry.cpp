// Contacts that last: what holds a resting body up, and makes a rolling one roll.
//
// A resting contact's impulse over a part of length h is found as the contact will be half-way through: the mean of the velocities
// before and after shall not approach there. Of a ball that is the implicit midpoint rule: the mean velocity moves it along a chord
// of a curved surface, whose ends both lie on it, and the normal impulse does no work (Hairer, Lubich, Wanner, "Geometric Numerical
// Integration", 2006, section IV.1). With the normal at the start instead, a ball in a bowl would gain energy at every part. A shape
// turns freely for half the part, is given all impulses at once, and turns on (advance(); the splitting of Strang, "On the
// Construction and Comparison of Difference Schemes", 1968): what they do to its energy is their product with the mean of the
// velocities where it then is, and a coin that rolls on its rim keeps it.
#include "core/effects/effect.h"
#include "core/measure/parallel.h"
#include "physics/rolling.h"
#include "physics/world.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace mb {
namespace {
constexpr double kMoves = 0.01;   // of half the thinner thickness: contacts of shapes that move less in half a part are taken as they are
constexpr double kOnward = 0.3;   // of the radius: how far a contact of shapes may go on in half a part
}  // namespace

/// Moves bodies to where they are half-way through the part if nothing is done to them. Returns what they were.
std::vector<PhysicsWorld::Moment> PhysicsWorld::goMidway(std::span<const int> members, double h) {
    std::vector<Moment> before;
    for (const int i : members) {
        Body& b = bodies_[slot(i)];
        before.push_back({i, b.position, b.orientation, b.spin});
        b.position += (0.5 * h) * b.velocity;
        if (!b.isBall() && has(Stage::spin)) turnFreely(b, b.orientation, b.spin, 0.5 * h);
    }
    return before;
}

void PhysicsWorld::goBack(std::span<const Moment> before) {
    for (const Moment& m : before) {
        Body& b = bodies_[slot(m.body)];
        b.position = m.position, b.orientation = m.orientation, b.spin = m.spin;
    }
}

/// Of balls, the same contacts with the normals they have midway; those that will have parted are left out.
void PhysicsWorld::ballsMidway(std::span<const Contact> start, std::vector<Contact>& io_midway) {
    const Body& a = bodies_[slot(start[0].a)];
    std::vector<Touch> touches;
    if (start[0].b == kStatic) {
        field_.touches(a.position, a.radius, kNear * a.radius, touches);
        ++counts_.static_queries;
    }
    for (const Contact& c : start) {
        Contact m = c;
        if (c.b != kStatic) {
            const Body& b = bodies_[slot(c.b)];
            const glm::dvec3 apart = a.position - b.position;
            if (const double d = glm::length(apart); d > 0.5 * (a.radius + b.radius)) m.normal = apart / d;
            m.arm_b = b.radius * m.normal;
        } else {
            const Touch* best = nullptr;
            for (const Touch& t : touches)
                if (!best || glm::dot(t.normal, c.normal) > glm::dot(best->normal, c.normal)) best = &t;
            if (!best || glm::dot(best->normal, c.normal) < 0.7 || (c.flown && best->gap > restDepth(a.radius))) continue;
            m.normal = best->normal;
        }
        m.arm_a = -a.radius * m.normal;
        io_midway.push_back(m);
    }
}

/// How far a pair's surfaces may get against one another in half a part, m.
double PhysicsWorld::halfTravelOf(const Contact& c, double h) const {
    const FlightRules half = rulesFor(0.5 * h);
    const Body& a = bodies_[slot(c.a)];
    return c.b == kStatic ? travelOf(a, half) : travelBetween(a, bodies_[slot(c.b)], half);
}

/// Whether the contacts of a pair of which one is a shape are other ones midway.
bool PhysicsWorld::movesOn(std::span<const Contact> start, double h) const {
    const Contact& c = start[0];
    if (betweenBalls(bodies_, c) || std::ranges::any_of(start, &Contact::way_out)) return false;
    const double inner = bodies_[slot(c.a)].inner;
    return halfTravelOf(c, h) > kMoves * (c.b == kStatic ? inner : std::min(inner, bodies_[slot(c.b)].inner));
}

/// Those contacts, found where the two are midway: as far as gravity alone would close them again, and of what is not met in flight as
/// far as they may get until the end of the part. Of `start` those that go on there: the same gap is aimed at.
void PhysicsWorld::findMidway(std::span<const Contact> start, double h, std::vector<Contact>& io_midway, StepCounts& io_counts) const {
    const Contact& c = start[0];
    const Body &a = bodies_[slot(c.a)], *b = c.b == kStatic ? nullptr : &bodies_[slot(c.b)];
    const Collider collider(world_, field_, io_counts);
    const double margin = c.depth + 0.5 * h * bounceSpeed(h) + (c.flown ? 0 : halfTravelOf(c, h));
    NearStatics unused;
    const std::size_t before = io_midway.size();
    if (b) collider.between(c.a, a, a.shapePose(), c.b, *b, b->shapePose(), margin, io_midway);
    else collider.withStatics(c.a, a, a.shapePose(), margin, unused, io_midway);
    for (Contact& m : std::span(io_midway).subspan(before)) {
        m.island = c.island, m.flown = c.flown;
        double nearest = kOnward * a.radius;
        const Contact* same = nullptr;
        for (const Contact& s : start) {
            const double apart = glm::length(s.arm_a - m.arm_a);
            if (apart < nearest && glm::dot(s.normal, m.normal) > 0.9) nearest = apart, same = &s;
        }
        const glm::dvec3 v = relativeVelocity(bodies_, m, has(Stage::spin));
        const double away = glm::dot(v, m.normal), risen = m.gap - (same ? std::min(same->gap, 0.0) : 0);
        m.target = std::min(-away, -2 * risen / h);
        if (!same) m.target = std::min(m.target, 0.0);
        const glm::dvec3 slip = v - away * m.normal;
        if (same && glm::length(same->slip) < 0.5 * glm::length(slip)) m.slip = -slip;
    }
}

/// The contacts at the start, with their slips there, as they are midway, with what is aimed at: in mean no approach beyond the gap there
/// is. For a ball's friction no slip, unless it would turn round on the way: then the mean slip is none, so that friction never does work
/// on the ball; and so of a shape that rolls.
std::vector<Contact> PhysicsWorld::atMidway(std::span<const Contact> contacts, double h) {
    struct Pair {
        std::span<const Contact> start;
        bool moves_on = false;
        std::vector<Contact> found = {};
        StepCounts counts = {};
    };
    std::vector<Pair> pairs;
    std::vector<std::size_t> searched;
    for (std::size_t begin = 0, end = 0; begin < contacts.size(); begin = end) {
        for (; end < contacts.size() && contacts[end].a == contacts[begin].a && contacts[end].b == contacts[begin].b;) ++end;
        Pair pair{contacts.subspan(begin, end - begin)};
        if (pair.moves_on = movesOn(pair.start, h); pair.moves_on) searched.push_back(pairs.size());
        pairs.push_back(std::move(pair));
    }
    constexpr std::size_t kWorthThreads = 8;
    inParallel(searched.size() < kWorthThreads ? 1 : threads_, searched.size(), [&](std::size_t k, bool) {
        Pair& pair = pairs[searched[k]];
        findMidway(pair.start, h, pair.found, pair.counts);
    });
    std::vector<Contact> midway;
    for (Pair& pair : pairs) {
        counts_.add(pair.counts);
        if (pair.moves_on) {
            midway.insert(midway.end(), pair.found.begin(), pair.found.end());
            continue;
        }
        const std::size_t before = midway.size();
        if (betweenBalls(bodies_, pair.start[0])) ballsMidway(pair.start, midway);
        else midway.insert(midway.end(), pair.start.begin(), pair.start.end());
        for (Contact& c : std::span(midway).subspan(before)) c.push = 0, c.drag = {}, c.twist = 0, c.slip = {}, aim(c, h);
    }
    return midway;
}

/// Sets what a contact that is the same midway aims at.
void PhysicsWorld::aim(Contact& io_c, double h) const {
    const glm::dvec3 v = relativeVelocity(bodies_, io_c, has(Stage::spin));
    const double away = glm::dot(v, io_c.normal);
    if (!betweenBalls(bodies_, io_c)) {
        io_c.target = -2 * std::max(io_c.gap, 0.0) / h - std::max(away, 0.0);
        return;
    }
    io_c.target = -away - (io_c.flown ? 0 : 2 * std::max(io_c.gap, 0.0) / h);
    if (!has(Stage::friction)) return;
    const glm::dvec3 slip = v - away * io_c.normal, fall = world_.fall() * h;
    const glm::dvec3 pulled = io_c.b == kStatic ? fall - glm::dot(fall, io_c.normal) * io_c.normal : glm::dvec3{0};
    io_c.slip = glm::dot(slip, slip + pulled) < 0 ? -slip : glm::dvec3{0};
}

/// Adds what the contacts a body rests on do to it through the part, and returns them with their impulses. Of a body that nothing
/// pushes the acceleration stays gravity itself: the quotient would round it, and what is given no spin turns at once, not by halves.
std::vector<Contact> PhysicsWorld::carry(std::span<Contact> contacts, double h, std::span<Motion> io_accelerations) {
    for (Contact& c : contacts) {
        const glm::dvec3 v = relativeVelocity(bodies_, c, has(Stage::spin));
        c.slip = v - glm::dot(v, c.normal) * c.normal;
    }
    const std::vector<Moment> start = goMidway(membersOf(contacts), h);
    std::vector<Contact> midway = atMidway(contacts, h);
    takeKept(midway);
    const std::span<const int> members = membersOf(midway);
    std::vector<Motion>& after = scratch_.motion;
    for (const int i : members) after[slot(i)] = {bodies_[slot(i)].velocity + world_.fall() * h, bodies_[slot(i)].spin};
    solveResisting(bodies_, midway, after, knobs_.iterations, stages_, counts_);
    for (const Contact& c : midway)
        for (const int i : {c.a, c.b}) {
            if (c.push == 0 || i == kStatic) continue;
            const Body& b = bodies_[slot(i)];
            io_accelerations[slot(i)] = {(after[slot(i)].velocity - b.velocity) / h, (after[slot(i)].spin - b.spin) / h};
        }
    goBack(start);
    return midway;
}

}  // namespace mb
