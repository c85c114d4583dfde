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

/// The records of one top-level object alone, neither moved nor turned: its shape in its own frame, scaled.
Scene alone(const Scene& scene, std::size_t object) {
    Scene one;
    const auto begin = scene.objects.begin();
    one.objects.assign(begin + static_cast<std::ptrdiff_t>(object), begin + static_cast<std::ptrdiff_t>(subtreeEnd(scene, object)));
    for (Object& o : one.objects) {
        o.parent = o.parent == kNoParent ? kNoParent : o.parent - static_cast<int>(object);
        o.material = kNoMaterial, o.name.clear();
    }
    Object& o = one.objects[0];
    o.pos = o.rot = o.vel = o.spin = glm::dvec3{0};
    o.mass = o.density = 0;
    o.restitution = o.friction = o.rolling = o.spinning = {};
    return one;
}

/// What the object's shape and mass make of it as a body; if it does not move though it should, why.
struct Movable {
    std::string_view why_not;
    double mass = 0;
    glm::dvec3 centre{0};  // of mass, in the object's frame
    glm::dmat3 inertia{0};
    double radius = 0;
    std::shared_ptr<const Solid> solid;
};

Movable ballOf(const Object& o) {
    Movable m;
    m.radius = o.numbers[0] * o.scale;
    m.mass = o.mass > 0 ? o.mass : o.density * (4.0 / 3 * 3.14159265358979323846 * m.radius * m.radius * m.radius);
    m.inertia = glm::dmat3(0.4 * m.mass * m.radius * m.radius);
    return m;
}

/// About the centre of mass, and no further.
Movable shapeOf(const Scene& shape, const Object& o) {
    Movable m;
    Tree tree = makeTree(shape);
    if (!tree.fault.empty()) return m.why_not = "it cannot be evaluated", m;
    const Box box = bounds(tree);
    for (std::size_t k = 0; k < 3; ++k)
        if (!(box.lo[k] <= box.hi[k])) return m.why_not = "it is empty", m;
    if (!isFinite(box)) return m.why_not = "it is infinite", m;
    const MassProperties mass = massProperties(tree);
    const double room = (box.hi[0] - box.lo[0]) * (box.hi[1] - box.lo[1]) * (box.hi[2] - box.lo[2]);
    if (!(mass.volume > 1e-10 * room)) return m.why_not = "it is empty", m;  // a shape less itself, but for rounding
    const double density = o.mass > 0 ? o.mass / mass.volume : o.density;
    m.mass = density * mass.volume, m.inertia = density * mass.inertia, m.centre = mass.centre;
    Scene centred = shape;
    centred.objects[0].pos = -mass.centre;
    m.solid = std::make_shared<const Solid>(makeSolid(makeTree(centred), true));
    m.radius = m.solid->radius;
    return m;
}

bool isOutOfRange(const Movable& m) {
    double least = INFINITY, sum = 0;
    for (int i = 0; i < 3; ++i) least = std::min(least, m.inertia[i][i]), sum += m.inertia[i][i];
    return !(least > 0) || !std::isfinite(1 / least) || !std::isfinite(sum) || !std::isfinite(m.mass) || !std::isfinite(1 / m.mass);
}

}  // namespace

PhysicsWorld::PhysicsWorld(const Scene& scene, StageChoice choice) : world_(scene.world), knobs_(scene.physics), choice_(choice) {
    std::vector<Made> made;
    for (std::size_t i = 0; i < scene.objects.size(); i = subtreeEnd(scene, i)) addBody(scene, i, made);
    findKept();
    changeStatics(scene);
}

/// Adds the object if it is a body. Equal shapes are made once.
void PhysicsWorld::addBody(const Scene& scene, std::size_t object, std::vector<Made>& io_made) {
    const Object& o = scene.objects[object];
    if (o.parent != kNoParent || o.hidden || !o.isBody()) return;
    Movable m;
    if (o.type->name == "sphere") {
        m = ballOf(o);
    } else {
        Scene shape = alone(scene, object);
        const auto made = std::ranges::find_if(io_made, [&](const Made& x) { return x.mass == o.mass && x.density == o.density && sameScene(x.shape, shape); });
        if (made != io_made.end()) {
            const Body& twin = bodies_[made->body];
            m.mass = twin.mass(), m.inertia = twin.inertia, m.centre = twin.offset, m.radius = twin.radius, m.solid = twin.solid;
        } else {
            m = shapeOf(shape, o);
            if (m.why_not.empty() && !isOutOfRange(m)) io_made.push_back({std::move(shape), o.mass, o.density, bodies_.size()});
        }
    }
    if (m.why_not.empty() && isOutOfRange(m)) m.why_not = "its mass or its size is out of range";
    if (!m.why_not.empty()) return note(fmt::format("{}: does not move, {}", label(scene, object), m.why_not));
    Body b;
    b.object = o.id, b.name = label(scene, object), b.solid = m.solid;
    b.orientation = b.placed = glm::normalize(glm::quat_cast(rotationFromDegrees(o.rot)));
    b.offset = m.centre;
    b.position = o.pos + (m.centre == glm::dvec3{0} ? m.centre : rotationFromDegrees(o.rot) * m.centre);
    b.velocity = o.vel;  // of the centre of mass
    b.spin = o.spin + glm::dvec3{0};  // −0 becomes 0, as it would where spin is summed
    b.radius = m.radius, b.inner = m.solid ? m.solid->inner : m.radius;
    b.inverse_mass = 1 / m.mass, b.inertia = m.inertia, b.inverse_inertia = glm::inverse(m.inertia);
    if (const OwnSurface own{o.restitution, o.friction, o.rolling, o.spinning}; own != OwnSurface{}) b.own = std::make_shared<const OwnSurface>(own);
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
        return std::ranges::find(bodies_, id, &Body::object) == bodies_.end() && std::ranges::find(frozen_, id, &Body::object) == frozen_.end() &&
               std::ranges::find(gone_, id) == gone_.end();
    };
    countShapes();
    if (!bodies_.empty()) field_ = StaticField(scene, is_solid, notes, &field_before, !allBalls());  // else nobody would ask it
    for (std::string& text : notes) note(std::move(text));
    for (NearStatics& near : near_) near = {};
    memory_.clear();
    for (Body& b : bodies_) b.awake = true, b.still = 0;
    compose();
}

void PhysicsWorld::countShapes() {
    shapes_ = static_cast<int>(std::ranges::count_if(bodies_, [](const Body& b) { return !b.isBall(); }));
    owners_ = static_cast<int>(std::ranges::count_if(bodies_, [](const Body& b) { return b.own != nullptr; }));
}

/// Asks the table of effects about the bodies and solids there are, as records of a scene.
void PhysicsWorld::compose() {
    Scene scene;
    scene.world = world_, scene.physics = knobs_;
    scene.objects.resize(bodies_.size() + (field_.empty() ? 0 : 1));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& b = bodies_[i];
        Object& o = scene.objects[i];
        o.type = findShapeType(b.isBall() ? "sphere" : "box");  // for any shape
        o.mass = b.mass(), o.spin = b.spin;
        if (b.own) o.restitution = b.own->restitution, o.friction = b.own->friction, o.rolling = b.own->rolling, o.spinning = b.own->spinning;
    }
    countShapes();
    stages_ = choice_.from(calledFor(scene));
    // What sleeps, or is about to, must be able to wake.
    const bool still = std::ranges::any_of(bodies_, [](const Body& b) { return !b.awake || b.still > 0; });
    if (still) stages_ = choice_.from(stages_ | Stages{Stage::sleeping});
    if (!grabs_.empty()) stages_ = choice_.from(stages_ | Stages{Stage::spin});  // a hand may turn what it holds
}

void PhysicsWorld::writeTo(Scene& scene) const {
    const auto write = [&](const Body& b) {
        const auto found = findObject(scene, b.object);
        if (!found) return;
        Object& o = scene.objects[*found];
        const bool turned_at_all = b.orientation != b.placed;
        if (turned_at_all) o.rot = degreesFromRotation(glm::mat3_cast(b.orientation));
        o.pos = b.offset == glm::dvec3{0} ? b.position : b.position - b.orientation * b.offset;
        o.vel = b.velocity, o.spin = b.spin;
    };
    std::ranges::for_each(bodies_, write), std::ranges::for_each(frozen_, write);
    for (const ObjectId id : gone_)
        if (const auto found = findObject(scene, id)) removeSubtree(scene, *found);
}

}  // namespace mb
