// Between a scene and its physics: which objects move, with what mass, and where they came to lie.
#include "core/effects/effect.h"
#include "physics/mass_properties.h"
#include "physics/world.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <utility>

namespace mb {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// The object alone in a scene, neither moved nor turned: its shape in its own frame, scaled.
Tree ownShape(const Scene& scene, std::size_t object) {
    Scene alone;
    const auto begin = scene.objects.begin();
    alone.objects.assign(begin + static_cast<std::ptrdiff_t>(object), begin + static_cast<std::ptrdiff_t>(subtreeEnd(scene, object)));
    for (Object& o : alone.objects) o.parent = o.parent == kNoParent ? kNoParent : o.parent - static_cast<int>(object), o.material = kNoMaterial;
    alone.objects[0].pos = alone.objects[0].rot = glm::dvec3{0};
    return makeTree(alone);
}

/// Whether the object moves; if not though it should, why.
struct Movable {
    bool moves = false;
    std::string_view why_not;
    glm::dvec3 centre{0};  // of the bounding ball, in the object's frame
    double radius = 0;
    double mass = 0;
};

Movable movable(const Scene& scene, std::size_t object) {
    const Object& o = scene.objects[object];
    Movable m;
    if (o.parent != kNoParent || o.hidden || !o.isBody()) return m;
    if (o.type->name == "sphere") {
        m.radius = o.numbers[0] * o.scale;
        m.mass = o.mass > 0 ? o.mass : o.density * (4.0 / 3 * kPi * m.radius * m.radius * m.radius);
    } else {
        const Tree tree = ownShape(scene, object);
        if (!tree.fault.empty()) return m.why_not = "it cannot be evaluated", m;
        const Box box = bounds(tree);
        double sum = 0;
        for (int i = 0; i < 3; ++i) {
            const auto k = static_cast<std::size_t>(i);
            if (!(box.lo[k] <= box.hi[k])) return m.why_not = "it is empty", m;
            if (!std::isfinite(box.lo[k]) || !std::isfinite(box.hi[k])) return m.why_not = "it is infinite", m;
            m.centre[i] = 0.5 * (box.lo[k] + box.hi[k]);
            sum += 0.25 * (box.hi[k] - box.lo[k]) * (box.hi[k] - box.lo[k]);
        }
        m.radius = std::sqrt(sum);
        m.mass = o.mass > 0 ? o.mass : o.density * massProperties(tree).volume;
    }
    const double inertia = 0.4 * m.mass * m.radius * m.radius;
    if (!(inertia > 0) || !std::isfinite(1 / inertia) || !std::isfinite(inertia)) m.why_not = "its mass or its size is out of range";
    m.moves = m.why_not.empty();
    return m;
}

}  // namespace

PhysicsWorld::PhysicsWorld(const Scene& scene, StageChoice choice) : world_(scene.world), knobs_(scene.physics), choice_(choice) {
    for (std::size_t i = 0; i < scene.objects.size(); i = subtreeEnd(scene, i)) addBody(scene, i);
    changeStatics(scene);
}

void PhysicsWorld::addBody(const Scene& scene, std::size_t object) {
    const Object& o = scene.objects[object];
    const Movable m = movable(scene, object);
    if (!m.why_not.empty()) note(fmt::format("{}: does not move, {}", label(scene, object), m.why_not));
    if (!m.moves) return;
    Body b;
    b.object = o.id, b.name = label(scene, object);
    b.orientation = b.placed = glm::normalize(glm::quat_cast(rotationFromDegrees(o.rot)));
    b.offset = m.centre;
    b.position = o.pos + (m.centre == glm::dvec3{0} ? m.centre : rotationFromDegrees(o.rot) * m.centre);
    b.velocity = o.vel, b.spin = o.spin + glm::dvec3{0};  // −0 becomes 0, as it would where spin is summed
    b.radius = m.radius, b.inverse_mass = 1 / m.mass, b.inverse_inertia = 1 / (0.4 * m.mass * m.radius * m.radius);
    b.restitution = o.restitution, b.friction = o.friction;
    bodies_.push_back(std::move(b));
    near_.emplace_back();
}

void PhysicsWorld::changeStatics(const Scene& scene) {
    world_ = scene.world, knobs_ = scene.physics;
    before_ += field_.evaluations();
    std::vector<std::string> notes;
    const StaticField field_before = std::exchange(field_, {});
    const auto is_solid = [&](std::size_t i) {
        const ObjectId id = scene.objects[i].id;
        return std::ranges::none_of(bodies_, [&](const Body& b) { return b.object == id; }) && std::ranges::find(gone_, id) == gone_.end();
    };
    if (!bodies_.empty()) field_ = StaticField(scene, is_solid, notes, &field_before);  // else nobody would ask it
    for (std::string& text : notes) note(std::move(text));
    for (NearStatics& near : near_) near = {};
    for (Body& b : bodies_) b.awake = true, b.still = 0;
    compose();
}

/// Asks the table of effects about the bodies and solids there are, as records of a scene.
void PhysicsWorld::compose() {
    Scene scene;
    scene.world = world_, scene.physics = knobs_;
    scene.objects.resize(bodies_.size() + (field_.empty() ? 0 : 1));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& b = bodies_[i];
        Object& o = scene.objects[i];
        o.mass = b.mass(), o.spin = b.spin, o.restitution = b.restitution, o.friction = b.friction;
    }
    stages_ = choice_.from(calledFor(scene));
    // What sleeps, or is about to, must be able to wake.
    const bool still = std::ranges::any_of(bodies_, [](const Body& b) { return !b.awake || b.still > 0; });
    if (still) stages_ = choice_.from(stages_ | Stages{Stage::sleeping});
}

void PhysicsWorld::writeTo(Scene& scene) const {
    for (const Body& b : bodies_) {
        const auto found = findObject(scene, b.object);
        if (!found) continue;
        Object& o = scene.objects[*found];
        const bool turned_at_all = b.orientation != b.placed;
        if (turned_at_all) o.rot = degreesFromRotation(glm::mat3_cast(b.orientation));
        o.pos = b.offset == glm::dvec3{0} ? b.position : b.position - b.orientation * b.offset;
        o.vel = b.velocity, o.spin = b.spin;
    }
    for (const ObjectId id : gone_)
        if (const auto found = findObject(scene, id)) removeSubtree(scene, *found);
}

}  // namespace mb
