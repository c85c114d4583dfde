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
