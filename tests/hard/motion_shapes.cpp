// Cases of motion that are harder for boxes and capsules than for balls.
#include "physics/scenes.h"

#include <doctest/doctest.h>

using namespace mb;
using namespace mb::test;

TEST_CASE("case 58: two cubes that meet face to face exchange velocities, wherever they start") {
    int through = 0;
    double worst = 0;
    for (int i = 0; i < 20; ++i) {
        const double gap = 2.5 + 0.05 * i;
        Scene s = scene(1.0 / 60, 1, 0, 0);
        block(s, {-0.5 - 0.5 * gap, 0, 0}, {1, 1, 1}).vel.x = 5;
        block(s, {0.5 + 0.5 * gap, 0, 0}, {1, 1, 1}).vel.x = -10;
        PhysicsWorld w(s);
        run(w, 1);
        through += w.bodies()[0].position.x > w.bodies()[1].position.x;
        worst = std::max({worst, std::fabs(w.bodies()[0].velocity.x + 10), std::fabs(w.bodies()[1].velocity.x - 5)});
    }
    MESSAGE(through, " of 20 went through one another");
    CHECK(through == 0);
    CHECK(worst <= 1e-5);
}

TEST_CASE("case 62: cubes in line overlap as deeply as they do") {
    for (const double overlap : {1e-4, 0.01, 0.1, 0.25, 0.4}) {
        Scene s = scene(1.0 / 60, 0, 0.5, 0);
        block(s, {}, {1, 1, 1}), block(s, {1 - overlap, 0, 0}, {1, 1, 1});
        CAPTURE(overlap);
        CHECK(PhysicsWorld(s).maxPenetration() == doctest::Approx(overlap).epsilon(1e-3));
    }
}

TEST_CASE("case 62: a pyramid of boxes that overlaps by a quarter comes apart") {
    Scene s = scene(1.0 / 60, 0, 0.5);
    floor(s);
    for (int row = 0; row < 4; ++row)
        for (int i = 0; i < 4 - row; ++i) block(s, {0.15 * i + 0.075 * row, 0.08 + 0.15 * row, 0}, {0.2, 0.2, 0.2});
    PhysicsWorld w(s);
    run(w, 2);
    MESSAGE("overlap left ", w.maxPenetration());
    CHECK(w.maxPenetration() <= 3e-4);
}

TEST_CASE("case 63: boxes and capsules whose centres coincide are parted") {
    for (const std::string_view kind : {"box", "capsule"}) {
        Scene s = scene(1.0 / 60, 0.5, 0.5, 0);
        bodyOf(s, kind, {}, 0.2), bodyOf(s, kind, {}, 0.2);
        PhysicsWorld w(s);
        const double seen = w.maxPenetration();
        run(w, 3);
        const double apart = glm::length(w.bodies()[0].position - w.bodies()[1].position);
        MESSAGE(kind, ": apart by ", apart, " m, overlap at first ", seen);
        CHECK(apart >= 0.2 - 1e-3);
    }
}

TEST_CASE("case 64: a body in a box that stands on the floor, or beside another, comes out and is not pushed back and forth") {
    // The nearest face of the box lies on the floor, or on the other box.
    for (const bool beside : {false, true})
        for (const std::string_view kind : kKinds)
            for (const double y : {0.12, 0.3}) {
                Scene s = scene(1.0 / 120, 0.3, 0.4);
                floor(s);
                add(s, "box", {0, 1, 0}, {2, 2, 2, 0});
                if (beside) add(s, "box", {2, 1, 0}, {2, 2, 2, 0});
                bodyOf(s, kind, {beside ? 0.9 : 0.1, y, 0.05}, 0.2);
                PhysicsWorld w(s);
                run(w, 4);
                const glm::dvec3 at = w.bodies()[0].position;
                MESSAGE(kind, " from ", y, " m: at ", at.x, " ", at.y, " ", at.z, ", ", w.maxPenetration(), " m deep, ", w.awake(), " awake");
                CHECK(w.maxPenetration() <= 1e-3);
                CHECK((at.x >= (beside ? 3.05 : 1.05) || at.x <= -1.05 || std::fabs(at.z) >= 1.05));  // what is not seen is not deep, either
            }
}

TEST_CASE("case 66: a thin pole that falls over is not held in the air") {
    // 2 m long, dropped a little aslant. Lying, its axis is its radius above the floor.
    for (const double radius : {0.003, 0.02, 0.03}) {
        Scene s = scene(1.0 / 120, 0.3, 0.4);
        floor(s);
        Object& o = add(s, "capsule", {0, 1.2, 0}, {radius, 2});
        o.rot = {3, 0, 4}, o.density = 700;
        PhysicsWorld w(s);
        double deepest = 0;
        while (w.time_s() < 8) w.step(), deepest = std::max(deepest, w.maxPenetration());
        MESSAGE("radius ", radius, ": ", w.bodies()[0].position.y - radius, " m above the floor, held ", w.held(), " times, at most ", deepest, " m deep");
        CHECK(std::fabs(w.bodies()[0].position.y - radius) <= 2e-3 * radius);
        CHECK(w.held() == 0);
        CHECK(deepest <= 0.1 * radius);
    }
}

TEST_CASE("case 66: a capsule that tumbles down a ball is not held in the air") {
    Scene s = scene(1.0 / 120, 0.5, 0.5);
    add(s, "sphere", {}, {0.5});
    bodyOf(s, "capsule", {0, 0.7, 0}, 0.2), bodyOf(s, "capsule", {0.01, 1.3, 0.02}, 0.2);
    PhysicsWorld w(s);
    const double seconds = secondsFor(w, 240);
    MESSAGE("held ", w.held(), " times in 240 steps, which took ", seconds, " s; the first is at ", w.bodies()[0].position.y, " m");
    CHECK(w.held() <= 10);
    CHECK(w.bodies()[0].position.y < -1);
}

TEST_CASE("case 67: a prism, a lens on its rim, a turned box and a tube rest on the floor and do not sink in") {
    // How high the middle of each is above the floor, lying so.
    struct Drop {
        std::string_view what;
        double height;
    };
    for (const Drop& drop : {Drop{"prism", 0.4 * std::sqrt(0.5)}, {"triangle", 0.2}, {"lens", std::sqrt(1 - 0.81)}, {"turned box", 0.175 * std::sqrt(2.0)}, {"tube", 0.1}}) {
        Scene s = scene(1.0 / 120, 0.3, 0.4);
        floor(s);
        const int own = static_cast<int>(s.objects.size());
        if (drop.what == "prism") add(s, "prism", {}, {4, 0.4, 0.4}).rot.z = 90;
        if (drop.what == "triangle") add(s, "prism", {}, {3, 0.4, 0.4}).rot.z = -90;
        if (drop.what == "lens") {
            add(s, "intersect", {}, {0});
            for (const double x : {-0.9, 0.9}) add(s, "sphere", {x, 0, 0}, {1}, own);
        }
        if (drop.what == "turned box") add(s, "union", {}, {0}).rot.z = -90, add(s, "box", {}, {0.35, 0.35, 0.35, 0}, own).rot.y = 45;
        if (drop.what == "tube") {
            add(s, "subtract", {}, {0}).rot.z = 90;
            add(s, "cylinder", {}, {0.1, 1, 0}, own), add(s, "cylinder", {}, {0.09, 1.2, 0}, own);
        }
        s.objects[static_cast<std::size_t>(own)].pos.y = drop.height + 0.3, s.objects[static_cast<std::size_t>(own)].density = 800;
        PhysicsWorld w(s);
        run(w, 4);
        MESSAGE(drop.what, ": ", w.bodies()[0].position.y - drop.height, " m too high, held ", w.held(), " times");
        CHECK(std::fabs(w.bodies()[0].position.y - drop.height) <= 1e-3);
        CHECK(w.held() == 0);
        CHECK(w.notes().empty());
    }
}

TEST_CASE("case 65: a thin needle that spins goes through no thin sheet, be it fixed or a body") {
    for (const bool moves : {false, true})
        for (const double speed : {10.0, 300.0}) {
            Scene s = scene(1.0 / 120, 0.3, 0.4, 0);
            add(s, "box", {2, 0, 0}, {0.001, 4, 4, 0}).mass = moves ? 1e6 : 0;
            Object& needle = add(s, "capsule", {}, {0.003, 0.6});
            needle.mass = 0.1, needle.vel.x = speed, needle.rot = {0, 0, 40}, needle.spin = {30, 20, 80};
            PhysicsWorld w(s);
            double furthest = 0;
            const std::size_t at = w.bodies().size() - 1;
            while (w.time_s() < 0.3) w.step(), furthest = std::max(furthest, w.bodies()[at].position.x);
            MESSAGE(std::string_view(moves ? "a body" : "fixed"), ", ", speed, " m/s: at most ", furthest, " m, held ", w.held(), " times");
            CHECK(furthest > 1);
            CHECK(furthest < 2);
        }
}

TEST_CASE("case 72: a small shape on a ten thousand times larger one is met in few questions to the field") {
    for (const std::string_view kind : {"capsule", "box"})
        for (const double size : {1e-3, 1e-6}) {
            Scene s = scene(1.0 / 120, 0.5, 0.5);
            floor(s);
            bodyOf(s, kind, {0, 2 * size, 0}, size), bodyOf(s, kind, {0, 4 * size, 0}, 1e-4 * size);
            PhysicsWorld w(s);
            run(w, 3.0 / 120);
            MESSAGE(kind, " of ", size, " m: ", w.counts().evaluations, " evaluations in 3 steps");
            CHECK(w.counts().evaluations < 1'000'000);  // once 1e9
        }
}

TEST_CASE("case 72: a stick of a metre takes no long steps, however thin it is") {
    for (const double thick : {0.004, 0.02}) {
        Scene s = scene(1.0 / 120, 0.3, 0.4);
        floor(s);
        block(s, {0, 0.8, 0}, {thick, 1, thick}, 700).rot = {3, 0, 4};
        PhysicsWorld w(s);
        run(w, 3);
        MESSAGE(thick, " m: ", w.counts().evaluations, " evaluations in 3 s, held ", w.held(), " times, at ", w.bodies()[0].position.y, " m");
        CHECK(w.counts().evaluations < 10'000'000);  // once 1e9
        CHECK(std::fabs(w.bodies()[0].position.y - 0.5 * thick) < 1e-3 * thick);
        CHECK(w.held() == 0);
    }
}

TEST_CASE("case 69: a box slides down a ramp with g (sin θ - μ cos θ)") {
    double worst = 0;
    for (const double degrees : {10.0, 20.0, 30.0, 40.0, 50.0, 60.0})
        for (const double mu : {0.1, 0.3, 0.6}) {
            const double a = degrees * kPi / 180, slide = std::max(kG * (std::sin(a) - mu * std::cos(a)), 0.0);
            Scene s = scene(1.0 / 120, 0, mu);
            add(s, "plane", {}, {std::sin(a), std::cos(a), 0, 0});
            s.objects[bodyOf(s, "box", 0.2 * glm::dvec3{std::sin(a), std::cos(a), 0}, 0.4)].rot.z = -degrees;
            PhysicsWorld w(s);
            run(w, 1);
            const double got = 2 * glm::dot(w.bodies()[0].position, glm::dvec3{std::cos(a), -std::sin(a), 0});
            worst = std::max(worst, std::fabs(got - slide) / (kG * std::sin(a)));
        }
    MESSAGE("ramp error of a box ", worst);
    CHECK(worst <= 0.01);
}

TEST_CASE("case 70: a sliding box stops after v²/(2μg)") {
    for (const glm::dvec3 size : {glm::dvec3{0.6, 0.02, 0.6}, glm::dvec3{0.6, 0.2, 0.6}, glm::dvec3{0.2, 0.2, 0.2}}) {
        Scene s = scene(1.0 / 120, 0, 0.3);
        floor(s);
        block(s, {0, 0.5 * size.y, 0}, size).vel.x = 5;
        PhysicsWorld w(s);
        run(w, 4);
        const double further = w.bodies()[0].position.x / (25 / (2 * 0.3 * kG)) - 1;
        MESSAGE("a box of ", size.x, " by ", size.y, " m slides ", 100 * further, " % too far");
        CHECK(std::fabs(further) <= 0.01);
    }
}
