// Many balls, long runs, states that must be equal, and input that makes no sense.
#include "physics/random.h"
#include "scenes.h"

#include <doctest/doctest.h>

#include <chrono>

using namespace mb;
using namespace mb::test;

namespace {
Scene poured(int n, double restitution) {
    Scene s = scene(1.0 / 120, restitution, 0.4);
    bowl(s, 1.5);
    Random random(1);
    for (int i = 0; i < n; ++i) {
        // One draw a statement: compilers may evaluate arguments in any order.
        const glm::dvec3 at{random.in(-0.5, 0.5), 0.2 + 0.02 * i, random.in(-0.5, 0.5)};
        const double radius = random.in(0.07, 0.11);
        ball(s, at, radius, {}, random.in(0.5, 2));
    }
    return s;
}
}  // namespace

TEST_CASE("200 balls poured into a bowl come to rest in it") {
    const Scene s = poured(200, 0.4);
    PhysicsWorld w(s);
    const double start = w.energy().total() + 1.5 * kG * 250;  // above the bowl's bottom
    double last = w.energy().total(), most_gain = 0, deepest = 0, asleep_at = 0;
    const auto begin = std::chrono::steady_clock::now();
    int step = 0;
    while (w.time_s() < 30) {
        w.step();
        const double now = w.energy().total();
        most_gain = std::max(most_gain, now - last), last = now;
        if (++step % 60 == 0) deepest = std::max(deepest, w.maxPenetration());
        if (w.awake() == 0) { asleep_at = w.time_s(); break; }
    }
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    CHECK(w.removed() == 0);
    CHECK(w.bodies().size() == 200);
    for (const Body& b : w.bodies()) CHECK(glm::length(b.position) + b.radius <= 1.5 + 1e-3);
    CHECK(most_gain <= 1e-5 * start);
    CHECK(deepest <= 2e-3);
    CHECK(w.awake() == 0);
    MESSAGE("bowl: asleep at ", asleep_at, " s, ", ms / step, " ms a step, deepest ", deepest, ", most energy gained in a step ",
            most_gain / start, " of all, held ", w.held(), ", evaluations a step ", w.evaluations() / static_cast<std::uint64_t>(step));
}

TEST_CASE("equal runs have equal states, and so has a run that was copied half-way") {
    const Scene s = poured(40, 0.5);
    PhysicsWorld a(s), b(s);
    run(a, 1), run(b, 0.5);
    PhysicsWorld c = b;
    CHECK(b.stateHash() != a.stateHash());
    run(b, 0.5), run(c, 0.5);
    CHECK(a.stateText() == b.stateText());
    CHECK(a.stateText() == c.stateText());
    CHECK(a.stateText().size() == 16);
    b.setMotion(3, b.bodies()[3].velocity + glm::dvec3{0, 1e-15, 0}, b.bodies()[3].spin);
    CHECK(a.stateHash() != b.stateHash());
    // The same on every compiler and at every level of optimisation. A change of the physics changes it: then write the new one.
    CHECK(a.stateText() == "46031c262a38194a");
}

TEST_CASE("a ball whose velocity is no number is removed and named; the others do not notice") {
    Scene s = poured(10, 0.5);
    ball(s, {20, 3, 0}, 0.1).name = "broken";
    PhysicsWorld with(s);
    s.objects.pop_back();
    PhysicsWorld without(s);
    for (int i = 0; i < 200; ++i) {
        if (i == 100) with.setMotion(10, {NAN, 0, 0}, {});
        with.step(), without.step();
    }
    CHECK(with.removed() == 1);
    REQUIRE(with.notes().size() == 1);
    CHECK(with.notes()[0].find("broken") != std::string::npos);
    REQUIRE(with.bodies().size() == 10);
    for (std::size_t i = 0; i < 10; ++i) {
        CHECK(with.bodies()[i].position == without.bodies()[i].position);
        CHECK(with.bodies()[i].velocity == without.bodies()[i].velocity);
    }
}

TEST_CASE("speeds are capped, and what leaves the world is counted and leaves the scene") {
    Scene s = scene(1.0 / 60, 0.5, 0.5);
    ball(s, {0, 5, 0}, 0.1).name = "stone";
    ball(s, {0, 9, 0}, 0.1);
    PhysicsWorld w(s);
    w.setMotion(0, {1e9, 1e300, 0}, {});
    w.step();
    CHECK(w.removed() == 1);
    REQUIRE(!w.notes().empty());
    CHECK(w.notes()[0].find("stone: slowed down") != std::string::npos);
    w.writeTo(s);
    CHECK(s.objects.size() == 1);
    run(w, 5);
    CHECK(w.removed() == 2);
    CHECK(w.bodies().empty());
    w.step();
}

TEST_CASE("sleepers wake when they are hit, or lose what they rest on") {
    Scene s = scene(1.0 / 120, 0.2, 0.5);
    add(s, "box", {0, -0.5, 0}, {4, 1, 4, 0});
    ball(s, {0, 0.1, 0}, 0.1);
    ball(s, {0.3, 0.1, 0}, 0.1);
    PhysicsWorld w(s);
    run(w, 1);
    REQUIRE(w.awake() == 0);
    const std::uint64_t asleep = w.stateHash();
    SUBCASE("hit") {
        w.setMotion(0, {2, 0, 0}, {});
        CHECK(w.stateHash() != asleep);
        run(w, 0.2);
        CHECK(w.bodies()[1].awake);
        CHECK(w.bodies()[1].velocity.x > 0.5);
    }
    SUBCASE("the support goes") {
        s.objects[0].pos.x = 50;
        w.changeStatics(s);
        w.step();
        CHECK(w.awake() == 2);
        CHECK(w.bodies()[0].velocity.y < -0.05);
    }
    SUBCASE("gravity turns round") {
        s.world.gravity = -1;
        w.changeStatics(s);
        w.step();
        CHECK(w.bodies()[0].velocity.y > 0);
    }
}

TEST_CASE("a long stall of a settled stack moves nothing") {
    Scene s = scene(1.0 / 60, 0.2, 0.5);
    floor(s);
    ball(s, {0, 0.1, 0}, 0.1);
    PhysicsWorld w(s);
    run(w, 2);
    const glm::dvec3 then = w.bodies()[0].position;
    for (int i = 0; i < 1'000'000 - 120; ++i) w.step();
    CHECK(w.steps() == 1'000'000);
    CHECK(w.time_s() == 1'000'000 * (1.0 / 60));
    CHECK(w.bodies()[0].position == then);
}

TEST_CASE("a box falls, tumbles and comes to lie on a face; an infinite body does not move") {
    Scene s = scene(1.0 / 120, 0, 0.5);
    floor(s);
    Object& o = add(s, "box", {1, 3, 0}, {1, 1, 1, 0});
    o.density = 700, o.rot = {10, 20, 30}, o.spin = {0, 3, 0};
    add(s, "plane", {0, -5, 0}, {0, 1, 0, 0}).mass = 1;
    PhysicsWorld w(s);
    REQUIRE(w.bodies().size() == 1);
    REQUIRE(w.notes().size() == 1);  // an infinite body
    CHECK(w.bodies()[0].radius == doctest::Approx(std::sqrt(0.75)));
    CHECK(w.bodies()[0].mass() == doctest::Approx(700));
    w.step();
    w.writeTo(s);
    CHECK(s.objects[1].pos.y < 3);
    CHECK(s.objects[1].rot != glm::dvec3{10, 20, 30});
    run(w, 3);
    CHECK(w.bodies()[0].position.y == doctest::Approx(0.5).epsilon(1e-3));
    CHECK(w.awake() == 0);
}
