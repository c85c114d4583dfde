// Cases 54 to 59, 73 and 76: flight, bounces, what two bodies do to one another, spin, and flight far from the origin.
#include "physics/scenes.h"

#include <doctest/doctest.h>

#include <vector>

using namespace mb;
using namespace mb::test;

TEST_CASE("case 54: free fall is the continuous law's, whatever the step") {
    double worst = 0;
    for (const std::string_view kind : kKinds)
        for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240}) {
            Scene s = scene(dt, 0.5, 0.5);
            Object& o = s.objects[bodyOf(s, kind, {0, 40, 0}, 1)];
            o.vel = {1, 2, -3}, o.spin = {3, 5, -1};
            PhysicsWorld w(s);
            const Body first = w.bodies()[0];
            run(w, 1);
            const double t = w.time_s();
            const glm::dvec3 want = first.position + t * first.velocity - glm::dvec3{0, 0.5 * kG * t * t, 0};
            worst = std::max(worst, glm::length(w.bodies()[0].position - want));
            CHECK(w.bodies()[0].velocity.y == doctest::Approx(first.velocity.y - kG * t).epsilon(1e-12));
        }
    CHECK(worst <= 1e-11);  // rounding of 240 sums of numbers near 40
    MESSAGE("free fall off by ", worst);
}

TEST_CASE("case 55: at e = 1 energy neither grows nor shrinks in 20 s") {
    for (const std::string_view kind : {"ball", "box"}) {
        double most = 0;
        for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120}) {
            Scene s = scene(dt, 1, 0.5);
            floor(s);
            bodyOf(s, kind, {0, 1.5, 0}, 1);
            PhysicsWorld w(s);
            const double start = w.energy().total(), base = 0.5 * kG * w.bodies()[0].mass();
            while (w.time_s() < 20) {
                w.step();
                most = std::max(most, std::fabs((w.energy().total() - base) / (start - base) - 1));
            }
            CHECK(w.impacts() + w.counts().bounces >= 15);
        }
        CHECK(most <= (kind == "ball" ? 1e-8 : 2e-3));  // a ball's few dozen impacts, each at a height that is known to 1e-11 m
        MESSAGE(kind, ": energy drift ", most);
    }
}

TEST_CASE("case 56: 1,000 steps at e = 0.9 follow a reference of ten lines") {
    const double dt = 1.0 / 60;
    Scene s = scene(dt, 0.9, 0);
    floor(s);
    ball(s, {0, 1.5, 0}, 0.5);
    PhysicsWorld w(s);
    double y = 1, v = 0, worst = 0;
    int followed = 0;
    for (; followed < 1000; ++followed) {
        w.step();
        for (double left = dt; left > 0;) {
            const double hit = (v + std::sqrt(v * v + 2 * kG * y)) / kG;
            const double t = std::min(left, hit);
            y = std::max(y + v * t - 0.5 * kG * t * t, 0.0), v -= kG * t, left -= t;
            if (t == hit) v *= -0.9;
        }
        if (std::fabs(v) < 1 && y < 0.06) break;  // soon it bounces more than once a step and comes to rest
        worst = std::max({worst, std::fabs(w.bodies()[0].position.y - 0.5 - y), std::fabs(w.bodies()[0].velocity.y - v)});
    }
    CHECK(worst <= 1e-5);
    CHECK(followed > 150);
    run(w, 1000 * dt - w.time_s());
    CHECK(w.bodies()[0].position.y == doctest::Approx(0.5).epsilon(1e-4));  // where the reference's bounces end
    MESSAGE("against the reference ", worst, " over ", followed, " steps");
}

namespace {
/// The greatest height of the lowest point between the first and the second impact.
double rebound(std::string_view kind, double e, double dt) {
    Scene s = scene(dt, e, 0.5);
    floor(s);
    const double up_by = kind == "capsule" ? 1 : 0.5;  // of its middle over its lowest point
    bodyOf(s, kind, {0, 2 + up_by, 0}, 1);
    PhysicsWorld w(s);
    double highest = 0;
    bool up = false;
    while (w.time_s() < 4) {
        w.step();
        const Body& b = w.bodies()[0];
        if (b.velocity.y > 0) up = true;
        // The apex lies between two steps: from either one it is v²/2g above.
        if (up) highest = std::max(highest, b.position.y - up_by + (std::fabs(b.velocity.y) < 2 * kG * dt ? b.velocity.y * b.velocity.y / (2 * kG) : 0));
        if (up && b.velocity.y < -2 * kG * dt) break;
    }
    return highest;
}
}  // namespace

TEST_CASE("case 57: dropped from 2 m a body rebounds to e² of the drop, whatever the step") {
    for (const std::string_view kind : {"ball", "box", "capsule"}) {
        double worst = 0;
        for (const double e : {0.3, 0.5, 0.8, 1.0})
            for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240}) {
                const double error = std::fabs(rebound(kind, e, dt) / 2 - e * e);
                worst = std::max(worst, error);
                CAPTURE(kind); CAPTURE(e); CAPTURE(dt);
                CHECK(error <= 0.05);
            }
        if (kind == "ball") CHECK(worst <= 1e-9);  // impacts are resolved when they happen: what is left is the root's tolerance
        MESSAGE(kind, ": rebound off by ", worst, " of the drop");
    }
}

TEST_CASE("case 57: at e = 0 what was dropped stays down") {
    for (const std::string_view kind : {"ball", "box"})
        for (const double dt : {1.0 / 30, 1.0 / 240}) {
            Scene s = scene(dt, 0, 0.5);
            floor(s);
            bodyOf(s, kind, {0, 2.5, 0}, 1);
            PhysicsWorld w(s);
            run(w, 2);
            CHECK(std::fabs(w.bodies()[0].position.y - 0.5) <= 1e-4);  // the depth a resting ball may sink to
            CHECK(w.awake() == 0);
        }
}

TEST_CASE("case 58: two bodies exchange velocities as Newton's law says") {
    struct Case { double m1, m2, v1, v2; };
    for (const std::string_view kind : {"ball", "die"}) {
        double worst = 0, momentum = 0;
        for (const Case& c : {Case{1, 1, 5, -10}, Case{1, 3, 4, 0}, Case{1000, 1, 2, -2}, Case{1e-3, 1e3, 10, -1}}) {
            Scene s = scene(1.0 / 60, 1, 0, 0);
            const std::size_t a = bodyOf(s, kind, {-2, 0, 0}, 1), b = bodyOf(s, kind, {2, 0, 0}, 1);
            s.objects[a].mass = c.m1, s.objects[a].density = 0, s.objects[a].vel.x = c.v1;
            s.objects[b].mass = c.m2, s.objects[b].density = 0, s.objects[b].vel.x = c.v2;
            if (kind == "die") s.objects[b].rot.y = 180;  // its pushes may pass beside the centres, and turn
            PhysicsWorld w(s);
            run(w, 1);
            const double sum = c.m1 + c.m2, before = c.m1 * c.v1 + c.m2 * c.v2, size = c.m1 * std::fabs(c.v1) + c.m2 * std::fabs(c.v2);
            const glm::dvec3 v1 = w.bodies()[0].velocity, v2 = w.bodies()[1].velocity;
            momentum = std::max(momentum, std::fabs(w.momentum().x - before) / size);
            CHECK(v2.x - v1.x > 0);
            if (kind == "die") continue;
            const double want1 = ((c.m1 - c.m2) * c.v1 + 2 * c.m2 * c.v2) / sum, want2 = ((c.m2 - c.m1) * c.v2 + 2 * c.m1 * c.v1) / sum;
            worst = std::max({worst, glm::length(v1 - glm::dvec3{want1, 0, 0}), glm::length(v2 - glm::dvec3{want2, 0, 0})});
        }
        CHECK(worst <= 1e-5);
        CHECK(momentum <= 1e-6);
        MESSAGE(kind, ": velocities off by ", worst, " m/s, momentum by ", momentum);
    }
}

TEST_CASE("case 59: of five touching balls the last one leaves, the same way each time; of boxes all") {
    for (const std::string_view kind : {"ball", "box"}) {
        std::uint64_t hash[2] = {};
        for (std::uint64_t& h : hash) {
            Scene s = scene(1.0 / 60, 1, 0, 0);
            for (int i = 0; i < 5; ++i) {
                Object& o = s.objects[bodyOf(s, kind, {i == 0 ? -0.5 : 0.2 * i, 0, 0}, 0.2)];
                o.mass = 1, o.density = 0, o.vel.x = i == 0 ? 1 : 0;
            }
            PhysicsWorld w(s);
            run(w, 1);
            std::vector<double> v;
            for (const Body& b : w.bodies()) v.push_back(b.velocity.x);
            CHECK(std::fabs(w.momentum().x - 1) <= 1e-3);
            CHECK(std::fabs(w.energy().total() - 0.5) <= 1e-3);
            if (kind == "ball")
                for (std::size_t i = 0; i < 5; ++i) CHECK(std::fabs(v[i] - (i == 4 ? 1 : 0)) <= 1e-9);
            h = w.stateHash();
            if (&h == hash)
                MESSAGE(kind, ": ", v[0], " ", v[1], " ", v[2], " ", v[3], " ", v[4], " m/s, momentum off by ", w.momentum().x - 1,
                        ", energy by ", w.energy().total() / 0.5 - 1);
        }
        CHECK(hash[0] == hash[1]);
    }
}

TEST_CASE("case 73: a ball's spin keeps its size for 1e6 steps, and the orientation its length") {
    Scene s = scene(1.0 / 120, 0, 0, 0);
    ball(s, {}, 0.3).spin = {60, 64, 48};
    PhysicsWorld w(s);
    for (int i = 0; i < 1'000'000; ++i) w.step();
    const double spin = std::fabs(glm::length(w.bodies()[0].spin) / 100 - 1), length = std::fabs(glm::length(w.bodies()[0].orientation) - 1);
    CHECK(spin <= 1e-5);
    CHECK(length <= 1e-6);
    // A hundred full turns end where they began: the angle errs by the tangent's x⁷/1575 at x ≤ 1/8.
    const glm::dquat q = turned({1, 0, 0, 0}, {0, 2 * kPi, 0}, 100);
    CHECK(std::fabs(std::fabs(q.w) - 1) <= 1e-6);
    MESSAGE("spin off by ", spin, ", length by ", length);
}

TEST_CASE("case 73: a body of three moments tumbles with the same angular momentum and never more energy") {
    for (const double spin : {10.0, 100.0}) {
        Scene s = scene(1.0 / 120, 0, 0, 0);
        block(s, {}, {0.4, 0.2, 0.1}).spin = spin * glm::dvec3{0.01, 1, 0.02};  // about the middle axis, from which it turns over
        bodyOf(s, "die", {3, 0, 0}, 0.3);
        s.objects[1].spin = spin * glm::dvec3{0.6, 0.64, 0.48}, s.objects[1].rot = {10, 20, 30};
        PhysicsWorld w(s);
        double most = 0, drift = 0, least = 1;
        std::vector<glm::dvec3> l;
        std::vector<double> e;
        for (const Body& b : w.bodies()) l.push_back(angularMomentum(b, b.spin)), e.push_back(kineticEnergy(b, {{}, b.spin}));
        for (int i = 0; i < 500'000; ++i) {
            w.step();
            for (std::size_t k = 0; k < 2; ++k) {
                const Body& b = w.bodies()[k];
                drift = std::max(drift, glm::length(angularMomentum(b, b.spin) - l[k]) / glm::length(l[k]));
                most = std::max(most, kineticEnergy(b, {{}, b.spin}) / e[k] - 1);
            }
            least = std::min(least, glm::dot(w.bodies()[0].spin, l[0]) / (glm::length(w.bodies()[0].spin) * glm::length(l[0])));
        }
        CHECK(drift <= 1e-6);  // the case's 0.05
        CHECK(most <= 1e-9);
        CHECK(least < 0.95);   // it did turn over
        MESSAGE("spin ", spin, ": angular momentum off by ", drift, ", energy up by ", most);
    }
}

TEST_CASE("case 73: whatever turns as fast as the world allows keeps its angular momentum and energy") {
    // A needle and a disc have an axis of symmetry, a box has none; in one step they turn up to 6,700 rad.
    double drift = 0, energy = 0, off = 0;
    for (const double spin : {2e3, 1e4, 1e5, 4e5})
        for (const glm::dvec3 way : {glm::dvec3{1, 0, 0}, {0, 1, 0}, {0.6, 0.64, 0.48}, {0.01, 1, 0.02}})
            for (const double dt : {1.0 / 60, 1e-5}) {
                Scene s = scene(dt, 0, 0, 0);
                add(s, "capsule", {}, {0.001, 0.3}).rot = {20, 30, 40};
                add(s, "cylinder", {3, 0, 0}, {0.1, 0.01, 0}), add(s, "box", {6, 0, 0}, {0.2, 0.3, 0.1, 0});
                for (Object& o : s.objects) o.density = 900, o.spin = spin * way;
                PhysicsWorld w(s);
                std::vector<Body> start(w.bodies().begin(), w.bodies().end());
                run(w, 20 * dt);
                REQUIRE(w.bodies().size() == 3);
                for (std::size_t k = 0; k < 3; ++k) {
                    const Body &b = w.bodies()[k], &a = start[k];
                    const glm::dvec3 l = angularMomentum(a, a.spin);
                    drift = std::max(drift, glm::length(angularMomentum(b, b.spin) - l) / glm::length(l));
                    energy = std::max(energy, std::fabs(kineticEnergy(b, {{}, b.spin}) / kineticEnergy(a, {{}, a.spin}) - 1));
                }
                // The axis of what has one goes around the angular momentum at |L|/I across it (Landau, Lifshitz, section 33).
                if (spin * dt < 150) continue;  // many short turns, each with an error of its own
                for (std::size_t k = 0; k < 2; ++k) {
                    const Body &b = w.bodies()[k], &a = start[k];
                    const glm::dvec3 l = angularMomentum(a, a.spin), axis = a.pose().rotation[1];
                    const double rate = glm::length(l) * a.inverse_inertia[0][0], angle = rate * w.time_s();
                    const glm::dvec3 n = glm::normalize(l);
                    const glm::dvec3 there = std::cos(angle) * axis + std::sin(angle) * glm::cross(n, axis) + (1 - std::cos(angle)) * glm::dot(n, axis) * n;
                    off = std::max(off, glm::length(b.pose().rotation[1] - there));
                }
            }
    CHECK(drift <= 1e-9);
    CHECK(energy <= 1e-9);
    CHECK(off <= 1e-3);  // turned() errs by 2.4e-9 of an angle; this one is up to 1.3e5 rad
    MESSAGE("angular momentum off by ", drift, ", energy by ", energy, ", the axes of what is symmetric by ", off);
}

namespace {
/// Where a ball and a box are that bounce and slide on a slab, `x` m from the origin: every tenth step, without x.
std::vector<glm::dvec3> flightAt(double x) {
    Scene s = scene(1.0 / 60, 0.5, 0.3);
    s.world.bounds = 1e9;
    add(s, "box", {x, -0.5, 0}, {20, 1, 20, 0});
    Object& o = ball(s, {x, 1, 0}, 0.25, {1, 0, 0.5});
    o.spin = {0, 3, 0};
    s.objects[bodyOf(s, "box", {x, 1, 2}, 0.5)].vel = {1, 0, 0};
    PhysicsWorld w(s);
    std::vector<glm::dvec3> path;
    for (int i = 0; i < 180; ++i) {
        w.step();
        if (i % 10 == 9)
            for (const Body& b : w.bodies()) path.push_back(b.position - glm::dvec3{x, 0, 0});
    }
    return path;
}
}  // namespace

TEST_CASE("case 76: far from the origin everything moves as it does there") {
    const std::vector<glm::dvec3> here = flightAt(0);
    for (const double x : {1e3, 1e4, 1e5, 1e6, 1e7}) {
        const std::vector<glm::dvec3> there = flightAt(x);
        REQUIRE(there.size() == here.size());
        double worst = 0;
        for (std::size_t i = 0; i < here.size(); ++i) worst = std::max(worst, glm::length(here[i] - there[i]));
        CAPTURE(x);
        CHECK(worst <= 1e-3);
        MESSAGE("at ", x, " m off by ", worst);
    }
    // The range is the world's, and enforced.
    Scene s = scene(1.0 / 60, 0.5, 0.3, 0);
    s.world.bounds = 1e3;
    ball(s, {990, 0, 0}, 0.1, {20, 0, 0});
    PhysicsWorld w(s);
    run(w, 1);
    CHECK(w.removed() == 1);
}
