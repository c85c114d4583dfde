// Boxes around leaves and whole trees: nothing of the shape is outside.
#include "core/sdf/tree.h"
#include "sdf/random_scene.h"

#include <doctest/doctest.h>

using namespace mb;

namespace {

sdf::Vec3<double> vec(glm::dvec3 p) { return {p.x, p.y, p.z}; }

bool inside(const Box& box, glm::dvec3 p, double slack) {
    for (int i = 0; i < 3; ++i) {
        const std::size_t k = static_cast<std::size_t>(i);
        if (!(box.lo[k] - slack <= p[i] && p[i] <= box.hi[k] + slack)) return false;
    }
    return true;
}

/// How far, in metres, points of the solid were found outside the box; 0 if none was. Points are drawn over all of the space
/// around and then walked down the slope, on to where the solid is, which also looks into what is thin or small.
double escapes(const Tree& tree, const Box& box, Draw& draw, double reach, int points) {
    double worst = 0;
    for (int i = 0; i < points; ++i) {
        glm::dvec3 p{draw.uniform(-reach, reach), draw.uniform(-reach, reach), draw.uniform(-reach, reach)};
        for (int step = 0; step < 30; ++step) {
            const Slope s = slope(tree, p);
            if (s.distance <= 0) {
                double out = 0;
                for (int k = 0; k < 3; ++k) {
                    const std::size_t a = static_cast<std::size_t>(k);
                    out = std::max({out, box.lo[a] - p[k], p[k] - box.hi[a]});
                }
                worst = std::max(worst, out);
                break;
            }
            p -= s.gradient * (s.distance / std::max(glm::dot(s.gradient, s.gradient), 1e-3) + 1e-12);
        }
    }
    return worst;
}

constexpr double kRounding = 1e-9;  // of metres, where everything lies within a few

}  // namespace

TEST_CASE("a leaf's box holds it, however it is turned") {
    Draw draw(21);
    for (const Primitive& row : primitives())
        for (int i = 0; i < times(20); ++i) {
            Scene scene;
            scene.objects.push_back(drawObject(draw, {}, row, 0));
            scene.objects[0].hidden = false;
            const Tree tree = makeTree(scene);
            CAPTURE(row.name);
            CHECK(escapes(tree, bounds(tree.leaves[0]), draw, 5, 100) < kRounding);
        }
}

TEST_CASE("a tree's box holds it, blends included") {
    Draw draw(22);
    for (int i = 0; i < times(300); ++i) {
        Scene scene;
        const SceneKind kind{.levels = 1 + draw.below(4), .hidden = 0.05};
        for (int top = draw.below(2); top >= 0; --top) addRandom(scene, draw, kind);
        const Tree tree = makeTree(scene);
        CAPTURE(i);
        CHECK(escapes(tree, bounds(tree), draw, 5, 100) < kRounding);
    }
}

TEST_CASE("a blend with a shape whose distance is a bound stays in the box") {
    // The ellipsoid's bound grows by only 0.05 a metre along x: a blend of 0.4 m carries the surface 2 m further there.
    Scene scene;
    const int u = addObject(scene, "union", {0.4});
    addObject(scene, "ellipsoid", {1, 1, 0.05}, {}, u);
    addObject(scene, "ellipsoid", {1, 1, 0.05}, {}, u);
    const Tree tree = makeTree(scene);
    CHECK(distance<double>(tree, vec({2.5, 0, 0})) < 0);
    CHECK(inside(bounds(tree), {2.5, 0, 0}, 0));
    Draw draw(23);
    CHECK(escapes(tree, bounds(tree), draw, 5, 2000) < kRounding);
}

TEST_CASE("boxes of plain operators are their children's, joined as the operator joins") {
    const auto of = [](std::string_view op, double blend) {
        Scene scene;
        const int o = addObject(scene, op, {blend});
        addObject(scene, "sphere", {1}, {}, o);
        addObject(scene, "sphere", {1}, {1, 0, 0}, o);
        return bounds(makeTree(scene));
    };
    CHECK(of("union", 0).hi == std::array<double, 3>{2, 1, 1});
    CHECK(of("union", 0.4).hi == std::array<double, 3>{2.1, 1.1, 1.1});
    CHECK(of("intersect", 0).lo == std::array<double, 3>{0, -1, -1});
    CHECK(of("intersect", 0.4).hi == std::array<double, 3>{1, 1, 1});
    CHECK(of("subtract", 0.4).hi == std::array<double, 3>{1, 1, 1});
}

TEST_CASE("a plane's box ends only where the plane is level with an axis") {
    Scene scene;
    addObject(scene, "plane", {0, 2, 0, 0.5}, {0, 1, 0});
    const Box floor = bounds(makeTree(scene));
    CHECK(std::isinf(floor.lo[0]));
    CHECK(std::isinf(floor.hi[2]));
    CHECK(std::isinf(floor.lo[1]));
    CHECK(floor.hi[1] == 1.25);  // normal·p <= offset, with a normal twice as long as the unit
    scene.objects[0].rot = {30, 0, 0};
    CHECK(std::isinf(bounds(makeTree(scene)).hi[1]));
}

TEST_CASE("a box that is too small is seen") {
    Scene scene;
    const int u = addObject(scene, "union", {0.4});
    addObject(scene, "box", {1, 1, 1, 0}, {}, u);
    addObject(scene, "box", {1, 1, 1, 0}, {0.5, 0, 0}, u);
    const Tree tree = makeTree(scene);
    Box box = bounds(tree);
    Draw draw(24);
    CHECK(escapes(tree, box, draw, 2, 1000) == 0);
    box.hi[1] -= 0.11;  // more than a quarter of the blend
    CHECK(escapes(tree, box, draw, 2, 1000) > 0);
}
