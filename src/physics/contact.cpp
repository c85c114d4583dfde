#include "physics/contact.h"

#include "core/effects/effect.h"
#include "physics/random.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace mb {
namespace {

/// A contact of balls with what the rounds need again and again. A ball's normal impulse passes through its centre and turns
/// nothing; the tangential one acts at the lever r and meets the mass 1/(1/m + r²/I), which is 2/7·m for a solid ball.
template <bool spins> struct BallRow {
    Contact& contact;
    Motion& motion_a;
    Motion* motion_b;
    double inverse_a = 0, inverse_b = 0;   // masses
    double radius_a = 0, radius_b = 0;
    double turn_a = 0, turn_b = 0;         // radius / moment of inertia
    double normal_mass = 0, tangent_mass = 0;

    BallRow(std::span<const Body> bodies, Contact& c, Motion& a, Motion* b) : contact(c), motion_a(a), motion_b(b) {
        const Body& of_a = bodies[static_cast<std::size_t>(c.a)];
        inverse_a = of_a.inverse_mass, radius_a = of_a.radius, turn_a = of_a.radius * of_a.inverse_inertia[0][0];
        if (b) {
            const Body& of_b = bodies[static_cast<std::size_t>(c.b)];
            inverse_b = of_b.inverse_mass, radius_b = of_b.radius, turn_b = of_b.radius * of_b.inverse_inertia[0][0];
        }
        const double inverse = inverse_a + inverse_b, turning = spins ? radius_a * turn_a + radius_b * turn_b : 0;
        normal_mass = 1 / inverse, tangent_mass = 1 / (inverse + turning);
    }
    glm::dvec3 velocity() const {
        if constexpr (!spins) return motion_b ? motion_a.velocity - motion_b->velocity : motion_a.velocity;
        glm::dvec3 v = motion_a.velocity - radius_a * glm::cross(motion_a.spin, contact.normal);
        if (motion_b) v -= motion_b->velocity + radius_b * glm::cross(motion_b->spin, contact.normal);
        return v;
    }
    void push(double impulse) const {
        motion_a.velocity += (impulse * inverse_a) * contact.normal;
        if (motion_b) motion_b->velocity -= (impulse * inverse_b) * contact.normal;
    }
    void drag(const glm::dvec3& impulse) const {
        motion_a.velocity += inverse_a * impulse;
        if (motion_b) motion_b->velocity -= inverse_b * impulse;
        if constexpr (!spins) return;
        const glm::dvec3 turn = glm::cross(contact.normal, impulse);
        motion_a.spin -= turn_a * turn;
        if (motion_b) motion_b->spin -= turn_b * turn;
    }
    /// The tangential impulse that changes the slip by that much; and the mass it meets, along the lightest direction.
    glm::dvec3 dragFor(const glm::dvec3& slip) const { return tangent_mass * slip; }
    double lightest() const { return tangent_mass; }
};

/// The same of any bodies: the levers are the contact's arms, and how hard a body is to turn depends on the axis.
template <bool spins> struct LeverRow {
    Contact& contact;
    Motion& motion_a;
    Motion* motion_b;
    double inverse_a = 0, inverse_b = 0, normal_mass = 0, twist_mass = 0;
    glm::dmat3 turning_a{0}, turning_b{0};  // inverse inertia, in the world's frame
    glm::dvec3 turn_a{0}, turn_b{0};        // by a normal impulse of 1
    glm::dvec3 t{0}, u{0};                  // unit tangents
    double tt = 0, tu = 0, uu = 0;          // of the inverse of the matrix from tangential impulses to slips

    LeverRow(std::span<const Body> bodies, Contact& c, Motion& a, Motion* b) : contact(c), motion_a(a), motion_b(b) {
        const Body& of_a = bodies[static_cast<std::size_t>(c.a)];
        inverse_a = of_a.inverse_mass;
        if (spins) turning_a = of_a.worldInverseInertia(), turn_a = turning_a * glm::cross(c.arm_a, c.normal);
        if (b) {
            const Body& of_b = bodies[static_cast<std::size_t>(c.b)];
            inverse_b = of_b.inverse_mass;
            if (spins) turning_b = of_b.worldInverseInertia(), turn_b = turning_b * glm::cross(c.arm_b, c.normal);
        }
        normal_mass = 1 / glm::dot(c.normal, response(c.normal));
        if (spins && c.patch > 0) twist_mass = 1 / glm::dot(c.normal, (turning_a + turning_b) * c.normal);
        const glm::dvec3 n = c.normal, size = glm::abs(n);
        t = glm::normalize(glm::cross(n, size.x < 0.6 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 1, 0})), u = glm::cross(n, t);
        const glm::dvec3 by_t = response(t), by_u = response(u);
        const double a11 = glm::dot(t, by_t), a12 = glm::dot(t, by_u), a22 = glm::dot(u, by_u), det = a11 * a22 - a12 * a12;
        tt = a22 / det, tu = -a12 / det, uu = a11 / det;
    }
    /// By how much an impulse changes the relative velocity.
    glm::dvec3 response(const glm::dvec3& impulse) const {
        glm::dvec3 v = (inverse_a + inverse_b) * impulse;
        if constexpr (spins) {
            v += glm::cross(turning_a * glm::cross(contact.arm_a, impulse), contact.arm_a);
            if (motion_b) v += glm::cross(turning_b * glm::cross(contact.arm_b, impulse), contact.arm_b);
        }
        return v;
    }
    glm::dvec3 velocity() const { return relativeVelocity(motion_a, motion_b, contact, spins); }
    void push(double impulse) const {
        motion_a.velocity += (impulse * inverse_a) * contact.normal;
        if (motion_b) motion_b->velocity -= (impulse * inverse_b) * contact.normal;
        if constexpr (!spins) return;
        motion_a.spin += impulse * turn_a;
        if (motion_b) motion_b->spin -= impulse * turn_b;
    }
    void drag(const glm::dvec3& impulse) const {
        motion_a.velocity += inverse_a * impulse;
        if (motion_b) motion_b->velocity -= inverse_b * impulse;
        if constexpr (!spins) return;
        motion_a.spin += turning_a * glm::cross(contact.arm_a, impulse);
        if (motion_b) motion_b->spin -= turning_b * glm::cross(contact.arm_b, impulse);
    }
    /// How fast a turns about the normal against b, rad/s.
    double turning() const { return glm::dot(motion_b ? motion_a.spin - motion_b->spin : motion_a.spin, contact.normal); }
    void twist(double impulse) const {
        motion_a.spin += turning_a * (impulse * contact.normal);
        if (motion_b) motion_b->spin -= turning_b * (impulse * contact.normal);
    }
    glm::dvec3 dragFor(const glm::dvec3& slip) const {
        const double s = glm::dot(t, slip), r = glm::dot(u, slip);
        return (tt * s + tu * r) * t + (tu * s + uu * r) * u;
    }
    double lightest() const {
        const double mean = 0.5 * (tt + uu), apart = 0.5 * (tt - uu);
        return mean - std::sqrt(apart * apart + tu * tu);
    }
};

/// Turns the drag towards no slip, within Coulomb's cone; says by how much it changed a velocity.
template <class Row> double turnDrag(const Row& row, std::uint64_t& io_drags) {
    Contact& c = row.contact;
    const double limit = c.pairing.friction * c.push;
    if (limit == 0 && c.drag == glm::dvec3{0}) return 0;
    ++io_drags;
    const glm::dvec3 v = row.velocity(), slip = v - glm::dot(v, c.normal) * c.normal;
    glm::dvec3 drag_now = c.drag + row.dragFor(c.slip - slip);
    if (glm::length(drag_now) > limit) {
        // What slides is dragged against its slip, however hard it is to turn: a step down the slip, then onto the cone.
        drag_now = c.drag + row.lightest() * (c.slip - slip);
        if (const double size = glm::length(drag_now); size > limit) drag_now *= limit / size;
    }
    const glm::dvec3 change = drag_now - c.drag;
    c.drag = drag_now;
    row.drag(change);
    return glm::length(change) * (row.inverse_a + row.inverse_b);
}

/// Turns the twist towards no turning about the normal, within what friction can do on a disc that presses evenly: ⅔ of it, at the
/// rim. Without it a die that hangs between two points would swing for ever.
template <class Row> void turnTwist(const Row& row) {
    Contact& c = row.contact;
    const double limit = 2.0 / 3 * c.pairing.friction * c.push * c.patch;
    if (limit == 0 && c.twist == 0) return;
    const double twist_now = std::clamp(c.twist - row.twist_mass * row.turning(), -limit, limit), change = twist_now - c.twist;
    c.twist = twist_now;
    row.twist(change);
}

/// One turn; says by how much it changed a velocity at the contact.
template <bool drags, class Row> double turn(const Row& row, std::uint64_t& io_drags) {
    Contact& c = row.contact;
    const double wanted = c.push + row.normal_mass * (c.target - glm::dot(row.velocity(), c.normal));
    const double pushed = std::max(wanted, 0.0), change = pushed - c.push;
    c.push = pushed;
    row.push(change);
    const double changed = std::fabs(change) / row.normal_mass;
    if constexpr (!drags) return changed;
    if constexpr (requires { row.twist_mass; })
        if (row.twist_mass > 0) turnTwist(row);
    return std::max(changed, turnDrag(row, io_drags));
}

template <bool drags, class Row> void begin(std::vector<Row>& io_rows, std::span<const Body> bodies, Contact& c, std::span<Motion> motion) {
    io_rows.emplace_back(bodies, c, motion[static_cast<std::size_t>(c.a)], c.b == kStatic ? nullptr : &motion[static_cast<std::size_t>(c.b)]);
    if (c.push != 0) io_rows.back().push(c.push);
    if constexpr (drags) {
        if (c.drag != glm::dvec3{0}) io_rows.back().drag(c.drag);
        if constexpr (requires(const Row& row) { row.twist_mass; })
            if (c.twist != 0) io_rows.back().twist(c.twist);
    }
}

template <bool spins, bool drags>
void solveRows(std::span<const Body> bodies, std::span<Contact> contacts, std::span<Motion> motion, int rounds, StepCounts& io_counts) {
    std::vector<BallRow<spins>> ball_rows;
    std::vector<LeverRow<spins>> lever_rows;
    ball_rows.reserve(contacts.size());
    for (Contact& c : contacts) {
        if (betweenBalls(bodies, c)) begin<drags>(ball_rows, bodies, c, motion);
        else begin<drags>(lever_rows, bodies, c, motion);
    }
    for (int round = 0; round < rounds; ++round) {
        // Shapes there and back: what the foot of a stack learns, its top has within a round. (Two balls on one another, of
        // very different masses, would lose every second round by that.)
        double changed = 0;
        const auto visit = [&](const auto& row) { changed = std::max(changed, turn<drags>(row, io_counts.drags)); };
        std::ranges::for_each(ball_rows, visit);
        if (round % 2 == 0) std::ranges::for_each(lever_rows, visit);
        else std::for_each(lever_rows.rbegin(), lever_rows.rend(), visit);
        ++io_counts.rounds;
        if (changed <= 1e-12) return;
    }
}

}  // namespace

bool betweenBalls(std::span<const Body> bodies, const Contact& c) {
    return bodies[static_cast<std::size_t>(c.a)].isBall() && (c.b == kStatic || bodies[static_cast<std::size_t>(c.b)].isBall());
}

glm::dvec3 directionApart(const Body& a, const Body& b) {
    const glm::dvec3 apart = a.position - b.position;
    const double d = glm::length(apart);
    if (d > 1e-12 * (a.radius + b.radius)) return apart / d;
    Random random(a.object.value * 0x100000000u + b.object.value);
    glm::dvec3 n{random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)};
    return glm::dot(n, n) > 1e-6 ? glm::normalize(n) : glm::dvec3{0, 1, 0};
}

Contact ballContact(int a, const Body& body, glm::dvec3 normal, double gap, Pairing pairing) {
    Contact c;
    c.a = a, c.normal = normal, c.gap = gap, c.arm_a = -body.radius * normal, c.pairing = pairing;
    return c;
}

Contact ballContact(int a, const Body& body_a, int b, const Body& body_b, Pairing pairing) {
    const double gap = glm::length(body_a.position - body_b.position) - body_a.radius - body_b.radius;
    Contact c = ballContact(a, body_a, directionApart(body_a, body_b), gap, pairing);
    c.b = b, c.arm_b = body_b.radius * c.normal;
    return c;
}

glm::dvec3 relativeVelocity(const Motion& a, const Motion* b, const Contact& c, bool spins) {
    if (!spins) return b ? a.velocity - b->velocity : a.velocity;
    glm::dvec3 v = a.velocity + glm::cross(a.spin, c.arm_a);
    if (b) v -= b->velocity + glm::cross(b->spin, c.arm_b);
    return v;
}

glm::dvec3 relativeVelocity(std::span<const Body> bodies, const Contact& c, bool spins) {
    const Motion a = motionOf(bodies[static_cast<std::size_t>(c.a)]);
    if (c.b == kStatic) return relativeVelocity(a, nullptr, c, spins);
    const Motion b = motionOf(bodies[static_cast<std::size_t>(c.b)]);
    return relativeVelocity(a, &b, c, spins);
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
