// Resistance to rolling and to spinning on the spot.
#include "scenes.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace mb;
using namespace mb::test;

TEST_CASE("a ball that rolls on a plane is slowed down by 5/7·g·rolling/r, stops, and sleeps") {
    for (const double lever : {0.001, 0.01, 0.03}) {
        constexpr double kRadius = 0.1;
        Scene s = scene(1.0 / 240, 0, 0.8);
        s.world.rolling = lever;
        floor(s);
        ball(s, {0, kRadius, 0}, kRadius, {1.2, 0, 0.5}).spin = {5, 0, -12};
        PhysicsWorld w(s);
        const double a = 5.0 / 7 * kG * lever / kRadius, speed = 1.3, stop = speed / a;
        double off = 0;
        while (w.time_s() < std::min(0.9 * stop, 4.0)) {
            w.step();
            off = std::max(off, std::fabs(glm::length(w.bodies()[0].velocity) - (speed - a * w.time_s())));
        }
        // Its torque comes before the friction that takes up what slip that leaves: found 1e-12.
        CHECK(off <= 1e-6 * speed);
        MESSAGE("lever ", lever, ": off by ", off, " m/s");
        if (stop > 10) continue;
        run(w, 0.2 * stop + 1);
        CHECK(w.bodies()[0].velocity == glm::dvec3{0});
        CHECK(w.bodies()[0].position.x == doctest::Approx(1.2 / 1.3 * speed * speed / (2 * a)).epsilon(1e-2));
        CHECK(w.awake() == 0);
    }
}

TEST_CASE("on a slope a ball stays where the slope is less than rolling/r, and rolls by what is left where it is more") {
    for (const double share : {0.9, 0.99, 1.02, 1.5}) {
        constexpr double kRadius = 0.1, kAngle = 8;
        const double angle = kAngle * kPi / 180, lever = kRadius * std::tan(angle) / share;
        Scene s = scene(1.0 / 120, 0, 0.9);
        s.physics.sleep_speed = 1e-3;  // else what begins as slowly falls asleep
        add(s, "plane", {}, {std::sin(angle), std::cos(angle), 0, 0});
        ball(s, kRadius * glm::dvec3{std::sin(angle), std::cos(angle), 0}, kRadius).rolling = lever;
        PhysicsWorld w(s);
        const glm::dvec3 at = w.bodies()[0].position;
        run(w, 2);
        const double moved = glm::length(w.bodies()[0].position - at);
        const double a = 5.0 / 7 * kG * (std::sin(angle) - std::cos(angle) * lever / kRadius);
        CHECK((w.awake() == 0) == (share < 1));
        if (share < 1) CHECK(moved <= 1e-6);
        else CHECK(moved == doctest::Approx(0.5 * a * 4).epsilon(1e-3));
        MESSAGE("slope of ", share, " times what is held: moved by ", moved, " m in 2 s");
    }
}

TEST_CASE("a ball that spins on the spot loses 5/2·g·spinning/r² a second, and does not wander") {
    constexpr double kRadius = 0.1, kLever = 0.002;
    Scene s = scene(1.0 / 240, 0, 0.8);
    floor(s);
    ball(s, {0, kRadius, 0}, kRadius).spin = {0, 20, 0};
    s.objects.back().spinning = kLever;
    PhysicsWorld w(s);
    const double a = 2.5 * kG * kLever / (kRadius * kRadius);
    run(w, 2);
    CHECK(w.bodies()[0].spin.y == doctest::Approx(20 - 2 * a).epsilon(1e-6));
    run(w, 3);
    CHECK(w.bodies()[0].spin == glm::dvec3{0});
    CHECK(w.awake() == 0);
    CHECK(std::fabs(w.bodies()[0].position.x) <= 1e-9);
}

TEST_CASE("a cylinder that rolls is slowed down by 2/3·g·rolling/r") {
    Scene s = scene(1.0 / 240, 0, 0.8);
    s.world.rolling = 0.01;
    floor(s);
    Object& roll = add(s, "cylinder", {0, 0.1, 0}, {0.1, 0.5, 0});
    roll.rot = {90, 0, 0}, roll.density = 1000, roll.vel = {0.5, 0, 0}, roll.spin = {0, 0, -5};
    PhysicsWorld w(s);
    const double path = 0.25 / (2 * 2.0 / 3 * kG * 0.1);
    run(w, 3);
    // Its contacts are points of its edges, over which it rolls a little unevenly.
    CHECK(std::fabs(w.bodies()[0].position.x - path) <= 0.1 * path);
    CHECK(std::fabs(w.bodies()[0].velocity.x) <= 1e-2);
    CHECK(std::fabs(w.bodies()[0].spin.z) <= 1e-1);
    MESSAGE("the cylinder went ", w.bodies()[0].position.x, " m of ", path);
}

TEST_CASE("a ball that rolls and spins on a body that can move: energy only falls, and both stop") {
    Scene s = scene(1.0 / 120, 0, 0.8);
    s.world.rolling = 0.01, s.world.spinning = 0.002;
    floor(s);
    block(s, {0, 0.1, 0}, {1, 0.2, 1});
    ball(s, {-0.2, 0.3, 0}, 0.1, {0.5, 0, 0}).spin = {0, 4, -5};
    ball(s, {0, 1, 0}, 0.1).spin = {3, 1, 0};  // on which it falls
    PhysicsWorld w(s);
    double last = w.energy().total(), most = 0;
    for (int i = 0; i < 5 * 120; ++i) {
        w.step();
        most = std::max(most, w.energy().total() - last), last = w.energy().total();
    }
    CHECK(most <= 1e-9);
    CHECK(w.awake() == 0);
    MESSAGE("most energy gained in a step ", most, " J");
}

TEST_CASE("of two bodies that say a lever the geometric mean counts, of one its own, of none the world's") {
    World world;
    world.rolling = 0.5, world.spinning = 0.25;
    Body a, b;
    CHECK(pairing(world, a).rolling == 0.5);
    CHECK(pairing(world, a, b).spinning == 0.25);
    a.own = std::make_shared<const OwnSurface>(OwnSurface{.rolling = 0.04});
    CHECK(pairing(world, a, b).rolling == 0.04);
    CHECK(pairing(world, b, a).rolling == 0.04);
    b.own = std::make_shared<const OwnSurface>(OwnSurface{.rolling = 0.09});
    CHECK(pairing(world, a, b).rolling == doctest::Approx(0.06));
    b.own = std::make_shared<const OwnSurface>(OwnSurface{.rolling = 0});
    CHECK(pairing(world, a, b).rolling == 0);
    CHECK(pairing(world, a, b).friction == world.friction);
}
