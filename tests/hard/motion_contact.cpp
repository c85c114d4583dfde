// Cases 60, 62 to 64 and 68 to 70: masses, overlaps, slow impacts, rolling and sliding.
#include "physics/contact.h"
#include "physics/scenes.h"

#include <doctest/doctest.h>

#include <vector>

using namespace mb;
using namespace mb::test;

TEST_CASE("case 60: of a heavy ball's fall onto a light one the rounds leave less than plain ones, whose rest is (R/(R+1))^k") {
    struct Row { double ratio; int rounds; double most; };
    for (const Row& row : {Row{10, 12, 0.04}, Row{100, 48, 0.015}, Row{1e6, 1000, 0.65}}) {
        Scene s = scene(1.0 / 120, 0, 0);
        ball(s, {0, 0.1, 0}, 0.1);
        ball(s, {0, 0.3, 0}, 0.1, {}, row.ratio);
        const PhysicsWorld w(s);
        std::vector<Contact> contacts;
        addBallContact(0, w.bodies()[0], {0, 1, 0}, 0, {}, contacts), addBallContact(1, w.bodies()[1], 0, w.bodies()[0], {}, contacts);
        std::vector<Motion> motion(2);
        motion[0].velocity = motion[1].velocity = {0, -1, 0};
        StepCounts counts;
        solve(w.bodies(), contacts, motion, row.rounds / 4, w.stages(), counts);  // of so few contacts four times as many are made
        CHECK(counts.rounds == static_cast<std::uint64_t>(row.rounds));
        const double plain = std::pow(row.ratio / (row.ratio + 1), row.rounds), left = std::fabs(motion[1].velocity.y);
        CHECK(left <= row.most);
        CHECK(left < plain);
        MESSAGE("R = ", row.ratio, ", ", row.rounds, " rounds: ", left, " left, by plain ones ", plain);
    }
}

TEST_CASE("case 60: a heavy ball on a light one, and a heavy box on two small ones: what sinks in for each ratio of masses") {
    for (const bool boxes : {false, true})
        for (const double ratio : {1.0, 10.0, 100.0, 1e3, 1e6}) {
            
            Scene s = scene(1.0 / 120, 0, 0.5);
            if (boxes) {
                floor(s);
                for (const double x : {-0.3, 0.3}) block(s, {x, 0.05, 0}, {0.1, 0.1, 0.1});
                block(s, {0, 0.2, 0}, {1, 0.2, 0.2}, ratio * 1000 / 40);  // 40 times as large
            } else {
                tube(s, 3);
                ball(s, {0, 0.2, 0}, 0.1);
                ball(s, {0, 0.4, 0}, 0.1, {}, ratio);
            }
            PhysicsWorld w(s);
            double deepest = 0;
            while (w.time_s() < 3) w.step(), deepest = std::max(deepest, w.maxPenetration());
            CAPTURE(boxes); CAPTURE(ratio);
            if (ratio <= (boxes ? 100 : 1000)) CHECK(deepest <= 1e-3);  // the range the solver is good for; beyond it is only finite
            CHECK(std::isfinite(deepest));
            CHECK(w.removed() == 0);
            MESSAGE(std::string_view(boxes ? "boxes" : "balls"), ", mass ratio ", ratio, ": deepest ", deepest);
        }
}

namespace {
/// The fastest and the highest of the bodies in that time, by where they are after each step.
struct Thrown { double fastest = 0, highest = -1e9; };
Thrown watch(PhysicsWorld& io_world, double seconds) {
    Thrown t;
    for (const double end = io_world.time_s() + seconds - 0.5 * io_world.dt_s(); io_world.time_s() < end;) {
        const std::vector<Body> before(io_world.bodies().begin(), io_world.bodies().end());
        io_world.step();
        for (std::size_t k = 0; k < before.size(); ++k) {
            const Body& b = io_world.bodies()[k];
            REQUIRE(std::isfinite(b.position.x + b.position.y + b.position.z + b.velocity.x + b.velocity.y + b.velocity.z));
            t.fastest = std::max(t.fastest, glm::length(b.position - before[k].position) / io_world.dt_s());
            t.highest = std::max(t.highest, b.position.y);
        }
    }
    return t;
}
}  // namespace

TEST_CASE("case 62: a pyramid of balls that overlaps by a quarter comes apart without being thrown") {
    Scene s = scene(1.0 / 60, 0, 0.5);
    floor(s);
    for (int row = 0; row < 4; ++row)
        for (int i = 0; i < 4 - row; ++i) ball(s, {0.15 * i + 0.075 * row, 0.08 + 0.13 * row, 0}, 0.1);
    PhysicsWorld w(s);
    const Thrown t = watch(w, 2);
    CHECK(w.maxPenetration() <= 3e-4);
    CHECK(t.highest <= 0.08 + 0.13 * 3 + 0.5);
    CHECK(t.fastest <= kPushOutSpeed + 3);  // the push and, at most, a fall of half a metre
    MESSAGE("overlap left ", w.maxPenetration(), ", fastest ", t.fastest, " m/s, highest ", t.highest);
}

TEST_CASE("case 62: boxes that overlap by a twentieth come apart without being thrown") {
    Scene s = scene(1.0 / 60, 0, 0.5);
    floor(s);
    for (int row = 0; row < 4; ++row)
        for (int i = 0; i < 4 - row; ++i) block(s, {0.25 * i + 0.125 * row, 0.095 + 0.19 * row, 0}, {0.2, 0.2, 0.2});
    PhysicsWorld w(s);
    const double before = w.maxPenetration();
    const Thrown t = watch(w, 2);
    CHECK(before == doctest::Approx(0.01));
    CHECK(w.maxPenetration() <= 3e-4);
    CHECK(t.highest <= 0.095 + 0.19 * 3 + 0.5);
    CHECK(t.fastest <= kPushOutSpeed + 3);
    MESSAGE("overlap left ", w.maxPenetration(), " of ", before, ", fastest ", t.fastest, " m/s, highest ", t.highest);
}

TEST_CASE("case 63: balls whose centres coincide are parted, the same way each time") {
    for (const int n : {2, 100}) {
        std::uint64_t hash[2] = {};
        for (std::uint64_t& h : hash) {
            Scene s = scene(1.0 / 60, 0.5, 0.5, 0);
            for (int i = 0; i < n; ++i) ball(s, {}, 0.1);
            PhysicsWorld w(s);
            const Thrown t = watch(w, 3);
            CHECK(w.bodies().size() == static_cast<std::size_t>(n));
            CHECK(w.maxPenetration() <= 1e-3);
            CHECK(glm::length(w.momentum()) <= 1e-5);
            CHECK(t.fastest <= kPushOutSpeed * (1 + 1e-9));
            h = w.stateHash();
            if (&h != hash) continue;
            MESSAGE(n, " balls: overlap left ", w.maxPenetration(), ", momentum ", glm::length(w.momentum()), ", fastest ", t.fastest, " m/s");
        }
        CHECK(hash[0] == hash[1]);
    }
}

TEST_CASE("case 64: a body deep inside a solid comes out, pushed no faster than 3 m/s") {
    for (const std::string_view kind : {"ball", "box", "capsule"})
        for (const glm::dvec3 at : {glm::dvec3{0, 0, 0}, glm::dvec3{0.1, 0.45, 0}, glm::dvec3{0.5, 0.5, 0.5}}) {
            Scene s = scene(1.0 / 120, 0.5, 0.5);
            add(s, "box", {}, {1, 1, 1, 0});
            bodyOf(s, kind, at, 0.2);
            PhysicsWorld w(s);
            const auto isOut = [&] {
                const glm::dvec3 p = glm::abs(w.bodies()[0].position);
                return std::max({p.x, p.y, p.z}) > 0.5 && w.maxPenetration() <= 1e-3;
            };
            double pushed = 0;
            while (w.time_s() < 5 && !isOut()) {
                // What it moves by beyond its own velocities, before and after.
                const Body before = w.bodies()[0];
                w.step();
                REQUIRE(w.bodies().size() == 1);
                const Body& b = w.bodies()[0];
                REQUIRE(std::isfinite(b.position.x + b.position.y + b.position.z));
                const glm::dvec3 moved = (b.position - before.position) / w.dt_s();
                pushed = std::max(pushed, glm::length(moved - 0.5 * (before.velocity + b.velocity)));
                CHECK(glm::length(b.velocity) <= kG * w.time_s() * (1 + 1e-9) + 1e-9);  // it falls, and is not thrown
            }
            CAPTURE(kind); CAPTURE(at.y);
            CHECK(isOut());
            CHECK(pushed <= kPushOutSpeed + 0.5 * kG * w.dt_s());
            MESSAGE(kind, " from ", at.y, ": out after ", w.time_s(), " s, pushed by ", pushed, " m/s");
        }
}

TEST_CASE("case 68: slow approaches do not bounce, fast ones do; the threshold is what gravity gives in two parts") {
    const double dt = 1.0 / 120;
    for (const std::string_view kind : {"ball", "box"})
        for (const double v : {0.02, 0.1, 0.15, 0.2, 0.5, 2.0}) {
            Scene s = scene(dt, 0.8, 0);
            floor(s);
            s.objects[bodyOf(s, kind, {0, 0.5, 0}, 1)].vel.y = -v;
            PhysicsWorld w(s);
            w.step();
            const double after = w.bodies()[0].velocity.y;
            CAPTURE(kind); CAPTURE(v);
            if (v < 2 * kG * dt) CHECK(std::fabs(after) <= (kind == "ball" ? 1e-9 : 1e-6));  // 0.1635 m/s
            else CHECK(std::fabs(after - (0.8 * v - kG * dt)) <= 1e-6);
        }
}

namespace {
/// A ball at rest on a plane that falls by `degrees` towards +x; how fast it gets along the slope in one second, and spins.
struct Rolled { double acceleration, spin; };
Rolled onRamp(std::string_view kind, double degrees, double friction, double dt, bool box) {
    const double a = degrees * kPi / 180, r = 0.2;
    const glm::dvec3 n{std::sin(a), std::cos(a), 0}, down{std::cos(a), -std::sin(a), 0};
    Scene s = scene(dt, 0, friction);
    if (box) add(s, "box", -0.5 * n, {60, 1, 4, 0}).rot = {0, 0, -degrees};
    else add(s, "plane", {}, {n.x, n.y, 0, 0});
    s.objects[bodyOf(s, kind, r * n, 2 * r)].rot.z = -degrees;
    PhysicsWorld w(s);
    run(w, 1);
    const Body& b = w.bodies()[0];
    CHECK(std::fabs(glm::dot(b.position, n) - r) <= 1e-4);
    // From rest s = a t²/2, exact for a constant acceleration.
    return {2 * glm::dot(b.position, down), -b.spin.z * r};
}
}  // namespace

TEST_CASE("case 69: a ball on a 20 degree ramp rolls with 5/7 of g sin 20°, whatever the step") {
    double worst = 0;
    for (const bool box : {false, true})
        for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240}) {
            const double want = 5.0 / 7 * kG * std::sin(20 * kPi / 180);
            const Rolled rolled = onRamp("ball", 20, 0.5, dt, box);
            worst = std::max({worst, std::fabs(rolled.acceleration / want - 1), std::fabs(rolled.spin / want - 1)});
        }
    CHECK(worst <= 1e-6);
    MESSAGE("rolling error ", worst);
}

TEST_CASE("case 69: on any ramp a ball rolls if tan θ ≤ 3.5 μ, and else slides and is turned; a box stays, or slides without friction") {
    double worst = 0, of_box = 0;
    for (const double degrees : {10.0, 20.0, 30.0, 40.0, 50.0, 60.0})
        for (const double mu : {0.0, 0.1, 0.3, 0.6, 1.0}) {
            const double a = degrees * kPi / 180, roll = 5.0 / 7 * kG * std::sin(a), slide = kG * (std::sin(a) - mu * std::cos(a));
            const bool rolls = std::tan(a) <= 3.5 * mu;
            const Rolled r = onRamp("ball", degrees, mu, 1.0 / 120, false);
            const double want = rolls ? roll : slide, spin = rolls ? roll : 2.5 * mu * kG * std::cos(a);
            worst = std::max({worst, std::fabs(r.acceleration / want - 1), std::fabs(r.spin - spin) / roll});
            if (mu > 0 && std::tan(a) > 0.8 * mu) continue;  // of a box that slides with friction: motion_shapes.cpp
            const Rolled b = onRamp("box", degrees, mu, 1.0 / 120, false);
            of_box = std::max({of_box, std::fabs(b.acceleration - std::max(slide, 0.0)) / (kG * std::sin(a)), std::fabs(b.spin) / roll});
        }
    CHECK(worst <= 0.01);
    CHECK(of_box <= 0.01);
    MESSAGE("ramp error ", worst, ", of a box ", of_box);
}

TEST_CASE("case 70: a sliding ball comes to roll with 5/7 of its speed after 2v/(7μg)") {
    Scene s = scene(1.0 / 120, 0, 0.3);
    s.world.bounds = 1e3;
    floor(s);
    ball(s, {0, 0.2, 0}, 0.2, {5, 0, 0});
    PhysicsWorld w(s);
    const double when = 2 * 5 / (7 * 0.3 * kG);
    double rolls_at = 0;
    while (w.time_s() < 2 * when) {
        w.step();
        const Body& b = w.bodies()[0];
        if (rolls_at == 0 && std::fabs(b.velocity.x + b.spin.z * b.radius) <= 1e-6) rolls_at = w.time_s();
    }
    CHECK(rolls_at == doctest::Approx(when).epsilon(0.05));
    CHECK(w.bodies()[0].velocity.x == doctest::Approx(5 * 5.0 / 7).epsilon(1e-4));
    MESSAGE("rolls after ", rolls_at / when, " of the time, with ", w.bodies()[0].velocity.x / (25.0 / 7) - 1, " more");
}
