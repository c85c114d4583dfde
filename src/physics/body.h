#pragma once
// A rigid body: a ball with mass. Objects of another shape move as their bounding ball and turn with it.
#include "core/scene/scene.h"

#include <glm/gtc/quaternion.hpp>

namespace mb {

struct Body {
    ObjectId object;
    std::string name;
    glm::dvec3 position{0};            // of the ball's centre, m
    glm::dvec3 velocity{0};            // of the centre, m/s
    glm::dvec3 spin{0};                // rad/s, in the world's frame
    glm::dquat orientation{1, 0, 0, 0};
    double radius = 0;                 // m
    double inverse_mass = 0;           // 1/kg
    double inverse_inertia = 0;        // 1/(kg·m²): 2/5·m·r² about every axis
    std::optional<double> restitution, friction;  // its own; none: the world's
    glm::dvec3 offset{0};              // of the ball's centre from the object's origin, in the object's frame, m
    glm::dquat placed{1, 0, 0, 0};     // the orientation the scene gave it
    bool awake = true;
    int still = 0;                     // parts of steps it has been still for

    double mass() const { return 1 / inverse_mass; }
};

/// What two surfaces do to one another.
struct Pairing {
    double restitution = 0, friction = 0;
};
/// A body against a static shape: the body's own values, else the world's.
inline Pairing pairing(const World& world, const Body& a) {
    return {a.restitution.value_or(world.restitution), a.friction.value_or(world.friction)};
}
/// Two bodies: where only one states a value, it counts; where both do, the greater restitution and the geometric mean
/// of the frictions; where neither does, the world's.
inline Pairing pairing(const World& world, const Body& a, const Body& b) {
    const Pairing pa = pairing(world, a), pb = pairing(world, b);
    Pairing p{std::max(pa.restitution, pb.restitution), std::sqrt(pa.friction * pb.friction)};
    if (a.restitution.has_value() != b.restitution.has_value()) p.restitution = (a.restitution ? pa : pb).restitution;
    if (a.friction.has_value() != b.friction.has_value()) p.friction = (a.friction ? pa : pb).friction;
    if (!a.friction && !b.friction) p.friction = world.friction;
    return p;
}

/// Turns an orientation by spin·time, with +, ·, ÷ and √ only, so that every compiler's result is the same to the bit.
glm::dquat turned(const glm::dquat& orientation, const glm::dvec3& spin, double time);

}  // namespace mb
