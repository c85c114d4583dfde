#include "physics/flight.h"

#include "core/effects/effect.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace mb {

Flight::Flight(std::vector<Body>& bodies, std::vector<NearStatics>& near, const StaticField& field, const FlightRules& rules,
               std::span<const Motion> accelerations, StepCounts& io_counts)
    : bodies_(bodies), near_(near), field_(field), rules_(rules), counts_(io_counts), paths_(bodies.size()) {
    for (std::size_t i = 0; i < bodies.size(); ++i)
        paths_[i].acceleration = accelerations[i].velocity, paths_[i].turning = accelerations[i].spin;
    if (!has(Stage::continuous)) return;
    motion_.resize(bodies.size());
    neighbours_.resize(bodies.size());
    if (has(Stage::broad_phase)) findNeighbours();
}

/// The pairs that may meet within the part.
void Flight::findNeighbours() {
    const double h = rules_.duration;
    reach_.resize(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& b = bodies_[i];
        const double pull = std::max(glm::length(paths_[i].acceleration), std::fabs(rules_.world.gravity));
        reach_[i] = {b.position, b.radius + (b.awake ? glm::length(b.velocity) * h + 0.5 * pull * h * h : 0)};
    }
    const std::vector<std::pair<int, int>> pairs = overlappingPairs(reach_);
    ++counts_.broad_phases, counts_.pairs += pairs.size();
    if (!has(Stage::body_contacts)) return;
    for (const auto& [i, j] : pairs) {
        neighbours_[static_cast<std::size_t>(i)].push_back(j);
        neighbours_[static_cast<std::size_t>(j)].push_back(i);
    }
}

void Flight::run() {
    if (has(Stage::continuous)) {
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            if (!bodies_[i].awake) continue;
            expectStatic(i);
            for (const int j : neighbours_[i])
                if (j > static_cast<int>(i) || !bodies_[static_cast<std::size_t>(j)].awake) expectPair(i, static_cast<std::size_t>(j));
        }
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
        ++counts_.integrations;
        b.position = positionAt(i, t);
        b.velocity += s * path.acceleration;
        if (has(Stage::spin)) {
            ++counts_.turned;
            b.orientation = turned(b.orientation, b.spin + (0.5 * s) * path.turning, s);
            b.spin += s * path.turning;
        }
    }
    path.time = t;
}

/// Looks for the ball's next impact with what does not move.
void Flight::expectStatic(std::size_t i) {
    if (!has(Stage::static_contacts) || field_.empty() || paths_[i].held || !bodies_[i].awake) return;
    const Body& b = bodies_[i];
    const double from = paths_[i].time, to = rules_.duration;
    const double speed = glm::length(b.velocity) + (to - from) * glm::length(paths_[i].acceleration);
    const ApproachLimits limits{speed, kNear * b.radius, rules_.bounce, restDepth(b.radius)};
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
    ++counts_.searches;
    const Meeting m = firstMeeting(gap_at, from, to, limits);
    if (m.stuck) paths_[i].events = kEventsAPart;
    if (m.found || m.stuck) events_.push({m.time, static_cast<int>(i), kStatic, paths_[i].version, 0});
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
    const ApproachLimits limits{speed, stride, rules_.bounce, restDepth(smaller)};
    ++counts_.body_gaps;
    if (rules_.proofs) {
        // No field is asked: what errs is the rounding of the positions.
        const double error = 1e-6 * gapError(bodies_[i].position, sum), gap = gap_at(from).gap;
        if (cannotReach(gap - error, to - from, limits, smaller) || restsThrough(to - from, limits, error)) return;
    }
    ++counts_.searches;
    const Meeting m = firstMeeting(gap_at, from, to, limits);
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
