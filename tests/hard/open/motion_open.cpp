// Cases of motion that this version does not meet, as they should be: in no test program until it does (the suite takes the files
// of tests/hard/ alone). docs/hard_cases.md has the figures and the causes.
#include "physics/scenes.h"

#include <doctest/doctest.h>

using namespace mb;
using namespace mb::test;

TEST_CASE("case 60, open: two small boxes carry one of a million times their mass") {
    for (const double ratio : {1e3, 1e6}) {
        Scene s = scene(1.0 / 120, 0, 0.5);
        floor(s);
        for (const double x : {-0.3, 0.3}) block(s, {x, 0.05, 0}, {0.1, 0.1, 0.1});
        block(s, {0, 0.2, 0}, {1, 0.2, 0.2}, ratio * 1000 / 40);  // 40 times as large
        PhysicsWorld w(s);
        double deepest = 0;
        while (w.time_s() < 3) w.step(), deepest = std::max(deepest, w.maxPenetration());
        MESSAGE("mass ratio ", ratio, ": deepest ", deepest);
        CHECK(deepest <= 1e-3);
    }
}

TEST_CASE("case 64, open: a hollow ball that lies wholly in a solid comes out") {
    Scene s = scene(1.0 / 120, 0.3, 0.4);
    floor(s);
    add(s, "box", {0, 0.5, 0}, {2, 1, 2, 0});
    add(s, "shell", {0.2, 0.4, 0.1}, {0.01}).density = 800;
    add(s, "sphere", {}, {0.3}, 2);
    PhysicsWorld w(s);
    run(w, 8);
    const glm::dvec3 at = w.bodies()[0].position;
    MESSAGE("at ", at.x, " ", at.y, " ", at.z, ", seen to be ", w.maxPenetration(), " m deep");
    CHECK((std::max(std::fabs(at.x), std::fabs(at.z)) >= 1.299 || at.y >= 1.299));
}

TEST_CASE("bumpy shapes, open: a ball with waves of 3 cm that falls onto a floor neither sinks in nor gains energy") {
    Scene s = scene(1.0 / 240, 0.3, 0.5);
    floor(s);
    add(s, "displace", {0, 6, 0}, {0.03, 12}).density = 800;
    add(s, "sphere", {}, {0.4}, 1);
    PhysicsWorld w(s);
    const double start = w.energy().total();
    double last = start, most = 0, deepest = 0;
    while (w.time_s() < 8) {
        w.step();
        most = std::max(most, (w.energy().total() - last) / start), last = w.energy().total();
        deepest = std::max(deepest, w.maxPenetration());
    }
    MESSAGE("deepest ", deepest, " m, most energy gained in a step ", most, " of all");
    CHECK(deepest <= 1e-3);
    CHECK(most <= 1e-5);
}
