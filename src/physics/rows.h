#pragma once
// A contact as the rounds of the solver see it: what they need again and again, worked out once.
#include "physics/contact.h"
#include "physics/lanes.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace mb {

using glm::cross, glm::dot;

/// The impulses of a contact, or what they change by.
template <class S, class V> struct ImpulsesOf {
    S push{};
    V drag{};
};

/// What every row has, in doubles, or in lanes of as many contacts at once (lanes.h).
template <class S, class V> struct RowOf : ImpulsesOf<S, V> {
    V normal{};
    S normal_mass{}, inverse_a{}, inverse_b{};  // inverse masses; 0: static
    S friction{}, target{};

    template <class M> MB_INLINE void pushBy(const S& impulse, M& io_a, M& io_b) const {
        io_a.velocity = io_a.velocity + (impulse * inverse_a) * normal;
        io_b.velocity = io_b.velocity - (impulse * inverse_b) * normal;
    }
};

/// The vector, or where it is longer, the one of that length in its direction.
template <class S, class V> MB_INLINE V shortened(const V& v, const S& most) {
    const S square = dot(v, v), share = most / rootOf(square);
    return (square > most * most ? share : all<S>(1)) * v;
}

/// A contact of balls. A ball's normal impulse passes through its centre and turns nothing; the tangential one acts at the
/// lever r and meets the mass 1/(1/m + r²/I), which is 2/7·m for a solid ball.
template <bool spins, class S, class V> struct BallRowOf : RowOf<S, V> {
    using Row = RowOf<S, V>;
    using Row::inverse_a, Row::inverse_b, Row::normal;
    S radius_a{}, radius_b{};
    S turn_a{}, turn_b{};                       // radius / moment of inertia
    S tangent_mass{};

    /// By how much a normal impulse of 1 changes the approach.
    MB_INLINE S give() const { return inverse_a + inverse_b; }
    template <class M> MB_INLINE S approach(const M& a, const M& b) const { return dot(a.velocity - b.velocity, normal); }
    template <class M> MB_INLINE V slipping(const M& a, const M& b) const {
        const V v = a.velocity - b.velocity, along = v - dot(v, normal) * normal;
        if constexpr (!spins) return along;
        else return along - cross(radius_a * a.spin + radius_b * b.spin, normal);
    }
    template <class M> MB_INLINE void dragBy(const V& impulse, M& io_a, M& io_b) const {
        io_a.velocity = io_a.velocity + inverse_a * impulse;
        io_b.velocity = io_b.velocity - inverse_b * impulse;
        if constexpr (spins) {
            const V turn = cross(normal, impulse);
            io_a.spin = io_a.spin - turn_a * turn;
            io_b.spin = io_b.spin - turn_b * turn;
        }
    }
    /// The drag that changes the slip by that much, within Coulomb's cone.
    MB_INLINE V dragWithin(const V& change, const S& most) const { return shortened(Row::drag + tangent_mass * change, most); }
};

/// What the row needs of a contact of balls: its bodies' masses and radii.
struct BallNumbers {
    double inverse_a = 0, inverse_b = 0, radius_a = 0, radius_b = 0, turn_a = 0, turn_b = 0;
    static BallNumbers of(std::span<const Body> bodies, const Contact& c, bool spins) {
        BallNumbers n{};
        const auto set = [&](int body, double& out_inverse, double& out_radius, double& out_turn) {
            const Body& b = bodies[static_cast<std::size_t>(body)];
            out_inverse = b.inverse_mass;
            if (spins) out_radius = b.radius, out_turn = turnOf(b);
        };
        set(c.a, n.inverse_a, n.radius_a, n.turn_a);
        if (c.b != kStatic) set(c.b, n.inverse_b, n.radius_b, n.turn_b);
        return n;
    }
    static double turnOf(const Body& ball) { return ball.radius * ball.inverse_inertia[0][0]; }
    double normalMass() const { return 1 / (inverse_a + inverse_b); }
    double tangentMass() const { return 1 / (inverse_a + inverse_b + (radius_a * turn_a + radius_b * turn_b)); }
};

/// A contact and the two it moves. The impulses are the row's until finish() gives them back to the contact.
struct Ends {
    Contact* contact;
    Motion *a, *b;                              // b of a static one: a motion that nothing changes
    ImpulsesOf<double, glm::dvec3> step{}, way{};  // what the last turn added, and the way the rounds go (goOn)
};

template <bool spins> struct BallRow : BallRowOf<spins, double, glm::dvec3>, Ends {
    BallRow(std::span<const Body> bodies, Contact& c, Motion& of_a, Motion& of_b) : Ends{&c, &of_a, &of_b} {
        const BallNumbers numbers = BallNumbers::of(bodies, c, spins);
        this->inverse_a = numbers.inverse_a, this->inverse_b = numbers.inverse_b;
        this->radius_a = numbers.radius_a, this->radius_b = numbers.radius_b;
        this->turn_a = numbers.turn_a, this->turn_b = numbers.turn_b;
        this->normal_mass = numbers.normalMass(), this->tangent_mass = numbers.tangentMass();
    }
};

/// The same of any bodies: the levers are the contact's arms, and how hard a body is to turn depends on the axis.
template <bool spins> struct LeverRow : RowOf<double, glm::dvec3>, Ends {
    glm::dvec3 arm_a, arm_b;
    glm::dmat3 turning_a{0}, turning_b{0};      // inverse inertia, in the world's frame
    glm::dvec3 turn_a{0}, turn_b{0};            // by a normal impulse of 1
    glm::dvec3 t{0}, u{0};                      // unit tangents
    double normal_give = 0;                     // 1 / normal_mass
    double tt = 0, tu = 0, uu = 0;              // of the inverse of the matrix from tangential impulses to slips
    double twist = 0, twist_mass = 0;           // N·m·s, about the normal; kg·m², 0: the contact is a point

    LeverRow(std::span<const Body> bodies, Contact& c, Motion& of_a, Motion& of_b) : Ends{&c, &of_a, &of_b}, arm_a(c.arm_a), arm_b(c.arm_b) {
        const Body& body_a = bodies[static_cast<std::size_t>(c.a)];
        normal = c.normal, inverse_a = body_a.inverse_mass;
        if (spins) turning_a = body_a.worldInverseInertia(), turn_a = turning_a * glm::cross(arm_a, normal);
        if (c.b != kStatic) {
            const Body& body_b = bodies[static_cast<std::size_t>(c.b)];
            inverse_b = body_b.inverse_mass;
            if (spins) turning_b = body_b.worldInverseInertia(), turn_b = turning_b * glm::cross(arm_b, normal);
        }
        normal_give = glm::dot(normal, response(normal)), normal_mass = 1 / normal_give;
        if (spins && c.patch > 0) twist = c.twist, twist_mass = 1 / glm::dot(normal, (turning_a + turning_b) * normal);
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
    glm::dvec3 velocity(const Motion& of_a, const Motion& of_b) const {
        if constexpr (!spins) return of_a.velocity - of_b.velocity;
        return (of_a.velocity + glm::cross(of_a.spin, arm_a)) - (of_b.velocity + glm::cross(of_b.spin, arm_b));
    }
    double give() const { return normal_give; }
    double approach(const Motion& of_a, const Motion& of_b) const { return glm::dot(velocity(of_a, of_b), normal); }
    glm::dvec3 slipping(const Motion& of_a, const Motion& of_b) const {
        const glm::dvec3 v = velocity(of_a, of_b);
        return v - glm::dot(v, normal) * normal;
    }
    void pushBy(double impulse, Motion& io_a, Motion& io_b) const {
        RowOf::pushBy(impulse, io_a, io_b);
        if constexpr (!spins) return;
        io_a.spin += impulse * turn_a;
        io_b.spin -= impulse * turn_b;
    }
    void dragBy(const glm::dvec3& impulse, Motion& io_a, Motion& io_b) const {
        io_a.velocity += inverse_a * impulse;
        io_b.velocity -= inverse_b * impulse;
        if constexpr (!spins) return;
        io_a.spin += turning_a * glm::cross(arm_a, impulse);
        io_b.spin -= turning_b * glm::cross(arm_b, impulse);
    }
    void twistBy(double impulse, Motion& io_a, Motion& io_b) const {
        io_a.spin += turning_a * (impulse * normal);
        io_b.spin -= turning_b * (impulse * normal);
    }
    /// Turns the twist towards no turning about the normal, within what friction can do on a disc that presses evenly: ⅔ of it, at
    /// the rim. Without it a die that hangs between two points would swing for ever.
    void turnTwist(Motion& io_a, Motion& io_b) {
        if (twist_mass == 0) return;
        const double limit = 2.0 / 3 * friction * push * contact->patch;
        const double turned = std::clamp(twist - twist_mass * glm::dot(io_a.spin - io_b.spin, normal), -limit, limit);
        twistBy(turned - twist, io_a, io_b);
        twist = turned;
    }
    /// What slides is dragged against its slip, however hard it is to turn: a step down the slip, then onto the cone.
    glm::dvec3 dragWithin(const glm::dvec3& change, double most) const {
        const double s = glm::dot(t, change), r = glm::dot(u, change);
        const glm::dvec3 wanted = drag + (tt * s + tu * r) * t + (tu * s + uu * r) * u;
        return glm::dot(wanted, wanted) <= most * most ? wanted : shortened(drag + lightest() * change, most);
    }
    /// The mass that a drag meets in the lightest direction.
    double lightest() const {
        const double mean = 0.5 * (tt + uu), apart = 0.5 * (tt - uu);
        return mean - std::sqrt(apart * apart + tu * tu);
    }
};

/// Of a double: nothing drags without friction, and −0 stays what it is. (Of lanes some may.)
MB_INLINE bool isSmooth(double friction) { return friction == 0; }
MB_INLINE bool isSmooth(const Lanes&) { return false; }

/// Applies the impulses a row begins with.
template <bool drags, class Row, class M> MB_INLINE void applyFirst(const Row& row, M& io_a, M& io_b) {
    row.pushBy(row.push, io_a, io_b);
    if constexpr (drags)
        if (!isSmooth(row.friction)) row.dragBy(row.drag, io_a, io_b);
}
/// What turns did.
template <class S> struct Change {
    S fastest{}, energy{};  // m²/s²: the square of the most that a velocity was changed by; J: of the impulses, by the mass they meet
    MB_INLINE void add(const S& by_fastest, const S& by_energy) { fastest = larger(fastest, by_fastest), energy = energy + by_energy; }
};

/// One turn of a push along the row's normal towards its target. Returns what it added.
template <class Row, class S, class M>
MB_INLINE S turnPush(const Row& row, S& io_push, const S& target, M& io_a, M& io_b, Change<S>& io_change) {
    const S pushed = larger(io_push + row.normal_mass * (target - row.approach(io_a, io_b)), all<S>(0)), step = pushed - io_push;
    io_push = pushed;
    row.pushBy(step, io_a, io_b);
    const S by = row.give() * step;
    io_change.add(by * by, step * by);
    return step;
}
/// One turn towards the row's target, and no slip but `slip`. Returns what it added.
template <bool drags, class Row, class M, class S, class V>
MB_INLINE ImpulsesOf<S, V> turn(Row& io_row, M& io_a, M& io_b, const V& slip, Change<S>& io_change) {
    ImpulsesOf<S, V> step;
    step.push = turnPush<Row, S>(io_row, io_row.push, io_row.target, io_a, io_b, io_change);
    if constexpr (drags) {
        if (isSmooth(io_row.friction)) return step;
        if constexpr (requires { io_row.twist_mass; }) io_row.turnTwist(io_a, io_b);
        const V drag = io_row.dragWithin(slip - io_row.slipping(io_a, io_b), io_row.friction * io_row.push);
        step.drag = drag - io_row.drag, io_row.drag = drag;
        io_row.dragBy(step.drag, io_a, io_b);
        const S square = dot(step.drag, step.drag), inverse = io_row.inverse_a + io_row.inverse_b;
        io_change.add(inverse * inverse * square, io_row.give() * square);
    }
    return step;
}

/// Goes on in the way the rounds have gone: a share of the last way, and to it the last turn's step is added. The next turn brings
/// back what goes too far. With Fletcher's and Reeves' share, what the last round changed over what the one before did, these are
/// the nonsmooth nonlinear conjugate gradients of Silcowitz, Niebe, Erleben, "A Nonsmooth Nonlinear Conjugate Gradient Method for
/// Interactive Contact Force Problems" (2010). A share of 0 begins anew. Returns what it added, of which the motion is to follow.
template <class T> MB_INLINE T goOn(T& io_sum, T& io_way, const T& step, double share) {
    const T by = share * io_way;
    io_sum = io_sum + by, io_way = by + step;
    return by;
}
inline constexpr double kSettled = 1e-24;  // m²/s²: rounds end that change no velocity by more than the root

/// How long rounds go on, and how far each goes on in the way of those before. Where much lies on little, rounds alone creep.
class Pace {
public:
    explicit Pace(int rounds) : rounds_(rounds) {}
    /// After a round that changed so much: whether another is to follow.
    template <class S> MB_INLINE bool more(const Change<S>& changed) {
        const double energy = sum(changed.energy);
        share_ = before_ > 0 && energy <= before_ ? energy / before_ : 0, before_ = energy;
        return ++made_ < rounds_ && largest(changed.fastest) > kSettled;
    }
    double share() const { return share_; }
    int made() const { return made_; }

private:
    int rounds_, made_ = 0;
    double before_ = 0, share_ = 0;
};

}  // namespace mb
