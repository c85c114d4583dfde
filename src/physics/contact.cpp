#include "physics/contact.h"

#include "core/effects/effect.h"
#include "physics/random.h"

#include <glm/geometric.hpp>

namespace mb {
namespace {

/// A contact with what the rounds need again and again.
template <bool spins, bool drags> struct Row {
    Contact& contact;
    const Body& a;
    const Body* b;
    Motion& motion_a;
    Motion* motion_b;
    double normal_mass = 0, tangent_mass = 0;

    glm::dvec3 velocity() const {
        if constexpr (!spins) return b ? motion_a.velocity - motion_b->velocity : motion_a.velocity;
        glm::dvec3 v = motion_a.velocity - a.radius * glm::cross(motion_a.spin, contact.normal);
        if (b) v -= motion_b->velocity + b->radius * glm::cross(motion_b->spin, contact.normal);
        return v;
    }
    void push(double impulse) const {
        motion_a.velocity += (impulse * a.inverse_mass) * contact.normal;
        if (b) motion_b->velocity -= (impulse * b->inverse_mass) * contact.normal;
    }
    void drag(const glm::dvec3& impulse) const {
        motion_a.velocity += a.inverse_mass * impulse;
        if (b) motion_b->velocity -= b->inverse_mass * impulse;
        if constexpr (!spins) return;
        const glm::dvec3 turn = glm::cross(contact.normal, impulse);
        motion_a.spin -= (a.radius * a.inverse_inertia) * turn;
        if (b) motion_b->spin -= (b->radius * b->inverse_inertia) * turn;
    }

    /// One turn; says by how much it changed a velocity at the contact.
    double turn(std::uint64_t& io_drags) const {
        const double wanted = contact.push + normal_mass * (contact.target - glm::dot(velocity(), contact.normal));
        const double pushed = std::max(wanted, 0.0), change = pushed - contact.push;
        contact.push = pushed;
        push(change);
        const double changed = std::fabs(change) / normal_mass;
        if constexpr (!drags) return changed;
        else return std::max(changed, turnDrag(io_drags));
    }
    double turnDrag(std::uint64_t& io_drags) const {
        const double limit = contact.pairing.friction * contact.push;
        if (limit == 0 && contact.drag == glm::dvec3{0}) return 0;
        ++io_drags;
        const glm::dvec3 v = velocity(), slip = v - glm::dot(v, contact.normal) * contact.normal;
        glm::dvec3 drag_now = contact.drag + tangent_mass * (contact.slip - slip);
        const double size = glm::length(drag_now);
        if (size > limit) drag_now *= limit / size;
        const glm::dvec3 drag_change = drag_now - contact.drag;
        contact.drag = drag_now;
        drag(drag_change);
        return glm::length(drag_change) / tangent_mass;
    }
};

/// The inverse of the mass that a push meets, and what a drag meets besides.
struct Resistance {
    double inverse = 0, turning = 0;
};
Resistance resistanceOf(const Body& b) { return {b.inverse_mass, b.radius * b.radius * b.inverse_inertia}; }

template <bool spins, bool drags>
void solveRows(std::span<const Body> bodies, std::span<Contact> contacts, std::span<Motion> motion, int rounds, StepCounts& io_counts) {
    std::vector<Row<spins, drags>> rows;
    rows.reserve(contacts.size());
    for (Contact& c : contacts) {
        const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(std::max(c.b, 0));
        const bool fixed = c.b == kStatic;
        Row<spins, drags> row{c, bodies[a], fixed ? nullptr : &bodies[b], motion[a], fixed ? nullptr : &motion[b]};
        const Resistance of_a = resistanceOf(bodies[a]), of_b = fixed ? Resistance{} : resistanceOf(bodies[b]);
        const double inverse = of_a.inverse + of_b.inverse, turning = spins ? of_a.turning + of_b.turning : 0;
        row.normal_mass = 1 / inverse, row.tangent_mass = 1 / (inverse + turning);
        row.push(c.push);
        if constexpr (drags)
            if (c.drag != glm::dvec3{0}) row.drag(c.drag);
        rows.push_back(row);
    }
    for (int round = 0; round < rounds; ++round) {
        double changed = 0;
        for (const Row<spins, drags>& row : rows) changed = std::max(changed, row.turn(io_counts.drags));
        ++io_counts.rounds;
        if (changed <= 1e-12) return;
    }
}

}  // namespace

glm::dvec3 directionApart(const Body& a, const Body& b) {
    const glm::dvec3 apart = a.position - b.position;
    const double d = glm::length(apart);
    if (d > 1e-12 * (a.radius + b.radius)) return apart / d;
    Random random(a.object.value * 0x100000000u + b.object.value);
    glm::dvec3 n{random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)};
    return glm::dot(n, n) > 1e-6 ? glm::normalize(n) : glm::dvec3{0, 1, 0};
}

glm::dvec3 relativeVelocity(std::span<const Body> bodies, const Motion& a, const Motion* b, const Contact& c, bool spins) {
    if (!spins) return b ? a.velocity - b->velocity : a.velocity;
    glm::dvec3 v = a.velocity - bodies[static_cast<std::size_t>(c.a)].radius * glm::cross(a.spin, c.normal);
    if (b) v -= b->velocity + bodies[static_cast<std::size_t>(c.b)].radius * glm::cross(b->spin, c.normal);
    return v;
}

void solve(std::span<const Body> bodies, std::span<Contact> contacts, std::span<Motion> motion, int rounds, Stages stages,
           StepCounts& io_counts) {
    if (contacts.empty()) return;
    const bool spins = stages.has(Stage::spin), drags = stages.has(Stage::friction);
    const auto rows = spins ? (drags ? solveRows<true, true> : solveRows<true, false>)
                            : (drags ? solveRows<false, true> : solveRows<false, false>);
    rows(bodies, contacts, motion, rounds, io_counts);
}

}  // namespace mb
