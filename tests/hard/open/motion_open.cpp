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

TEST_CASE("case 79, open: a cube on a ball or a ridge gains no energy") {
    for (const double x : {0.0, 5.0}) {
        Scene s = scene(1.0 / 120, 0.5, 0.5);
        add(s, "sphere", {}, {0.5});
        add(s, "box", {5, 0, 0}, {1, 1, 1, 0}).rot.z = 45;
        const double top = x == 0 ? 0.5 : std::sqrt(0.5);
        bodyOf(s, "box", {x, top + 0.1, 0}, 0.2), bodyOf(s, "box", {x + 0.01, top + 0.4, 0.02}, 0.2);
        PhysicsWorld w(s);
        const double start = w.energy().total();
        double last = start, most = 0;
        for (int i = 0; i < 240; ++i) {
            w.step();
            most = std::max(most, (w.energy().total() - last) / start), last = w.energy().total();
        }
        MESSAGE((x == 0 ? std::string_view("ball") : std::string_view("ridge")), ": energy up by ", most, " in a step");
        CHECK(most <= 1e-9);
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
