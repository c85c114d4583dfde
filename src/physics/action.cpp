#include "physics/action.h"

#include <algorithm>
#include <utility>

namespace mb {
namespace {

constexpr Argument kThrow[] = {{"seed", &Action::seed}, {"speed", &Action::speed}};
constexpr Argument kMotion[] = {{"body", &Action::body}, {"vel", &Action::vel}, {"spin", &Action::spin}};
constexpr Argument kGrab[] = {{"body", &Action::body}, {"arm", &Action::arm}, {"target", &Action::target}};
constexpr Argument kLetGo[] = {{"body", &Action::body}};
constexpr Argument kExplode[] = {{"at", &Action::at}, {"speed", &Action::speed}, {"radius", &Action::radius, 0}};
constexpr Argument kRemove[] = {{"body", &Action::body}};

void setMotion(PhysicsWorld& world, const Action& a) {
    const auto body = std::ranges::find(world.bodies(), a.body, &Body::object);
    if (body != world.bodies().end()) world.setMotion(static_cast<std::size_t>(body - world.bodies().begin()), a.vel, a.spin);
}

constexpr ActionKind kKinds[] = {
    {"throw", kThrow, [](PhysicsWorld& world, const Action& a) { world.throwAbout(a.seed, a.speed); }},
    {"motion", kMotion, setMotion},
    {"grab", kGrab, [](PhysicsWorld& world, const Action& a) { world.grab(a.body, a.arm, a.target); }},
    {"let_go", kLetGo, [](PhysicsWorld& world, const Action& a) { world.letGo(a.body); }},
    {"explode", kExplode, [](PhysicsWorld& world, const Action& a) { world.explode(a.at, a.speed, a.radius); }},
    {"remove", kRemove, [](PhysicsWorld& world, const Action& a) { world.remove(a.body); }},
    {"statics", {}, [](PhysicsWorld& world, const Action& a) { world.changeStatics(*a.scene); }, true},
};

Action ofKind(std::string_view name) {
    Action action;
    action.kind = std::ranges::find(kKinds, name, &ActionKind::name);
    return action;
}

}  // namespace

std::span<const ActionKind> actionKinds() { return kKinds; }

Action throwing(std::uint64_t seed, double speed) {
    Action action = ofKind("throw");
    action.seed = seed, action.speed = speed;
    return action;
}

Action settingMotion(ObjectId body, glm::dvec3 vel, glm::dvec3 spin) {
    Action action = ofKind("motion");
    action.body = body, action.vel = vel, action.spin = spin;
    return action;
}

Action grabbing(ObjectId body, glm::dvec3 arm, glm::dvec3 target) {
    Action action = ofKind("grab");
    action.body = body, action.arm = arm, action.target = target;
    return action;
}

Action lettingGo(ObjectId body) {
    Action action = ofKind("let_go");
    action.body = body;
    return action;
}

Action exploding(glm::dvec3 at, double speed, double radius) {
    Action action = ofKind("explode");
    action.at = at, action.speed = speed, action.radius = radius;
    return action;
}

Action removing(ObjectId body) {
    Action action = ofKind("remove");
    action.body = body;
    return action;
}

Action changingStatics(Scene scene) {
    Action action = ofKind("statics");
    action.scene = std::make_shared<const Scene>(std::move(scene));
    return action;
}

}  // namespace mb
