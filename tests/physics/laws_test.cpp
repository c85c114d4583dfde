// Laws beside the hard cases (tests/hard/motion_*.cpp).
#include "scenes.h"

#include <doctest/doctest.h>

using namespace mb;
using namespace mb::test;

TEST_CASE("a ball in a box of walls never leaves it, and e = 1 keeps its energy") {
    Scene s = scene(1.0 / 30, 1, 0);
    room(s, 2);
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

TEST_CASE("thrown balls are thrown the same way for the same seed") {
    Scene s = scene(1.0 / 120, 0.5, 0.4);
    bowl(s, 1.5);
    for (int i = 0; i < 20; ++i) bodyOf(s, kKinds[i % 2], {0.3 * (i % 4) - 0.45, 0.2 * (i / 4) - 0.8, 0.1}, 0.15);
    PhysicsWorld a(s), b(s), c(s);
    a.throwAbout(7, 5), b.throwAbout(7, 5), c.throwAbout(8, 5);
    run(a, 0.5), run(b, 0.5), run(c, 0.5);
    CHECK(a.stateHash() == b.stateHash());
    CHECK(a.stateHash() != c.stateHash());
}

TEST_CASE("static shapes that cannot be evaluated are named, not met") {
    Scene s = scene(1.0 / 120, 0.5, 0.5);
    Object& o = add(s, "bend", {}, {0.1});
    o.name = "hull";
    add(s, "plane", {}, {0, 1, 0, 0}, 0);
    ball(s, {0, 2, 0}, 0.1);
    PhysicsWorld w(s);
    REQUIRE(w.notes().size() == 1);
    CHECK(w.notes()[0].find("no body meets it: object 'hull'") == 0);
    run(w, 0.5);
    CHECK(w.bodies()[0].position.y < 1);
}
