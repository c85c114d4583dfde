// Where two shapes touch.
#include "physics/manifold.h"
#include "physics/random.h"
#include "physics/scenes.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

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
