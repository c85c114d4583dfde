// What hands do to bodies: hold, throw, blow up.
#include "physics/timeline.h"
#include "scenes.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace mb;
using namespace mb::test;

namespace {
glm::dvec3 held(const PhysicsWorld& w) { return w.bodies()[0].pose().toWorld(w.grabs()[0].arm); }

Scene alone(std::string_view kind, double dt, double mass) {
    Scene s = scene(dt, 0.3, 0.5);
    Object& o = s.objects[bodyOf(s, kind, {0, 1, 0}, 0.2)];
    o.density = 0, o.mass = mass;
    return s;
}
}  // namespace

TEST_CASE("what is grabbed comes to hang below the hand, whatever it weighs and however long a step is") {
    for (const std::string_view kind : kKinds)
        for (const double mass : {1e-30, 1e-6, 1.0, 1e6, 1e30})
            for (const double dt : {1e-3, 1.0 / 120, 0.1, 1.0}) {
                if (dt < 5e-3 && mass != 1) continue;  // takes long
                CAPTURE(kind); CAPTURE(mass); CAPTURE(dt);
                PhysicsWorld w(alone(kind, dt, mass));
                const ObjectId id = w.bodies()[0].object;
                const glm::dvec3 target{0.5, 2, -0.3};
                w.grab(id, {0, 0.1, 0}, target);
                double furthest = 0, fastest = 0;
                for (double t = 0; t < std::max(6.0, 40 * dt); t += dt) {
                    w.step();
                    furthest = std::max(furthest, glm::length(held(w) - target));
                    fastest = std::max(fastest, glm::length(w.bodies()[0].velocity));
                }
                CHECK(fastest <= 2 * kGrabSpeed + kG * dt);
                // In steps of a second a body turns too far for its point to have a velocity; it does not fly off.
                CHECK(furthest <= (dt < 1 ? std::max(1.3, kGrabSpeed * dt) : 50));  // 1.16 m at the start
                if (dt < 1) CHECK(glm::length(held(w) - target) <= std::max(0.02, 0.6 * kG * dt * dt));  // the spring gives way by g/ω² = 0.011
                CHECK(w.awake() == 1);
            }
}

TEST_CASE("a grabbed ball without gravity goes to the target as the critically damped spring does") {
    Scene s = scene(1e-4, 0, 0, 0);
    ball(s, {0.1, 0, 0}, 0.05);
    PhysicsWorld w(s);
    w.grab(w.bodies()[0].object, {}, {0, 0, 0});
    double off = 0;
    for (int i = 1; i <= 3000; ++i) {
        w.step();
        const double t = 1e-4 * i, x = 0.1 * (1 + kGrabRate * t) * std::exp(-kGrabRate * t);
        off = std::max(off, std::fabs(w.bodies()[0].position.x - x));
    }
    CHECK(off <= 2e-4);  // the implicit step errs by h·ω of 0.1 m
    MESSAGE("off by ", off, " m of 0.1");
}

TEST_CASE("a hand pulls no stronger than it says, and does not pull a light body through what holds it") {
    Scene s = scene(1.0 / 120, 0, 0.5);
    floor(s);
    block(s, {0, 0.1, 0}, {0.2, 0.2, 0.2});
    PhysicsWorld w(s);
    const ObjectId id = w.bodies()[0].object;
    w.grab(id, {0, 0.1, 0}, {0, -30, 0});  // under the floor
    double fastest = 0;
    for (int i = 0; i < 240; ++i) {
        const glm::dvec3 before = w.bodies()[0].velocity;
        w.step();
        fastest = std::max(fastest, glm::length(w.bodies()[0].velocity - before));
        CHECK(w.bodies()[0].position.y >= 0.1 - 5e-3);
    }
    CHECK(fastest <= (kGrabPull + kG) / 120);
    w.letGo(id);
    run(w, 3);
    CHECK(w.awake() == 0);
    CHECK(w.bodies()[0].position.y == doctest::Approx(0.1).epsilon(1e-2));
}

TEST_CASE("a sleeper that is grabbed wakes, with what lies on it, and is thrown as fast as the hand moved") {
    Scene s = scene(1.0 / 120, 0, 0.6);
    floor(s);
    block(s, {0, 0.1, 0}, {0.2, 0.2, 0.2}), block(s, {0, 0.3, 0}, {0.2, 0.2, 0.2});
    PhysicsWorld w(s);
    run(w, 3);
    REQUIRE(w.awake() == 0);
    const std::uint64_t asleep = w.stateHash();
    const ObjectId id = w.bodies()[1].object;
    w.grab(id, {}, w.bodies()[1].position);
    CHECK(w.stateHash() != asleep);
    w.step();
    CHECK(w.awake() == 2);
    run(w, 3);
    CHECK(w.awake() == 2);  // what is held does not sleep
    glm::dvec3 hand = w.bodies()[1].position;
    for (int i = 0; i < 60; ++i) hand += glm::dvec3{2, 1, 0} / 120.0, w.grab(id, {}, hand), w.step();
    const glm::dvec3 v = w.bodies()[1].velocity;
    CHECK(v.x == doctest::Approx(2).epsilon(0.02));
    CHECK(v.y == doctest::Approx(1).epsilon(0.05));
    w.letGo(id);
    CHECK(w.grabs().empty());
    w.grab({12345}, {}, {});  // nobody
    w.letGo({12345});
    CHECK(w.grabs().empty());
    w.grab(id, {}, {NAN, 0, 0});
    w.step();
    CHECK(w.frozen().size() == 1);
    CHECK(w.grabs().empty());
}

TEST_CASE("an explosion gives what is near a velocity away from it, less with the distance, and wakes it") {
    Scene s = scene(1.0 / 120, 0, 0.5, 0);
    s.physics.sleep_speed = 0.1;
    ball(s, {1, 0, 0}, 0.1, {}, 5), ball(s, {0, 0.5, 0}, 0.1), ball(s, {0, 0, 3}, 0.1), ball(s, {0, 0, 0}, 0.1);
    Object& box = block(s, {-1, 0, 1}, {0.1, 0.2, 0.3});
    box.spin = {0, 1, 0};
    PhysicsWorld w(s);
    w.explode({0, 0, 0}, 8, 2);
    CHECK(w.bodies()[0].velocity == glm::dvec3{4, 0, 0});  // whatever it weighs
    CHECK(w.bodies()[1].velocity == glm::dvec3{0, 6, 0});
    CHECK(w.bodies()[2].velocity == glm::dvec3{0, 0, 0});  // beyond the radius
    CHECK(w.bodies()[3].velocity == glm::dvec3{0, 8, 0});  // there: up
    const double d = std::sqrt(2.0);
    CHECK(glm::length(w.bodies()[4].velocity - 8 * (1 - d / 2) / d * glm::dvec3{-1, 0, 1}) <= 1e-14);
    CHECK(w.bodies()[4].spin == glm::dvec3{0, 1, 0});

    Scene asleep = scene(1.0 / 120, 0, 0.5);
    floor(asleep);
    for (int i = 0; i < 3; ++i) block(asleep, {0.3 * i, 0.1, 0}, {0.2, 0.2, 0.2});
    PhysicsWorld v(asleep);
    run(v, 3);
    REQUIRE(v.awake() == 0);
    v.explode({0, 0.1, 0.3}, 3, 0.32);
    CHECK(v.awake() == 1);
    v.explode({0, 0, 0}, 3, 0), v.explode({0, 0, 0}, 3, -1), v.explode({NAN, 0, 0}, 3, 1);
    CHECK(v.awake() == 1);
    run(v, 0.1);
    CHECK(v.bodies()[0].position.z < -0.003);
}

TEST_CASE("a run with a hand in it is the same again, from its recording too, and at each moment gone back to") {
    Scene s = scene(1.0 / 120, 0.3, 0.5);
    floor(s);
    block(s, {0, 0.1, 0}, {0.2, 0.2, 0.2}), ball(s, {0.4, 0.15, 0}, 0.15);
    Timeline t(s);
    const ObjectId id = s.objects[1].id;
    for (int i = 0; i < 120; ++i) {
        if (i >= 20 && i < 80) t.act(grabbing(id, {0.03, 0.1, 0}, {0.01 * i, 0.5, 0.1}));
        if (i == 80) t.act(lettingGo(id));
        if (i == 100) t.act(exploding({0.5, 0, 0}, 5, 2));
        t.advance();
    }
    const std::uint64_t end = t.world().stateHash();
    const std::string text = writeRecording(t.recording());
    CHECK(text.find("\ngrab body:2 arm:0.03,0.1,0 target:0.2,0.5,0.1\n") != std::string::npos);
    CHECK(text.find("\nlet_go body:2\n") != std::string::npos);
    CHECK(text.find("\nexplode at:0.5,0,0 speed:5 radius:2\n") != std::string::npos);
    RecordingResult read = readRecording(text);
    REQUIRE(read.ok());
    CHECK_FALSE(replay(std::move(read.recording)));
    for (const std::uint64_t step : {50u, 79u, 80u, 81u, 3u, 110u}) {
        t.seek(step);
        CHECK(t.world().grabs().size() == (step > 20 && step <= 80 ? 1 : 0));
    }
    t.seek(120);
    CHECK(t.world().stateHash() == end);
    CHECK_FALSE(t.divergence());
    const auto refused = [](const char* line) {
        const std::string recording = std::string("marchbox-recording 1\nscene\n  marchbox 1\n  object name:a type:sphere radius:1 density:1\n") + line + "\nend\n";
        return !readRecording(recording).ok();
    };
    CHECK(refused("explode at:0,0,0 speed:1 radius:-1"));
    CHECK(refused("explode at:0,0,nan speed:1 radius:1"));
    CHECK(refused("grab body:1 arm:0,0,0"));
    CHECK_FALSE(refused("grab body:1 arm:0,0,0 target:0,0,0"));
    CHECK(refused("grab body:2 arm:0,0,0 target:0,0,0"));  // there is none
    CHECK_FALSE(refused("remove body:1"));
    CHECK(refused("remove body:99"));
    CHECK_FALSE(refused("explode at:0,0,0 speed:1 radius:1"));
}
