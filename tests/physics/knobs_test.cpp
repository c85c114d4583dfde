// What the physics record's knobs do: each changes what it says.
#include "scenes.h"

#include <doctest/doctest.h>

using namespace mb;
using namespace mb::test;

namespace {

/// What is left after 0.1 s of a ball's overlap with a box, a tenth of the ball's radius at first.
double overlapLeft(double push_out) {
    Scene s = scene(1.0 / 120, 0, 0.5, 0);
    s.physics.push_out = push_out;
    add(s, "box", {0, -1, 0}, {2, 2, 2, 0});
    ball(s, {0, 0.9, 0}, 1);
    PhysicsWorld w(s);
    run(w, 0.1);
    return w.maxPenetration();
}

/// When a ball that slides over a floor without friction falls asleep; at most 5 s.
double asleepAt(double sleep_speed, double speed, double gravity = kG) {
    Scene s = scene(1.0 / 120, 0, 0, gravity);
    s.physics.sleep_speed = sleep_speed;
    floor(s);
    ball(s, {0, 0.1, 0}, 0.1, {speed, 0, 0});
    PhysicsWorld w(s);
    while (w.awake() > 0 && w.time_s() < 5) w.step();
    return w.time_s();
}

}  // namespace

TEST_CASE("push_out: an overlap falls by that share in each part") {
    double before = 0;
    for (const double share : {1.0, 0.5, 0.2, 0.02}) {
        const double left = overlapLeft(share);
        CAPTURE(share);
        CHECK(left >= before);
        before = left;
        // Down to half the depth that a ball rests at, and not faster than kPushOutSpeed: 25 mm a part.
        const double rest = 0.5 * restDepth(1), wanted = rest + (0.1 - rest) * std::pow(1 - share, 12);
        if (share <= 0.2) CHECK(left == doctest::Approx(wanted).epsilon(1e-6));
    }
    CHECK(before > 0.07);
    CHECK(overlapLeft(PhysicsKnobs{}.push_out) == overlapLeft(0.2));
}

TEST_CASE("sleep_speed: what is slower sleeps after half a second, what is faster does not; at 0 nothing ever does") {
    for (const double speed : {0.0, 0.01, 0.1, 1.0, 10.0})
        for (const double sleep_speed : {0.003, 0.03, 0.3, 3.0, 30.0}) {
            CAPTURE(speed); CAPTURE(sleep_speed);
            if (speed < sleep_speed) CHECK(asleepAt(sleep_speed, speed) == doctest::Approx(kStillTime).epsilon(0.05));
            else CHECK(asleepAt(sleep_speed, speed) >= 5);
        }
    for (const double gravity : {0.0, kG}) {
        CHECK(asleepAt(0, 0, gravity) >= 5);
        CHECK(asleepAt(0.03, 0, gravity) < 1);
    }
    CHECK(asleepAt(30, 0.01, 0) >= 5);  // without gravity only rest itself is still
}

TEST_CASE("a ball that bounces and rolls sleeps sooner the faster it may be") {
    double before = 60;
    for (const double sleep_speed : {0.02, 0.1, 1.0}) {
        Scene s = scene(1.0 / 120, 0.5, 0.5);
        s.physics.sleep_speed = sleep_speed;
        groove(s, 120);
        ball(s, {0.2, 1, 0}, 0.1);
        PhysicsWorld w(s);
        while (w.awake() > 0 && w.time_s() < 60) w.step();
        CAPTURE(sleep_speed);
        CHECK(w.time_s() < before);
        before = w.time_s();
    }
}

TEST_CASE("the knobs are part of the state: worlds that differ in one have other hashes, and an edit brings it") {
    Scene s = scene(1.0 / 120, 0.5, 0.5);
    floor(s);
    ball(s, {0, 1, 0}, 0.5);
    const PhysicsWorld w(s);
    for (double PhysicsKnobs::*knob : {&PhysicsKnobs::push_out, &PhysicsKnobs::sleep_speed}) {
        Scene other = s;
        other.physics.*knob *= 0.5;
        CHECK(PhysicsWorld(other).stateHash() != w.stateHash());
        PhysicsWorld changed = w;
        changed.changeStatics(other);
        CHECK(changed.stateHash() == PhysicsWorld(other).stateHash());
    }
}
