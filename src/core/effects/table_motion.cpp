// The rows of the physics: the stages of a step, and what in a scene calls for each. A stage that is left out changes
// nothing to the bit: where a row is in doubt it calls.
//
// What a row may know of an object is in its record: a body that turns out not to move (it has no end, or no volume) still
// counts as one here. The physics asks these rows about the bodies and solids that it made of the scene.
#include "core/effects/effect.h"

#include <fmt/format.h>

#include <array>

namespace mb {
namespace {

using Record = Because::Record;

/// Each object that takes part: at the top level and not hidden.
template <class F> void eachPart(const Scene& scene, F visit) {
    for (std::size_t i = 0; i < scene.objects.size(); i = subtreeEnd(scene, i))
        if (!scene.objects[i].hidden) visit(i, scene.objects[i]);
}

struct Cast {
    std::size_t bodies = 0, solids = 0;
    /// Whether some body has something that it can touch.
    bool canTouch() const { return bodies > 0 && bodies + solids > 1; }
};
Cast castOf(const Scene& scene) {
    Cast cast;
    eachPart(scene, [&](std::size_t, const Object& o) { ++(o.isBody() ? cast.bodies : cast.solids); });
    return cast;
}

void addBodies(const Scene& scene, Calls& out) {
    eachPart(scene, [&](std::size_t i, const Object& o) {
        if (!o.isBody() || out.full()) return;
        out.add({Record::object, i, o.mass > 0 ? fmt::format("mass:{}", o.mass) : fmt::format("density:{}", o.density)});
    });
}

/// A number that bodies state or take from the world: what two bodies do with theirs is pairing()'s, in physics/body.h.
struct Shared {
    std::string_view key;
    double World::*of_world;
    std::optional<double> Object::*of_body;
    bool product;  // of two stated values; else the greater counts
};
constexpr Shared kFriction{"friction", &World::friction, &Object::friction, true};
constexpr Shared kRolling{"rolling", &World::rolling, &Object::rolling, true};
constexpr Shared kSpinning{"spinning", &World::spinning, &Object::spinning, true};
constexpr Shared kRestitution{"restitution", &World::restitution, &Object::restitution, false};

/// The records for which some pair that can touch has a value other than 0: a body's own where its partner is a solid, or
/// another body that states none, or (of a product) none of 0; the world's where neither of two states one.
void addShared(const Scene& scene, const Shared& value, Calls& out) {
    const Cast cast = castOf(scene);
    std::size_t silent = 0, at_work = 0;
    eachPart(scene, [&](std::size_t, const Object& o) {
        if (!o.isBody()) return;
        const std::optional<double>& own = o.*value.of_body;
        silent += !own, at_work += own && *own != 0;
    });
    const double of_world = scene.world.*value.of_world;
    if (of_world != 0 && (silent > 1 || (silent == 1 && cast.solids > 0)))
        out.add({Record::world, 0, fmt::format("{}:{}", value.key, of_world)});
    const std::size_t partners = value.product ? silent + at_work : cast.bodies;
    if (cast.solids == 0 && partners < 2) return;
    eachPart(scene, [&](std::size_t i, const Object& o) {
        const std::optional<double>& own = o.*value.of_body;
        if (o.isBody() && own && *own != 0 && !out.full()) out.add({Record::object, i, fmt::format("{}:{}", value.key, *own)});
    });
}

void ofBodies(const Effect&, const Scene& scene, const Tree&, Calls& out) { addBodies(scene, out); }
void ofSolids(const Effect&, const Scene& scene, const Tree&, Calls& out) {
    if (castOf(scene).bodies == 0) return;
    eachPart(scene, [&](std::size_t i, const Object& o) {
        if (!o.isBody() && !out.full()) out.add({Record::object, i, fmt::format("type:{}", o.type ? o.type->name : "none")});
    });
}
void ofPairs(const Effect&, const Scene& scene, const Tree&, Calls& out) {
    if (castOf(scene).bodies > 1) addBodies(scene, out);
}
void ofTouch(const Effect&, const Scene& scene, const Tree&, Calls& out) {
    if (castOf(scene).canTouch()) addBodies(scene, out);
}
void ofFriction(const Effect&, const Scene& scene, const Tree&, Calls& out) { addShared(scene, kFriction, out); }
void ofRolling(const Effect&, const Scene& scene, const Tree&, Calls& out) { addShared(scene, kRolling, out), addShared(scene, kSpinning, out); }
void ofRestitution(const Effect&, const Scene& scene, const Tree&, Calls& out) { addShared(scene, kRestitution, out); }
/// A body turns from the start, or friction makes it turn; or it is no ball, and any contact does.
void ofSpin(const Effect&, const Scene& scene, const Tree&, Calls& out) {
    eachPart(scene, [&](std::size_t i, const Object& o) {
        if (o.isBody() && o.spin != glm::dvec3{0} && !out.full())
            out.add({Record::object, i, fmt::format("spin:{},{},{}", o.spin.x, o.spin.y, o.spin.z)});
    });
    if (castOf(scene).canTouch())
        eachPart(scene, [&](std::size_t i, const Object& o) {
            if (o.isBody() && o.type && o.type->name != "sphere" && !out.full()) out.add({Record::object, i, fmt::format("type:{}", o.type->name)});
        });
    addShared(scene, kFriction, out);
}
/// What touches nothing falls for ever; without gravity it may rest in free space.
void ofRest(const Effect&, const Scene& scene, const Tree&, Calls& out) {
    if (!(scene.physics.sleep_speed > 0)) return;
    const Cast cast = castOf(scene);
    if (cast.bodies > 0 && scene.world.gravity == 0) out.add({Record::world, 0, "gravity:0"});
    if (cast.canTouch()) addBodies(scene, out);
}

constexpr std::array kMotion{
    Effect{.name = "flight", .tip = "bodies fall and fly on", .calls = ofBodies, .counts = "bodies brought forward", .stage = Stage::flight},
    Effect{.name = "static_contacts", .tip = "bodies meet what does not move", .calls = ofSolids, .counts = "questions to the static field", .stage = Stage::static_contacts},
    Effect{.name = "broad_phase", .tip = "finds the pairs of bodies that may meet", .calls = ofPairs, .counts = "sweeps over the bodies", .stage = Stage::broad_phase},
    Effect{.name = "body_contacts", .tip = "bodies meet one another", .calls = ofPairs, .counts = "pairs measured", .stage = Stage::body_contacts},
    Effect{.name = "spin", .tip = "bodies turn", .calls = ofSpin, .counts = "bodies turned", .stage = Stage::spin},
    Effect{.name = "friction", .tip = "surfaces that slide drag on one another", .calls = ofFriction, .counts = "turns of a contact's drag", .stage = Stage::friction},
    Effect{.name = "restitution", .tip = "what meets fast parts again", .calls = ofRestitution, .counts = "contacts that bounce", .stage = Stage::restitution},
    Effect{.name = "continuous", .tip = "a fast body stops at what it would have crossed", .calls = ofTouch, .counts = "searches along a path", .stage = Stage::continuous},
    Effect{.name = "sleeping", .tip = "what lies still costs nothing", .calls = ofRest, .counts = "passes over the islands", .stage = Stage::sleeping},
    Effect{.name = "rolling", .tip = "contacts resist rolling and spinning on the spot", .calls = ofRolling, .counts = "turns of a contact's torque", .stage = Stage::rolling},
};

}  // namespace

std::span<const Effect> motionEffects() { return kMotion; }

}  // namespace mb
