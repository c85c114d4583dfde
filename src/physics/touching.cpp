// Which bodies touch at the start of a part, or will within it.
#include "core/effects/effect.h"
#include "core/measure/parallel.h"
#include "physics/world.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace mb {

/// Contacts at the start of a part of length h; the pairs behind the static ones. Of those that are met in flight, only what touches
/// now; of the others also what lies ahead.
std::span<Contact> PhysicsWorld::touching(double h) {
    scratch_.found.clear();
    memory_.begin();
    const FlightRules rules = rulesFor(h);
    scratch_.travel.clear(), scratch_.ids.clear();
    for (const Body& b : bodies_) scratch_.travel.push_back(b.awake ? travelOf(b, rules) : 0), scratch_.ids.push_back(b.object.value);
    if (has(Stage::static_contacts)) findAll(bodies_.size(), [&](std::size_t i, Found& io_found) { touchStatics(i, rules, io_found); });
    if (has(Stage::broad_phase)) touchBodies(rules);
    if (!allBalls()) remember(), noteWaysOut();
    return scratch_.found;
}

/// Of what sleeps nothing is asked, and nothing is forgotten.
void PhysicsWorld::remember() {
    std::vector<std::uint32_t> asleep;
    for (const Body& b : bodies_)
        if (!b.awake) asleep.push_back(b.object.value);
    std::ranges::sort(asleep);
    memory_.end(asleep);
}

void PhysicsWorld::noteWaysOut() {
    const auto name = [&](int i) { return bodies_[static_cast<std::size_t>(i)].name; };
    constexpr int kNamed = 8;  // of a heap of bodies in one place some tell enough
    for (const Contact& c : scratch_.found) {
        if (!c.way_out || ways_named_ > kNamed) continue;
        const std::size_t before = notes_.size();
        if (ways_named_ == kNamed) note("more are so deep in one another, which are not named");
        else note(fmt::format("{}: so deep in {} that no surface of theirs faces the other's; moved out a straight way, at {} m/s at most", name(c.a),
                              c.b == kStatic ? "what does not move" : name(c.b), kPushOutSpeed));
        ways_named_ += notes_.size() > before;
    }
}

/// Appends what is found of the first `count` things, in their order, whichever thread finds it: find(i, io_found) adds what there is
/// of i. Balls alone are found sooner than threads begin.
template <class Find> void PhysicsWorld::findAll(std::size_t count, Find find) {
    constexpr std::size_t kLeast = 8;  // things of a share
    const std::size_t shares = allBalls() || threads_ <= 1 ? 1 : std::clamp<std::size_t>(count / kLeast, 1, 8 * threads_);
    std::vector<Found> found(shares, Found(memory_));
    if (shares == 1) std::swap(found[0].contacts, scratch_.found);
    inParallel(threads_, shares, [&](std::size_t k, bool) {
        for (std::size_t i = count * k / shares; i < count * (k + 1) / shares; ++i) find(i, found[k]);
    });
    if (shares == 1) std::swap(found[0].contacts, scratch_.found);
    for (Found& f : found) {
        scratch_.found.insert(scratch_.found.end(), f.contacts.begin(), f.contacts.end());
        memory_.add(std::move(f.memory));
        counts_.add(f.counts);
    }
}

void PhysicsWorld::touchStatics(std::size_t i, const FlightRules& rules, Found& io_found) {
    const Body& b = bodies_[i];
    if (!b.awake) return;
    const double travel = scratch_.travel[i];
    const bool flown = metInFlight(b, rules, travel);
    const double ahead = restDepth(b.inner) + (flown ? 0 : travel);
    const double margin = b.isBall() ? std::min(ahead, kNear * b.radius) : ahead;
    if (choice_.proofs && near_[i].roomAt(b.position, b.radius) > margin) return;
    const Collider collider(world_, field_, io_found.counts, &io_found.memory);
    const std::size_t before = io_found.contacts.size();
    collider.withStatics(static_cast<int>(i), b, b.shapePose(), margin, near_[i], io_found.contacts);
    for (std::size_t k = before; k < io_found.contacts.size(); ++k) io_found.contacts[k].flown = flown;
}

/// How far around its centre a body may come to be within a time, against bodies that drift, m.
Reach PhysicsWorld::reachOf(std::size_t i, glm::dvec3 drift, double pull, double time) const {
    const Body& b = bodies_[i];
    const double fastest = glm::length(b.velocity - drift) + turningSpeed(b) + std::max(pull, std::fabs(world_.gravity)) * time;
    return {b.position, b.radius + restDepth(b.inner) + fastest * time};
}

/// Sees to it that the list of pairs holds through the part. What is found anew is good for some
/// steps, unless something is made faster.
/// `accelerations`: of the bodies, if they are known.
void PhysicsWorld::coverPairs(double h, std::span<const Motion> accelerations) {
    const auto needs = [&](std::size_t i) {
        return reachOf(i, pairs_.drift(), accelerations.empty() ? 0 : glm::length(accelerations[i].velocity), h);
    };
    if (pairs_.holds(bodies_.size(), needs)) return;
    constexpr double kMore = 0.05, kAhead = 8;  // of the radius; steps
    glm::dvec3 drift{0};
    for (const Body& b : bodies_) drift += b.velocity / static_cast<double>(bodies_.size());
    std::vector<Reach> reach;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const double pull = accelerations.empty() ? 0 : glm::length(accelerations[i].velocity);
        reach.push_back(reachOf(i, drift, pull, kAhead * knobs_.dt));
        reach.back().reach += kMore * bodies_[i].radius;
    }
    pairs_.find(std::move(reach), drift);
    ++counts_.broad_phases, counts_.pairs += pairs_.pairs().size();
}

void PhysicsWorld::touchBodies(const FlightRules& rules) {
    coverPairs(rules.duration);
    if (!has(Stage::body_contacts)) return;
    std::vector<Reach>& reach = scratch_.reach;
    reach.clear();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& b = bodies_[i];
        reach.push_back({b.position, b.radius + restDepth(b.inner) + scratch_.travel[i]});
    }
    std::vector<std::pair<int, int>>& near = scratch_.near;
    near.resize(std::max(near.size(), pairs_.pairs().size()));
    std::size_t count = 0;
    for (const auto& [i, j] : pairs_.pairs()) {
        const Reach &a = reach[static_cast<std::size_t>(i)], &b = reach[static_cast<std::size_t>(j)];
        const glm::dvec3 apart = a.centre - b.centre;
        const double most = a.reach + b.reach;
        near[count] = {i, j}, count += glm::dot(apart, apart) <= most * most;  // no branch, which would be guessed wrong
    }
    findAll(count, [&](std::size_t k, Found& io_found) { touchPair(near[k].first, near[k].second, rules, io_found); });
}

void PhysicsWorld::touchPair(int i, int j, const FlightRules& rules, Found& io_found) {
    const Body &a = bodies_[static_cast<std::size_t>(i)], &b = bodies_[static_cast<std::size_t>(j)];
    const bool balls = allBalls() || (a.isBall() && b.isBall());
    const Pairing pair = owners_ == 0 ? pairing(world_) : pairing(world_, a, b);
    const double travel = travelBetween(a, b, rules, balls), inner = std::min(a.inner, b.inner);
    const bool flown = metInFlight(balls, inner, pair, rules, travel);
    const double margin = restDepth(inner) + (flown ? 0 : travel);
    const Collider collider(world_, field_, io_found.counts, &io_found.memory);
    const std::size_t before = io_found.contacts.size();
    if (balls) collider.betweenBalls(i, a, j, b, pair, margin, io_found.contacts);
    else collider.between(i, a, a.shapePose(), j, b, b.shapePose(), margin, io_found.contacts);
    for (std::size_t n = before; n < io_found.contacts.size(); ++n) io_found.contacts[n].flown = flown;
}

}  // namespace mb
