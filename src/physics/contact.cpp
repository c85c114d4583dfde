#include "physics/contact.h"

#include "core/effects/effect.h"
#include "physics/random.h"
#include "physics/rows.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace mb {
namespace {

constexpr double kTogether = 1e-12;  // of the sum of radii: centres so near coincide

template <bool drags, class Row> void start(Row& io_row) {
    const Contact& c = *io_row.contact;
    io_row.normal = c.normal, io_row.target = c.target, io_row.push = c.push, io_row.friction = c.pairing.friction, io_row.drag = c.drag;
    applyFirst<drags>(io_row, *io_row.a, *io_row.b);
    if constexpr (drags && requires { io_row.twist_mass; })
        if (io_row.twist != 0) io_row.twistBy(io_row.twist, *io_row.a, *io_row.b);
}

template <bool drags, class Row> void round(std::vector<Row>& io_rows, Change<double>& io_change) {
    for (Row& row : io_rows) row.step = turn<drags>(row, *row.a, *row.b, row.contact->slip, io_change);
}

template <bool drags, class Row> void goOnAll(std::vector<Row>& io_rows, double share) {
    for (Row& row : io_rows) {
        row.pushBy(goOn(row.push, row.way.push, row.step.push, share), *row.a, *row.b);
        if constexpr (drags)
            if (!isSmooth(row.friction)) row.dragBy(goOn(row.drag, row.way.drag, row.step.drag, share), *row.a, *row.b);
    }
}

/// Gives the impulses back to the contacts.
template <class Row> void finish(const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        row.contact->push = row.push, row.contact->drag = row.drag;
        if constexpr (requires { row.twist; }) row.contact->twist = row.twist;
    }
}

/// The rounds of one island.
template <bool spins, bool drags>
void solveIsland(std::span<const Body> bodies, std::span<Contact> contacts, std::span<Motion> motion, int rounds, StepCounts& io_counts) {
    static thread_local std::vector<BallRow<spins>> ball_rows;  // their memory is used again
    static thread_local std::vector<LeverRow<spins>> lever_rows;
    ball_rows.clear(), lever_rows.clear();
    Motion still;
    std::uint64_t rough = 0;
    for (Contact& c : contacts) {
        Motion &a = motion[static_cast<std::size_t>(c.a)], &b = c.b == kStatic ? still : motion[static_cast<std::size_t>(c.b)];
        if (betweenBalls(bodies, c)) start<drags>(ball_rows.emplace_back(bodies, c, a, b));
        else start<drags>(lever_rows.emplace_back(bodies, c, a, b));
        rough += c.pairing.friction != 0;
    }
    Pace pace(rounds);
    for (;;) {
        Change<double> changed;
        round<drags>(ball_rows, changed), round<drags>(lever_rows, changed);
        if (!pace.more(changed)) break;
        goOnAll<drags>(ball_rows, pace.share()), goOnAll<drags>(lever_rows, pace.share());
    }
    finish(ball_rows), finish(lever_rows);
    io_counts.rounds += static_cast<std::uint64_t>(pace.made());
    if constexpr (drags) io_counts.drags += rough * static_cast<std::uint64_t>(pace.made());
}

/// Island by island: how many rounds one takes is no other's concern.
template <bool spins, bool drags>
void solveIslands(std::span<const Body> bodies, std::span<Contact> contacts, std::span<Motion> motion, int rounds, StepCounts& io_counts) {
    for (std::size_t begin = 0, end = 0; begin < contacts.size(); begin = end) {
        while (end < contacts.size() && contacts[end].island == contacts[begin].island) ++end;
        solveIsland<spins, drags>(bodies, contacts.subspan(begin, end - begin), motion, roundsFor(end - begin, rounds), io_counts);
    }
}

/// How far to go from a motion towards another for no more than that energy, 0 to 1: kinetic energies of the first, the other, and half-way.
double shareWithin(double energy, double of_first, double half_way, double of_other) {
    if (of_other <= energy) return 1;
    if (of_first >= energy) return 0;
    // The parabola through the three; it is convex.
    const double square = 2 * (of_first - 2 * half_way + of_other), slope = 4 * half_way - 3 * of_first - of_other, off = energy - of_first;
    const double root = std::sqrt(std::max(slope * slope + 4 * square * off, 0.0));
    return std::clamp(slope > 0 ? 2 * off / (slope + root) : (root - slope) / (2 * square), 0.0, 1.0);
}

}  // namespace

int roundsFor(std::size_t contacts, int rounds) {
    constexpr std::size_t kAffordable = 1024;  // contacts, times rounds asked for
    return rounds * static_cast<int>(std::clamp<std::size_t>(kAffordable / contacts, 1, 4));
}

bool betweenBalls(std::span<const Body> bodies, const Contact& c) {
    return bodies[static_cast<std::size_t>(c.a)].isBall() && (c.b == kStatic || bodies[static_cast<std::size_t>(c.b)].isBall());
}

glm::dvec3 directionApart(const Body& a, const Body& b) {
    const glm::dvec3 apart = a.position - b.position;
    const double d = glm::length(apart);
    if (d > kTogether * (a.radius + b.radius)) return apart / d;
    Random random(a.object.value * 0x100000000u + b.object.value);
    glm::dvec3 n{random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)};
    return glm::dot(n, n) > 1e-6 ? glm::normalize(n) : glm::dvec3{0, 1, 0};
}

Contact& addBallContact(int a, const Body& body, const glm::dvec3& normal, double gap, const Pairing& pairing, std::vector<Contact>& io_contacts) {
    Contact& c = io_contacts.emplace_back();
    c.a = a, c.normal = normal, c.gap = gap, c.depth = restDepth(body.inner), c.arm_a = -body.radius * normal, c.pairing = pairing;
    return c;
}

Contact& addBallContact(int a, const Body& body_a, int b, const Body& body_b, const Pairing& pairing, std::vector<Contact>& io_contacts) {
    const glm::dvec3 apart = body_a.position - body_b.position;
    const double d = glm::length(apart), sum = body_a.radius + body_b.radius;
    Contact& c = addBallContact(a, body_a, d > kTogether * sum ? apart / d : directionApart(body_a, body_b), d - sum, pairing, io_contacts);
    c.b = b, c.arm_b = body_b.radius * c.normal, c.depth = std::min(c.depth, restDepth(body_b.inner));
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
    const auto rows = spins ? (drags ? solveIslands<true, true> : solveIslands<true, false>)
                            : (drags ? solveIslands<false, true> : solveIslands<false, false>);
    rows(bodies, contacts, motion, rounds, io_counts);
}

void temper(std::span<const Body> bodies, std::span<const Contact> contacts, std::span<const int> members, double most, std::span<Motion> io_motion,
            int rounds, Stages stages, StepCounts& io_counts) {
    const auto energy = [&] {
        double sum = 0;
        for (const int i : members) sum += kineticEnergy(bodies[slot(i)], io_motion[slot(i)]);
        return sum;
    };
    const double bounced = energy();
    if (bounced <= most) return;
    std::vector<Contact> dead(contacts.begin(), contacts.end());
    for (Contact& c : dead) c.target = std::min(c.target, 0.0), c.push = c.twist = 0, c.drag = {};
    std::vector<Motion> full;
    for (const int i : members) full.push_back(io_motion[slot(i)]), io_motion[slot(i)] = motionOf(bodies[slot(i)]);
    solve(bodies, dead, io_motion, rounds, stages, io_counts);
    std::vector<Motion> none;
    for (const int i : members) none.push_back(io_motion[slot(i)]);
    const auto go = [&](double share) {
        for (std::size_t k = 0; k < members.size(); ++k) {
            io_motion[slot(members[k])] = {none[k].velocity + share * (full[k].velocity - none[k].velocity),
                                           none[k].spin + share * (full[k].spin - none[k].spin)};
        }
    };
    const double first = energy();
    go(0.5);
    go(shareWithin(most, first, energy(), bounced));
}

}  // namespace mb
