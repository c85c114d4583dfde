// Falling and bouncing: the cases that have a closed form.
#include "scenes.h"

#include <doctest/doctest.h>

using namespace mb;
using namespace mb::test;

TEST_CASE("free fall is exact for any step") {
    for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240}) {
        Scene s = scene(dt, 0.5, 0.5);
        ball(s, {0, 40, 0}, 0.5, {1, 2, -3});
        PhysicsWorld w(s);
        run(w, 1);
        const double t = w.time_s();
        const glm::dvec3 want = glm::dvec3{0, 40, 0} + t * glm::dvec3{1, 2, -3} - glm::dvec3{0, 0.5 * kG * t * t, 0};
        CHECK(glm::length(w.bodies()[0].position - want) <= 1e-11);  // rounding of 240 sums of numbers near 40
        CHECK(w.bodies()[0].velocity.y == doctest::Approx(2 - kG * t).epsilon(1e-12));
    }
}

namespace {
/// The greatest height of the lowest point between the first and the second impact.
double rebound(double e, double dt) {
    Scene s = scene(dt, e, 0.5);
    floor(s);
    ball(s, {0, 2.5, 0}, 0.5);
    PhysicsWorld w(s);
    double highest = 0;
    bool up = false;
    while (w.time_s() < 4) {
        w.step();
        const Body& b = w.bodies()[0];
        if (b.velocity.y > 0) up = true;
        // The apex lies between two steps: from either one it is v²/2g above.
        if (up) highest = std::max(highest, b.position.y - 0.5 + (std::fabs(b.velocity.y) < 2 * kG * dt ? b.velocity.y * b.velocity.y / (2 * kG) : 0));
        if (up && b.velocity.y < -2 * kG * dt) break;
    }
    return highest;
}
}  // namespace

TEST_CASE("a ball dropped from 2 m rebounds to e² of the drop, whatever the step") {
    double worst = 0;
    for (const double e : {0.3, 0.5, 0.8, 1.0})
        for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240}) {
            const double error = std::fabs(rebound(e, dt) / (2 * e * e) - 1);
            worst = std::max(worst, error);
            CAPTURE(e); CAPTURE(dt);
            CHECK(error <= 0.02);
        }
    CHECK(worst <= 1e-9);  // impacts are resolved when they happen: what is left is the root's tolerance
    MESSAGE("rebound error ", worst);
}

TEST_CASE("at e = 0 a dropped ball stays down") {
    for (const double dt : {1.0 / 30, 1.0 / 240}) {
        Scene s = scene(dt, 0, 0.5);
        floor(s);
        ball(s, {0, 2.5, 0}, 0.5);
        PhysicsWorld w(s);
        run(w, 2);
        CHECK(std::fabs(w.bodies()[0].position.y - 0.5) <= 1e-4);  // the depth a resting ball may sink to
        CHECK(w.awake() == 0);
    }
}

TEST_CASE("at e = 1 energy neither grows nor shrinks in 20 s") {
    for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120}) {
        Scene s = scene(dt, 1, 0.5);
        floor(s);
        ball(s, {0, 1.5, 0}, 0.5);
        PhysicsWorld w(s);
        const double start = w.energy().total(), base = 0.5 * kG;
        double most = 0;
        while (w.time_s() < 20) {
            w.step();
            most = std::max(most, std::fabs((w.energy().total() - base) / (start - base) - 1));
        }
        CHECK(most <= 1e-8);  // a few dozen impacts, each at a height that is known to 1e-11 m
        MESSAGE("energy drift ", most, " at dt ", dt);
    }
}

TEST_CASE("1,000 steps at e = 0.9 follow a reference of ten lines") {
    const double dt = 1.0 / 60;
    Scene s = scene(dt, 0.9, 0);
    floor(s);
    ball(s, {0, 1.5, 0}, 0.5);
    PhysicsWorld w(s);
    double y = 1, v = 0, worst = 0;
    for (int i = 0; i < 1000; ++i) {
        w.step();
        for (double left = dt; left > 0;) {
            const double hit = (v + std::sqrt(v * v + 2 * kG * y)) / kG;
            const double t = std::min(left, hit);
            y = std::max(y + v * t - 0.5 * kG * t * t, 0.0), v -= kG * t, left -= t;
            if (t == hit) v *= -0.9;
        }
        if (std::fabs(v) < 1 && y < 0.06) break;  // soon it bounces more than once a step and comes to rest
        worst = std::max({worst, std::fabs(w.bodies()[0].position.y - 0.5 - y), std::fabs(w.bodies()[0].velocity.y - v)});
    }
    CHECK(worst <= 1e-5);
    MESSAGE("against the reference ", worst);
}

TEST_CASE("slow approaches do not bounce, fast ones do") {
    const double dt = 1.0 / 120;
    for (const double v : {0.02, 0.1, 0.15, 0.2, 0.5, 2.0}) {
        Scene s = scene(dt, 0.8, 0);
        floor(s);
        ball(s, {0, 0.5, 0}, 0.5, {0, -v, 0});
        PhysicsWorld w(s);
        w.step();
        const double after = w.bodies()[0].velocity.y;
        if (v < 2 * kG * dt) CHECK(std::fabs(after) <= 1e-9);                  // 0.1635 m/s: what gravity gives in two steps
        else CHECK(after == doctest::Approx(0.8 * v - kG * dt).epsilon(1e-9));
    }
}

TEST_CASE("nothing tunnels") {
    for (const double speed : {200.0, 1e3, 1e4})
        for (const double dt : {1.0 / 30, 1.0 / 60}) {
            Scene s = scene(dt, 0, 0, 0);
            add(s, "box", {0.5, 0, 0}, {0.1, 4, 4, 0});
            ball(s, {-30, 0, 0}, 0.1, {speed, 0, 0});
            PhysicsWorld w(s);
            run(w, 1);
            REQUIRE(w.bodies().size() == 1);
            CHECK(std::fabs(w.bodies()[0].position.x - 0.35) <= 1e-4);
        }
}

TEST_CASE("a fast ball keeps its speed until the wall") {
    Scene s = scene(0.25, 0, 0, 0);
    add(s, "plane", {12, 0, 0}, {-1, 0, 0, 0});
    ball(s, {0, 0, 0}, 0.3, {20, 0, 0});
    PhysicsWorld w(s);
    w.step(), w.step();
    CHECK(w.bodies()[0].position.x == doctest::Approx(10));
    run(w, 1);
    CHECK(w.bodies()[0].position.x == doctest::Approx(11.7).epsilon(1e-6));
}

TEST_CASE("a ball in a box of walls never leaves it, and e = 1 keeps its energy") {
    Scene s = scene(1.0 / 30, 1, 0);
    add(s, "subtract", {}, {0});
    add(s, "box", {}, {2.2, 2.2, 2.2, 0}, 0);
    add(s, "box", {}, {2, 2, 2, 0}, 0);
    ball(s, {0.1, 0.2, -0.3}, 0.1, {13, 7, 11});
    PhysicsWorld w(s);
    const double start = w.energy().total();
    double worst = 0;
    for (int i = 0; i < 600; ++i) {
        w.step();
        const glm::dvec3 p = glm::abs(w.bodies()[0].position);
        REQUIRE(std::max({p.x, p.y, p.z}) <= 0.9 + 1e-4);
        worst = std::max(worst, std::fabs(w.energy().total() / start - 1));
    }
    CHECK(worst <= 1e-8);
    MESSAGE("energy drift in the box ", worst);
}
