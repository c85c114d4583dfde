// Cases 65, 66 and 83: what is fast goes through nothing, waits for nothing, and is slowed down to the top speed.
#include "physics/random.h"
#include "physics/scenes.h"
#include "sdf/draw.h"

#include <doctest/doctest.h>

using namespace mb;
using namespace mb::test;

TEST_CASE("case 65: at 200, 1e3 and 1e4 m/s nothing goes through a wall of 0.1 m") {
    for (const std::string_view kind : kKinds) {
        double worst = 0;
        for (const double speed : {200.0, 1e3, 1e4})
            for (const double dt : {1.0 / 30, 1.0 / 60}) {
                Scene s = scene(dt, 0, 0, 0);
                add(s, "box", {0.5, 0, 0}, {0.1, 4, 4, 0});
                s.objects[bodyOf(s, kind, {-30, 0, 0}, 0.2)].vel.x = speed;
                PhysicsWorld w(s);
                run(w, 1);
                REQUIRE(w.bodies().size() == 1);
                if (kind == "die") CHECK(w.bodies()[0].position.x < 0.35);  // its push may pass beside its centre: then it turns
                else worst = std::max(worst, std::fabs(w.bodies()[0].position.x - 0.35));
            }
        CAPTURE(kind);
        CHECK(worst <= 1e-4);
        MESSAGE(kind, " stops off by ", worst);
    }
}

namespace {

/// A closed shell of 1 mm, 2 m wide: round, or with corners.
void shell(Scene& s, bool round) {
    add(s, "subtract", {}, {0});
    if (round) add(s, "sphere", {}, {1.001}, 0), add(s, "sphere", {}, {1}, 0);
    else add(s, "box", {}, {2.002, 2.002, 2.002, 0}, 0), add(s, "box", {}, {2, 2, 2, 0}, 0);
}

/// Launches a body within the shell at 10 to 500 m/s; whether it is still within after a quarter of a second.
bool staysIn(std::string_view kind, bool round, Random& io_random) {
    const auto any = [&](double x) { return glm::dvec3{io_random.in(-x, x), io_random.in(-x, x), io_random.in(-x, x)}; };
    Scene s = scene(1.0 / 60, io_random.in(0, 1), io_random.in(0, 1), 0);
    shell(s, round);
    Object& o = s.objects[bodyOf(s, kind, any(0.4), 0.2)];
    o.vel = glm::normalize(any(1)) * std::exp(io_random.in(std::log(10.0), std::log(500.0)));
    o.rot = any(180), o.spin = any(50);
    PhysicsWorld w(s);
    for (int i = 0; i < 15; ++i) {
        w.step();
        if (w.bodies().empty()) return false;
        const auto outside = [&](const glm::dvec3& p, double wall) {
            const glm::dvec3 size = glm::abs(p);
            return (round ? glm::length(p) : std::max({size.x, size.y, size.z})) >= wall;
        };
        const Body& b = w.bodies()[0];
        if (outside(b.position, 1)) return false;
        for (int k = 0; k < 8 && !b.isBall(); ++k)  // no corner has come out
            if (outside(b.pose().toWorld({k & 1 ? 0.1 : -0.1, k & 2 ? 0.1 : -0.1, k & 4 ? 0.1 : -0.1}), 1.001)) return false;
    }
    return true;
}

}  // namespace

namespace {
/// The issue asks for 10,000 of each kind.
void launchAll(std::string_view kind, bool round) {
    const auto launches = static_cast<int>(environmentNumber("TEST_LAUNCHES", 200));
    Random random(testSeed());
    int through = 0;
    for (int i = 0; i < launches; ++i) through += !staysIn(kind, round, random);
    CHECK(through == 0);
    MESSAGE(kind, round ? std::string_view(", round shell: ") : std::string_view(", shell with corners: "), through, " of ", launches, " went through");
}
}  // namespace

// Cases of their own, so that several may run at once.
TEST_CASE("case 65: of random launches of balls at 10 to 500 m/s none goes through a round shell of 1 mm") { launchAll("ball", true); }
TEST_CASE("case 65: of random launches of balls at 10 to 500 m/s none goes through a shell of 1 mm with corners") { launchAll("ball", false); }
TEST_CASE("case 65: of random launches of cubes at 10 to 500 m/s none goes through a round shell of 1 mm") { launchAll("box", true); }
TEST_CASE("case 65: of random launches of cubes at 10 to 500 m/s none goes through a shell of 1 mm with corners") { launchAll("box", false); }

TEST_CASE("case 66: a fast body keeps its speed until the wall") {
    for (const std::string_view kind : {"ball", "box"}) {
        Scene s = scene(0.25, 0, 0, 0);
        add(s, "plane", {12, 0, 0}, {-1, 0, 0, 0});
        s.objects[bodyOf(s, kind, {}, 0.6)].vel.x = 20;
        PhysicsWorld w(s);
        w.step(), w.step();
        CHECK(w.bodies()[0].position.x == doctest::Approx(10));
        run(w, 1);
        CHECK(std::fabs(w.bodies()[0].position.x - 11.7) <= 1e-4);
        MESSAGE(kind, " rests off by ", w.bodies()[0].position.x - 11.7);
    }
}

TEST_CASE("case 83: speeds are capped and said, and what leaves the world is counted and leaves the scene") {
    for (const std::string_view kind : {"ball", "box"}) {
        Scene s = scene(1.0 / 60, 0.5, 0.5);
        s.objects[bodyOf(s, kind, {0, 5, 0}, 0.2)].name = "stone";
        bodyOf(s, kind, {5, 9, 0}, 0.2);
        s.world.bounds = 1e3;
        PhysicsWorld w(s);
        w.setMotion(0, {1e9, 1e300, 0}, {0, 1e9, 0});
        w.step();
        REQUIRE(w.notes().size() == 2);
        CHECK(w.notes()[0] == "stone: slowed down to 10000 m/s");
        CHECK(w.notes()[1] == "stone: slowed down to 1000000 rad/s");
        CHECK(glm::length(w.bodies()[0].velocity) == doctest::Approx(kTopSpeed).epsilon(1e-3));
        run(w, 1);
        CHECK(w.removed() == 1);
        w.writeTo(s);
        CHECK(s.objects.size() == 1);
        run(w, 20);
        CHECK(w.removed() == 2);
        CHECK(w.bodies().empty());
        w.step();
    }
}

TEST_CASE("case 66: what has thin walls falls as far as what has none, held in no step") {
    for (const double wall : {1e-2, 1e-4, 1e-6}) {
        Scene s = scene(1.0 / 120, 0, 0.5);
        floor(s);
        add(s, "shell", {0, 6, 0}, {wall}).mass = 1;
        add(s, "sphere", {}, {1}, static_cast<int>(s.objects.size()) - 1);
        PhysicsWorld w(s);
        run(w, 1);
        CAPTURE(wall);
        CHECK(std::fabs(w.bodies()[0].position.y - (6 - 0.5 * kG)) <= 1e-9);
        CHECK(w.held() == 0);
        CHECK(w.counts().evaluations < 1'000'000);
    }
}
