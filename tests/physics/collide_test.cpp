// Balls against balls.
#include "physics/broadphase.h"
#include "physics/random.h"
#include "scenes.h"

#include <doctest/doctest.h>

#include <numeric>

using namespace mb;
using namespace mb::test;

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

TEST_CASE("which restitution and friction two bodies have") {
    World world;
    world.restitution = 0.6, world.friction = 0.4;
    Body a, b;
    CHECK(pairing(world, a, b).restitution == 0.6);
    CHECK(pairing(world, a, b).friction == 0.4);
    a.own = std::make_shared<const OwnSurface>(OwnSurface{.restitution = 0.1, .friction = 0.9});
    CHECK(pairing(world, a, b).restitution == 0.1);
    CHECK(pairing(world, b, a).friction == 0.9);
    b.own = std::make_shared<const OwnSurface>(OwnSurface{.restitution = 0.3, .friction = 0.4});
    CHECK(pairing(world, a, b).restitution == 0.3);
    CHECK(pairing(world, a, b).friction == doctest::Approx(0.6));
    CHECK(pairing(world, a).friction == 0.9);
}
