#include "gui/simulation.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace mb {
namespace {

/// Puts the shapes, the knobs and what of the world the bodies feel into a scene. How things look and are called stays as it is.
void takeShapes(const Scene& from, Scene& io_scene) {
    std::unordered_map<std::uint32_t, const Object*> now;
    for (const Object& o : io_scene.objects) now[o.id.value] = &o;
    std::vector<Object> objects = from.objects;
    for (Object& o : objects)
        if (const auto same = now.find(o.id.value); same != now.end()) o.name = same->second->name, o.material = same->second->material;
    io_scene.objects = std::move(objects);
    io_scene.physics = from.physics;
    std::apply([&](auto... felt) { ((io_scene.world.*felt = from.world.*felt), ...); }, kFelt);
}

}  // namespace

Timeline& Simulation::ready(const Scene& scene) {
    if (!timeline_) {
        timeline_.emplace(scene);
        shown_ = timeline_->scene(), shown_step_ = 0, told_ = false;
    } else if (changed_) {
        timeline_->act(changingStatics(scene));
        shown_ = timeline_->scene();
    }
    changed_ = false;
    return *timeline_;
}

/// Makes the scene show the moment the timeline stands at.
void Simulation::show(Scene& scene) {
    const bool other = timeline_->scene() != shown_;
    // Bodies that left the world since are there again.
    if (other || timeline_->step() < shown_step_) takeShapes(*timeline_->scene(), scene);
    timeline_->world().writeTo(scene);
    took_shapes_ |= other;
    shown_ = timeline_->scene(), shown_step_ = timeline_->step();
}

bool Simulation::advance(Scene& scene, double seconds) {
    if (!playing && !seeking()) return false;
    ready(scene);
    if (seeking()) {
        timeline_->arrive(kMostSeconds);
        return show(scene), true;
    }
    if (!playing) return false;
    const double dt = scene.physics.dt;
    owed_ += std::clamp(seconds, 0.0, 1.0);
    int made = 0;
    const auto start = std::chrono::steady_clock::now();
    const auto late = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > kMostSeconds; };
    while (owed_ >= dt && made < kMostSteps && !asleep() && (made == 0 || !late())) {
        makeStep();
        owed_ -= dt, ++made;
    }
    if (asleep()) owed_ = 0;
    // What is left of a step waits for the next call; whole steps that could not be made are dropped.
    const double dropped = owed_ >= dt ? owed_ - std::fmod(owed_, dt) : 0;
    owed_ -= dropped;
    const double reached = made * dt / std::max(made * dt + dropped, 1e-9);
    if (made > 0) ratio_ += 0.2 * (reached - ratio_), show(scene);
    return made > 0;
}

void Simulation::step(Scene& scene) {
    ready(scene);
    makeStep();
    show(scene);
}

/// One step, before which the run is told where the hand is. Behind what was recorded nothing is held but by the hand.
void Simulation::makeStep() {
    if (timeline_->atEnd()) {
        std::vector<ObjectId> held_by_none;
        for (const Grab& g : timeline_->world().grabs()) {
            if (!hand_ || g.object != hand_->object) held_by_none.push_back(g.object);
            else if (g.target != hand_->target) timeline_->act(grabbing(hand_->object, hand_->arm, hand_->target));
        }
        for (const ObjectId object : held_by_none) timeline_->act(lettingGo(object));
    }
    timeline_->advance();
}

void Simulation::throwAbout(Scene& scene) {
    ready(scene).act(throwing(throws++, kThrowSpeed));
    show(scene);
}

void Simulation::explode(Scene& scene, glm::dvec3 at, double radius) {
    ready(scene).act(exploding(at, kExplodeSpeed, radius));
    show(scene);
}

void Simulation::grab(Scene& scene, ObjectId object, glm::dvec3 at) {
    letGo();
    const auto bodies = ready(scene).world().bodies();
    const auto body = std::ranges::find(bodies, object, &Body::object);
    if (body == bodies.end()) return;
    hand_ = Grab{object, body->pose().fromWorld(at), at};
    timeline_->act(grabbing(object, hand_->arm, at));
    show(scene);
}

void Simulation::moveHand(glm::dvec3 to) {
    if (hand_) hand_->target = to;
}

void Simulation::letGo() {
    if (hand_ && holds(hand_->object) && timeline_->atEnd()) timeline_->act(lettingGo(hand_->object));
    hand_.reset();
}

bool Simulation::holds(ObjectId body) const {
    return timeline_ && std::ranges::find(timeline_->world().grabs(), body, &Grab::object) != timeline_->world().grabs().end();
}

std::optional<Grab> Simulation::hand() const { return hand_ && holds(hand_->object) ? hand_ : std::nullopt; }

void Simulation::seek(Scene& scene, std::uint64_t step) {
    letGo();
    ready(scene).aim(step);
    if (seeking()) timeline_->arrive(kMostSeconds);
    show(scene);
}

void Simulation::discardFuture() {
    if (timeline_) timeline_->discardFuture();
    loaded_ = 0;
}

bool Simulation::hasBody(ObjectId object) const {
    const auto among = [&](std::span<const Body> bodies) { return std::ranges::find(bodies, object, &Body::object) != bodies.end(); };
    return timeline_ && (among(timeline_->world().bodies()) || among(timeline_->world().frozen()));
}

void Simulation::remove(ObjectId body) {
    if (hasBody(body)) timeline_->act(removing(body));
}

void Simulation::load(Recording recording) {
    stop();
    loaded_ = recording.steps.size();
    timeline_.emplace(std::move(recording));
    shown_ = timeline_->scene(), shown_step_ = 0;
}

std::optional<Divergence> Simulation::divergenceToTell() {
    if (!timeline_ || !timeline_->divergence() || told_) return {};
    told_ = true, loaded_ = 0;
    return timeline_->divergence();
}

std::uint64_t Simulation::equalStepsToTell() {
    if (loaded_ == 0 || timeline_->step() < loaded_) return 0;
    return std::exchange(loaded_, 0);
}

}  // namespace mb
