// Gravity of any direction.
#include "core/scene/text.h"
#include "physics/motion_sweep.h"
#include "physics/random.h"
#include "physics/true_motion.h"
#include "scenes.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace mb;
using namespace mb::test;

namespace {

/// The whole scene, gravity with it, turned about the origin.
Scene turnedScene(Scene s, const glm::dmat3& by) {
    s.world.down = by * s.world.down;
    for (Object& o : s.objects) {
        if (o.parent != kNoParent) continue;
        o.pos = by * o.pos, o.vel = by * o.vel, o.spin = by * o.spin;
        o.rot = degreesFromRotation(by * rotationFromDegrees(o.rot));
    }
    return s;
}

/// Balls that fall into a bowl, and a box and a ball onto a slope. (Where several points of a shape are equally deep, rounding says
/// which counts: so the box does not come down flat.)
Scene playground() {
    Scene s = scene(1.0 / 120, 0.4, 0.5);
    bowl(s, 1.5);
    add(s, "box", {2.5, 0.4, 0}, {2, 0.4, 2, 0.02}).rot = {0, 0, 25};
    ball(s, {0.3, 0.5, 0.1}, 0.2, {0.5, 0, 1}), ball(s, {-0.6, 0.1, -0.3}, 0.15);
    ball(s, {2.6, 1.2, 0.2}, 0.2).spin = {1, 2, 3};
    block(s, {2.4, 1.1, -0.5}, {0.3, 0.2, 0.4}).rot = {10, 20, 30};
    return s;
}

}  // namespace

TEST_CASE("gravity and the scene turned together turn the motion") {
    const Scene s = playground();
    Random random(7);
    for (int trial = 0; trial < 4; ++trial) {
        const double a = random.in(-180, 180), b = random.in(-180, 180), c = random.in(-180, 180);
        const glm::dmat3 by = rotationFromDegrees(trial == 0 ? glm::dvec3{0, 0, 90} : glm::dvec3{a, b, c});
        PhysicsWorld straight(s), turned(turnedScene(s, by));
        double rolling = 0, apart = 0, tilted = 0;  // m of the balls, m of the box, of all
        for (int i = 0; i < 90; ++i) {
            straight.step(), turned.step();
            for (std::size_t k = 0; k < straight.bodies().size(); ++k) {
                double& most = straight.bodies()[k].isBall() ? rolling : apart;
                most = std::max(most, glm::length(by * straight.bodies()[k].position - turned.bodies()[k].position));
                const glm::dmat3 there = glm::mat3_cast(turned.bodies()[k].orientation), here = by * glm::mat3_cast(straight.bodies()[k].orientation);
                for (int axis = 0; axis < 3; ++axis) tilted = std::max(tilted, glm::length(there[axis] - here[axis]));
            }
        }
        // What differs is rounding, which every impact multiplies: 2e-14 of the balls, 1.3e-13 of the box.
        CHECK(rolling <= 1e-10);
        CHECK(apart <= 1e-10);
        CHECK(tilted <= 1e-10);
        const double lost = straight.energy().total() - turned.energy().total();
        CHECK(std::fabs(lost) <= 1e-10 * std::fabs(straight.energy().total()));
        MESSAGE("turn ", trial, ": balls apart by ", rolling, " m, the box by ", apart, " m, ", tilted, " rad, energy by ", lost, " J");
    }
}

TEST_CASE("a body falls along `down`, whatever its length, and its energy stays") {
    for (const glm::dvec3 down : {glm::dvec3{1, 0, 0}, glm::dvec3{0, 3, 0}, glm::dvec3{1e-200, -2e-200, 2e-200}, glm::dvec3{3e11, 0, -4e11}}) {
        Scene s = scene(1.0 / 120, 0, 0);
        ball(s, {1, 2, 3}, 0.1, {0.5, 0, 0}, 2);
        block(s, {-3, 2, 3}, {0.2, 0.4, 0.3}).spin = {3, 1, 0};
        s.world.down = down;
        PhysicsWorld w(s);
        const double before = w.energy().total();
        run(w, 1);
        const glm::dvec3 largest = down / std::max({std::fabs(down.x), std::fabs(down.y), std::fabs(down.z)});
        const glm::dvec3 fallen = 0.5 * kG * glm::normalize(largest);
        CHECK(glm::length(w.bodies()[0].position - (glm::dvec3{1.5, 2, 3} + fallen)) <= 1e-12);
        CHECK(glm::length(w.bodies()[1].position - (glm::dvec3{-3, 2, 3} + fallen)) <= 1e-12);
        CHECK(w.energy().total() == doctest::Approx(before).epsilon(1e-12));
    }
}

TEST_CASE("what rests on a wall that gravity points to sleeps there, and wakes when gravity turns") {
    Scene s = scene(1.0 / 120, 0.3, 0.5);
    s.world.down = {2, 0, 0};
    add(s, "plane", {}, {-1, 0, 0, 0});
    ball(s, {-0.5, 0, 0}, 0.1), block(s, {-0.4, 1, 0}, {0.2, 0.2, 0.2});
    PhysicsWorld w(s);
    run(w, 4);
    CHECK(w.awake() == 0);
    for (const Body& b : w.bodies()) CHECK(b.position.x == doctest::Approx(-0.1).epsilon(1e-3));
    s.world.down = {0, -1, 0};
    w.changeStatics(s);
    run(w, 0.5);
    CHECK(w.awake() == 2);
    for (const Body& b : w.bodies()) CHECK(b.velocity.y < -4);
}

TEST_CASE("the default is what a file without the key says, and what has no length is refused with its place") {
    const ReadResult silent = readScene("marchbox 1\nworld gravity:9.81\n"), said = readScene("marchbox 1\nworld down:0,-1,0\n");
    REQUIRE(silent.ok());
    CHECK(sameScene(silent.scene, said.scene));
    CHECK(silent.scene.world.fall() == glm::dvec3{0, -9.81, 0});
    const ReadResult tilted = readScene("marchbox 1\nworld down:1,-2,0.5\n");
    REQUIRE(tilted.ok());
    CHECK(writeScene(tilted.scene) == "marchbox 1\nworld down:1,-2,0.5\n");
    const auto refused = [](const char* value) {
        const ReadResult r = readScene(std::string("marchbox 1\nworld gravity:1 down:") + value + "\n");
        return r.ok() ? std::string("read") : describe(r.faults.front(), "s.txt");
    };
    CHECK(refused("0,0,0") == "s.txt:2:22: error: 'down' has no length, expected a direction");
    CHECK(refused("0,-0,0") == "s.txt:2:22: error: 'down' has no length, expected a direction");
    for (const char* bad : {"nan,0,0", "0,inf,0", "1e400,0,0", "1,2", "1", "down", "1e13,0,0"}) CHECK(refused(bad).starts_with("s.txt:2:"));
    Scene s;
    CHECK(setKnob(s, "down=0,0,0"));
    CHECK_FALSE(setKnob(s, "down=1,0,0"));
    CHECK(s.world.fall() == glm::dvec3{9.81, 0, 0});
}

TEST_CASE("where gravity is not upright there is no closed form, and restitution is measured all the same") {
    Scene s = scene(1.0 / 120, 0.8, 0);
    floor(s);
    ball(s, {0, 1, 0}, 0.1);
    CHECK(closedTrack(s, 1, 0.1));
    s.world.down = {0, -7, 0};
    CHECK(closedTrack(s, 1, 0.1));
    s.world.down = {0.1, -1, 0};
    CHECK_FALSE(closedTrack(s, 1, 0.1));
    s.world.down = {0, 1, 0};
    CHECK_FALSE(closedTrack(s, 1, 0.1));
    CHECK(restitutionError(s.world, s.physics) <= 1e-9);
}
