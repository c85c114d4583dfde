// What happens at the moment two things meet.
#include "core/effects/effect.h"
#include "physics/flight.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace mb {
namespace {
constexpr int kImpactRounds = 15;

/// Of the contacts from `first` on keeps those nearer than the depth; if there are none, and `any`, those as near as the nearest: what
/// is met suddenly, as a corner that comes round an edge, is met a little before. They were looked for as the search for the impact
/// looked, so that what it found is among them.
void dropApart(std::vector<Contact>& io_contacts, std::size_t first, double depth, bool any) {
    const auto begin = io_contacts.begin() + static_cast<std::ptrdiff_t>(first);
    if (begin == io_contacts.end()) return;
    const double nearest = std::min_element(begin, io_contacts.end(), [](const Contact& a, const Contact& b) { return a.gap < b.gap; })->gap;
    const double most = any && nearest > depth ? nearest + depth : depth;
    io_contacts.erase(std::remove_if(begin, io_contacts.end(), [&](const Contact& c) { return c.gap > most; }), io_contacts.end());
}
}  // namespace

void Flight::addStaticContacts(int i, bool alone, std::vector<Contact>& io_contacts) {
    const Body& body = bodies_[static_cast<std::size_t>(i)];
    NearStatics& near = near_[static_cast<std::size_t>(i)];
    if (rules_.proofs && near.roomAt(body.position, body.radius) > restDepth(body.inner)) return;
    const std::size_t before = io_contacts.size();
    collider_.withStatics(i, body, body.shapePose(), kNear * body.inner, near, io_contacts);
    dropApart(io_contacts, before, restDepth(body.inner), alone && !body.isBall());
}

/// The contacts of one or two bodies at this moment: between the two, and with what does not move.
std::vector<Contact> Flight::contactsOf(int a, int b) {
    std::vector<Contact> contacts;
    if (has(Stage::static_contacts))
        for (const int i : {a, b})
            if (i != kStatic) addStaticContacts(i, b == kStatic, contacts);
    if (b == kStatic) return contacts;
    const Body &x = bodies_[static_cast<std::size_t>(a)], &y = bodies_[static_cast<std::size_t>(b)];
    const double inner = std::min(x.inner, y.inner);
    const std::size_t before = contacts.size();
    // That balls meet is known; their gap is 0 but for rounding.
    const bool balls = x.isBall() && y.isBall();
    collider_.between(a, x, x.shapePose(), b, y, y.shapePose(), balls ? INFINITY : kNear * inner, contacts);
    if (!balls) dropApart(contacts, before, restDepth(inner), true);
    return contacts;
}

double Flight::energyOf(int i) const {
    if (i == kStatic) return 0;
    return kineticEnergy(bodies_[static_cast<std::size_t>(i)], motion_[static_cast<std::size_t>(i)]);
}

/// Newton's law of impact at every contact at once, with Coulomb's friction. No energy is made: where several contacts with
/// restitution would make some together, only the hardest counts now, and the others are met next; where that one makes some still, its
/// restitution is less. Says whether an approach was fast.
bool Flight::bounceApart(std::vector<Contact>& contacts, int a, int b) {
    const auto load = [&](int i) {
        if (i != kStatic) motion_[static_cast<std::size_t>(i)] = motionOf(bodies_[static_cast<std::size_t>(i)]);
    };
    load(a), load(b);
    const double before = energyOf(a) + energyOf(b);
    double fastest = rules_.bounce;
    std::size_t hardest = contacts.size();
    for (Contact& c : contacts) {
        const double approach = -glm::dot(relativeVelocity(bodies_, c, has(Stage::spin)), c.normal);
        if (has(Stage::restitution) && approach > rules_.bounce) ++counts_.bounces, c.target = c.pairing.restitution * approach;
        if (approach > fastest) fastest = approach, hardest = static_cast<std::size_t>(&c - contacts.data());
    }
    const bool fast = hardest < contacts.size();
    solve(bodies_, contacts, motion_, kImpactRounds, rules_.stages, counts_);
    const double most = before * (1 + 1e-9);  // more than the rounds leave unsolved
    if (fast && energyOf(a) + energyOf(b) > most) {
        load(a), load(b);
        Contact alone = contacts[hardest];
        alone.push = 0, alone.drag = {}, alone.twist = 0;
        solve(bodies_, {&alone, 1}, motion_, kImpactRounds, rules_.stages, counts_);
        const std::array both{a, b};
        temper(bodies_, {&alone, 1}, std::span(both).first(b == kStatic ? 1 : 2), most, motion_, kImpactRounds, rules_.stages, counts_);
    }
    for (const int i : {a, b}) {
        if (i == kStatic) continue;
        bodies_[static_cast<std::size_t>(i)].velocity = motion_[static_cast<std::size_t>(i)].velocity;
        bodies_[static_cast<std::size_t>(i)].spin = motion_[static_cast<std::size_t>(i)].spin;
    }
    return fast;
}

/// The acceleration of the point that touches: of a ball that rolls, its centre's.
glm::dvec3 Flight::accelerationAt(std::size_t i, const glm::dvec3& arm) const {
    const Body& b = bodies_[i];
    if (b.isBall() || !has(Stage::spin)) return paths_[i].acceleration;
    return paths_[i].acceleration + glm::cross(paths_[i].turning, arm) + glm::cross(b.spin, glm::cross(b.spin, arm));
}

/// Adds a force at an arm to the accelerations, N.
void Flight::bear(std::size_t i, const glm::dvec3& arm, const glm::dvec3& force) {
    const Body& b = bodies_[i];
    paths_[i].acceleration += b.inverse_mass * force;
    if (!b.isBall() && has(Stage::spin)) paths_[i].turning += b.worldInverseInertia() * glm::cross(arm, force);
}
/// By how much a force of 1 N along the normal changes the point's acceleration along it.
double Flight::yieldOf(std::size_t i, const glm::dvec3& arm, const glm::dvec3& normal) const {
    const Body& b = bodies_[i];
    if (b.isBall() || !has(Stage::spin)) return b.inverse_mass;
    const glm::dvec3 lever = glm::cross(arm, normal);
    return b.inverse_mass + glm::dot(lever, b.worldInverseInertia() * lever);
}

/// Takes from the accelerations what would press the bodies further into the contacts they now rest on.
void Flight::support(const std::vector<Contact>& contacts) {
    for (int round = 0; round < 8; ++round) {
        for (const Contact& c : contacts) {
            const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(std::max(c.b, 0));
            const bool pair = c.b != kStatic;
            if (glm::dot(relativeVelocity(bodies_, c, has(Stage::spin)), c.normal) > 1e-9) continue;
            const glm::dvec3 acceleration = accelerationAt(a, c.arm_a) - (pair ? accelerationAt(b, c.arm_b) : glm::dvec3{0});
            const double press = -glm::dot(acceleration, c.normal);
            if (press <= 0) continue;
            const double force = press / (yieldOf(a, c.arm_a, c.normal) + (pair ? yieldOf(b, c.arm_b, c.normal) : 0));
            bear(a, c.arm_a, force * c.normal);
            if (pair) bear(b, c.arm_b, -force * c.normal);
        }
    }
}

/// Leaves a body where it is for the rest of the part, with its velocity: neither energy nor a wall is lost by that.
void Flight::hold(std::size_t i) {
    if (!paths_[i].held) held.push_back(static_cast<int>(i));
    paths_[i].held = true;
}

void Flight::meet(const Event& event) {
    const std::array<int, 2> both{event.a, event.b};
    ++impacts;
    for (const int i : both) {
        if (i == kStatic) continue;
        const auto k = static_cast<std::size_t>(i);
        advance(k, event.time);
        ++paths_[k].version, ++paths_[k].events;
        if (!bodies_[k].awake) {
            // It was at rest on something: the impact finds out on what.
            bodies_[k].awake = true, bodies_[k].still = 0;
            paths_[k].acceleration = {}, paths_[k].turning = {};
        }
    }
    std::vector<Contact> contacts = contactsOf(event.a, event.b);
    const bool fast = bounceApart(contacts, event.a, event.b);
    const bool waits = event.b != kStatic && (paths_[static_cast<std::size_t>(event.a)].held || paths_[static_cast<std::size_t>(event.b)].held);
    for (const int i : both) {
        if (i == kStatic) continue;
        const auto k = static_cast<std::size_t>(i);
        if (fast || !paths_[k].carried) paths_[k].turning = {};  // else what carries it goes on, as a rim that rolls does
        if (!fast) ++paths_[k].slow;
        if (fast) paths_[k].acceleration = rules_.world.fall();
        if (waits || contacts.empty() || paths_[k].events > kEventsAPart) hold(k);
    }
    support(contacts);
    for (const int i : both) {
        if (i == kStatic) continue;
        growReach(static_cast<std::size_t>(i));
        expectAll(static_cast<std::size_t>(i));
    }
}

}  // namespace mb
