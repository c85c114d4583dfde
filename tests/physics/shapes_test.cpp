// Contact with shapes whose field is not their distance, and with several surfaces at once.
#include "physics/random.h"
#include "scenes.h"

#include <doctest/doctest.h>

#include <glm/gtc/constants.hpp>

using namespace mb;
using namespace mb::test;

namespace {
double gapAt(const Scene& s, glm::dvec3 c, double r) {
    std::vector<std::string> notes;
    const StaticField field(s, [](std::size_t) { return true; }, notes);
    std::vector<Touch> touches;
    const double free = field.touches(c, r, 3, touches);
    return touches.empty() ? free : touches[0].gap;
}
}  // namespace

TEST_CASE("the gap to a lens is the distance to it, on its faces and beyond its rim") {
    Scene s;
    lens(s);
    const double rim = std::sqrt(1 - 0.81);
    Random random(5);
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 c{random.in(-0.6, 0.6), random.in(-1.2, 1.2), random.in(-1.2, 1.2)};
        const double r = random.in(0.01, 0.5), out = std::hypot(c.y, c.z);
        if (std::max(glm::length(c - glm::dvec3{-0.9, 0, 0}), glm::length(c - glm::dvec3{0.9, 0, 0})) < 1.001) continue;  // inside
        // The foot on the further cap if it lies on the lens, else the rim.
        const double side = c.x < 0 ? 1 : -1;
        const glm::dvec3 centre{0.9 * side, 0, 0}, foot = centre + glm::normalize(c - centre);
        const double d = foot.x * side <= 0 ? glm::length(c - foot) : std::hypot(c.x, out - rim);
        worst = std::max(worst, std::fabs(gapAt(s, c, r) - (d - r)));
    }
    CHECK(worst <= 1e-7);
    MESSAGE("lens gap error ", worst);
}

TEST_CASE("the gap to every primitive is the distance to its nearest surface point") {
    for (const Primitive& p : primitives()) {
        if (p.name == "plane") continue;
        Scene s;
        add(s, p.name, {0.1, -0.2, 0.3}, {}).rot = {20, 30, 40};
        s.objects[0].numbers = initialNumbers(p);
        if (p.name == "ellipsoid") s.objects[0].numbers = {0.9, 0.3, 0.5};
        const Tree tree = makeTree(s);
        Random random(11);
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 c{random.in(-2, 2), random.in(-2, 2), random.in(-2, 2)};
            const double f = distance<double>(tree, {c.x, c.y, c.z}), r = 0.1;
            if (f < 0.01) continue;
            const double d = gapAt(s, c, r) + r;
            CAPTURE(p.name);
            if (p.exact) CHECK(d == doctest::Approx(f).epsilon(1e-9));
            else CHECK(d >= f - 1e-12);
            // No point of the surface is nearer: walk towards the shape from many directions.
            for (int k = 0; k < 50; ++k) {
                const glm::dvec3 u = glm::normalize(glm::dvec3{random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)});
                const glm::dvec3 q = c + (d * 0.999) * u;
                CHECK(distance<double>(tree, {q.x, q.y, q.z}) > -1e-9);
            }
        }
    }
}

TEST_CASE("a ball at rest on a rim, a hollow's edge or a box's edge touches it") {
    // The tolerance is the issue's; the resting depth is 1e-4.
    double worst = 0;
    for (const double r : {0.05, 0.1, 0.2, 0.5}) {
        Scene on_rim = scene(1.0 / 120, 0, 1);
        lens(on_rim);
        ball(on_rim, {0, std::sqrt(0.19) + r + 0.01, 0}, r);
        Scene on_edge = scene(1.0 / 120, 0, 1);
        add(on_edge, "box", {0, -std::sqrt(0.5), 0}, {1, 1, 1, 0}).rot = {0, 0, 45};
        ball(on_edge, {0, r + 0.01, 0}, r);
        Scene in_hollow = scene(1.0 / 120, 0, 1);
        bowl(in_hollow, 1);
        ball(in_hollow, {0, -1 + r + 0.01, 0}, r);
        Scene over_hole = scene(1.0 / 120, 0, 1);
        bowl(over_hole, 0.7 * r);
        ball(over_hole, {0, r, 0}, r);
        int which = 0;
        for (const Scene* s : {&on_rim, &on_edge, &in_hollow, &over_hole}) {
            PhysicsWorld w(*s);
            run(w, 0.6);
            REQUIRE(w.bodies().size() == 1);
            Scene still = *s;
            still.objects.pop_back();
            const double gap = gapAt(still, w.bodies()[0].position, r);
            CAPTURE(which); CAPTURE(r);
            CHECK(std::fabs(gap) <= 1e-3);
            worst = std::max(worst, std::fabs(gap));
            ++which;
        }
    }
    MESSAGE("gap at rest ", worst);
}

TEST_CASE("a ball in the corner of a pit touches three walls") {
    Scene s;
    add(s, "subtract", {}, {0});
    add(s, "box", {}, {4, 4, 4, 0}, 0);
    add(s, "box", {0, 1, 0}, {2, 4, 2, 0}, 0);
    std::vector<std::string> notes;
    const StaticField field(s, [](std::size_t) { return true; }, notes);
    std::vector<Touch> touches;
    field.touches({0.9, -0.9, -0.9 + 1e-5}, 0.1, 0.01, touches);
    REQUIRE(touches.size() == 3);
    for (const Touch& t : touches) CHECK(std::fabs(t.gap) <= 2e-5);
}

TEST_CASE("a ball rolls over the seam of two tiles as over one") {
    Scene s = scene(1.0 / 120, 0.5, 0.5);
    add(s, "box", {-1, -0.5, 0}, {2, 1, 2, 0});
    add(s, "box", {1, -0.5, 0}, {2, 1, 2, 0});
    Object& o = ball(s, {-0.5, 0.1, 0}, 0.1, {1, 0, 0});
    o.spin = {0, 0, -10};
    PhysicsWorld w(s);
    run(w, 1);
    CHECK(w.bodies()[0].velocity.x == doctest::Approx(1).epsilon(1e-9));
    CHECK(std::fabs(w.bodies()[0].position.y - 0.1) <= 1e-6);
}

TEST_CASE("a shape less itself is nothing to land on") {
    Scene s = scene(1.0 / 120, 0.5, 0.5);
    add(s, "subtract", {}, {0});
    add(s, "sphere", {}, {1}, 0);
    add(s, "sphere", {}, {1}, 0);
    ball(s, {0, 3, 0}, 0.1);
    PhysicsWorld w(s);
    run(w, 1);
    CHECK(w.bodies()[0].position.y == doctest::Approx(3 - 0.5 * kG).epsilon(1e-6));
}

TEST_CASE("a ball that starts in a solid comes out of it whole, its centre not left on a face") {
    for (const double y : {4.0, 5.7, 5.95, 6.0})
        for (const bool round : {false, true}) {
            Scene s = scene(1.0 / 120, 0.5, 0.5);
            if (round) add(s, "cylinder", {0, 3, 0}, {3, 6, 0});
            else add(s, "box", {0, 3, 0}, {6, 6, 6, 0});
            ball(s, {0, y, 0.1}, 0.2);
            PhysicsWorld w(s);
            run(w, 5);
            CAPTURE(y);
            REQUIRE(w.bodies().size() == 1);
            CHECK(w.bodies()[0].position.y == doctest::Approx(6.2).epsilon(1e-4));
        }
}

namespace {

/// Boxes and balls in a heap; `of_one` makes them one object.
Scene heap(int n, bool of_one) {
    Scene s;
    Random random(17);
    if (of_one) add(s, "union", {}, {0});
    for (int i = 0; i < n; ++i) {
        const glm::dvec3 at{random.in(-3, 3), random.in(-1, 1), random.in(-3, 3)};
        const double size = random.in(0.1, 0.5);
        const int parent = of_one ? 0 : kNoParent;
        Object& o = i % 2 ? add(s, "box", at, {size, 0.7 * size, 1.2 * size, 0}, parent) : add(s, "sphere", at, {0.5 * size}, parent);
        o.rot = {10.0 * i, 7.0 * i, 0};
    }
    return s;
}
/// The nearest gap, asked of a few objects at a time: too few for a grid.
double gapOfAll(const Scene& s, glm::dvec3 c, double r) {
    double least = INFINITY;
    std::vector<std::string> notes;
    std::vector<Touch> touches;
    for (std::size_t from = 0; from < s.objects.size(); from += 20) {
        const StaticField few(s, [from](std::size_t i) { return i >= from && i < from + 20; }, notes);
        few.touches(c, r, 0.2, touches);
        if (!touches.empty()) least = std::min(least, touches[0].gap);
    }
    return least;
}

}  // namespace

TEST_CASE("many shapes are found through a grid as one by one") {
    const Scene s = heap(150, false);
    std::vector<std::string> notes;
    const StaticField all(s, [](std::size_t) { return true; }, notes);
    std::vector<Touch> touches;
    Random random(18);
    int touched = 0;
    for (int i = 0; i < 600; ++i) {
        const glm::dvec3 c{random.in(-4, 4), random.in(-2, 2), random.in(-4, 4)};
        const double r = random.in(0.02, 0.4), truth = gapOfAll(s, c, r), free = all.touches(c, r, 0.2, touches);
        touched += !touches.empty();
        if (truth < 0.2) {
            REQUIRE(!touches.empty());
            CHECK(touches[0].gap == truth);
        }
        CHECK(free <= std::max(truth, 0.0) + (truth > 0.2 ? 1e9 : 0));
    }
    CHECK(touched > 100);
    CHECK(touched < 590);
}

TEST_CASE("a shape of many leaves is found through a grid as shapes of one") {
    const Scene many = heap(150, false), one = heap(150, true);
    std::vector<std::string> notes;
    const StaticField apart(many, [](std::size_t) { return true; }, notes), whole(one, [](std::size_t) { return true; }, notes);
    std::vector<Touch> a, b;
    Random random(19);
    int touched = 0;
    for (int i = 0; i < 600; ++i) {
        const glm::dvec3 c{random.in(-4, 4), random.in(-2, 2), random.in(-4, 4)};
        const double r = random.in(0.02, 0.4);
        apart.touches(c, r, 0.2, a), whole.touches(c, r, 0.2, b);
        // Apart, what lies inside another shape counts as a surface too.
        if (b.empty() || b[0].gap < -r) continue;
        ++touched;
        REQUIRE(!a.empty());
        CHECK(a[0].gap <= b[0].gap + 1e-9);
    }
    CHECK(touched > 100);
}

TEST_CASE("a grid of what does not move follows a change, and copies keep their own") {
    Scene s = heap(150, false);
    std::vector<std::string> notes;
    const StaticField before(s, [](std::size_t) { return true; }, notes), copy = before;
    const glm::dvec3 was = s.objects[40].pos, is = was + glm::dvec3{0.8, 0.4, 0};
    s.objects[40].pos = is;
    const StaticField after(s, [](std::size_t) { return true; }, notes, &before), anew(s, [](std::size_t) { return true; }, notes);
    std::vector<Touch> a, b;
    Random random(20);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 c = (i % 2 ? was : is) + glm::dvec3{random.in(-0.6, 0.6), random.in(-0.6, 0.6), random.in(-0.6, 0.6)};
        after.touches(c, 0.1, 0.2, a), anew.touches(c, 0.1, 0.2, b);
        REQUIRE(a.size() == b.size());
        for (std::size_t k = 0; k < a.size(); ++k) CHECK(a[k].point == b[k].point);
    }
    // What was is as it was.
    before.touches(was + glm::dvec3{0, 0.35, 0}, 0.1, 0.2, a), copy.touches(was + glm::dvec3{0, 0.35, 0}, 0.1, 0.2, b);
    REQUIRE(a.size() == b.size());
    for (std::size_t k = 0; k < a.size(); ++k) CHECK(a[k].point == b[k].point);
}

TEST_CASE("a capsule that spins on its end is slowed by the friction of a small disc") {
    // Two thirds of friction times weight at the rim of the disc: a ball as thick as the capsule has it when sunk in by the depth of rest.
    for (const double friction : {0.0, 0.2, 0.5}) {
        Scene s = scene(1.0 / 120, 0, friction);
        floor(s);
        Object& o = s.objects[bodyOf(s, "capsule", {0, 0.2, 0}, 0.2)];
        o.spin = {0, 20, 0};
        PhysicsWorld w(s);
        const Body& b = w.bodies()[0];
        run(w, 0.2);
        const double patch = std::sqrt(2 * b.inner * restDepth(b.inner));
        const double torque = 2.0 / 3 * friction * b.mass() * kG * patch;
        CAPTURE(friction);
        CHECK(std::fabs(20 - b.spin.y - 0.2 * torque * b.inverse_inertia[1][1]) < 1e-3 + 0.02 * (20 - b.spin.y));
    }
}

TEST_CASE("a shape that begins deep in what does not move, or in another body, comes out of it slowly; where no surface tells the way, it says so") {
    enum class In { ground, same, body };
    for (const std::string_view kind : {"box", "capsule", "die"})
        for (const In in : {In::ground, In::same, In::body}) {
            Scene s = scene(1.0 / 120, 0, 0.5, in == In::ground ? kG : 0);
            if (in == In::ground) add(s, "box", {0, -5, 0}, {20, 10, 20, 0});
            else if (in == In::same) add(s, "box", {0, -0.01, 0}, {0.21, 0.21, 0.21, 0});
            else bodyOf(s, kind, {0, 0.01, 0}, 0.2);
            bodyOf(s, kind, in == In::ground ? glm::dvec3{0, -1, 0} : glm::dvec3{0}, 0.2);
            PhysicsWorld w(s);
            double fastest = 0;
            for (int i = 0; i < 4 * 120; ++i) {
                w.step();
                for (const Body& b : w.bodies()) fastest = std::max(fastest, glm::length(b.velocity));
            }
            CAPTURE(kind);
            CAPTURE(static_cast<int>(in));
            CHECK(w.maxPenetration() <= 1e-3);
            CHECK(glm::length(w.bodies()[0].position) > 0.05);
            CHECK(fastest <= 1);
            const bool says = !w.notes().empty() && w.notes()[0].find("so deep in") != std::string_view::npos;
            CHECK(says == (in != In::ground));
        }
}

TEST_CASE("what stands in a ring's hole does not touch the ring") {
    SUBCASE("a ring slides down over a peg") {
        Scene s = scene(1.0 / 120, 0.3, 0.4);
        floor(s);
        add(s, "cylinder", {0, 0.5, 0}, {0.1, 1, 0});
        add(s, "torus", {0.02, 1.5, 0}, {0.25, 0.07}).density = 500;
        PhysicsWorld w(s);
        run(w, 8);
        CHECK(w.bodies()[0].position.y == doctest::Approx(0.07).epsilon(0.01));
        CHECK(w.awake() == 0);
        CHECK(w.notes().empty());
    }
    SUBCASE("nor does a body that floats in it") {
        Scene s = scene(1.0 / 120, 0.3, 0.4, 0);
        add(s, "torus", {0, 0, 0}, {0.25, 0.07}).density = 500;
        block(s, {0.02, 0, 0}, {0.2, 0.1, 0.2});
        PhysicsWorld w(s);
        run(w, 1);
        CHECK(w.bodies()[0].position == glm::dvec3{0});
        CHECK(w.bodies()[1].position == glm::dvec3{0.02, 0, 0});
        CHECK(w.notes().empty());
    }
}
