// Cases 71, 72, 74, 82 and 84 to 87: masses, sizes and steps that make no sense, the broad phase, a gas, broken numbers, bodies
// that come and go, and states that are gone back to.
#include "core/scene/text.h"
#include "physics/broadphase.h"
#include "physics/random.h"
#include "physics/scenes.h"
#include "physics/timeline.h"
#include "sdf/draw.h"

#include <doctest/doctest.h>

#include <fmt/format.h>

#include <chrono>
#include <malloc.h>
#include <set>

using namespace mb;
using namespace mb::test;

namespace {

/// The first fault of a scene of one record more, or nothing.
std::string fault(const std::string& record) {
    const ReadResult r = readScene("marchbox 1\n" + record + "\n");
    return r.faults.empty() ? "" : r.faults[0].message;
}
bool finite(const Body& b) {
    const glm::dvec3 sum = b.position + b.velocity + b.spin;
    return std::isfinite(sum.x + sum.y + sum.z + b.orientation.w + b.orientation.x + b.orientation.y + b.orientation.z);
}

/// Bodies of every kind that fall into a bowl.
Scene poured(int n) {
    Scene s = scene(1.0 / 120, 0.5, 0.4);
    bowl(s, 1.5);
    Random random(1);
    for (int i = 0; i < n; ++i) {
        const glm::dvec3 at{random.in(-0.5, 0.5), 0.2 + 0.15 * i, random.in(-0.5, 0.5)};
        s.objects[bodyOf(s, kKinds[i % 4], at, 0.2)].name = fmt::format("body{}", i);
    }
    return s;
}

}  // namespace

TEST_CASE("case 71: a mass is 0, for a static shape, or a number a file may hold; whatever it is nothing becomes NaN") {
    for (const char* mass : {"-1", "nan", "inf", "1e13", "-1e-30"}) {
        CAPTURE(mass);
        CHECK(fault(fmt::format("object type:sphere radius:1 mass:{}", mass)).find("'mass'") != std::string::npos);
        CHECK(fault(fmt::format("object type:box size:1,1,1 density:{}", mass)).find("'density'") != std::string::npos);
    }
    const ReadResult still = readScene("marchbox 1\nobject type:sphere radius:1 mass:0\n");
    REQUIRE(still.ok());
    CHECK(PhysicsWorld(still.scene).bodies().empty());
    for (const std::string_view kind : kKinds)
        for (const double mass : {1e-30, 1e-6, 1e6, 1e12, 1e30}) {
            Scene s = scene(1.0 / 120, 0.5, 0.5);
            floor(s);
            Object& o = s.objects[bodyOf(s, kind, {0, 1, 0}, 0.2)];
            o.density = 0, o.mass = mass, o.spin = {1, 2, 3};
            s.objects[bodyOf(s, kind, {0.05, 2, 0}, 0.2)].spin = {3, 0, 1};
            PhysicsWorld w(s);
            run(w, 2);
            CAPTURE(kind); CAPTURE(mass);
            REQUIRE(w.bodies().size() == 2);
            for (const Body& b : w.bodies()) CHECK(finite(b));
            CHECK(w.bodies()[0].position.y > 0);
        }
}

TEST_CASE("case 72: bodies of 1e-6 to 1e6 m, and of 1 to 10,000 beside each other, have inertia and no NaN") {
    CHECK(fault("object type:sphere radius:0 mass:1") != "");
    CHECK(fault("object type:box size:1,0,1 mass:1") != "");
    for (const std::string_view kind : {"ball", "box", "capsule"})
        for (const double size : {1e-6, 1e-3, 1e3, 1e6}) {
            Scene s = scene(1.0 / 120, 0.5, 0.5);
            s.world.bounds = 1e9;
            floor(s);
            const double up = kind == "capsule" ? 1 : 0.5;
            bodyOf(s, kind, {0, up * size, 0}, size);
            const bool beside = kind == "ball" || size > 1;  // open: small shapes, and much smaller ones, take seconds a step
            if (beside) bodyOf(s, kind, {0, (2 * up + 3e-4) * size, 0}, 1e-4 * size);
            PhysicsWorld w(s);
            CAPTURE(kind); CAPTURE(size);
            for (const Body& b : w.bodies())
                for (int i = 0; i < 3; ++i) {
                    CHECK(b.inertia[i][i] > 0);
                    CHECK(std::isfinite(b.inverse_inertia[i][i]));
                }
            run(w, 1);
            REQUIRE(w.bodies().size() == (beside ? 2 : 1));
            for (const Body& b : w.bodies()) CHECK(finite(b));
            CHECK(w.bodies()[0].position.y == doctest::Approx(up * size).epsilon(1e-2));
        }
    Random random(72);
    std::vector<Reach> balls;
    for (int i = 0; i < 1000; ++i) balls.push_back({{random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)}, std::pow(10.0, random.in(-6, 0)) * (i % 50 ? 0.1 : 1)});
    balls.push_back({{0, 0, 0}, 1e6}), balls.push_back({{1, 0, 0}, 0});
    std::vector<std::pair<int, int>> all;
    for (std::size_t i = 0; i < balls.size(); ++i)
        for (std::size_t j = i + 1; j < balls.size(); ++j)
            if (overlap(balls[i], balls[j])) all.push_back({static_cast<int>(i), static_cast<int>(j)});
    CHECK(overlappingPairs(balls) == all);
    MESSAGE(all.size(), " pairs of radii 0 and 1e-7 to 1e6, as comparing all with all finds");
}

TEST_CASE("case 74: steps of 0, of less, of no number or beyond a second are refused; of a microsecond or a second they do no harm") {
    for (const char* dt : {"0", "-1", "nan", "1e-9", "10", "inf"}) {
        CAPTURE(dt);
        CHECK(fault(fmt::format("physics dt:{}", dt)).find("'dt'") != std::string::npos);
    }
    for (const std::string_view kind : kKinds)
        for (const double dt : {1.0, 1e-6}) {
            Scene s = scene(dt, 0.5, 0.5);
            floor(s);
            bodyOf(s, kind, {0, 1, 0}, 0.2);
            PhysicsWorld w(s);
            for (int i = 0; i < 50; ++i) w.step();
            CAPTURE(kind); CAPTURE(dt);
            REQUIRE(w.bodies().size() == 1);
            CHECK(w.bodies()[0].position.y >= 0.1 - 1e-3);
            CHECK(w.bodies()[0].position.y <= 1 + 1e-3);
        }
}

TEST_CASE("case 82: the broad phase finds the pairs that comparing all with all finds, of 10,000 too") {
    for (const int kind : {0, 1, 2, 3}) {
        const auto made = [&](int n) {
            Random random(3);
            std::vector<Reach> balls;
            const double wide = 10 * std::cbrt(n / 2000.0);
            for (int i = 0; i < n; ++i) {
                glm::dvec3 c{random.in(-wide, wide), random.in(-wide, wide), random.in(-wide, wide)};
                if (kind == 1) c *= 0.05;
                if (kind == 2) c = {0.1 * i, 0, 0};
                balls.push_back({c, kind == 3 && i == 77 ? 50.0 : random.in(0.01, 0.2)});
            }
            return balls;
        };
        const auto time = [&](int n) {
            const std::vector<Reach> balls = made(n);
            double least = 1e9;
            for (int i = 0; i < 5; ++i) {
                const auto start = std::chrono::steady_clock::now();
                (void)overlappingPairs(balls);
                least = std::min(least, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
            }
            return least;
        };
        const std::vector<Reach> balls = made(kind == 1 ? 2000 : 10'000);
        std::vector<std::pair<int, int>> all;
        for (std::size_t i = 0; i < balls.size(); ++i)
            for (std::size_t j = i + 1; j < balls.size(); ++j)
                if (overlap(balls[i], balls[j])) all.push_back({static_cast<int>(i), static_cast<int>(j)});
        CHECK(overlappingPairs(balls) == all);
        constexpr std::string_view kNames[]{"uniform", "clustered", "in a line", "one giant"};
        if (kind == 1) continue;
        MESSAGE(kNames[kind], ": ", all.size(), " pairs, ", time(1250), " ms of 1,250 and ", time(10'000), " ms of 10,000");
    }
}

TEST_CASE("case 84: elastic balls in a closed box keep their energy and share it evenly") {
    const int steps = times(100'000);
    Scene s = scene(1.0 / 60, 1, 0, 0);
    room(s, 4);
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 at = 0.55 * glm::dvec3{i % 6 - 2.5, i / 6 % 6 - 2.5, i / 36 - 2.5 + random.in(-0.1, 0.1)};
        ball(s, at, 0.08, {random.in(-2, 2), random.in(-2, 2), 0});
    }
    PhysicsWorld w(s);
    const double start = w.energy().total();
    glm::dvec3 share{0};
    for (int i = 0; i < steps; ++i) {
        w.step();
        if (i >= 600)
            for (const Body& b : w.bodies()) share += b.velocity * b.velocity;
    }
    CHECK(w.removed() == 0);
    CHECK(std::fabs(w.energy().total() / start - 1) <= 1e-2);
    share /= share.x + share.y + share.z;
    double uneven = 0;
    for (int axis = 0; axis < 3; ++axis) uneven = std::max(uneven, std::fabs(3 * share[axis] - 1));
    CHECK(uneven <= 0.1);
    MESSAGE(steps, " steps: energy off by ", w.energy().total() / start - 1, " after ", w.impacts(), " impacts, shares by ", uneven, ", held ", w.held());
}

TEST_CASE("case 85: a body whose velocity is no number is frozen at once and named; the others do not notice") {
    for (const std::string_view kind : {"ball", "box"}) {
        Scene s = poured(6);
        const std::size_t at = bodyOf(s, kind, {20, 3, 0}, 0.2);
        s.objects[at].name = "broken";
        PhysicsWorld with(s);
        Scene fewer = s;
        removeSubtree(fewer, at);
        PhysicsWorld without(fewer);
        glm::dvec3 last{0};
        for (int i = 0; i < 200; ++i) {
            const bool broken = i >= 100;
            if (i == 100) last = with.bodies()[6].position, with.setMotion(6, {NAN, 0, 0}, {});
            with.step(), without.step();
            REQUIRE(with.frozen().size() == (broken ? 1 : 0));
            const std::uint64_t before = with.stateHash();
            CHECK(PhysicsWorld(with).stateHash() == before);
        }
        CHECK(with.removed() == 0);
        CHECK(with.frozen()[0].position == last);
        CHECK(with.frozen()[0].velocity == glm::dvec3{0});
        CHECK(with.stateHash() != without.stateHash());
        REQUIRE(with.notes().size() == 1);
        CHECK(with.notes()[0].find("broken") != std::string::npos);
        REQUIRE(with.bodies().size() == 6);
        for (std::size_t i = 0; i < 6; ++i) CHECK(with.bodyHash(i) == without.bodyHash(i));
        // It stays in the scene, where it last was, and nothing meets it there: not as what does not move either.
        Scene after = s;
        with.writeTo(after);
        const auto in_scene = std::ranges::find(after.objects, std::string("broken"), &Object::name);
        REQUIRE(in_scene != after.objects.end());
        CHECK(glm::length(in_scene->pos - last) <= 1e-12);
        after.physics.iterations = s.physics.iterations + 1;
        with.changeStatics(after);
        with.setMotion(0, {0, 0, 0}, {});
        CHECK(with.maxPenetration() == without.maxPenetration());
        with.remove(in_scene->id);
        CHECK(with.frozen().empty());
    }
}

TEST_CASE("case 85: what becomes no number within a step stays where it was before it") {
    for (const std::string_view kind : kKinds)
        for (const double gravity : {std::nan(""), HUGE_VAL, 1e308}) {
            Scene s = scene(1.0 / 120, 0.5, 0.5);
            floor(s);
            bodyOf(s, kind, {0, 1, 0}, 0.2), bodyOf(s, kind, {0.1, 2, 0}, 0.2);
            PhysicsWorld w(s);
            run(w, 0.1);
            const glm::dvec3 at = w.bodies()[0].position;
            s.world.gravity = gravity;
            w.changeStatics(s);
            for (int i = 0; i < 3; ++i) w.step();
            CAPTURE(kind); CAPTURE(gravity);
            REQUIRE(w.bodies().size() + w.frozen().size() + static_cast<std::size_t>(w.removed()) == 2);
            for (const Body& b : w.frozen()) CHECK(finite(b));
            for (const Body& b : w.bodies()) CHECK(finite(b));
            if (std::isfinite(gravity)) continue;
            REQUIRE(w.frozen().size() == 2);
            CHECK(w.frozen()[0].position == at);
            CHECK(w.notes().size() == 2);
        }
}

TEST_CASE("case 86: bodies come and go while it steps: no id comes twice, what is kept of one goes with it, no memory stays") {
    // A world takes bodies from its scene and gives them back: what is added needs a world made anew.
    const int rounds = times(1'000);
    Scene s = scene(1.0 / 60, 0.3, 0.5);
    floor(s);
    Random random(86);
    std::set<std::uint32_t> ids;
    std::uint64_t taken = 0;
    std::size_t memory = 0;
    for (int round = 0; round < rounds; ++round) {
        for (int i = 0; i < 10; ++i) {
            const glm::dvec3 at{random.in(-0.6, 0.6), random.in(0.2, 0.8), random.in(-0.6, 0.6)};
            REQUIRE(ids.insert(s.objects[bodyOf(s, kKinds[i % 3], at, 0.2)].id.value).second);
        }
        PhysicsWorld w(s);
        for (int i = 0; i < 10; ++i) {
            w.step();
            const auto which = static_cast<std::size_t>(random.in(0, static_cast<double>(w.bodies().size())));
            const ObjectId gone = w.bodies()[which].object;
            w.remove(gone);
            ++taken;
            for (const Body& b : w.bodies()) REQUIRE(!(b.object == gone));
        }
        w.writeTo(s);
        REQUIRE(s.objects.size() == 1);
        if (round == rounds / 2) memory = mallinfo2().uordblks;
    }
    // The set of ids grows: 48 bytes each.
    const std::size_t of_ids = static_cast<std::size_t>(rounds - rounds / 2) * 10 * 48;
    CHECK(mallinfo2().uordblks <= memory + of_ids + 65'536);
    MESSAGE(taken, " bodies came and went, ", (mallinfo2().uordblks - memory) / 1024, " KiB more at the end than half-way, ", of_ids / 1024, " of them ids");
}

TEST_CASE("case 86: what is kept of a body that is taken away is gone: the others go on as if they had been alone") {
    for (const std::string_view kind : kKinds) {
        Scene s = scene(1.0 / 60, 0.3, 0.5);
        floor(s);
        bodyOf(s, kind, {3, 0.5, 0}, 0.2);
        const std::size_t second = bodyOf(s, kind, {0, 0.5, 0}, 0.2);
        PhysicsWorld both(s);
        removeSubtree(s, second);
        PhysicsWorld alone(s);
        const ObjectId gone = both.bodies()[1].object;
        run(both, 0.4), run(alone, 0.4);
        both.remove(gone);
        CHECK(both.stateHash() == alone.stateHash());
        run(both, 1), run(alone, 1);
        CHECK(both.stateHash() == alone.stateHash());
    }
}

TEST_CASE("case 87: a copy of step 100, and a seek to it, go on to the state of step 200; and so with one body more") {
    for (const int n : {6, 7}) {
        const Scene s = poured(n);
        PhysicsWorld world(s);
        for (int i = 0; i < 100; ++i) world.step();
        PhysicsWorld copy = world;
        for (int i = 0; i < 100; ++i) world.step();
        for (int i = 0; i < 100; ++i) copy.step();
        CHECK(copy.stateHash() == world.stateHash());

        Timeline whole(s);
        while (whole.step() < 200) {
            if (whole.step() == 40) whole.act(throwing(5, 3));
            if (whole.step() == 120) whole.act(removing(s.objects.back().id));
            whole.advance();
        }
        const std::uint64_t end = whole.world().stateHash();
        whole.seek(100);
        Timeline restored = whole;
        while (!restored.atEnd()) restored.advance();
        CHECK(restored.world().stateHash() == end);
        CHECK_FALSE(restored.divergence());
        CHECK(end != world.stateHash());
    }
}
