// Cases 61, 67, 75 and 77: stacks that stand, bodies that lie still, a million steps, and what wakes a sleeper.
#include "physics/scenes.h"
#include "sdf/draw.h"

#include <doctest/doctest.h>

#include <malloc.h>

using namespace mb;
using namespace mb::test;

namespace {

constexpr double kSlop = 1e-4;  // restDepth() of bodies of 10 cm and more

/// Runs until all sleep, at most so long; says when that was, and the deepest overlap on the way.
struct Settled { double at = 1e9, deepest = 0; };
Settled settle(PhysicsWorld& io_world, double seconds) {
    Settled r;
    for (int i = 0; io_world.time_s() < seconds; ++i) {
        io_world.step();
        if (i % 10 == 0) r.deepest = std::max(r.deepest, io_world.maxPenetration());
        if (io_world.awake() > 0) r.at = 1e9;
        else if (r.at > 1e8) r.at = io_world.time_s();
        if (io_world.awake() == 0) break;
    }
    return r;
}
/// The farthest a body of b is from where it was in a.
double moved(const std::vector<Body>& a, std::span<const Body> b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, glm::length(a[i].position - b[i].position));
    return most;
}

/// A card of 1 × 0.7 × 0.02 m at a place, turned by that about z.
void card(Scene& s, glm::dvec3 pos, double degrees) {
    Object& o = block(s, pos, {1, 0.02, 0.7}, 900);
    o.rot.z = degrees;
}
/// Two cards that lean against each other by 20 degrees from upright, their feet at height y.
void frame(Scene& s, double x, double y) {
    // The edge at the foot lies on the floor, and the edges at the top meet in the middle.
    const double a = 20 * kPi / 180, up = 0.5 * std::cos(a) + 0.01 * std::sin(a), in = 0.5 * std::sin(a) + 0.01 * std::cos(a);
    card(s, {x - in, y + up, 0}, 70), card(s, {x + in, y + up, 0}, 110);
}

}  // namespace

TEST_CASE("case 61: 10, 20 and 50 balls in a tube stand, at their height, asleep") {
    for (const int n : {10, 20, 50}) {
        Scene s = scene(1.0 / 120, 0, 0.5);
        tube(s, 0.2 * n + 1);
        for (int i = 0; i < n; ++i) ball(s, {0, 0.2 + 0.2 * i, 0}, 0.1);
        PhysicsWorld w(s);
        const Settled r = settle(w, 5);
        run(w, 10 - w.time_s());
        const double off = w.bodies()[static_cast<std::size_t>(n - 1)].position.y - 0.2 * n;
        CAPTURE(n);
        CHECK(w.awake() == 0);
        CHECK(w.maxPenetration() <= 2 * kSlop);
        // Straight it is 0.2·n high; leaning from wall to wall by 2 mm a ball, at most 1e-5 a ball lower.
        CHECK(std::fabs(off) <= 2 * kSlop * n);
        MESSAGE(n, " balls: asleep at ", r.at, " s, deepest ", r.deepest, ", top off by ", off);
    }
}

TEST_CASE("case 61: a pyramid of ten rows of boxes, a stack of 20 of a metre, and a heap of balls between walls stand and fall asleep") {
    for (const std::string_view what : {"pyramid", "stack", "heap of balls"}) {
        Scene s = scene(1.0 / 120, 0, 0.5);
        s.physics = {};  // as shipped
        floor(s);
        double top = 0;
        int rows = 0;
        if (what == "pyramid") {
            rows = 10, top = 0.2 * rows - 0.1;
            for (int row = 0; row < rows; ++row)
                for (int i = 0; i < rows - row; ++i) block(s, {0.21 * i + 0.105 * row, 0.1 + 0.2 * row, 0}, {0.2, 0.2, 0.2});
        } else if (what == "stack") {
            rows = 20, top = rows - 0.5;
            for (int row = 0; row < rows; ++row) block(s, {0, 0.5 + row, 0}, {1, 1, 1});
        } else {  // balls in the gaps of the row below, between walls that hold the lowest row together
            rows = 6, top = 0.1 + (rows - 1) * 0.1 * std::sqrt(3.0);
            for (const double x : {-0.1 - 0.5, 0.2 * rows - 0.1 + 0.5}) add(s, "box", {x, 0.1, 0}, {1, 0.4, 1, 0});
            for (const double z : {-0.6, 0.6}) add(s, "box", {0.5, 1, z}, {4, 4, 1, 0});
            for (int row = 0; row < rows; ++row)
                for (int i = 0; i < rows - row; ++i) ball(s, {0.2 * i + 0.1 * row, 0.1 + 0.1 * std::sqrt(3.0) * row, 0}, 0.1);
        }
        PhysicsWorld w(s);
        const Settled r = settle(w, 5);
        run(w, 10 - w.time_s());
        const double off = w.bodies().back().position.y - top;
        CAPTURE(what);
        CHECK(r.at <= 5);
        CHECK(w.maxPenetration() <= 2 * kSlop);
        CHECK(std::fabs(off) <= 2 * kSlop * rows);
        MESSAGE(what, ": asleep at ", r.at, " s, deepest ", r.deepest, ", top off by ", off);
    }
}

TEST_CASE("case 61: a stack of 20 boxes of 0.2 m stands with the knobs as shipped") {
    Scene s;
    s.world.restitution = 0, s.world.friction = 0.5;
    floor(s);
    for (int row = 0; row < 20; ++row) block(s, {0, 0.1 + 0.2 * row, 0}, {0.2, 0.2, 0.2});
    PhysicsWorld w(s);
    run(w, 5);
    const glm::dvec3 top = w.bodies().back().position;
    run(w, 5);
    MESSAGE("after 5 s the top is ", std::hypot(top.x, top.z), " m aside, after 10 s at ", w.bodies().back().position.y, " m");
    CHECK(w.awake() == 0);
    CHECK(std::fabs(w.bodies().back().position.y - 3.9) <= 4e-3);
}

TEST_CASE("case 61: a house of seven cards stands for a minute, asleep") {
    Scene s = scene(1.0 / 120, 0, 0.6);
    s.physics = {};
    floor(s);
    const double a = 20 * kPi / 180, up = std::cos(a) + 0.02 * std::sin(a);
    frame(s, -0.5, 0), frame(s, 0.5, 0);
    card(s, {0, up + 0.01, 0}, 0);
    frame(s, 0, up + 0.02);
    PhysicsWorld w(s);
    const std::vector<Body> start(w.bodies().begin(), w.bodies().end());
    const Settled r = settle(w, 60);
    run(w, 60 - w.time_s());
    CHECK(w.awake() == 0);
    CHECK(moved(start, w.bodies()) <= 0.01);
    MESSAGE("card house: asleep at ", r.at, " s, moved by ", moved(start, w.bodies()), ", deepest ", r.deepest);
}

TEST_CASE("case 67: a body at rest stays where it is for a minute, asleep") {
    struct Place { std::string_view name, kind; };
    for (const Place& p : {Place{"floor", "ball"}, Place{"bowl", "ball"}, Place{"groove", "ball"}, Place{"floor", "box"}, Place{"floor", "die"},
                           Place{"slope", "box"}, Place{"slope", "die"}, Place{"groove", "capsule"}}) {
        Scene s = scene(1.0 / 120, 0.5, 0.5);
        glm::dvec3 at{0, 0.1, 0}, rot{0};
        const double slope = 15, a = slope * kPi / 180;
        if (p.name == "floor") floor(s);
        else if (p.name == "bowl") bowl(s, 1), at = {0, -0.9, 0};
        else if (p.name == "slope") add(s, "plane", {}, {std::sin(a), std::cos(a), 0, 0}), at = 0.1 * glm::dvec3{std::sin(a), std::cos(a), 0}, rot.z = -slope;
        else groove(s, 90), at = {0, 0.1 * std::sqrt(2.0), 0}, rot.x = 90;
        s.objects[bodyOf(s, p.kind, at, 0.2)].rot = rot;
        PhysicsWorld w(s);
        const glm::dvec3 start = w.bodies()[0].position;
        run(w, 1);
        CAPTURE(p.name); CAPTURE(p.kind);
        CHECK(w.awake() == 0);
        CHECK(glm::length(w.bodies()[0].velocity) <= 1e-3);
        const glm::dvec3 then = w.bodies()[0].position;
        run(w, 59);
        CHECK(glm::length(w.bodies()[0].position - then) <= 1e-9);
        CHECK(glm::length(w.bodies()[0].position - start) <= 1e-3);
        MESSAGE(p.kind, " on a ", p.name, ": off by ", glm::length(w.bodies()[0].position - start));
    }
}

TEST_CASE("case 75: after 1e6 steps the clock is right, a settled stack has not moved, and no memory was taken") {
    Scene s = scene(1.0 / 60, 0.2, 0.5);
    floor(s);
    for (int i = 0; i < 3; ++i) block(s, {0, 0.1 + 0.2 * i, 0}, {0.2, 0.2, 0.2});
    ball(s, {2, 0.1, 0}, 0.1);
    PhysicsWorld w(s);
    run(w, 2);
    const std::vector<Body> then(w.bodies().begin(), w.bodies().end());
    const std::size_t memory = mallinfo2().uordblks;
    for (int i = 0; i < 1'000'000 - 120; ++i) w.step();
    CHECK(w.steps() == 1'000'000);
    CHECK(w.time_s() == 1'000'000 * (1.0 / 60));
    CHECK(moved(then, w.bodies()) == 0);
    CHECK(mallinfo2().uordblks <= memory + 4096);

    // The same where nothing may sleep.
    s.physics.sleep_speed = 0;
    PhysicsWorld awake(s);
    run(awake, 2);
    const std::vector<Body> before(awake.bodies().begin(), awake.bodies().end());
    const std::size_t taken = mallinfo2().uordblks;
    const int steps = times(20'000);
    for (int i = 0; i < steps; ++i) awake.step();
    CHECK(awake.awake() == 4);
    CHECK(moved(before, awake.bodies()) <= 1e-3);
    CHECK(mallinfo2().uordblks <= taken + 65'536);
    MESSAGE("awake for ", steps, " steps the stack moved by ", moved(before, awake.bodies()), " m");
}

TEST_CASE("case 77: what lies asleep on a body that is frozen wakes and falls") {
    Scene s = scene(1.0 / 120, 0, 0.5);
    floor(s);
    block(s, {0, 0.5, 0}, {1, 1, 1}), block(s, {0, 1.5, 0}, {1, 1, 1}), ball(s, {5, 0.5, 0}, 0.5);
    PhysicsWorld w(s);
    run(w, 2);
    REQUIRE(w.awake() == 0);
    w.setMotion(0, {NAN, 0, 0}, {});
    run(w, 2);
    REQUIRE(w.bodies().size() == 2);
    CHECK(w.frozen().size() == 1);
    CHECK(w.bodies()[0].position.y == doctest::Approx(0.5).epsilon(1e-3));
    CHECK(w.awake() == 0);
}

TEST_CASE("case 77: sleepers wake when they are hit, lose or are pushed by what they rest on, or gravity changes") {
    for (const std::string_view kind : kKinds) {
        Scene s = scene(1.0 / 120, 0.2, 0.5);
        add(s, "box", {0, -0.5, 0}, {4, 1, 4, 0});
        bodyOf(s, kind == "capsule" ? "ball" : kind, {0, 0.1, 0}, 0.2);
        bodyOf(s, kind == "capsule" ? "ball" : kind, {0.3, 0.1, 0}, 0.2);
        bodyOf(s, kind, {-1, kind == "capsule" ? 0.2 : 0.1, 0}, 0.2);
        const std::size_t on = bodyOf(s, "box", {1, 0.1, 0}, 0.2);
        bodyOf(s, "box", {1, 0.3, 0}, 0.2);
        const ObjectId under = s.objects[on].id;
        PhysicsWorld rested(s);
        run(rested, 3);
        CAPTURE(kind);
        REQUIRE(rested.awake() == 0);
        const std::uint64_t asleep = rested.stateHash();
        {  // hit
            PhysicsWorld w = rested;
            w.setMotion(0, {2, 0, 0}, {});
            CHECK(w.stateHash() != asleep);
            run(w, 0.2);
            CHECK(w.bodies()[1].awake);
            CHECK(w.bodies()[1].velocity.x > 0.3);
        }
        {  // the support goes, at once
            Scene other = s;
            other.objects[0].pos.x = 50;
            PhysicsWorld w = rested;
            w.changeStatics(other);
            w.step();
            CHECK(w.awake() == 5);
            for (const Body& b : w.bodies()) CHECK(b.velocity.y < -0.05);
        }
        {  // it comes up
            Scene other = s;
            other.objects[0].pos.y += 0.05;
            PhysicsWorld w = rested;
            w.changeStatics(other);
            w.step();
            CHECK(w.awake() == 5);
            run(w, 3);
            CHECK(std::fabs(w.bodies()[0].position.y - rested.bodies()[0].position.y - 0.05) <= 1e-3);
        }
        {  // a body under another is taken
            PhysicsWorld w = rested;
            w.remove(under);
            w.step();
            CHECK(w.bodies().back().awake);
            CHECK(w.bodies().back().velocity.y < -0.05);
        }
        {  // gravity turns round
            Scene other = s;
            other.world.gravity = -1;
            PhysicsWorld w = rested;
            w.changeStatics(other);
            w.step();
            for (const Body& b : w.bodies()) CHECK(b.velocity.y > 0);
        }
    }
}
