// Where two shapes touch.
#include "physics/manifold.h"
#include "physics/random.h"
#include "physics/scenes.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/quaternion.hpp>

using namespace mb;
using namespace mb::test;

namespace {

Solid solidOf(std::string_view type, std::initializer_list<double> numbers) {
    Scene s;
    add(s, type, {}, numbers);
    return makeSolid(makeTree(s), true);
}

/// How far apart two boxes are, sizes given by their halves: each turn takes the nearest point of the one to that of the other
/// (Cheney, Goldstein, "Proximity Maps for Convex Sets", 1959). 0: they overlap.
double boxesApart(glm::dvec3 half, const Pose& a, const Pose& b) {
    glm::dvec3 x = a.position, y = b.position;
    const auto nearest = [&](const Pose& box, glm::dvec3 p) { return box.toWorld(glm::clamp(box.fromWorld(p), -half, half)); };
    for (int i = 0; i < 20'000; ++i) {
        const glm::dvec3 last = x;
        y = nearest(b, x), x = nearest(a, y);
        if (glm::length(x - last) < 1e-12) break;
    }
    return glm::length(x - y);
}

Pose turnedBy(glm::dvec3 position, glm::dvec3 turn) { return {position, glm::mat3_cast(turned({1, 0, 0, 0}, turn, 1))}; }

}  // namespace

TEST_CASE("a box upon an equal one touches it at four corners, whatever the last digits") {
    const Solid box = solidOf("box", {1, 1, 1, 0});
    Random random(7);
    for (int i = 0; i < 300; ++i) {
        CAPTURE(i);
        const double shift = i % 3 == 0 ? 0 : i % 3 == 1 ? 1e-6 : 1e-3, tilt = i % 2 ? 0 : 1e-5;
        const auto some = [&](double size) { return glm::dvec3{random.in(-size, size), 0, random.in(-size, size)}; };
        const Placed a{&box, turnedBy(some(shift) + glm::dvec3{0, 1 + random.in(-1e-4, 2e-5), 0}, some(tilt)), 0}, b{&box, turnedBy({}, some(tilt)), 0};
        std::uint64_t evaluations = 0;
        const std::vector<ManifoldPoint> points = manifold(a, {&b, 1}, 1e-4, evaluations).points;
        int corners = 0;
        for (const glm::dvec3 corner : {glm::dvec3{0.5, 0.5, 0.5}, glm::dvec3{0.5, 0.5, -0.5}, glm::dvec3{-0.5, 0.5, 0.5}, glm::dvec3{-0.5, 0.5, -0.5}})
            corners += std::any_of(points.begin(), points.end(), [&](const ManifoldPoint& p) { return glm::length(p.point - corner) < 0.05; });
        CHECK(corners == 4);
        for (const ManifoldPoint& p : points) {
            CHECK(p.normal.y > 0.999);
            CHECK(std::fabs(p.gap - (a.pose.position.y - 1)) < 2e-5);
        }
        CHECK(points.size() <= 12);
    }
}

TEST_CASE("of two rounded boxes in any position the nearest place is found") {
    constexpr double kRound = 0.04, kHalf = 0.25, kMargin = 2e-3;
    const Solid box = solidOf("box", {2 * kHalf, 2 * kHalf, 2 * kHalf, kRound});
    const glm::dvec3 core{kHalf - kRound};
    Random random(5);
    const auto some = [&] { double x = random.in(-1, 1), y = random.in(-1, 1), z = random.in(-1, 1); return glm::dvec3{x, y, z}; };
    double worst = 0;
    int missed = 0;
    for (int i = 0; i < 1000; ++i) {
        // One comes towards the other until they overlap by up to a millimetre, or not quite touch.
        const double wanted = random.in(-1e-3, 1e-3);
        const Pose b = turnedBy({}, 3.0 * some());
        Pose a = turnedBy({}, 3.0 * some());
        if (i % 4 == 0) a.rotation = b.rotation * glm::mat3_cast(turned({1, 0, 0, 0}, 0.02 * some(), 1));  // nearly parallel faces and edges
        const glm::dvec3 way = glm::normalize(some()), aside = 0.2 * some();
        double near = 0, far = 1;
        for (int k = 0; k < 60; ++k) {
            const double mid = 0.5 * (near + far);
            a.position = aside + mid * way;
            (boxesApart(core, a, b) - 2 * kRound < wanted ? near : far) = mid;
        }
        const double gap = boxesApart(core, a, b) - 2 * kRound;
        const Placed pa{&box, a, 0}, pb{&box, b, 0};
        std::uint64_t evaluations = 0;
        double found = INFINITY;
        for (const ManifoldPoint& p : manifold(pa, {&pb, 1}, kMargin, evaluations).points) found = std::min(found, p.gap);
        CAPTURE(i);
        CAPTURE(gap);
        CAPTURE(found);
        if (found == INFINITY) ++missed;
        else worst = std::max(worst, std::fabs(found - gap));
        CHECK(std::fabs(found - gap) < 1e-4);
    }
    MESSAGE("worst ", worst, ", missed ", missed);
}

namespace {
/// How far a shape of this kind reaches in a direction from its middle, m.
double reachOf(std::string_view type, std::span<const double> n, glm::dvec3 d) {
    if (type == "capsule") return n[0] + 0.5 * n[1] * std::fabs(d.y);
    if (type == "ellipsoid") return glm::length(glm::dvec3{n[0], n[1], n[2]} * d);
    if (type == "cylinder") return n[0] * std::hypot(d.x, d.z) + 0.5 * n[1] * std::fabs(d.y);
    if (type == "cone") return std::max(0.5 * n[2] * d.y, n[0] * std::hypot(d.x, d.z) - 0.5 * n[2] * d.y);  // pointed
    if (type == "torus") return n[0] * std::hypot(d.x, d.z) + n[1];
    const glm::dvec3 core = 0.5 * glm::dvec3{n[0], n[1], n[2]} - n[3];  // a box
    return n[3] + glm::dot(core, glm::abs(d));
}
}  // namespace

TEST_CASE("of thin shapes in any position the lowest place over a floor is found") {
    struct Kind {
        std::string_view type;
        std::vector<double> numbers;
    };
    const std::vector<Kind> kinds{{"capsule", {0.02, 2}}, {"capsule", {0.003, 2}}, {"ellipsoid", {0.02, 1, 0.02}}, {"ellipsoid", {0.5, 0.02, 0.5}},
                                  {"ellipsoid", {0.3, 0.1, 0.05}}, {"cylinder", {0.02, 2}}, {"cylinder", {0.5, 0.01}}, {"cone", {0.05, 0, 1}},
                                  {"torus", {0.5, 0.02}}, {"box", {0.02, 2, 0.02, 0}}, {"box", {0.02, 2, 0.02, 0.009}}, {"box", {1, 0.01, 1, 0.003}}};
    Scene under;
    floor(under);
    const Solid ground = makeSolid(makeTree(under), false);
    for (const Kind& kind : kinds) {
        Scene s;
        std::ranges::copy(kind.numbers, add(s, kind.type, {}, {}).numbers.begin());
        const Solid solid = makeSolid(makeTree(s), true);
        Random random(5);
        double worst = 0;
        for (int i = 0; i < 400; ++i) {
            const double tilt = random.in(0, kPi), turn = random.in(-kPi, kPi), wanted = random.in(-0.01, 0.01) * solid.inner;
            Placed a{&solid, turnedBy({}, {tilt, 0, 0}), 0}, b{&ground, {}, 0};
            a.pose.rotation = a.pose.rotation * turnedBy({}, {0, turn, 0}).rotation;
            a.pose.position.y = wanted + reachOf(kind.type, kind.numbers, glm::dvec3{0, -1, 0} * a.pose.rotation);
            std::uint64_t evaluations = 0;
            double found = INFINITY;
            for (const ManifoldPoint& p : manifold(a, {&b, 1}, 0.25 * solid.inner, evaluations).points) found = std::min(found, p.gap);
            worst = std::max(worst, std::fabs(found - wanted) / solid.inner);
        }
        CAPTURE(kind.type);
        CAPTURE(kind.numbers[0]);
        MESSAGE(kind.type, " ", kind.numbers[0], ": worst ", worst, " of half its thickness");
        // Where a ring lies nearly flat all of it is low; the search for the lowest place ends after some strides.
        CHECK(worst < 0.1);
    }
}

TEST_CASE("a wall thinner than a cell has the points of its four edges along each side") {
    Scene s;
    add(s, "subtract", {}, {});
    add(s, "box", {0, 0.8, 0}, {4.2, 2, 4.2, 0}, 0);
    add(s, "box", {0, 1, 0}, {3.8, 2, 3.8, 0}, 0);
    const Solid tray = makeSolid(makeTree(s), true);
    for (const double edge : {-2.1, -1.9, 1.9, 2.1})
        for (const int along : {0, 2}) {
            int points = 0;
            for (const SurfacePoint& p : tray.points.points()) {
                const bool there = std::fabs(p.place[2 - along] - edge) < 1e-6 && std::fabs(p.place.y - 1.8) < 1e-6;
                points += there && p.sharp && std::fabs(p.along[along]) > 0.999;
            }
            CAPTURE(edge);
            CAPTURE(along);
            CHECK(points >= 7);  // a cell is 0.41 m, the edge 3.8 or 4.2; the corners have the ends
        }
}

TEST_CASE("a corner in a pip touches its rim where it is deepest") {
    // The rim is a circle, and the rounded box is convex with an exact distance: its least value on the circle is the depth.
    constexpr double kHalf = 0.25, kPip = 0.05;
    Scene s;
    add(s, "subtract", {}, {});
    add(s, "box", {}, {2 * kHalf, 2 * kHalf, 2 * kHalf, 0.04}, 0);
    add(s, "sphere", {0, kHalf, 0}, {kPip}, 0);
    const Solid die = makeSolid(makeTree(s), true), box = solidOf("box", {2 * kHalf, 2 * kHalf, 2 * kHalf, 0.04});
    const Placed b{&die, {}, 0};
    const glm::dmat3 corner_down = glm::mat3_cast(glm::rotation(glm::normalize(glm::dvec3{1, 1, 1}), glm::dvec3{0, -1, 0}));
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        const double x = random.in(-1, 1), y = random.in(-3, 3), z = random.in(-1, 1);
        Placed a{&box, turnedBy({}, {0, y, 0}), 0};
        a.pose.rotation = turnedBy({}, {0.4 * x, 0, 0.4 * z}).rotation * a.pose.rotation * corner_down;
        const double aside_x = random.in(-0.02, 0.02), aside_z = random.in(-0.02, 0.02), wanted = random.in(-2e-3, -2e-4);
        const auto depth = [&] {
            double least = INFINITY;
            for (int k = 0; k < 2000; ++k) {
                const double turn = 2 * kPi * k / 2000;
                least = std::min(least, box.at(a.pose.fromWorld({kPip * std::cos(turn), kHalf, kPip * std::sin(turn)})));
            }
            return least;
        };
        const glm::dvec3 tip = a.pose.rotation * glm::dvec3{0.23};
        double low = 0.1, high = 0.5;
        for (int k = 0; k < 30; ++k) {
            a.pose.position = glm::dvec3{aside_x, 0.5 * (low + high), aside_z} - tip;
            (depth() < wanted ? low : high) = 0.5 * (low + high);
        }
        const double deepest = depth();
        std::uint64_t evaluations = 0;
        double found = INFINITY;
        for (const ManifoldPoint& p : manifold(a, {&b, 1}, 1e-3, evaluations).points) found = std::min(found, p.gap);
        CAPTURE(i);
        CAPTURE(deepest);
        CHECK(found <= deepest + 2e-4);
        CHECK(found >= -0.05);
    }
}

TEST_CASE("every contact's place is on the surface it belongs to, at a tray's rim too") {
    // Above its opening the tray's distance is a bound that is 0 nowhere: what is moved along the rim and past it finds no surface.
    Scene s;
    add(s, "subtract", {}, {});
    add(s, "box", {0, 1.4, 0}, {6, 3, 6, 0}, 0);
    add(s, "box", {0, 1.6, 0}, {5.6, 3, 5.6, 0}, 0);
    const Solid tray = makeSolid(makeTree(s), true), die = solidOf("box", {0.5, 0.5, 0.5, 0.04});
    const Placed b{&tray, {}, 0};
    Random random(4);
    int touching = 0;
    for (int i = 0; i < 1000; ++i) {
        const double x = random.in(1.9, 3.1), y = random.in(2.8, 3.2), z = random.in(-3, 3), turn_x = random.in(-3, 3), turn_z = random.in(-3, 3);
        const Placed a{&die, turnedBy({x, y, z}, {turn_x, 0, turn_z}), 0};
        std::uint64_t evaluations = 0;
        const Manifold found = manifold(a, {&b, 1}, 1e-3, evaluations);
        touching += !found.points.empty();
        for (const ManifoldPoint& p : found.points) {
            const bool of_tray = (p.feature >> 63) != 0;
            const double off = of_tray ? tray.at(p.point) : die.at(a.pose.fromWorld(p.point));
            CAPTURE(i);
            CAPTURE(of_tray);
            CHECK(std::fabs(off) < 1e-5);
            if (of_tray) CHECK(die.at(a.pose.fromWorld(p.point)) < 2e-3);
        }
    }
    CHECK(touching > 200);
}

TEST_CASE("no contact lies on an edge that was cut away") {
    // A nut: a ball cuts its prism's edges short, and those between the sides down to a point each. Their planes go on.
    Scene s;
    add(s, "subtract", {}, {});
    add(s, "intersect", {}, {}, 0);
    add(s, "prism", {}, {6, 0.24, 0.2}, 1);
    add(s, "sphere", {}, {0.24}, 1);
    add(s, "cylinder", {}, {0.11, 0.6, 0}, 0);
    const Solid nut = makeSolid(makeTree(s), true), other = solidOf("box", {0.4, 0.4, 0.4, 0});
    Random random(5);
    int touching = 0;
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto any = [&](double x) { return glm::dvec3{random.in(-x, x), random.in(-x, x), random.in(-x, x)}; };
        const glm::dvec3 way = glm::normalize(any(1));
        const Placed a{&nut, turnedBy(random.in(0.3, 0.5) * way, any(3)), 0}, b{i % 2 ? &nut : &other, turnedBy({}, any(3)), 0};
        std::uint64_t evaluations = 0;
        const Manifold found = manifold(a, {&b, 1}, i % 3 ? 1e-3 : 0, evaluations);
        touching += !found.points.empty();
        for (const ManifoldPoint& p : found.points) {
            const Placed& owner = p.feature >> 63 ? b : a;
            worst = std::max(worst, std::fabs(owner.solid->at(owner.pose.fromWorld(p.point))));
        }
    }
    CHECK(touching > 1000);
    CHECK(worst < 1e-4);  // a thousandth of how far points of the surface are apart
    MESSAGE(touching, " touch, a contact lies off its surface by ", worst, " m at most");
}
