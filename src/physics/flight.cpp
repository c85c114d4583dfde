#include "physics/flight.h"

#include "core/effects/effect.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace mb {

namespace {

// Of the depth: a ball's gap is known to rounding; of two curved shapes the lowest place is looked for, and not met exactly.
constexpr double kBallNoise = 1e-3, kShapeNoise = 0.25;
// Of the radius: a ball that was struck on its way, and gets no further before the part ends, meets what it meets then in the next
// one. Else a fast ball that falls into a pile would be felt through all of it within a part, impact by impact.
constexpr double kStruck = 0.02;
// The same of a shape, of half its thickness: less than what is thin, as a shell, may hide.
constexpr double kStruckShape = 0.005;
constexpr double kWider = 8;  // times as far is looked where a shape meets nothing

glm::dvec3 positionAfter(const Body& b, const glm::dvec3& acceleration, double time) {
    return b.position + time * b.velocity + (0.5 * time * time) * acceleration;
}

/// Turns a body at an angular acceleration: half-way through it is given all that adds to its spin (carry.cpp).
void turn(const Body& body, glm::dquat& io_orientation, glm::dvec3& io_spin, const glm::dvec3& acceleration, double time) {
    if (acceleration == glm::dvec3{0}) return turnFreely(body, io_orientation, io_spin, time);
    turnFreely(body, io_orientation, io_spin, 0.5 * time);
    io_spin += time * acceleration;
    turnFreely(body, io_orientation, io_spin, 0.5 * time);
}
}  // namespace

Flight::Flight(std::vector<Body>& bodies, std::vector<NearStatics>& near, const StaticField& field, const FlightRules& rules,
               std::span<const Motion> accelerations, std::span<const std::pair<int, int>> pairs, StepCounts& io_counts)
    : bodies_(bodies), near_(near), field_(field), rules_(rules), counts_(io_counts), collider_(rules.world, field, io_counts),
      paths_(bodies.size()), pairs_(pairs) {
    const glm::dvec3 fall = rules.world.fall();
    for (std::size_t i = 0; i < bodies.size(); ++i)
        paths_[i].acceleration = accelerations[i].velocity, paths_[i].turning = accelerations[i].spin,
        paths_[i].carried = bodies[i].awake && accelerations[i].velocity != fall;
}

/// Where each body may get within the part, and whom it may meet there: before anything is advanced.
void Flight::rememberReach() {
    if (!has(Stage::broad_phase) || !reach_.empty()) return;
    const double h = rules_.duration;
    reach_.resize(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& b = bodies_[i];
        const double pull = std::max(glm::length(paths_[i].acceleration), std::fabs(rules_.world.gravity));
        reach_[i] = {b.position, b.radius + (b.awake ? glm::length(b.velocity) * h + 0.5 * pull * h * h : 0)};
    }
    neighbours_.resize(bodies_.size());
    for (const auto& [i, j] : pairs_) {
        neighbours_[static_cast<std::size_t>(i)].push_back(j);
        neighbours_[static_cast<std::size_t>(j)].push_back(i);
    }
}

bool anyMetInFlight(std::span<const Body> bodies, const FlightRules& rules) {
    double furthest = 0, thinnest = INFINITY;
    for (const Body& b : bodies) {
        if (b.isBall() && pairing(rules.world, b).restitution != 0) return true;
        furthest = std::max(furthest, travelOf(b, rules)), thinnest = std::min(thinnest, b.inner);
    }
    return 2 * furthest > kNear * thinnest;
}

void Flight::run() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) expectStatic(i);
    std::vector<double> travel;
    for (const Body& b : bodies_) travel.push_back(b.isBall() && pairing(rules_.world, b).restitution != 0 ? INFINITY : travelOf(b, rules_));
    for (const auto& [i, j] : pairs_) {
        const auto k = static_cast<std::size_t>(i), l = static_cast<std::size_t>(j);
        if (travel[k] + travel[l] > kNear * std::min(bodies_[k].inner, bodies_[l].inner)) expectPair(k, l);
    }
    if (!events_.empty()) motion_.resize(bodies_.size()), rememberReach();
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
    return positionAfter(bodies_[i], paths_[i].acceleration, t - paths_[i].time);
}

/// Where a body is at a time, turned as it will be.
Pose Flight::poseAt(std::size_t i, double t) const {
    Pose pose{positionAt(i, t), glm::dmat3{1}};
    const Body& b = bodies_[i];
    if (b.isBall()) return pose;
    glm::dquat orientation = b.orientation;
    glm::dvec3 spin = b.spin;
    const double s = t - paths_[i].time;
    if (s > 0 && !paths_[i].held && b.awake && has(Stage::spin)) {
        turn(b, orientation, spin, paths_[i].turning, s);
    }
    pose.rotation = glm::mat3_cast(orientation);
    return pose;
}

Motion Flight::motionAt(std::size_t i, double t) const {
    if (paths_[i].held || !bodies_[i].awake) return {};
    return {velocityAt(i, t), bodies_[i].spin + (t - paths_[i].time) * paths_[i].turning};
}

/// No point of the body is faster than this until the end of the part, m/s.
double Flight::fastest(std::size_t i) const {
    if (paths_[i].held || !bodies_[i].awake) return 0;
    const Body& b = bodies_[i];
    const double left = rules_.duration - paths_[i].time;
    const double turned = b.isBall() ? 0 : b.radius * left * glm::length(paths_[i].turning);
    return glm::length(b.velocity) + left * glm::length(paths_[i].acceleration) + turningSpeed(b) + turned;
}

glm::dvec3 Flight::velocityAt(std::size_t i, double t) const {
    if (paths_[i].held || !bodies_[i].awake) return glm::dvec3{0};
    return bodies_[i].velocity + (t - paths_[i].time) * paths_[i].acceleration;
}

void advance(Body& io_body, const Motion& acceleration, double time, bool spins, StepCounts& io_counts) {
    if (!(time > 0) || !io_body.awake) return;
    ++io_counts.integrations;
    io_body.position = positionAfter(io_body, acceleration.velocity, time);
    io_body.velocity += time * acceleration.velocity;
    if (!spins) return;
    ++io_counts.turned;
    turn(io_body, io_body.orientation, io_body.spin, acceleration.spin, time);
}

void Flight::advance(std::size_t i, double t) {
    Path& path = paths_[i];
    if (!path.held) mb::advance(bodies_[i], {path.acceleration, path.turning}, t - path.time, has(Stage::spin), counts_);
    path.time = t;
}

/// Looks for the body's next impact with what does not move.
void Flight::expectStatic(std::size_t i) {
    if (!has(Stage::static_contacts) || field_.empty() || paths_[i].held || !bodies_[i].awake) return;
    const Body& b = bodies_[i];
    if (!b.isBall()) return expectStaticOfShape(i);
    const double from = paths_[i].time, to = rules_.duration;
    const double speed = glm::length(b.velocity) + (to - from) * glm::length(paths_[i].acceleration);
    if (!metInFlight(b, rules_) && (paths_[i].events == 0 || speed * (to - from) <= kStruck * b.inner)) return;
    const ApproachLimits limits{speed, kNear * b.radius, rules_.bounce, restDepth(b.inner), kBallNoise};
    if (rules_.proofs && noStaticAhead(i, to - from, limits)) return;
    const auto gap_at = [&](double t) {
        near_[i].moveTo(field_, positionAt(i, t), b.radius, counts_);
        const std::vector<Touch>& touches = near_[i].touches();
        if (touches.empty()) return GapAt{near_[i].free(), 0, false};
        // Of points that touch at once the one approached fastest tells, else the nearest.
        const glm::dvec3 v = velocityAt(i, t);
        GapAt g{touches[0].gap, glm::dot(touches[0].normal, v), true};
        for (const Touch& touch : touches)
            if (touch.gap <= 0) g.rate = std::min(g.rate, glm::dot(touch.normal, v));
        return g;
    };
    expect(firstMeeting(gap_at, from, to, limits), i, i);
}

/// What a search found: an impact, or that it gave up, and then those two wait where they are known to be free. j = i: what does not move.
void Flight::expect(const Meeting& m, std::size_t i, std::size_t j) {
    ++counts_.searches;
    if (!m.found && !m.stuck) return;
    if (m.stuck) paths_[i].events = paths_[j].events = kEventsAPart;
    const auto [a, b] = std::minmax(i, j);
    events_.push({m.time, static_cast<int>(a), i == j ? kStatic : static_cast<int>(b), paths_[a].version, i == j ? 0 : paths_[b].version});
}

/// Whether it is proved that the search along the ball's path finds nothing: the ball creeps, or has room. The field is asked
/// only where the room it last proved does not tell.
bool Flight::noStaticAhead(std::size_t i, double duration, const ApproachLimits& limits) {
    const Body& b = bodies_[i];
    if (restsThrough(duration, limits, gapError(b.position, b.radius))) return true;
    if (cannotReach(near_[i].roomAt(b.position, b.radius), duration, limits, b.radius)) return true;
    near_[i].moveTo(field_, b.position, b.radius, counts_);
    return cannotReach(near_[i].roomAt(b.position, b.radius), duration, limits, b.radius);
}

void Flight::expectPair(std::size_t i, std::size_t j) {
    if (!bodies_[i].awake && !bodies_[j].awake) return;
    if (!bodies_[i].isBall() || !bodies_[j].isBall()) return expectPairOfShapes(i, j);
    const bool struck = paths_[i].events != 0 || paths_[j].events != 0, met = metInFlight(bodies_[i], bodies_[j], rules_);
    if (!met && !struck) return;
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
    if (!met && speed * (to - from) <= kStruck * smaller) return;
    const double stride = bend == glm::dvec3{0} ? speed * (to - from) : kNear * smaller;
    const ApproachLimits limits{speed, stride, rules_.bounce, restDepth(smaller), kBallNoise};
    ++counts_.body_gaps;
    if (rules_.proofs) {
        // No field is asked: what errs is the rounding of the positions.
        const double error = 1e-6 * gapError(bodies_[i].position, sum), gap = gap_at(from).gap;
        if (cannotReach(gap - error, to - from, limits, smaller) || restsThrough(to - from, limits, error)) return;
    }
    expect(firstMeeting(gap_at, from, to, limits), i, j);
}

/// The gap of a shape to what does not move (j = i), or of two bodies of which one is a shape.
GapAt Flight::shapeGap(std::size_t i, std::size_t j, double t, double margin) {
    const bool alone = i == j;
    const Pose at = poseAt(i, t), other = alone ? Pose{} : poseAt(j, t);
    const double room = alone ? field_.room(at.position, bodies_[i].radius)
                              : glm::length(at.position - other.position) - bodies_[i].radius - bodies_[j].radius;
    if (room > margin) return {room, 0, false};
    std::vector<Contact> contacts;
    const auto look = [&](double within) {
        if (alone) collider_.withStatics(static_cast<int>(i), bodies_[i], at, within, near_[i], contacts);
        else collider_.between(static_cast<int>(i), bodies_[i], at, static_cast<int>(j), bodies_[j], other, within, contacts);
    };
    look(margin);
    if (contacts.empty()) {
        // What is much thinner than wide would take thousands of strides through an empty room.
        const double smaller = alone ? bodies_[i].radius : std::min(bodies_[i].radius, bodies_[j].radius);
        const double ahead = std::min((fastest(i) + (alone ? 0 : fastest(j))) * (rules_.duration - t), 0.25 * smaller);
        double free = margin;
        for (double within = kWider * margin; within < ahead; within *= kWider) {
            look(within);
            if (!contacts.empty()) break;
            free = within;
        }
        return {free, 0, false};
    }
    // Of points that touch at once the one approached fastest tells, else the nearest.
    GapAt g{INFINITY, 0, true};
    for (const Contact& c : contacts) {
        const Motion a = motionAt(static_cast<std::size_t>(c.a), t), b = c.b == kStatic ? Motion{} : motionAt(static_cast<std::size_t>(c.b), t);
        const double rate = glm::dot(relativeVelocity(a, c.b == kStatic ? nullptr : &b, c, has(Stage::spin)), c.normal);
        const bool touches = c.gap <= 0 && g.gap <= 0;
        if (touches) g.rate = std::min(g.rate, rate), g.gap = std::min(g.gap, c.gap);
        else if (c.gap < g.gap) g.gap = c.gap, g.rate = rate;
    }
    return g;
}

/// How deep a slow shape is let in, m. Where it keeps meeting something slowly, as between the edges it rests on, ever deeper: at such
/// speed it does not get far within the part, and the next moves it out.
double Flight::depthOf(std::size_t i, std::size_t j) const {
    constexpr double kCarried = 0.1;   // of what gravity gets it to: where its contacts carry it, they are met no sooner
    constexpr double kShallow = 0.05;  // of half the thickness; and where that is not sure, no deeper
    const double inner = std::min(bodies_[i].inner, bodies_[j].inner);
    const double far = rules_.bounce * rules_.duration, carried = std::clamp(kCarried * far, restDepth(inner), kShallow * inner);
    const double first = paths_[i].carried || paths_[j].carried ? carried : restDepth(inner);
    return far > kShallow * inner ? first : std::ldexp(first, std::min(2 * std::max(paths_[i].slow, paths_[j].slow), 16));
}

void Flight::expectStaticOfShape(std::size_t i) {
    const Body& b = bodies_[i];
    const double from = paths_[i].time, to = rules_.duration, speed = fastest(i), stride = kNear * b.inner;
    if (!metInFlight(b, rules_) && (paths_[i].events == 0 || speed * (to - from) <= kStruckShape * b.inner)) return;
    const ApproachLimits limits{speed, stride, rules_.bounce, depthOf(i, i), kShapeNoise};
    if (rules_.proofs && cannotReach(field_.room(positionAt(i, from), b.radius), to - from, limits, b.radius)) return;
    expect(firstMeeting([&](double t) { return shapeGap(i, i, t, stride); }, from, to, limits), i, i);
}

void Flight::expectPairOfShapes(std::size_t of_i, std::size_t of_j) {
    const auto [i, j] = std::minmax(of_i, of_j);  // as the impact will see them
    const Body &x = bodies_[i], &y = bodies_[j];
    if (!metInFlight(x, y, rules_)) return;
    const double from = std::max(paths_[i].time, paths_[j].time), to = rules_.duration, inner = std::min(x.inner, y.inner);
    const ApproachLimits limits{fastest(i) + fastest(j), kNear * inner, rules_.bounce, depthOf(i, j), kShapeNoise};
    const double room = glm::length(positionAt(i, from) - positionAt(j, from)) - x.radius - y.radius;
    ++counts_.body_gaps;
    if (rules_.proofs && cannotReach(room - 1e-9 * (x.radius + y.radius), to - from, limits, inner)) return;
    const std::size_t first = i, second = j;
    expect(firstMeeting([&](double t) { return shapeGap(first, second, t, limits.stride); }, from, to, limits), i, j);
}

void Flight::expectAll(std::size_t i) {
    expectStatic(i);
    if (neighbours_.empty()) return;
    for (const int j : neighbours_[i]) expectPair(i, static_cast<std::size_t>(j));
}

/// A body that was made faster may get further than the pairs were looked for.
void Flight::growReach(std::size_t i) {
    if (reach_.empty()) return;
    const double left = rules_.duration - paths_[i].time;
    const double pull = std::max(glm::length(paths_[i].acceleration), std::fabs(rules_.world.gravity));
    const double reach = glm::length(bodies_[i].position - reach_[i].centre) + bodies_[i].radius +
                         glm::length(bodies_[i].velocity) * left + 0.5 * pull * left * left;
    if (reach <= reach_[i].reach) return;
    reach_[i].reach = reach;
    if (!has(Stage::body_contacts)) return;
    for (std::size_t j = 0; j < bodies_.size(); ++j) {
        std::vector<int>& mine = neighbours_[i];
        if (j == i || !overlap(reach_[i], reach_[j]) || std::find(mine.begin(), mine.end(), static_cast<int>(j)) != mine.end()) continue;
        mine.push_back(static_cast<int>(j));
        neighbours_[j].push_back(static_cast<int>(i));
    }
}

}  // namespace mb
