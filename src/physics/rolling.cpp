#include "physics/rolling.h"

#include "core/effects/effect.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace mb {
namespace {

/// The angular impulse of a contact on its body a, and the opposite one on b.
struct Twist {
    const Contact& contact;
    glm::dvec3 rolling{0};       // along the surface, N·m·s
    double spinning = 0;         // along the normal
};

/// By how much an angular impulse turns the bodies of a contact, in the round that decides on it. Friction that holds the point that
/// touches makes a body turn about it, not about its centre: without that the turns would hardly converge, a ball's by 5/7 each.
struct Response {
    const Body& a;
    const Body* b;
    const Contact& contact;
    bool holds = false;

    Response(std::span<const Body> bodies, const Contact& c, bool drags) : a(bodies[slot(c.a)]), b(c.b == kStatic ? nullptr : &bodies[slot(c.b)]), contact(c) {
        holds = drags && !b && glm::length(c.drag) < (1 - 1e-9) * c.pairing.friction * c.push;
    }
    /// The moment of inertia about an axis, kg·m².
    double inertia(const glm::dvec3& axis) const {
        const double yields = glm::dot(axis, a.worldInverseInertia() * axis) + (b ? glm::dot(axis, b->worldInverseInertia() * axis) : 0);
        const glm::dvec3 lever = glm::cross(axis, contact.arm_a);
        return 1 / yields + (holds ? a.mass() * glm::dot(lever, lever) : 0);
    }
    void turn(std::span<glm::dvec3> io_spins, const glm::dvec3& impulse) const {
        const double size = glm::length(impulse);
        if (!(size > 0)) return;
        const glm::dvec3 axis = impulse / size, turns = a.worldInverseInertia() * impulse;
        const double share = holds ? 1 / (inertia(axis) * glm::dot(axis, a.worldInverseInertia() * axis)) : 1;
        io_spins[slot(contact.a)] += share * turns;
        if (b) io_spins[slot(contact.b)] -= b->worldInverseInertia() * impulse;
    }
};

/// One turn of a contact's torque towards no relative spin, within its limits; says by how much it changed a spin.
double turn(Twist& io_twist, const Response& response, std::span<glm::dvec3> io_spins) {
    const Contact& c = io_twist.contact;
    const auto relative = [&] { return c.b == kStatic ? io_spins[slot(c.a)] : io_spins[slot(c.a)] - io_spins[slot(c.b)]; };
    double changed = 0;
    const double about = glm::dot(relative(), c.normal), of_normal = response.inertia(c.normal), most = c.pairing.spinning * c.push;
    const double spinning = std::clamp(io_twist.spinning - of_normal * about, -most, most), by = spinning - io_twist.spinning;
    io_twist.spinning = spinning, response.turn(io_spins, by * c.normal);
    changed = std::fabs(by) / of_normal;

    const glm::dvec3 spin = relative(), rolls = spin - glm::dot(spin, c.normal) * c.normal;
    const double rate = glm::length(rolls), limit = c.pairing.rolling * c.push;
    const double inertia = response.inertia(rate > 0 ? rolls / rate : glm::dvec3{0});
    glm::dvec3 rolling = io_twist.rolling;
    if (rate > 0) rolling -= inertia * rolls;
    rolling -= glm::dot(rolling, c.normal) * c.normal;
    if (const double size = glm::length(rolling); size > limit) rolling *= limit / size;
    const glm::dvec3 change = rolling - io_twist.rolling;
    io_twist.rolling = rolling, response.turn(io_spins, change);
    return rate > 0 ? std::max(changed, glm::length(change) / inertia) : changed;
}

/// Of one island, which has contacts that resist. `io_spins`: of every body, to work in.
void solveIsland(std::span<const Body> bodies, std::span<Contact> io_contacts, std::span<Motion> io_motion, std::vector<Twist>& io_twists,
                 std::span<glm::dvec3> io_spins, int rounds, Stages stages, StepCounts& io_counts) {
    std::vector<std::pair<std::size_t, Motion>> free;  // of the bodies, some of them more than once
    for (const Contact& c : io_contacts)
        for (const int i : {c.a, c.b})
            if (i != kStatic) free.emplace_back(slot(i), io_motion[slot(i)]);
    solve(bodies, io_contacts, io_motion, rounds, stages, io_counts);
    const bool drags = stages.has(Stage::friction);
    for (int round = 0; round < rounds; ++round) {
        for (const auto& [i, motion] : free) io_spins[i] = io_motion[i].spin;
        double changed = 0;
        for (Twist& twist : io_twists) changed = std::max(changed, turn(twist, Response(bodies, twist.contact, drags), io_spins));
        io_counts.torques += io_twists.size();
        if (changed <= 1e-12) return;
        for (const auto& [i, motion] : free) io_motion[i] = motion;
        for (const Twist& twist : io_twists) {
            const Contact& c = twist.contact;
            const glm::dvec3 impulse = twist.rolling + twist.spinning * c.normal;
            io_motion[slot(c.a)].spin += bodies[slot(c.a)].worldInverseInertia() * impulse;
            if (c.b != kStatic) io_motion[slot(c.b)].spin -= bodies[slot(c.b)].worldInverseInertia() * impulse;
        }
        solve(bodies, io_contacts, io_motion, rounds, stages, io_counts);
    }
}

}  // namespace

void solveResisting(std::span<const Body> bodies, std::span<Contact> io_contacts, std::span<Motion> io_motion, int rounds, Stages stages,
                    StepCounts& io_counts) {
    std::vector<glm::dvec3> spins(bodies.size());
    std::vector<Twist> twists;
    for (std::size_t begin = 0, end = 0; begin < io_contacts.size(); begin = end) {
        twists.clear();
        for (; end < io_contacts.size() && io_contacts[end].island == io_contacts[begin].island; ++end) {
            const Contact& c = io_contacts[end];
            if (stages.has(Stage::rolling) && stages.has(Stage::spin) && (c.pairing.rolling > 0 || c.pairing.spinning > 0)) twists.push_back({c});
        }
        const std::span<Contact> island = io_contacts.subspan(begin, end - begin);
        if (twists.empty()) solve(bodies, island, io_motion, rounds, stages, io_counts);
        else solveIsland(bodies, island, io_motion, twists, spins, rounds, stages, io_counts);
    }
}

}  // namespace mb
