#include "physics/world.h"

#include "core/effects/effect.h"
#include "physics/hash.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>

namespace mb {
namespace {

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool finite(const glm::dquat& q) { return std::isfinite(q.w) && std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z); }

/// Shortens a vector to at most `most`; says whether it was longer.
bool shorten(glm::dvec3& io_v, double most) {
    const double largest = std::max({std::fabs(io_v.x), std::fabs(io_v.y), std::fabs(io_v.z)});
    if (largest <= 0.5 * most) return false;
    const glm::dvec3 unit = io_v / largest;  // whose length cannot overflow
    const double length = glm::length(unit);
    if (largest <= most / length) return false;
    io_v = unit * (most / length);
    return true;
}

template <class Hash> void addState(Hash& io_hash, const Body& b) {
    io_hash.add(std::uint64_t{b.object.value});
    io_hash.add(b.position), io_hash.add(b.velocity), io_hash.add(b.spin), io_hash.add(b.orientation);
    io_hash.add(b.radius), io_hash.add(b.inverse_mass);
    for (int i = 0; i < 3; ++i) io_hash.add(b.inverse_inertia[i]);
    io_hash.add(std::uint64_t{b.awake}), io_hash.add(static_cast<std::uint64_t>(b.still));
}

}  // namespace

void PhysicsWorld::step() {
    const std::uint64_t before = field_.evaluations();
    for (int i = 0; i < knobs_.substeps; ++i) part(knobs_.dt / knobs_.substeps);
    counts_.evaluations += field_.evaluations() - before;
    ++steps_;
}

/// A contact that gravity alone closes again within two parts is a resting one; and without gravity, one that the solver's rounding does.
double PhysicsWorld::bounceSpeed(double h) const { return std::max(2 * std::fabs(world_.gravity) * h, 1e-9); }

void PhysicsWorld::part(double h) {
    // Sleepers lie still, and only what is awake, or what is done to the world between steps, wakes them. No impulse is kept
    // of one.
    if (choice_.proofs && awake() == 0) {
        contacts_ = 0;
        return;
    }
    if (!grabs_.empty()) pullGrabbed(h);
    tame();
    const std::span<Contact> contacts = touching(h);
    const Islands islands(bodies_.size(), contacts);
    if (has(Stage::sleeping)) wakeAndSleep(islands);
    const std::vector<Motion> accelerations = rest(contacts, islands, h);
    if (has(Stage::flight)) fly(accelerations, h);
    pairs_.pass(h);
    if (has(Stage::sleeping)) countStill(contacts, h), noteStuck(contacts, h);
    leaveOut();
}

/// What lasts of the contacts keeps the bodies up: their accelerations through the part. Crowds are settled, the others carried.
std::vector<Motion> PhysicsWorld::rest(std::span<Contact> contacts, const Islands& islands, double h) {
    std::vector<Motion> accelerations = falling();
    std::vector<Contact>& others = scratch_.others;
    std::vector<std::uint32_t>& crowds = scratch_.crowds;
    others.clear(), crowds.clear();
    const std::vector<std::uint32_t> order = islands.sorted(contacts);
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        const int island = islands.of(contacts[order[begin]]);
        bool balls = true, pairs = false;  // what resists rolling is no crowd
        for (; end < order.size() && islands.of(contacts[order[end]]) == island; ++end) {
            Contact& c = contacts[order[end]];
            balls = balls && (allBalls() || betweenBalls(bodies_, c)) && c.pairing.rolling == 0 && c.pairing.spinning == 0, pairs = pairs || c.b != kStatic;
            c.island = island;
        }
        if (!bodies_[static_cast<std::size_t>(island)].awake) continue;
        for (std::size_t k = begin; k < end; ++k) {
            if (balls && pairs) crowds.push_back(order[k]);
            else others.push_back(contacts[order[k]]);
        }
    }
    if (!others.empty()) {
        pushApart(others, h);
        dropImpacts(others, h);
        stopApproaches(others, h);
        others = carry(others, h, accelerations);
    }
    settleCrowds(contacts, crowds, h, accelerations);
    keep(others, contacts, crowds);
    contacts_ = static_cast<int>(kept_.size());
    return accelerations;
}

/// Fast approaches that are met in flight are the flight's business.
bool PhysicsWorld::isImpact(const Contact& c, const FlightRules& rules) const {
    return c.flown && glm::dot(relativeVelocity(bodies_, c, has(Stage::spin)), c.normal) < -rules.bounce;
}

void PhysicsWorld::dropImpacts(std::vector<Contact>& io_contacts, double h) const {
    const FlightRules rules = rulesFor(h);
    std::erase_if(io_contacts, [&](const Contact& c) { return isImpact(c, rules); });
}

void PhysicsWorld::fly(std::span<const Motion> accelerations, double h) {
    if (!has(Stage::continuous) || !anyMetInFlight(bodies_, rulesFor(h))) {
        for (std::size_t i = 0; i < bodies_.size(); ++i) advance(bodies_[i], accelerations[i], h, has(Stage::spin), counts_);
        return;
    }
    const bool pairs = has(Stage::body_contacts) && has(Stage::broad_phase);
    if (pairs) coverPairs(h, accelerations);
    Flight flight(bodies_, near_, field_, rulesFor(h), accelerations, pairs ? pairs_.pairs() : std::span<const std::pair<int, int>>{}, counts_);
    flight.run();
    impacts_ += static_cast<std::uint64_t>(flight.impacts);
    held_ += flight.held.size();
    for (const int i : flight.held)
        note(fmt::format("{}: could not be followed to the end of a step, and waited there", bodies_[static_cast<std::size_t>(i)].name));
}

/// Takes out bodies that are nowhere, freezes those whose motion is no number, and slows down those beyond the top speed, before any
/// meets another; and remembers where they are.
void PhysicsWorld::tame() {
    static constexpr auto kNowhere = [](const Body& b) { return !finite(b.position) || !finite(b.orientation) || glm::dot(b.position, b.position) > 1e20; };
    constexpr auto kOdd = [](const Body& b) {
        const double v = glm::dot(b.velocity, b.velocity), w = glm::dot(b.spin, b.spin);
        return !(v < 0.5 * kTopSpeed * kTopSpeed && w < 0.5 * kTopSpin * kTopSpin) || kNowhere(b);
    };
    if (std::ranges::any_of(bodies_, kOdd)) {
        for (const Body& b : bodies_)
            if (kNowhere(b)) note(fmt::format("{}: removed at {} s, its place is no number", b.name, time_s()));
        removeWhere(kNowhere);
        freezeBroken();  // all are somewhere
        for (Body& b : bodies_) {
            if (shorten(b.velocity, kTopSpeed)) note(fmt::format("{}: slowed down to {} m/s", b.name, kTopSpeed));
            if (has(Stage::spin) && shorten(b.spin, kTopSpin)) note(fmt::format("{}: slowed down to {} rad/s", b.name, kTopSpin));
        }
    }
    scratch_.before.clear();
    for (const Body& b : bodies_) scratch_.before.push_back({b.position, b.orientation});
}

/// After a part: freezes what is no number any more, and takes out what is out of bounds.
void PhysicsWorld::leaveOut() {
    const double bounds = world_.bounds * world_.bounds;
    const auto inside = [&](const Body& b) {
        const double squares = glm::dot(b.velocity, b.velocity) + glm::dot(b.spin, b.spin);
        return glm::dot(b.position, b.position) <= bounds && std::isfinite(squares) && finite(b.orientation);
    };
    if (std::ranges::all_of(bodies_, inside)) return;
    freezeBroken();
    const auto left = [&](const Body& b) { return glm::dot(b.position, b.position) > bounds; };
    for (const Body& b : bodies_)
        if (left(b)) note(fmt::format("{}: removed at {} s, beyond the bounds of {} m", b.name, time_s(), world_.bounds));
    removeWhere(left);
}

/// Puts bodies whose state is no number back to where they last were, and aside.
void PhysicsWorld::freezeBroken() {
    const auto broken = [](const Body& b) { return !finite(b.position) || !finite(b.orientation) || !finite(b.velocity) || !finite(b.spin); };
    if (std::ranges::none_of(bodies_, broken)) return;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (Body& b = bodies_[i]; !finite(b.position) || !finite(b.orientation))
            b.position = scratch_.before[i].position, b.orientation = scratch_.before[i].orientation, b.velocity.x = NAN;
    takeOut(broken, [&](Body& b) {
        note(fmt::format("{}: frozen at {} s where it last was, its state is no number", b.name, time_s()));
        b.velocity = b.spin = {}, b.awake = false;
        frozen_.push_back(std::move(b));
    });
}

/// Takes bodies out, with what is kept of them, and wakes what is near; of one that is nowhere, all.
void PhysicsWorld::takeOut(const std::function<bool(const Body&)>& wanted, const std::function<void(Body&)>& taken) {
    for (const Body& gone : bodies_)  // what may have rested on it
        if (wanted(gone))
            for (Body& b : bodies_)
                if (!(glm::length(b.position - gone.position) > 1.01 * (b.radius + gone.radius))) b.awake = true, b.still = 0;
    std::size_t left = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (wanted(bodies_[i])) {
            const ObjectId object = bodies_[i].object;
            std::erase_if(kept_, [&](const Kept& k) { return k.a == object.value || k.b == object.value; });
            std::erase_if(grabs_, [&](const Grab& g) { return g.object == object; });
            memory_.forget(object.value);
            taken(bodies_[i]);
            continue;
        }
        if (left != i) bodies_[left] = std::move(bodies_[i]), near_[left] = std::move(near_[i]);
        ++left;
    }
    if (left == bodies_.size()) return;
    bodies_.resize(left), near_.resize(left);
    findKept();
    pairs_.forget();
    compose();
}

void PhysicsWorld::removeWhere(const std::function<bool(const Body&)>& gone) {
    takeOut(gone, [&](const Body& b) { ++removed_, gone_.push_back(b.object); });
}

void PhysicsWorld::note(std::string text) {
    if (notes_.size() > kMostNotes || std::ranges::find(notes_, text) != notes_.end()) return;
    notes_.push_back(notes_.size() < kMostNotes ? std::move(text) : "and more, which are not named");
}

int PhysicsWorld::awake() const {
    return static_cast<int>(std::count_if(bodies_.begin(), bodies_.end(), [](const Body& b) { return b.awake; }));
}

Energy PhysicsWorld::energy() const {
    Energy e;
    for (const Body& b : bodies_) {
        e.kinetic += kineticEnergy(b, motionOf(b));
        e.potential -= glm::dot(world_.fall(), b.position) / b.inverse_mass;
    }
    return e;
}

glm::dvec3 PhysicsWorld::momentum() const {
    glm::dvec3 p{0};
    for (const Body& b : bodies_) p += b.velocity / b.inverse_mass;
    return p;
}

glm::dvec3 PhysicsWorld::angularMomentum() const {
    glm::dvec3 l{0};
    for (const Body& b : bodies_) l += glm::cross(b.position, b.velocity) / b.inverse_mass + mb::angularMomentum(b, b.spin);
    return l;
}

double PhysicsWorld::maxPenetration() const {
    std::vector<Contact> contacts;
    std::vector<Reach> reach;
    StepCounts unused;
    const Collider collider(world_, field_, unused);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& b = bodies_[i];
        reach.push_back({b.position, b.radius});
        NearStatics near;
        collider.withStatics(static_cast<int>(i), b, b.shapePose(), 0, near, contacts);
    }
    for (const auto& [i, j] : overlappingPairs(reach)) {
        const Body &a = bodies_[static_cast<std::size_t>(i)], &b = bodies_[static_cast<std::size_t>(j)];
        collider.between(i, a, a.shapePose(), j, b, b.shapePose(), 0, contacts);
    }
    double deepest = 0;
    for (const Contact& c : contacts) deepest = std::max(deepest, -c.gap);
    return deepest;
}

std::size_t PhysicsWorld::bytes() const {
    constexpr std::size_t kTouches = 2;  // that a body keeps in mind, on average
    constexpr std::size_t kBody = sizeof(Body) + sizeof(NearStatics) + kTouches * sizeof(Touch) + sizeof kept_begin_[0];
    return sizeof *this + (bodies_.size() + frozen_.size()) * kBody + kept_.size() * sizeof(Kept) + memory_.bytes() + pairs_.bytes();
}

std::uint64_t PhysicsWorld::stateHash() const {
    StateHash hash;
    hash.add(steps_), hash.add(static_cast<std::uint64_t>(removed_));
    hash.add(knobs_.dt), hash.add(static_cast<std::uint64_t>(knobs_.substeps)), hash.add(static_cast<std::uint64_t>(knobs_.iterations));
    hash.add(knobs_.push_out), hash.add(knobs_.sleep_speed);
    for (const Body& b : bodies_) addState(hash, b);
    for (const Body& b : frozen_) addState(hash, b);
    for (const Grab& g : grabs_) hash.add(std::uint64_t{g.object.value}), hash.add(g.arm), hash.add(g.target);
    for (const Kept& k : kept_) {
        hash.add(std::uint64_t{k.a}), hash.add(std::uint64_t{k.b});
        hash.add(k.feature), hash.add(k.normal), hash.add(k.arm), hash.add(k.push), hash.add(k.drag);
        if (k.twist != 0) hash.add(k.twist);  // of shapes
    }
    memory_.addTo(hash);
    return hash.value();
}

std::uint64_t PhysicsWorld::bodyHash(std::size_t body) const {
    QuickHash hash;
    addState(hash, bodies_[body]);
    return hash.value();
}

std::string PhysicsWorld::stateText() const { return fmt::format("{:016x}", stateHash()); }

}  // namespace mb
