#include "physics/world.h"

#include "core/effects/effect.h"
#include "physics/hash.h"
#include "physics/quick_hash.h"
#include "physics/random.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>

namespace mb {
namespace {

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

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
    io_hash.add(static_cast<std::uint64_t>(b.awake)), io_hash.add(static_cast<std::uint64_t>(b.still));
}

}  // namespace

void PhysicsWorld::step() {
    const std::uint64_t before = field_.evaluations();
    for (int i = 0; i < knobs_.substeps; ++i) part(knobs_.dt / knobs_.substeps);
    counts_.evaluations += field_.evaluations() - before;
    ++steps_;
}

/// A contact that gravity alone closes again within two parts is a resting one.
double PhysicsWorld::bounceSpeed(double h) const { return 2 * std::fabs(world_.gravity) * h; }

void PhysicsWorld::part(double h) {
    // Sleepers lie still, and only what is awake, or what is done to the world between steps, wakes them. No impulse is kept
    // of one.
    if (choice_.proofs && awake() == 0) {
        contacts_ = 0;
        return;
    }
    tame();
    std::vector<Contact> contacts = touching(h);
    if (has(Stage::sleeping)) wakeAndSleep(contacts);
    const std::vector<Motion> accelerations = rest(contacts, h);
    if (has(Stage::flight)) fly(accelerations, h);
    if (has(Stage::sleeping)) countStill(contacts, h);
    removeWhere([&](const Body& b) { return glm::dot(b.position, b.position) > world_.bounds * world_.bounds; });
}

/// What lasts of the contacts keeps the balls up: their accelerations through the part.
std::vector<Motion> PhysicsWorld::rest(std::vector<Contact>& io_contacts, double h) {
    std::vector<Motion> accelerations = falling();
    if (!io_contacts.empty()) {
        pushApart(io_contacts, h);
        dropImpacts(io_contacts, h);
    }
    if (io_contacts.empty()) {
        kept_.clear(), contacts_ = 0;
        return accelerations;
    }
    stopApproaches(io_contacts, h);
    carry(io_contacts, h, accelerations);
    return accelerations;
}

bool PhysicsWorld::flown(const Contact& c, const FlightRules& rules) const {
    const Body& a = bodies_[static_cast<std::size_t>(c.a)];
    return c.b == kStatic ? metInFlight(a, rules) : metInFlight(a, bodies_[static_cast<std::size_t>(c.b)], rules);
}

/// Fast approaches that are met in flight are the flight's business. Sleepers need nothing.
void PhysicsWorld::dropImpacts(std::vector<Contact>& io_contacts, double h) const {
    const FlightRules rules = rulesFor(h);
    std::erase_if(io_contacts, [&](const Contact& c) {
        if (!bodies_[static_cast<std::size_t>(c.a)].awake) return true;
        return flown(c, rules) && glm::dot(relativeVelocity(bodies_, c, has(Stage::spin)), c.normal) < -rules.bounce;
    });
}

void PhysicsWorld::fly(std::span<const Motion> accelerations, double h) {
    Flight flight(bodies_, near_, field_, rulesFor(h), accelerations, counts_);
    flight.run();
    impacts_ += static_cast<std::uint64_t>(flight.impacts);
    held_ += static_cast<std::uint64_t>(flight.held);
}

/// Takes out bodies whose state is no number and slows down those beyond the top speed, before either meets another.
void PhysicsWorld::tame() {
    const auto broken = [](const Body& b) {
        return !finite(b.position) || !finite(b.velocity) || !finite(b.spin) || glm::dot(b.position, b.position) > 1e20;
    };
    for (Body& b : bodies_) {
        if (broken(b)) {
            note(fmt::format("{}: removed at {} s, its state is no number", b.name, time_s()));
            continue;
        }
        if (shorten(b.velocity, kTopSpeed)) note(fmt::format("{}: slowed down to {} m/s", b.name, kTopSpeed));
        if (has(Stage::spin) && shorten(b.spin, kTopSpin)) note(fmt::format("{}: slowed down to {} rad/s", b.name, kTopSpin));
    }
    removeWhere(broken);
}

void PhysicsWorld::removeWhere(const std::function<bool(const Body&)>& gone) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (gone(bodies_[i])) {
            ++removed_;
            gone_.push_back(bodies_[i].object);
            std::erase_if(kept_, [&](const Kept& k) { return k.a == bodies_[i].object.value || k.b == bodies_[i].object.value; });
            memory_.forget(bodies_[i].object.value);
            continue;
        }
        if (left != i) bodies_[left] = std::move(bodies_[i]), near_[left] = std::move(near_[i]);
        ++left;
    }
    if (left == bodies_.size()) return;
    bodies_.resize(left), near_.resize(left);
    compose();
}

void PhysicsWorld::note(std::string text) {
    if (std::find(notes_.begin(), notes_.end(), text) == notes_.end()) notes_.push_back(std::move(text));
}

void PhysicsWorld::setMotionOf(Body& io_body, glm::dvec3 velocity, glm::dvec3 spin) {
    io_body.velocity = velocity, io_body.spin = spin + glm::dvec3{0};
    io_body.awake = true, io_body.still = 0;
}

void PhysicsWorld::setMotion(std::size_t body, glm::dvec3 velocity, glm::dvec3 spin) {
    setMotionOf(bodies_[body], velocity, spin);
    compose();
}

void PhysicsWorld::throwAbout(std::uint64_t seed, double speed) {
    Random random(seed);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const double x = random.in(-0.5, 0.5), y = random.in(0.2, 0.7), z = random.in(-0.5, 0.5);
        const glm::dvec3 spin{random.in(-10, 10), random.in(-10, 10), random.in(-10, 10)};
        setMotionOf(bodies_[i], speed * glm::dvec3{x, y, z}, spin);
    }
    compose();
}

void PhysicsWorld::remove(ObjectId object) {
    const auto found = std::find_if(bodies_.begin(), bodies_.end(), [&](const Body& b) { return b.object == object; });
    if (found == bodies_.end()) return;
    for (Body& b : bodies_)
        if (glm::length(b.position - found->position) <= (b.radius + found->radius) * 1.01) b.awake = true, b.still = 0;
    removeWhere([&](const Body& b) { return b.object == object; });
    --removed_;  // it was taken, not lost
}

int PhysicsWorld::awake() const {
    return static_cast<int>(std::count_if(bodies_.begin(), bodies_.end(), [](const Body& b) { return b.awake; }));
}

Energy PhysicsWorld::energy() const {
    Energy e;
    for (const Body& b : bodies_) {
        e.kinetic += kineticEnergy(b, motionOf(b));
        e.potential += world_.gravity * b.position.y / b.inverse_mass;
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
        collider.withStatics(static_cast<int>(i), b, b.pose(), 0, near, contacts);
    }
    for (const auto& [i, j] : overlappingPairs(reach)) {
        const Body &a = bodies_[static_cast<std::size_t>(i)], &b = bodies_[static_cast<std::size_t>(j)];
        collider.between(i, a, a.pose(), j, b, b.pose(), 0, contacts);
    }
    double deepest = 0;
    for (const Contact& c : contacts) deepest = std::max(deepest, -c.gap);
    return deepest;
}

std::uint64_t PhysicsWorld::stateHash() const {
    StateHash hash;
    hash.add(steps_), hash.add(static_cast<std::uint64_t>(removed_));
    hash.add(knobs_.dt), hash.add(static_cast<std::uint64_t>(knobs_.substeps)), hash.add(static_cast<std::uint64_t>(knobs_.iterations));
    hash.add(knobs_.push_out), hash.add(knobs_.sleep_speed);
    for (const Body& b : bodies_) addState(hash, b);
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
