#pragma once
// A contact as the rounds of the solver see it: what they need again and again, worked out once.
#include "physics/contact.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace mb {

/// What every row has. The impulses are the row's until finish() gives them back to the contact.
struct Row {
    Contact* contact;
    Motion *a, *b;                         // b of a static one: a motion that nothing changes
    glm::dvec3 normal, slip, drag;
    double target, push, friction;
    double inverse_a = 0, inverse_b = 0;   // masses; 0: static
    double normal_mass = 0;
    double step = 0, way = 0;              // of the push: what the last turn added, and the way the rounds go (goOn)
    glm::dvec3 drag_step{0}, drag_way{0};

    Row(Contact& c, Motion& of_a, Motion& of_b)
        : contact(&c), a(&of_a), b(&of_b), normal(c.normal), slip(c.slip), drag(c.drag), target(c.target), push(c.push), friction(c.pairing.friction) {}
    void finish() const { contact->push = push, contact->drag = drag; }
};

/// A contact of balls. A ball's normal impulse passes through its centre and turns nothing; the tangential one acts at the
/// lever r and meets the mass 1/(1/m + r²/I), which is 2/7·m for a solid ball.
template <bool spins> struct BallRow : Row {
    double radius_a = 0, radius_b = 0;
    double turn_a = 0, turn_b = 0;         // radius / moment of inertia
    double tangent_mass = 0;

    BallRow(std::span<const Body> bodies, Contact& c, Motion& of_a, Motion& of_b) : Row(c, of_a, of_b) {
        const Body& ball_a = bodies[static_cast<std::size_t>(c.a)];
        inverse_a = ball_a.inverse_mass, radius_a = ball_a.radius, turn_a = ball_a.radius * ball_a.inverse_inertia[0][0];
        if (c.b != kStatic) {
            const Body& ball_b = bodies[static_cast<std::size_t>(c.b)];
            inverse_b = ball_b.inverse_mass, radius_b = ball_b.radius, turn_b = ball_b.radius * ball_b.inverse_inertia[0][0];
        }
        const double inverse = inverse_a + inverse_b, turning = spins ? radius_a * turn_a + radius_b * turn_b : 0;
        normal_mass = 1 / inverse, tangent_mass = 1 / (inverse + turning);
    }
    double approach() const { return glm::dot(a->velocity - b->velocity, normal); }
    glm::dvec3 slipping() const {
        const glm::dvec3 v = a->velocity - b->velocity, along = v - glm::dot(v, normal) * normal;
        if constexpr (!spins) return along;
        return along - glm::cross(radius_a * a->spin + radius_b * b->spin, normal);
    }
    void pushBy(double impulse) const {
        a->velocity += (impulse * inverse_a) * normal;
        b->velocity -= (impulse * inverse_b) * normal;
    }
    void dragBy(const glm::dvec3& impulse) const {
        a->velocity += inverse_a * impulse;
        b->velocity -= inverse_b * impulse;
        if constexpr (!spins) return;
        const glm::dvec3 turn = glm::cross(normal, impulse);
        a->spin -= turn_a * turn;
        b->spin -= turn_b * turn;
    }
    /// The tangential impulse that changes the slip by that much; and the mass it meets, along the lightest direction.
    glm::dvec3 dragFor(const glm::dvec3& change) const { return tangent_mass * change; }
    double lightest() const { return tangent_mass; }
};

/// The same of any bodies: the levers are the contact's arms, and how hard a body is to turn depends on the axis.
template <bool spins> struct LeverRow : Row {
    glm::dvec3 arm_a, arm_b;
    glm::dmat3 turning_a{0}, turning_b{0};  // inverse inertia, in the world's frame
    glm::dvec3 turn_a{0}, turn_b{0};        // by a normal impulse of 1
    glm::dvec3 t{0}, u{0};                  // unit tangents
    double tt = 0, tu = 0, uu = 0;          // of the inverse of the matrix from tangential impulses to slips

    LeverRow(std::span<const Body> bodies, Contact& c, Motion& of_a, Motion& of_b) : Row(c, of_a, of_b), arm_a(c.arm_a), arm_b(c.arm_b) {
        const Body& body_a = bodies[static_cast<std::size_t>(c.a)];
        inverse_a = body_a.inverse_mass;
        if (spins) turning_a = body_a.worldInverseInertia(), turn_a = turning_a * glm::cross(arm_a, normal);
        if (c.b != kStatic) {
            const Body& body_b = bodies[static_cast<std::size_t>(c.b)];
            inverse_b = body_b.inverse_mass;
            if (spins) turning_b = body_b.worldInverseInertia(), turn_b = turning_b * glm::cross(arm_b, normal);
        }
        normal_mass = 1 / glm::dot(normal, response(normal));
        const glm::dvec3 size = glm::abs(normal);
        t = glm::normalize(glm::cross(normal, size.x < 0.6 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 1, 0})), u = glm::cross(normal, t);
        const glm::dvec3 by_t = response(t), by_u = response(u);
        const double a11 = glm::dot(t, by_t), a12 = glm::dot(t, by_u), a22 = glm::dot(u, by_u), det = a11 * a22 - a12 * a12;
        tt = a22 / det, tu = -a12 / det, uu = a11 / det;
    }
    /// By how much an impulse changes the relative velocity.
    glm::dvec3 response(const glm::dvec3& impulse) const {
        glm::dvec3 v = (inverse_a + inverse_b) * impulse;
        if constexpr (spins) {
            v += glm::cross(turning_a * glm::cross(arm_a, impulse), arm_a);
            if (contact->b != kStatic) v += glm::cross(turning_b * glm::cross(arm_b, impulse), arm_b);
        }
        return v;
    }
    glm::dvec3 velocity() const {
        if constexpr (!spins) return a->velocity - b->velocity;
        return (a->velocity + glm::cross(a->spin, arm_a)) - (b->velocity + glm::cross(b->spin, arm_b));
    }
    double approach() const { return glm::dot(velocity(), normal); }
    glm::dvec3 slipping() const {
        const glm::dvec3 v = velocity();
        return v - glm::dot(v, normal) * normal;
    }
    void pushBy(double impulse) const {
        a->velocity += (impulse * inverse_a) * normal;
        b->velocity -= (impulse * inverse_b) * normal;
        if constexpr (!spins) return;
        a->spin += impulse * turn_a;
        b->spin -= impulse * turn_b;
    }
    void dragBy(const glm::dvec3& impulse) const {
        a->velocity += inverse_a * impulse;
        b->velocity -= inverse_b * impulse;
        if constexpr (!spins) return;
        a->spin += turning_a * glm::cross(arm_a, impulse);
        b->spin -= turning_b * glm::cross(arm_b, impulse);
    }
    glm::dvec3 dragFor(const glm::dvec3& change) const {
        const double s = glm::dot(t, change), r = glm::dot(u, change);
        return (tt * s + tu * r) * t + (tu * s + uu * r) * u;
    }
    double lightest() const {
        const double mean = 0.5 * (tt + uu), apart = 0.5 * (tt - uu);
        return mean - std::sqrt(apart * apart + tu * tu);
    }
};

/// Applies the impulses a row begins with.
template <bool drags, class Row> void applyFirst(const Row& row) {
    if (row.push != 0) row.pushBy(row.push);
    if constexpr (drags)
        if (row.drag != glm::dvec3{0}) row.dragBy(row.drag);
}

/// What turns did.
struct Change {
    double fastest = 0;  // m²/s²: the square of the most that a velocity was changed by
    double energy = 0;   // the sum of the impulses' squares, each over the mass it meets, J
    void add(const Change& c) { fastest = std::max(fastest, c.fastest), energy += c.energy; }
};

/// Turns the drag towards the slip that is wanted, within Coulomb's cone.
template <class Row> void turnDrag(Row& io_row) {
    const double limit = io_row.friction * io_row.push;
    const glm::dvec3 wanted = io_row.slip - io_row.slipping();
    glm::dvec3 drag = io_row.drag + io_row.dragFor(wanted);
    if (glm::dot(drag, drag) > limit * limit) {
        // What slides is dragged against its slip, however hard it is to turn: a step down the slip, then onto the cone.
        drag = io_row.drag + io_row.lightest() * wanted;
        if (const double square = glm::dot(drag, drag); square > limit * limit) drag *= limit / std::sqrt(square);
    }
    io_row.drag_step = drag - io_row.drag;
    io_row.drag = drag;
    io_row.dragBy(io_row.drag_step);
}

/// One turn towards the row's target.
template <bool drags, class Row> Change turn(Row& io_row, std::uint64_t& io_drags) {
    const double pushed = std::max(io_row.push + io_row.normal_mass * (io_row.target - io_row.approach()), 0.0);
    io_row.step = pushed - io_row.push, io_row.push = pushed;
    io_row.pushBy(io_row.step);
    const double by = io_row.step / io_row.normal_mass;
    Change change{by * by, io_row.step * by};
    if constexpr (drags) {
        io_row.drag_step = {};
        if (io_row.friction == 0 || (io_row.push == 0 && io_row.drag == glm::dvec3{0})) return change;
        ++io_drags;
        turnDrag(io_row);
        const double square = glm::dot(io_row.drag_step, io_row.drag_step), inverse = io_row.inverse_a + io_row.inverse_b;
        change.fastest = std::max(change.fastest, inverse * inverse * square), change.energy += square / io_row.normal_mass;
    }
    return change;
}

/// Goes on in the way the rounds have gone: a share of the last way, and to it the last turn's step is added. The next turn brings
/// back what goes too far. With Fletcher's and Reeves' share, what the last round changed over what the one before did, these are
/// the nonsmooth nonlinear conjugate gradients of Silcowitz, Niebe, Erleben, "A Nonsmooth Nonlinear Conjugate Gradient Method for
/// Interactive Contact Force Problems" (2010). A share of 0 begins anew.
template <bool drags, class Row> void goOn(Row& io_row, double share) {
    io_row.way *= share;
    if (io_row.way != 0) io_row.push += io_row.way, io_row.pushBy(io_row.way);
    io_row.way += io_row.step;
    if constexpr (!drags) return;
    io_row.drag_way *= share;
    if (io_row.drag_way != glm::dvec3{0}) io_row.drag += io_row.drag_way, io_row.dragBy(io_row.drag_way);
    io_row.drag_way += io_row.drag_step;
}

inline constexpr double kSettled = 1e-24;  // m²/s²: rounds end that change no velocity by more than the root

}  // namespace mb
