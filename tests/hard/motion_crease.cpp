// Cases 78 to 81: grooves, ridges, bowls, and energy that only falls.
#include "physics/random.h"
#include "physics/scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>

using namespace mb;
using namespace mb::test;

TEST_CASE("case 78: a ball in a groove rests on both walls, at r / sin(A/2)") {
    const double r = 0.1;
    double worst = 0, fastest = 0;
    for (const double degrees : {90.0, 60.0, 30.0, 10.0})
        for (const bool cut : {false, true}) {
            Scene s = scene(1.0 / 120, 0.3, 0.3);
            if (!cut) groove(s, degrees);
            else if (degrees != 90) continue;
            else {  // one leaf makes both walls
                add(s, "subtract", {}, {0});
                add(s, "box", {0, -0.9, 0}, {4, 2, 4, 0}, 0);
                add(s, "box", {0, std::sqrt(2.0), 0}, {2, 2, 3, 0}, 0).rot = {0, 0, 45};
            }
            const double rest = r / std::sin(degrees / 2 * kPi / 180);
            ball(s, {0.003, rest + 0.05, 0}, r);
            PhysicsWorld w(s);
            run(w, 3);
            CAPTURE(degrees); CAPTURE(cut);
            const double off = std::fabs(w.bodies()[0].position.y - rest);
            worst = std::max(worst, off), fastest = std::max(fastest, glm::length(w.bodies()[0].velocity));
            CHECK(off <= 1e-3);
            CHECK(std::fabs(w.bodies()[0].position.x) <= 1e-3);
        }
    CHECK(fastest <= 1e-3);
    MESSAGE("groove height error ", worst, ", speed ", fastest);
}

TEST_CASE("case 78: a cube in a right-angled groove, a capsule along it and a ball in the corner of a tilted pit rest on all walls") {
    for (const std::string_view kind : {"box", "capsule", "corner"}) {
        Scene s = scene(1.0 / 120, 0, 0.3);
        glm::dvec3 want{0};
        if (kind == "corner") {
            const glm::dvec3 tilt{20, 0, 20};
            add(s, "subtract", {}, {0});
            add(s, "box", {}, {4, 4, 4, 0}, 0);
            add(s, "box", {0, 1, 0}, {2, 4, 2, 0}, 0).rot = tilt;
            ball(s, {0, 0, 0}, 0.1);
            // In the frame of the tilted pit it lies by 0.9 to each side and 1.9 below: in the lowest of the four corners.
            want.y = 1e9;
            for (const double x : {-0.9, 0.9})
                for (const double z : {-0.9, 0.9})
                    if (const glm::dvec3 p = rotationFromDegrees(tilt) * glm::dvec3{x, -1.9, z}; p.y + 1 < want.y) want = p + glm::dvec3{0, 1, 0};
        } else {
            groove(s, 90);
            Object& o = s.objects[bodyOf(s, kind, {}, 0.2)];
            const double rest = 0.1 * std::sqrt(2.0);
            o.pos = {0.003, rest + 0.02, 0}, o.rot = kind == "box" ? glm::dvec3{0, 0, 45} : glm::dvec3{90, 0, 0};
            want = {0, rest, 0};
        }
        PhysicsWorld w(s);
        run(w, kind == "corner" ? 10 : 4);
        const Body& b = w.bodies()[0];
        glm::dvec3 off = b.position - want;
        if (kind != "corner") off.z = 0;  // along the groove it may lie anywhere
        CAPTURE(kind);
        CHECK(glm::length(off) <= 1e-3);
        CHECK(glm::length(b.velocity) <= 1e-3);
        CHECK(w.awake() == 0);
        MESSAGE(kind, " off by ", glm::length(off));
    }
}

namespace {
/// What energy a step adds, J, beyond what lifts the heaviest body out of the deepest overlap there is: overlaps are undone.
/// `io_most`, if asked for: the most that any step added, that included.
double gainOfStep(PhysicsWorld& io_w, double* io_most = nullptr) {
    double heaviest = 0;
    for (const Body& b : io_w.bodies()) heaviest = std::max(heaviest, b.mass());
    const double before = io_w.energy().total(), lift = kG * heaviest * io_w.maxPenetration();
    io_w.step();
    const double gain = io_w.energy().total() - before;
    if (io_most) *io_most = std::max(*io_most, gain);
    return gain - lift;
}
}  // namespace

TEST_CASE("case 79: a body put on a ridge or a ball stays or falls, the same way each time, and a ball gains no energy") {
    for (const std::string_view kind : {"ball", "box"}) {
        std::uint64_t hash[2] = {};
        double most = 0;
        for (std::uint64_t& h : hash) {
            Scene s = scene(1.0 / 120, 0.5, 0.5);
            add(s, "sphere", {}, {0.5});
            add(s, "box", {5, 0, 0}, {1, 1, 1, 0}).rot.z = 45;
            for (const double x : {0.0, 5.0}) {
                const double top = x == 0 ? 0.5 : std::sqrt(0.5);
                bodyOf(s, kind, {x, top + 0.1, 0}, 0.2);
                bodyOf(s, kind, {x + 0.01, top + 0.4, 0.02}, 0.2);
            }
            PhysicsWorld w(s);
            const double start = w.energy().total();
            for (int i = 0; i < 240; ++i) most = std::max(most, gainOfStep(w) / start);
            CHECK(w.bodies().size() == 4);
            h = w.stateHash();
        }
        CAPTURE(kind);
        CHECK(hash[0] == hash[1]);
        CHECK(most <= 1e-9);
        MESSAGE(kind, ": energy up by ", most, " in a step");
    }
}

TEST_CASE("case 80: in a bowl a ball swings with the period of rolling, and of sliding without friction") {
    for (const double mu : {0.0, 1.0}) {
        Scene s = scene(1.0 / 240, 0, mu);
        bowl(s, 1);
        const double swing = 0.05, l = 0.9;
        ball(s, {l * std::sin(swing), -l * std::cos(swing), 0}, 0.1);
        PhysicsWorld w(s);
        const double start = w.energy().total();
        double last = w.bodies()[0].position.x, first = 0, most = 0;
        int crossings = 0;
        double crossed = 0;
        while (crossings < 9) {
            w.step();
            const double x = w.bodies()[0].position.x;
            if ((x > 0) != (last > 0)) {
                crossed = w.time_s() - w.dt_s() * x / (x - last);
                if (crossings++ == 0) first = crossed;
            }
            last = x;
            most = std::max(most, w.energy().total() - start);
            REQUIRE(w.time_s() < 20);
        }
        const double period = (crossed - first) / 4;
        const double want = 2 * kPi * std::sqrt(l / kG * (mu > 0 ? 1.4 : 1)) * (1 + swing * swing / 16);
        CHECK(period == doctest::Approx(want).epsilon(0.01));
        CHECK(most <= 1e-5 * kG);  // case 81's share of m·g·1 m
        MESSAGE("bowl period error ", period / want - 1, ", energy gained ", most);
    }
}

namespace {
/// A floor, a slope, a rounded block, a lens, a bowl and a few pillars; bodies above them, balls alone or of every kind.
Scene anyScene(std::uint64_t seed, double dt, bool balls) {
    Random random(seed);
    // One draw a statement, or within braces: compilers may evaluate arguments in any order.
    const double restitution = random.in(0, 0.95);
    Scene s = scene(dt, restitution, random.in(0, 1));
    floor(s);
    Object& slab = add(s, "box", {random.in(-2, 2), 0.2, random.in(-2, 2)}, {2, 0.6, 1, 0.1});
    slab.rot = {random.in(-30, 30), random.in(0, 90), random.in(-30, 30)};
    add(s, "ellipsoid", {random.in(-2, 2), 0.1, random.in(-2, 2)}, {0.8, 0.3, 0.5});
    add(s, "torus", {random.in(-2, 2), 0.1, random.in(-2, 2)}, {0.5, 0.2});
    add(s, "union", {random.in(-2, 2), 0, random.in(-2, 2)}, {0.3});
    const int parent = static_cast<int>(s.objects.size()) - 1;
    add(s, "cylinder", {0, 0.3, 0}, {0.3, 0.8, 0}, parent);
    add(s, "sphere", {0.4, 0.2, 0}, {0.35}, parent);
    for (int i = 0; i < 20; ++i) {
        const double r = random.in(0.05, 0.25);
        const glm::dvec3 at{random.in(-2, 2), 1.2 + (balls ? 0.5 : 0.7) * i, random.in(-2, 2)};
        Object& o = s.objects[bodyOf(s, balls ? "ball" : kKinds[i % 4], at, 2 * r)];
        o.vel = {random.in(-3, 3), random.in(-3, 3), random.in(-3, 3)};
        if (balls) o.mass = random.in(0.1, 5), o.density = 0;
        o.spin = {random.in(-20, 20), random.in(-20, 20), random.in(-20, 20)};
    }
    return s;
}
}  // namespace

TEST_CASE("case 81: energy never grows, and nothing sinks in, whatever the scene") {
    for (const bool balls : {true, false}) {
        double most = 0, coarse = 0, all = 0, deepest = 0;  // coarse: of steps of 1/30 s; all: of the others, what lifts included
        for (std::uint64_t seed = 1; seed <= (balls ? 12 : 24); ++seed) {
            const double dt = seed % 3 == 0 ? 1.0 / 30 : seed % 3 == 1 ? 1.0 / 60 : 1.0 / 240;
            PhysicsWorld w(anyScene(seed, dt, balls));
            const double start = w.energy().total();
            double& gained = dt > 0.02 ? coarse : most;
            double gain = 0;
            while (w.time_s() < 3) gained = std::max(gained, gainOfStep(w, &gain) / start);
            if (dt <= 0.02) all = std::max(all, gain / start);
            CAPTURE(seed);
            // Five resting depths: a ball squeezed between others. What rolls on edges sinks in as it lands on the next one, by what it turns in
            // a part, and is moved out again.
            CHECK(w.maxPenetration() <= (balls ? 5e-4 : dt > 0.02 ? 3e-3 : 1e-3));
            deepest = std::max(deepest, w.maxPenetration());
            CHECK(w.removed() == 0);
            CHECK(w.bodies().size() == 20);
        }
        CAPTURE(balls);
        CHECK(all <= 1e-5);  // the case
        CHECK(most <= (balls ? 1e-9 : 1e-6));
        // What lands on another edge in the middle of a step is pushed by the first one until the step ends.
        CHECK(coarse <= (balls ? 1e-9 : 1e-5));
        MESSAGE(std::string_view(balls ? "balls" : "all kinds"), ": most energy gained in a step ", all, " of all, ", most, " of it unlifted, ", coarse, " in steps of 1/30 s, deepest ", deepest);
    }
}

namespace {
/// One body alone on a floor, in parts as long as those of the default knobs.
struct Wobbler {
    Wobbler(std::string_view of, std::string_view type, glm::dvec3 pos, std::initializer_list<double> numbers, glm::dvec3 rot, glm::dvec3 spin)
        : name(of), alone(scene(1.0 / 240, 0, 0.5)) {
        floor(alone);
        Object& o = add(alone, type, pos, numbers);
        o.rot = rot, o.spin = spin, o.density = 2500;
    }
    void with(std::string_view type, glm::dvec3 pos, std::initializer_list<double> numbers, double turned = 0) {
        add(alone, type, pos, numbers, 1).rot = {0, turned, 0};
    }
    static Wobbler disc(std::string_view of, double radius, double height, glm::dvec3 spin) {
        const double tilt = glm::radians(15.0);
        return {of, "cylinder", {0, radius * std::sin(tilt) + 0.5 * height * std::cos(tilt), 0}, {radius, height, 0}, {0, 0, 15}, spin};
    }
    std::string_view name;
    Scene alone;
};
}  // namespace

TEST_CASE("case 81: coins, plates, a cup and a rattleback that roll and wobble gain no energy") {
    Wobbler cup("cup", "subtract", {0, 0.3, 0}, {0}, {70, 0, 10}, {0, 5, 8});
    cup.with("cylinder", {}, {0.15, 0.3, 0}), cup.with("cylinder", {0, 0.02, 0}, {0.13, 0.3, 0});
    Wobbler rattleback("rattleback", "union", {0, 0.2, 0}, {0}, {}, {0, 8, 0.5});
    rattleback.with("ellipsoid", {}, {0.5, 0.1, 0.15}), rattleback.with("box", {0, 0.08, 0}, {0.3, 0.05, 0.08, 0}, 25);
    for (const Wobbler& wobbler : {Wobbler::disc("coin", 0.1, 0.003, {1.5, 12, 0}), Wobbler::disc("penny", 0.01, 0.0015, {0.5, 40, 0}),
                                   Wobbler::disc("plate", 0.15, 0.01, {1.5, 9, 0}), Wobbler::disc("disc", 0.1, 0.02, {1.5, 12, 0}), cup, rattleback}) {
        PhysicsWorld w(wobbler.alone);
        const double start = w.energy().total();
        double most = 0, deepest = 0;
        while (w.time_s() < 4) most = std::max(most, gainOfStep(w) / start), deepest = std::max(deepest, w.maxPenetration());
        CAPTURE(wobbler.name);
        CHECK(most <= 2e-6);
        CHECK(deepest <= 1e-3);
        CHECK(w.held() <= 5);  // about to lie down flat it may strike its rim more often than is followed
        MESSAGE(wobbler.name, ": most energy gained in a step ", most, " of all, left ", w.energy().total() / start, ", deepest ", deepest, " m, ",
                std::string_view(w.awake() == 0 ? "asleep" : "awake"), ", held ", w.held());
    }
}

TEST_CASE("case 81: of bodies alone in a room none gains energy by bouncing, however lively and rough") {
    for (const double gravity : {0.0, kG}) {
        double most = 0, left = 0;
        int hits = 0;
        Random random(9);
        for (int i = 0; i < 48; ++i) {
            const double restitution = std::array{0.6, 0.8, 0.95, 1.0}[static_cast<std::size_t>(i % 4)], friction = random.in(0, 1);
            Scene s = scene(1.0 / 120, restitution, friction, gravity);
            add(s, "subtract", {}, {0});
            add(s, "box", {}, {4.4, 4.4, 4.4, 0}, 0), add(s, "box", {}, {4, 4, 4, 0}, 0);
            const auto any = [&](double x) {
                const double a = random.in(-x, x), b = random.in(-x, x), c = random.in(-x, x);
                return glm::dvec3{a, b, c};
            };
            Object& o = s.objects[bodyOf(s, kKinds[i / 4 % 4], any(1), 0.4)];
            o.vel = any(3), o.spin = any(10), o.rot = any(180);
            PhysicsWorld w(s);
            const double start = w.energy().kinetic + 2 * gravity * w.bodies()[0].mass();
            while (w.time_s() < 2) most = std::max(most, gainOfStep(w) / start);
            hits += static_cast<int>(w.impacts());
            if (restitution == 1 && friction < 0.5) left = std::max(left, (w.energy().kinetic + gravity * w.bodies()[0].mass() * (2 + w.bodies()[0].position.y)) / start);
        }
        CAPTURE(gravity);
        CHECK(hits > 50);
        CHECK(most <= 1e-7);
        CHECK(left > 0.5);  // it bounces all the same
        MESSAGE("gravity ", gravity, ": most gained in a step ", most, " of all, in ", hits, " impacts");
    }
}
