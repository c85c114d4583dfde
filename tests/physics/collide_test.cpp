// Balls against balls.
#include "physics/broadphase.h"
#include "physics/random.h"
#include "scenes.h"

#include <doctest/doctest.h>

#include <numeric>

using namespace mb;
using namespace mb::test;

TEST_CASE("two balls exchange velocities as Newton's law says") {
    struct Case { double m1, m2, v1, v2; };
    for (const Case& c : {Case{1, 1, 5, -10}, Case{1, 3, 4, 0}, Case{1000, 1, 2, -2}, Case{1e-3, 1e3, 10, -1}}) {
        Scene s = scene(1.0 / 60, 1, 0, 0);
        ball(s, {-2, 0, 0}, 0.5, {c.v1, 0, 0}, c.m1);
        ball(s, {2, 0, 0}, 0.5, {c.v2, 0, 0}, c.m2);
        PhysicsWorld w(s);
        run(w, 1);
        const double sum = c.m1 + c.m2;
        CHECK(w.bodies()[0].velocity.x == doctest::Approx(((c.m1 - c.m2) * c.v1 + 2 * c.m2 * c.v2) / sum).epsilon(1e-9));
        CHECK(w.bodies()[1].velocity.x == doctest::Approx(((c.m2 - c.m1) * c.v2 + 2 * c.m1 * c.v1) / sum).epsilon(1e-9));
    }
}

TEST_CASE("a collision keeps momentum and angular momentum, spin and friction included") {
    double worst = 0;
    int met = 0;
    Random random(7);
    for (int i = 0; i < 200; ++i) {
        Scene s = scene(1.0 / 60, random.in(0, 1), random.in(0, 1), 0);
        const auto any = [&](double x) { return glm::dvec3{random.in(-x, x), random.in(-x, x), random.in(-x, x)}; };
        ball(s, glm::dvec3{-1, 0, 0} + any(0.2), random.in(0.2, 0.5), glm::dvec3{6, 0, 0} + any(1), random.in(0.1, 10)).spin = any(20);
        ball(s, glm::dvec3{1, 0, 0} + any(0.2), random.in(0.2, 0.5), glm::dvec3{-6, 0, 0} + any(1), random.in(0.1, 10)).spin = any(20);
        PhysicsWorld w(s);
        const glm::dvec3 p = w.momentum(), l = w.angularMomentum();
        const double e = w.energy().total(), size = 12 * (1 / w.bodies()[0].inverse_mass + 1 / w.bodies()[1].inverse_mass);
        run(w, 0.5);
        met += w.impacts() >= 1;
        worst = std::max({worst, glm::length(w.momentum() - p) / size, glm::length(w.angularMomentum() - l) / size});
        CHECK(w.energy().total() <= e * (1 + 1e-12));
    }
    CHECK(worst <= 1e-6);
    CHECK(met >= 150);  // the others were aimed past one another
    MESSAGE("momentum error ", worst);
}

TEST_CASE("of five touching balls the last one leaves") {
    Scene s = scene(1.0 / 60, 1, 0, 0);
    for (int i = 0; i < 5; ++i) ball(s, {i == 0 ? -0.5 : 0.2 * i, 0, 0}, 0.1, {i == 0 ? 1.0 : 0, 0, 0});
    PhysicsWorld w(s);
    run(w, 1);
    for (std::size_t i = 0; i < 4; ++i) CHECK(std::fabs(w.bodies()[i].velocity.x) <= 1e-9);
    CHECK(w.bodies()[4].velocity.x == doctest::Approx(1));
}

TEST_CASE("a stack of balls in a tube stands, at its height, asleep") {
    const int n = 10;
    Scene s = scene(1.0 / 120, 0, 0.5);
    add(s, "subtract", {}, {0});
    add(s, "cylinder", {0, 1.5, 0}, {0.5, 3, 0}, 0);
    add(s, "cylinder", {0, 1.6, 0}, {0.101, 3, 0}, 0);
    for (int i = 0; i < n; ++i) ball(s, {0, 0.2 + 0.2 * i, 0}, 0.1);
    PhysicsWorld w(s);
    run(w, 5);
    CHECK(w.awake() == 0);
    CHECK(w.maxPenetration() <= 2e-4);  // two resting depths
    // Straight it is 0.2·n high; leaning from wall to wall by 2 mm a ball, at most 1e-5 a ball lower.
    CHECK(std::fabs(w.bodies()[n - 1].position.y - (0.2 + 0.2 * (n - 1))) <= n * 2e-4);
    MESSAGE("stack: deepest ", w.maxPenetration(), " top off by ", w.bodies()[n - 1].position.y - 2.0);
}

TEST_CASE("a pile that overlaps by a quarter comes apart without being thrown") {
    Scene s = scene(1.0 / 60, 0, 0.5);
    floor(s);
    for (int row = 0; row < 4; ++row)
        for (int i = 0; i < 4 - row; ++i) ball(s, {0.15 * i + 0.075 * row, 0.08 + 0.13 * row, 0}, 0.1);
    PhysicsWorld w(s);
    double fastest = 0, highest = 0;
    for (int i = 0; i < 120; ++i) {
        const std::vector<Body> before(w.bodies().begin(), w.bodies().end());
        w.step();
        for (std::size_t k = 0; k < before.size(); ++k) {
            fastest = std::max(fastest, glm::length(w.bodies()[k].position - before[k].position) * 60);
            highest = std::max(highest, w.bodies()[k].position.y);
        }
    }
    CHECK(w.maxPenetration() <= 3e-4);
    CHECK(highest <= 0.08 + 0.13 * 3 + 0.5);
    CHECK(fastest <= kPushOutSpeed + 3);  // the push and, at most, a fall of half a metre
    MESSAGE("overlap left ", w.maxPenetration(), " fastest ", fastest);
}

TEST_CASE("balls whose centres coincide are parted, the same way each time") {
    for (const int n : {2, 100}) {
        std::uint64_t hash = 0;
        for (int again = 0; again < 2; ++again) {
            Scene s = scene(1.0 / 60, 0.5, 0.5, 0);
            for (int i = 0; i < n; ++i) ball(s, {}, 0.1);
            PhysicsWorld w(s);
            run(w, 3);
            CHECK(w.bodies().size() == static_cast<std::size_t>(n));
            CHECK(w.maxPenetration() <= 1e-3);
            CHECK(glm::length(w.momentum()) <= 1e-5);
            if (again) CHECK(w.stateHash() == hash);
            hash = w.stateHash();
        }
    }
}

TEST_CASE("the broad phase finds the pairs that comparing all with all finds") {
    Random random(3);
    for (const int kind : {0, 1, 2, 3}) {
        std::vector<Reach> balls;
        for (int i = 0; i < 2000; ++i) {
            glm::dvec3 c{random.in(-10, 10), random.in(-10, 10), random.in(-10, 10)};
            if (kind == 1) c *= 0.05;
            if (kind == 2) c = {0.1 * i, 0, 0};
            balls.push_back({c, kind == 3 && i == 77 ? 50.0 : random.in(0.01, 0.2)});
        }
        std::vector<std::pair<int, int>> all;
        for (int i = 0; i < 2000; ++i)
            for (int j = i + 1; j < 2000; ++j)
                if (overlap(balls[static_cast<std::size_t>(i)], balls[static_cast<std::size_t>(j)])) all.push_back({i, j});
        CHECK(overlappingPairs(balls) == all);
    }
}

TEST_CASE("which restitution and friction two bodies have") {
    World world;
    world.restitution = 0.6, world.friction = 0.4;
    Body a, b;
    CHECK(pairing(world, a, b).restitution == 0.6);
    CHECK(pairing(world, a, b).friction == 0.4);
    a.restitution = 0.1, a.friction = 0.9;
    CHECK(pairing(world, a, b).restitution == 0.1);
    CHECK(pairing(world, b, a).friction == 0.9);
    b.restitution = 0.3, b.friction = 0.4;
    CHECK(pairing(world, a, b).restitution == 0.3);
    CHECK(pairing(world, a, b).friction == doctest::Approx(0.6));
    CHECK(pairing(world, a).friction == 0.9);
}
