#include "physics/flight.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace mb {
namespace {

constexpr int kEventsAPart = 48;   // of one ball; beyond it the ball waits for the next part
constexpr int kImpactRounds = 60;
constexpr double kNear = 0.25;     // of the radius: static points are looked for within it, and strides are that long

double motionEnergy(const Body& b, const Motion& m) {
    return 0.5 * (glm::dot(m.velocity, m.velocity) / b.inverse_mass + glm::dot(m.spin, m.spin) / b.inverse_inertia);
}

}  // namespace

void NearStatics::moveTo(const StaticField& field, glm::dvec3 position, double radius) {
    if (at == position) return;
    at = position;
    free = field.touches(position, radius, kNear * radius, touches);
}

Flight::Flight(std::vector<Body>& bodies, std::vector<NearStatics>& near, const StaticField& field, const FlightRules& rules,
               std::span<const Motion> accelerations)
    : bodies_(bodies), near_(near), field_(field), rules_(rules), paths_(bodies.size()), motion_(bodies.size()),
      reach_(bodies.size()), neighbours_(bodies.size()) {
    const double h = rules.duration;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        paths_[i].acceleration = accelerations[i].velocity, paths_[i].turning = accelerations[i].spin;
        const Body& b = bodies[i];
        const double pull = std::max(glm::length(paths_[i].acceleration), std::fabs(rules.world.gravity));
        reach_[i] = {b.position, b.radius + (b.awake ? glm::length(b.velocity) * h + 0.5 * pull * h * h : 0)};
    }
    for (const auto& [i, j] : overlappingPairs(reach_)) {
        neighbours_[static_cast<std::size_t>(i)].push_back(j);
        neighbours_[static_cast<std::size_t>(j)].push_back(i);
    }
}

void Flight::run() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (!bodies_[i].awake) continue;
        expectStatic(i);
        for (const int j : neighbours_[i])
            if (j > static_cast<int>(i) || !bodies_[static_cast<std::size_t>(j)].awake) expectPair(i, static_cast<std::size_t>(j));
    }
    while (!events_.empty()) {
        const Event event = events_.top();
        events_.pop();
        const bool stale = paths_[static_cast<std::size_t>(event.a)].version != event.version_a ||
                           (event.b != kStatic && paths_[static_cast<std::size_t>(event.b)].version != event.version_b);
        if (!stale) meet(event);
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) advance(i, rules_.duration);
}

glm::dvec3 Flight::positionAt(std::size_t i, double t) const {
    if (paths_[i].held || !bodies_[i].awake) return bodies_[i].position;
    const double s = t - paths_[i].time;
    return bodies_[i].position + s * bodies_[i].velocity + (0.5 * s * s) * paths_[i].acceleration;
}

glm::dvec3 Flight::velocityAt(std::size_t i, double t) const {
    if (paths_[i].held || !bodies_[i].awake) return glm::dvec3{0};
    return bodies_[i].velocity + (t - paths_[i].time) * paths_[i].acceleration;
}

void Flight::advance(std::size_t i, double t) {
    Path& path = paths_[i];
    Body& b = bodies_[i];
    const double s = t - path.time;
    if (s > 0 && !path.held && b.awake) {
        b.position = positionAt(i, t);
        b.velocity += s * path.acceleration;
        b.orientation = turned(b.orientation, b.spin + (0.5 * s) * path.turning, s);
        b.spin += s * path.turning;
    }
    path.time = t;
}

/// Looks for the ball's next impact with what does not move.
void Flight::expectStatic(std::size_t i) {
    if (field_.empty() || paths_[i].held || !bodies_[i].awake) return;
    const Body& b = bodies_[i];
    const double from = paths_[i].time, to = rules_.duration;
    const auto gap_at = [&](double t) {
        near_[i].moveTo(field_, positionAt(i, t), b.radius);
        const std::vector<Touch>& touches = near_[i].touches;
        if (touches.empty()) return GapAt{near_[i].free, 0, false};
        // Of points that touch at once the one approached fastest tells, else the nearest.
        const glm::dvec3 v = velocityAt(i, t);
        GapAt g{touches[0].gap, glm::dot(touches[0].normal, v), true};
        for (const Touch& touch : touches)
            if (touch.gap <= 0) g.rate = std::min(g.rate, glm::dot(touch.normal, v));
        return g;
    };
    const double speed = glm::length(b.velocity) + (to - from) * glm::length(paths_[i].acceleration);
    const Meeting m = firstMeeting(gap_at, from, to, {speed, kNear * b.radius, rules_.bounce, restDepth(b.radius)});
    if (m.stuck) paths_[i].events = kEventsAPart;
    if (m.found || m.stuck) events_.push({m.time, static_cast<int>(i), kStatic, paths_[i].version, 0});
}

void Flight::expectPair(std::size_t i, std::size_t j) {
    if (!bodies_[i].awake && !bodies_[j].awake) return;
    const double sum = bodies_[i].radius + bodies_[j].radius;
    const double from = std::max(paths_[i].time, paths_[j].time), to = rules_.duration;
    const auto gap_at = [&](double t) {
        const glm::dvec3 apart = positionAt(i, t) - positionAt(j, t);
        const double d = glm::length(apart);
        const double rate = d > 0 ? glm::dot(apart, velocityAt(i, t) - velocityAt(j, t)) / d : 0;
        return GapAt{d - sum, rate, true};
    };
    // Where both fall freely their relative path is a straight line, along which the gap is convex.
    const glm::dvec3 bend = (paths_[i].held || !bodies_[i].awake ? glm::dvec3{0} : paths_[i].acceleration) -
                            (paths_[j].held || !bodies_[j].awake ? glm::dvec3{0} : paths_[j].acceleration);
    const double speed = glm::length(velocityAt(i, from) - velocityAt(j, from)) + (to - from) * glm::length(bend);
    const double smaller = std::min(bodies_[i].radius, bodies_[j].radius);
    const double stride = bend == glm::dvec3{0} ? speed * (to - from) : kNear * smaller;
    const Meeting m = firstMeeting(gap_at, from, to, {speed, stride, rules_.bounce, restDepth(smaller)});
    if (!m.found) return;
    const auto [a, b] = std::minmax(i, j);
    events_.push({m.time, static_cast<int>(a), static_cast<int>(b), paths_[a].version, paths_[b].version});
}

void Flight::expectAll(std::size_t i) {
    expectStatic(i);
    for (const int j : neighbours_[i]) expectPair(i, static_cast<std::size_t>(j));
}

/// A ball that was made faster may get further than the pairs were looked for.
void Flight::growReach(std::size_t i) {
    const double left = rules_.duration - paths_[i].time;
    const double pull = std::max(glm::length(paths_[i].acceleration), std::fabs(rules_.world.gravity));
    const double reach = glm::length(bodies_[i].position - reach_[i].centre) + bodies_[i].radius +
                         glm::length(bodies_[i].velocity) * left + 0.5 * pull * left * left;
    if (reach <= reach_[i].reach) return;
    reach_[i].reach = reach;
    for (std::size_t j = 0; j < bodies_.size(); ++j) {
        std::vector<int>& mine = neighbours_[i];
        if (j == i || !overlap(reach_[i], reach_[j]) || std::find(mine.begin(), mine.end(), static_cast<int>(j)) != mine.end()) continue;
        mine.push_back(static_cast<int>(j));
        neighbours_[j].push_back(static_cast<int>(i));
    }
}

/// The contacts of one or two balls at this moment: between the two, and with what does not move.
std::vector<Contact> Flight::contactsOf(int a, int b) {
    std::vector<Contact> contacts;
    for (const int i : {a, b}) {
        if (i == kStatic) continue;
        const Body& body = bodies_[static_cast<std::size_t>(i)];
        NearStatics& near = near_[static_cast<std::size_t>(i)];
        near.moveTo(field_, body.position, body.radius);
        for (const Touch& touch : near.touches)
            if (touch.gap <= restDepth(body.radius))
                contacts.push_back({i, kStatic, touch.normal, touch.gap, pairing(rules_.world, body), 0, {}, 0, {}});
    }
    if (b == kStatic) return contacts;
    const Body &x = bodies_[static_cast<std::size_t>(a)], &y = bodies_[static_cast<std::size_t>(b)];
    contacts.push_back({a, b, directionApart(x, y), glm::length(x.position - y.position) - x.radius - y.radius,
                        pairing(rules_.world, x, y), 0, {}, 0, {}});
    return contacts;
}

/// Newton's law of impact at every contact at once, with Coulomb's friction. No energy is made: should several contacts
/// with friction and restitution make some together, they are taken as inelastic. Says whether an approach was fast.
bool Flight::bounceApart(std::vector<Contact>& contacts, int a, int b) {
    const auto load = [&](int i) {
        if (i != kStatic) motion_[static_cast<std::size_t>(i)] = {bodies_[static_cast<std::size_t>(i)].velocity, bodies_[static_cast<std::size_t>(i)].spin};
    };
    const auto energy = [&] {
        double sum = 0;
        for (const int i : {a, b})
            if (i != kStatic) sum += motionEnergy(bodies_[static_cast<std::size_t>(i)], motion_[static_cast<std::size_t>(i)]);
        return sum;
    };
    load(a), load(b);
    const double before = energy();
    bool fast = false;
    for (Contact& c : contacts) {
        const Motion* other = c.b == kStatic ? nullptr : &motion_[static_cast<std::size_t>(c.b)];
        const double approach = -glm::dot(relativeVelocity(bodies_, motion_[static_cast<std::size_t>(c.a)], other, c), c.normal);
        if (approach > rules_.bounce) c.target = c.pairing.restitution * approach, fast = true;
    }
    solve(bodies_, contacts, motion_, kImpactRounds);
    if (energy() > before * (1 + 1e-12)) {
        load(a), load(b);
        for (Contact& c : contacts) c.target = 0, c.push = 0, c.drag = {};
        solve(bodies_, contacts, motion_, kImpactRounds);
    }
    for (const int i : {a, b}) {
        if (i == kStatic) continue;
        bodies_[static_cast<std::size_t>(i)].velocity = motion_[static_cast<std::size_t>(i)].velocity;
        bodies_[static_cast<std::size_t>(i)].spin = motion_[static_cast<std::size_t>(i)].spin;
    }
    return fast;
}

/// Takes from the accelerations what would press the balls further into the contacts they now rest on.
void Flight::support(const std::vector<Contact>& contacts) {
    for (int round = 0; round < 8; ++round) {
        for (const Contact& c : contacts) {
            const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(std::max(c.b, 0));
            const bool pair = c.b != kStatic;
            const glm::dvec3 v = bodies_[a].velocity - (pair ? bodies_[b].velocity : glm::dvec3{0});
            if (glm::dot(v, c.normal) > 1e-9) continue;
            const glm::dvec3 acceleration = paths_[a].acceleration - (pair ? paths_[b].acceleration : glm::dvec3{0});
            const double press = -glm::dot(acceleration, c.normal);
            if (press <= 0) continue;
            const double ma = bodies_[a].inverse_mass, mb = pair ? bodies_[b].inverse_mass : 0;
            paths_[a].acceleration += (press * ma / (ma + mb)) * c.normal;
            if (pair) paths_[b].acceleration -= (press * mb / (ma + mb)) * c.normal;
        }
    }
}

/// Leaves a ball where it is for the rest of the part, with its velocity: neither energy nor a wall is lost by that.
void Flight::hold(std::size_t i) {
    if (!paths_[i].held) ++held;
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
        paths_[k].turning = {};
        if (fast) paths_[k].acceleration = {0, -rules_.world.gravity, 0};
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
