#pragma once
// A rigid body: a ball, or any shape that has an end.
#include "core/scene/scene.h"
#include "physics/solid.h"

#include <glm/gtc/quaternion.hpp>

namespace mb {

/// What a body's surface does by its own; what it does not say, the world's does.
struct OwnSurface {
    std::optional<double> restitution = {}, friction = {}, rolling = {}, spinning = {};
    friend bool operator==(const OwnSurface&, const OwnSurface&) = default;
};

/// What the steps ask for most comes first, in as few lines of the cache as hold it.
struct alignas(64) Body {
    glm::dvec3 position{0};              // of the centre of mass, m
    glm::dvec3 velocity{0};              // of the centre of mass, m/s
    double radius = 0;                   // m: the ball's, or of the ball around the centre of mass that holds the shape
    double inner = 0;                    // m: the ball's, or half the shape's thickness
    glm::dvec3 spin{0};                  // rad/s, in the world's frame
    double inverse_mass = 0;             // 1/kg
    glm::dquat orientation{1, 0, 0, 0};
    std::shared_ptr<const Solid> solid;  // its shape about its centre of mass; none: a ball. Equal shapes share it
    std::shared_ptr<const OwnSurface> own;  // none: it says nothing
    ObjectId object;
    int still = 0;                       // parts of steps it has been still for
    int stuck = 0;                       // the same, for how many it has been deep in another
    bool awake = true;
    glm::dmat3 inverse_inertia{0};       // of the inertia
    glm::dmat3 inertia{0};               // kg·m², about the centre of mass, in the body's frame
    std::string name;
    glm::dvec3 offset{0};                // of the centre of mass from the object's origin, in the object's frame, m
    glm::dquat placed{1, 0, 0, 0};       // the orientation the scene gave it

    bool isBall() const { return !solid; }
    double mass() const { return 1 / inverse_mass; }
    Pose pose() const { return {position, glm::mat3_cast(orientation)}; }
    /// As contacts see it: a ball is the same however it is turned.
    Pose shapePose() const { return isBall() ? Pose{position, glm::dmat3{1}} : pose(); }
    /// In the world's frame; every direction of a ball is alike.
    glm::dmat3 worldInverseInertia() const;
};

/// How deep a resting body may sink before it counts as moving into what it rests on, m; of the ball's radius, or half the
/// shape's thickness.
inline double restDepth(double inner) { return std::min(1e-4, 1e-3 * inner); }

/// What impulses change.
struct Motion {
    glm::dvec3 velocity{0}, spin{0};
};
inline Motion motionOf(const Body& b) { return {b.velocity, b.spin}; }

/// About the centre of mass, in the world's frame, kg·m²/s.
glm::dvec3 angularMomentum(const Body& body, glm::dvec3 spin);
/// The body's if it moved so, J.
double kineticEnergy(const Body& body, const Motion& motion);

/// What two surfaces do to one another.
struct Pairing {
    double restitution = 0, friction = 0;
    double rolling = 0, spinning = 0;    // m
};
/// Of bodies that say nothing.
inline Pairing pairing(const World& world) { return {world.restitution, world.friction, world.rolling, world.spinning}; }
/// The same as pairing(), of bodies that say something.
Pairing ownPairing(const World& world, const Body& a);
Pairing ownPairing(const World& world, const Body& a, const Body& b);
/// A body against a static shape: the body's own values, else the world's.
inline Pairing pairing(const World& world, const Body& a) { return a.own ? ownPairing(world, a) : pairing(world); }
/// Two bodies: where only one states a value, it counts; where both do, the greater restitution and the geometric mean of the
/// others; where neither does, the world's.
inline Pairing pairing(const World& world, const Body& a, const Body& b) { return a.own || b.own ? ownPairing(world, a, b) : pairing(world); }

/// No point of the body's surface, of those it shows to what it meets, is made faster than this by its turning, m/s, as long as it turns
/// freely: angular momentum and energy, which it keeps, bound its spin about each axis of its frame, and its box how far a point lies from
/// that. (A needle may spin fast about its length, and no other way.)
double turningSpeedOfShape(const Body& body);
/// A ball's is 0: none is faster than its centre.
inline double turningSpeed(const Body& body) { return body.isBall() ? 0 : turningSpeedOfShape(body); }

/// Turns an orientation by spin·time, with +, ·, ÷ and √ only, so that every compiler's result is the same to the bit.
glm::dquat turned(const glm::dquat& orientation, const glm::dvec3& spin, double time);

/// Turns a body's orientation freely for a time, and its spin with it: the angular momentum keeps its value and direction, and
/// the energy its value, to rounding. Source: Austin, Krishnaprasad, Wang, "Almost Poisson Integration of Rigid Body Systems" (1993).
/// Beyond 102 rad at once the attitude is followed only of what has an axis of symmetry.
void turnFreely(const Body& body, glm::dquat& io_orientation, glm::dvec3& io_spin, double time);

}  // namespace mb
