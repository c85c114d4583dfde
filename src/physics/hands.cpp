// What hands do to a world, between two steps or, where they hold something, at the start of each part.
#include "physics/random.h"
#include "physics/world.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace mb {

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
    std::erase_if(frozen_, [&](const Body& b) { return b.object == object; });
    if (std::ranges::find(bodies_, object, &Body::object) == bodies_.end()) return;
    removeWhere([&](const Body& b) { return b.object == object; });
    --removed_;  // it was taken, not lost
}

void PhysicsWorld::grab(ObjectId object, glm::dvec3 arm, glm::dvec3 target) {
    const auto body = std::ranges::find(bodies_, object, &Body::object);
    if (body == bodies_.end()) return;
    body->awake = true, body->still = 0;
    const auto held = std::ranges::find(grabs_, object, &Grab::object);
    if (held == grabs_.end()) grabs_.push_back({object, arm, target});
    else held->arm = arm, held->target = target;
    compose();
}

void PhysicsWorld::letGo(ObjectId object) {
    std::erase_if(grabs_, [&](const Grab& g) { return g.object == object; });
    compose();
}

void PhysicsWorld::explode(glm::dvec3 at, double speed, double radius) {
    const glm::dvec3 fall = world_.fall();
    const double weight = glm::length(fall);
    for (Body& b : bodies_) {
        const glm::dvec3 away = b.position - at;
        const double distance = glm::length(away);
        if (!(distance < radius)) continue;
        const glm::dvec3 direction = distance > 1e-9 * radius ? away / distance : weight > 0 ? -fall / weight : glm::dvec3{0, 1, 0};
        b.velocity += speed * (1 - distance / radius) * direction;
        b.awake = true, b.still = 0;
    }
    compose();
}

/// The impulse of each spring over a part of length h. With a spring of k = m·ω² and a damper of c = 2·m·ω, taken at the part's
/// end, it solves (K + γ)·J = −(v + β/h·x), where K is how the point yields to an impulse, v its mean velocity through the part, x its offset from the
/// target, γ = 1/(h·(c + h·k)) and β/h = k/(c + h·k): so whatever the step and the masses, it does not grow.
/// Source: Catto, "Soft Constraints: Reinventing the Spring" (2011). Solved times the mass, so that no mass is out of range.
void PhysicsWorld::pullGrabbed(double h) {
    for (const Grab& g : grabs_) {
        Body& b = *std::ranges::find(bodies_, g.object, &Body::object);
        b.awake = true, b.still = 0;
        b.spin /= 1 + h * kGrabCalm;
        const glm::dvec3 arm = b.pose().rotation * g.arm;
        glm::dvec3 wanted = (kGrabRate / (2 + h * kGrabRate)) * (b.position + arm - g.target);
        if (const double speed = glm::length(wanted); speed > kGrabSpeed) wanted *= kGrabSpeed / speed;
        const glm::dmat3 cross{0, arm.z, -arm.y, -arm.z, 0, arm.x, arm.y, -arm.x, 0};  // times a vector: arm × it
        const glm::dmat3 turning = b.mass() * b.worldInverseInertia();
        const glm::dmat3 yields = glm::dmat3(1 + 1 / (h * kGrabRate * (2 + h * kGrabRate))) - cross * turning * cross;
        glm::dvec3 change = -(glm::inverse(yields) * (b.velocity + 0.5 * h * world_.fall() + glm::cross(b.spin, arm) + wanted));  // impulse / mass
        if (const double size = glm::length(change); size > kGrabPull * h) change *= kGrabPull * h / size;
        b.velocity += change, b.spin += turning * glm::cross(arm, change);
    }
}

}  // namespace mb
