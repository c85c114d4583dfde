#pragma once
// What is done to a world between two steps: one row a kind, from which its form in a recording's text follows.
#include "physics/world.h"

#include <limits>
#include <memory>
#include <span>
#include <variant>

namespace mb {

struct ActionKind;

/// One thing done. It has those of the members that its kind's row names; every number is finite.
struct Action {
    const ActionKind* kind = nullptr;
    std::uint64_t step = 0;              // it is done after so many steps, before the next
    ObjectId body;
    std::uint64_t seed = 0;
    double speed = 0, radius = 0;        // m/s, m
    glm::dvec3 vel{0}, spin{0};          // m/s, rad/s
    glm::dvec3 at{0}, arm{0}, target{0}; // m
    std::shared_ptr<const Scene> scene;  // with the ids its objects have in the world
};

/// A key of an action's line.
struct Argument {
    using Member = std::variant<ObjectId Action::*, std::uint64_t Action::*, double Action::*, glm::dvec3 Action::*>;
    std::string_view name;
    Member member;
    double lo = -std::numeric_limits<double>::max(), hi = std::numeric_limits<double>::max();  // of each real number
};

struct ActionKind {
    std::string_view name;
    std::span<const Argument> arguments;
    /// Does it. What names a body that is no longer there does nothing.
    void (*apply)(PhysicsWorld&, const Action&);
    bool has_scene = false;              // a scene's text follows its line
};
std::span<const ActionKind> actionKinds();

Action throwing(std::uint64_t seed, double speed);
Action settingMotion(ObjectId body, glm::dvec3 vel, glm::dvec3 spin);
Action removing(ObjectId body);
Action grabbing(ObjectId body, glm::dvec3 arm, glm::dvec3 target);
Action lettingGo(ObjectId body);
Action exploding(glm::dvec3 at, double speed, double radius);
Action changingStatics(Scene scene);

}  // namespace mb
