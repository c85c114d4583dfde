// Rolling, sliding and lying still.
#include "scenes.h"

#include <doctest/doctest.h>

using namespace mb;
using namespace mb::test;

namespace {
/// A ball at rest on a plane that falls by `degrees` towards +x; how fast it gets along the slope in one second, and spins.
struct Rolled { double acceleration, spin; };
Rolled onRamp(double degrees, double friction, double dt, bool box) {
    const double a = degrees * kPi / 180, r = 0.2;
    const glm::dvec3 n{std::sin(a), std::cos(a), 0}, down{std::cos(a), -std::sin(a), 0};
    Scene s = scene(dt, 0, friction);
    if (box) add(s, "box", -0.5 * n, {60, 1, 4, 0}).rot = {0, 0, -degrees};
    else add(s, "plane", {}, {n.x, n.y, 0, 0});
    ball(s, r * n, r);
    PhysicsWorld w(s);
    run(w, 1);
    const Body& b = w.bodies()[0];
    CHECK(std::fabs(glm::dot(b.position, n) - r) <= 1e-4);
    // From rest s = a t²/2, exact for a constant acceleration.
    return {2 * glm::dot(b.position, down), -b.spin.z * r};
}
}  // namespace

TEST_CASE("a ball on a 20 degree ramp rolls with 5/7 of g sin 20°") {
    double worst = 0;
    for (const bool box : {false, true})
        for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240}) {
            const double want = 5.0 / 7 * kG * std::sin(20 * kPi / 180);
            const Rolled rolled = onRamp(20, 0.5, dt, box);
            worst = std::max({worst, std::fabs(rolled.acceleration / want - 1), std::fabs(rolled.spin / want - 1)});
            CHECK(rolled.acceleration == doctest::Approx(want).epsilon(0.02));
        }
    CHECK(worst <= 1e-6);
    MESSAGE("rolling error ", worst);
}

TEST_CASE("on any ramp a ball rolls if tan θ ≤ 3.5 μ, and else slides while it is turned") {
    double worst = 0;
    for (const double degrees : {10.0, 30.0, 45.0, 60.0})
        for (const double mu : {0.0, 0.1, 0.3, 1.0}) {
            const double a = degrees * kPi / 180, roll = 5.0 / 7 * kG * std::sin(a);
            const bool rolls = std::tan(a) <= 3.5 * mu;
            const Rolled r = onRamp(degrees, mu, 1.0 / 120, false);
            const double want = rolls ? roll : kG * (std::sin(a) - mu * std::cos(a));
            const double spin = rolls ? roll : 2.5 * mu * kG * std::cos(a);
            worst = std::max({worst, std::fabs(r.acceleration / want - 1), std::fabs(r.spin - spin) / roll});
        }
    CHECK(worst <= 0.01);
    MESSAGE("ramp error ", worst);
}

TEST_CASE("a sliding ball comes to roll with 5/7 of its speed after 2v/(7μg)") {
    Scene s = scene(1.0 / 120, 0, 0.3);
    s.world.bounds = 1e3;
    floor(s);
    ball(s, {0, 0.2, 0}, 0.2, {5, 0, 0});
    PhysicsWorld w(s);
    const double when = 2 * 5 / (7 * 0.3 * kG);
    double rolls_at = 0;
    while (w.time_s() < 2 * when) {
        w.step();
        const Body& b = w.bodies()[0];
        if (rolls_at == 0 && std::fabs(b.velocity.x + b.spin.z * b.radius) <= 1e-6) rolls_at = w.time_s();
    }
    CHECK(rolls_at == doctest::Approx(when).epsilon(0.05));
    CHECK(w.bodies()[0].velocity.x == doctest::Approx(5 * 5.0 / 7).epsilon(1e-4));
}

TEST_CASE("in a bowl a ball swings with the period of rolling, and of sliding without friction") {
    for (const double mu : {0.0, 1.0}) {
        Scene s = scene(1.0 / 240, 0, mu);
        bowl(s, 1);
        const double swing = 0.05, l = 0.9;
        ball(s, {l * std::sin(swing), -l * std::cos(swing), 0}, 0.1);
        PhysicsWorld w(s);
        const double start = w.energy().total();
        double last = w.bodies()[0].position.x, first = 0, most = 0;
        int crossings = 0;
        double crossed = 0;
        while (crossings < 9) {
            w.step();
            const double x = w.bodies()[0].position.x;
            if ((x > 0) != (last > 0)) {
                crossed = w.time_s() - w.dt_s() * x / (x - last);
                if (crossings++ == 0) first = crossed;
            }
            last = x;
            most = std::max(most, w.energy().total() - start);
            REQUIRE(w.time_s() < 20);
        }
        const double period = (crossed - first) / 4;
        const double want = 2 * kPi * std::sqrt(l / kG * (mu > 0 ? 1.4 : 1)) * (1 + swing * swing / 16);
        CHECK(period == doctest::Approx(want).epsilon(0.01));
        CHECK(most <= 1e-5 * kG);  // case 81's share of m·g·1 m
        MESSAGE("bowl period error ", period / want - 1, ", energy gained ", most);
    }
}

TEST_CASE("a ball at rest stays where it is for a minute, asleep") {
    struct Place { std::string_view name; glm::dvec3 at; };
    for (const int place : {0, 1, 2}) {
        Scene s = scene(1.0 / 120, 0.5, 0.5);
        glm::dvec3 at{0, 0.1, 0};
        if (place == 0) floor(s);
        else if (place == 1) bowl(s, 1), at = {0, -0.9, 0};
        else groove(s, 90), at = {0, 0.1 * std::sqrt(2.0), 0};
        ball(s, at, 0.1);
        PhysicsWorld w(s);
        run(w, 1);
        CHECK(w.awake() == 0);
        CHECK(glm::length(w.bodies()[0].velocity) <= 1e-3);
        const glm::dvec3 then = w.bodies()[0].position;
        run(w, 59);
        CHECK(glm::length(w.bodies()[0].position - then) <= 1e-9);
        CHECK(glm::length(w.bodies()[0].position - at) <= 1e-3);
    }
}

TEST_CASE("spin in free space keeps its size, and the orientation its length") {
    Scene s = scene(1.0 / 120, 0, 0, 0);
    ball(s, {}, 0.3).spin = {60, 64, 48};
    PhysicsWorld w(s);
    for (int i = 0; i < 20'000; ++i) w.step();
    CHECK(glm::length(w.bodies()[0].spin) == doctest::Approx(100).epsilon(1e-12));
    CHECK(std::fabs(glm::length(w.bodies()[0].orientation) - 1) <= 1e-12);
    // A hundred full turns end where they began: the angle errs by the tangent's x⁷/1575 at x ≤ 1/8.
    const glm::dquat q = turned({1, 0, 0, 0}, {0, 2 * kPi, 0}, 100);
    CHECK(std::fabs(std::fabs(q.w) - 1) <= 1e-6);
}
