#include "physics/body.h"

#include <glm/matrix.hpp>

#include <optional>

namespace mb {

glm::dmat3 Body::worldInverseInertia() const {
    if (isBall()) return inverse_inertia;
    const glm::dmat3 r = glm::mat3_cast(orientation);
    return r * inverse_inertia * glm::transpose(r);
}

namespace {
const OwnSurface& ownOf(const Body& b) {
    static const OwnSurface nothing;
    return b.own ? *b.own : nothing;
}
}  // namespace

Pairing ownPairing(const World& world, const Body& body) {
    const OwnSurface& a = ownOf(body);
    return {a.restitution.value_or(world.restitution), a.friction.value_or(world.friction), a.rolling.value_or(world.rolling),
            a.spinning.value_or(world.spinning)};
}

Pairing ownPairing(const World& world, const Body& body_a, const Body& body_b) {
    const OwnSurface &a = ownOf(body_a), &b = ownOf(body_b);
    const auto both = [](const std::optional<double>& x, const std::optional<double>& y, double of_world, auto join) {
        return x && y ? join(*x, *y) : x.value_or(y.value_or(of_world));
    };
    const auto greater = [](double x, double y) { return std::max(x, y); };
    const auto mean = [](double x, double y) { return std::sqrt(x * y); };
    return {both(a.restitution, b.restitution, world.restitution, greater), both(a.friction, b.friction, world.friction, mean),
            both(a.rolling, b.rolling, world.rolling, mean), both(a.spinning, b.spinning, world.spinning, mean)};
}

glm::dvec3 angularMomentum(const Body& body, glm::dvec3 spin) {
    if (body.isBall()) return body.inertia[0][0] * spin;
    const glm::dmat3 r = glm::mat3_cast(body.orientation);
    return r * (body.inertia * (spin * r));
}

double kineticEnergy(const Body& body, const Motion& m) {
    return 0.5 * (glm::dot(m.velocity, m.velocity) / body.inverse_mass + glm::dot(m.spin, angularMomentum(body, m.spin)));
}

glm::dquat turned(const glm::dquat& orientation, const glm::dvec3& spin, double time) {
    // A turn by an angle is (1, tan(angle/2)·axis), made a unit. tan x = x(15 − x²)/(15 − 6x²) errs by x⁷/1575
    // (Padé approximant [3/2]); the angle is halved until x ≤ 1/8, and the turn squared as often.
    glm::dvec3 half = 0.5 * time * spin;
    int halvings = 0;
    for (; glm::dot(half, half) > 0.125 * 0.125 && halvings < 40; ++halvings) half *= 0.5;
    const double x2 = glm::dot(half, half);
    if (x2 == 0) return orientation;
    const glm::dvec3 tangent = half * ((15 - x2) / (15 - 6 * x2));
    glm::dquat turn{1, tangent.x, tangent.y, tangent.z};
    for (; halvings > 0; --halvings) turn = glm::normalize(turn * turn);
    return glm::normalize(turn * orientation);
}

double turningSpeedOfShape(const Body& body) {
    if (body.spin == glm::dvec3{0}) return 0;
    const glm::dvec3 spin = body.spin * glm::mat3_cast(body.orientation), momentum = body.inertia * spin;
    const double energy = glm::dot(spin, momentum), size = glm::length(momentum);  // twice the energy
    const Box& box = body.solid->box;
    glm::dvec3 most, half;
    double easiest = 0;  // no eigenvalue of the inverse inertia is greater (Gershgorin's circles)
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 row = glm::abs(body.inverse_inertia[k]);
        easiest = std::fmax(easiest, row.x + row.y + row.z);
        most[k] = std::fmin(std::sqrt(energy * row[k]), size * glm::length(row));
        half[k] = std::fmax(std::fabs(box.lo[k]), std::fabs(box.hi[k]));
    }
    const double whole = std::fmin(std::sqrt(energy * easiest), size * easiest);
    const glm::dvec3 speed{most.y * half.z + most.z * half.y, most.z * half.x + most.x * half.z, most.x * half.y + most.y * half.x};
    return (1 + 1e-9) * std::fmin(glm::length(speed), body.radius * whole);
}

namespace {

constexpr double kMostAngle = 0.1;  // of one of many turns, rad: its own error is the cube of it over twelve
constexpr int kMostTurns = 1024;

/// The eigenvalues of an inverse inertia two of which are equal, 1/(kg·m²).
struct Symmetric {
    double across = 0, along = 0;   // the double one, and that of the axis
    glm::dvec3 axis{1, 0, 0};       // unit
};

/// Nothing where no two are equal, to a billionth of the greatest.
std::optional<Symmetric> symmetryOf(const glm::dmat3& inverse) {
    double trace = 0, squares = 0;
    for (int k = 0; k < 3; ++k) trace += inverse[k][k], squares += glm::dot(inverse[k], inverse[k]);
    const double apart = std::sqrt(std::fmax(0.5 * (3 * squares - trace * trace), 0));
    for (const double by : {apart, -apart}) {
        Symmetric s{(trace - by) / 3, (trace + 2 * by) / 3};
        const glm::dmat3 left = inverse - glm::dmat3{s.across}, product = left * (inverse - glm::dmat3{s.along});
        double error = 0, longest = 0;
        for (int k = 0; k < 3; ++k) {
            error = std::fmax(error, glm::length(product[k]));
            if (const double l = glm::length(left[k]); l > longest) longest = l, s.axis = left[k] / l;
        }
        if (error <= 1e-9 * trace * trace) return s;
    }
    return {};
}

/// A turn too long to be made of short ones. The angular momentum is kept to rounding, and so is the energy. Where the body has an axis
/// of symmetry the turn is the true one: about the angular momentum, then about that axis (Landau, Lifshitz, "Mechanics", 1960, section
/// 33). Else the body is turned about its angular momentum alone, no faster than any of its points truly gets: as many as sixteen whole
/// turns in one part of a step leave its attitude unknown.
void turnFar(const Body& body, glm::dquat& io_orientation, glm::dvec3& io_spin, double time) {
    const glm::dvec3 momentum = angularMomentum(body, io_spin);
    const glm::dmat3& inverse = body.inverse_inertia;
    const glm::dmat3 before = glm::mat3_cast(io_orientation);
    if (const std::optional<Symmetric> s = symmetryOf(inverse)) {
        io_orientation = turned(io_orientation, s->across * momentum, time);
        const double own = (s->along - s->across) * glm::dot(before * s->axis, momentum);
        io_orientation = glm::normalize(io_orientation * turned({1, 0, 0, 0}, own * s->axis, time));
    } else {
        double slowest = INFINITY;  // no eigenvalue of the inverse inertia is less (Gershgorin's circles)
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 row = glm::abs(body.inertia[k]);
            slowest = std::fmin(slowest, 1 / (row.x + row.y + row.z));
        }
        io_orientation = turned(io_orientation, slowest * momentum, time);
    }
    const glm::dmat3 after = glm::mat3_cast(io_orientation);
    io_spin = after * (inverse * (momentum * after));
}

}  // namespace

void turnFreely(const Body& body, glm::dquat& io_orientation, glm::dvec3& io_spin, double time) {
    if (io_spin == glm::dvec3{0}) return;
    if (body.isBall()) {
        io_orientation = turned(io_orientation, io_spin, time);
        return;
    }
    const double angle = glm::length(io_spin) * time;
    if (!(angle <= kMostAngle * kMostTurns)) return turnFar(body, io_orientation, io_spin, time);
    const int turns = static_cast<int>(std::ceil(angle / kMostAngle));
    // In the body's frame the angular momentum m goes by m' = m × I⁻¹m. The implicit midpoint rule keeps |m|² and m·I⁻¹m, and
    // the turn that goes with it, (1, h/2·I⁻¹(m₀ + m₁)/2) made a unit, takes m₁ in the new frame to m₀ in the old one.
    constexpr int kRounds = 20;
    const double h = time / std::max(turns, 1);
    const glm::dmat3 before = glm::mat3_cast(io_orientation);
    glm::dvec3 m = body.inertia * (io_spin * before);
    for (int i = 0; i < turns; ++i) {
        glm::dvec3 next = m;
        for (int round = 0; round < kRounds; ++round) {
            const glm::dvec3 mean = 0.5 * (m + next), better = m + h * glm::cross(mean, body.inverse_inertia * mean);
            if (better == next) break;
            next = better;
        }
        const glm::dvec3 half = (0.5 * h) * (body.inverse_inertia * (0.5 * (m + next)));
        io_orientation = glm::normalize(io_orientation * glm::normalize(glm::dquat{1, half.x, half.y, half.z}));
        m = next;
    }
    io_spin = glm::mat3_cast(io_orientation) * (body.inverse_inertia * m);
}

}  // namespace mb
