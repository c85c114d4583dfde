// Scenes made into trees: transforms, scales, hidden objects, depth and width, and which surface is found.
#include "core/sdf/tree.h"
#include "sdf/random_scene.h"

#include <doctest/doctest.h>

using namespace mb;

namespace {

sdf::Vec3<double> vec(glm::dvec3 p) { return {p.x, p.y, p.z}; }
double distanceAt(const Scene& scene, glm::dvec3 p) { return distance<double>(makeTree(scene), vec(p)); }
glm::dvec3 drawPoint(Draw& draw, double reach) { return {draw.uniform(-reach, reach), draw.uniform(-reach, reach), draw.uniform(-reach, reach)}; }

/// How often a tree and the walk over the objects disagree, at drawn points.
struct Disagreements {
    int distances = 0, leaves = 0, points = 0;
};
Disagreements compare(const Scene& scene, const Tree& tree, Draw& draw, double reach) {
    Disagreements d;
    for (int i = 0; i < 40; ++i, ++d.points) {
        const glm::dvec3 p = drawPoint(draw, reach);
        const std::optional<Found> want = found(scene, p);
        const Nearest<double> got = nearest<double>(tree, vec(p));
        // Two ways of rounding the same transforms: some 2⁻⁵³ of the coordinates a level.
        d.distances += !(std::fabs(got.distance - (want ? want->distance : kEmptyDistance)) <= 1e-12 * reach);
        const int object = got.leaf < 0 ? -1 : static_cast<int>(tree.leaves[static_cast<std::size_t>(got.leaf)].index);
        d.leaves += object != (want ? static_cast<int>(want->object) : -1);
    }
    return d;
}

}  // namespace

TEST_CASE("a tree says what its objects say, each in its own frame") {
    Draw draw(11);
    int leaves = 0, points = 0;
    for (int i = 0; i < times(400); ++i) {
        const SceneKind kind{.levels = 1 + draw.below(6), .hidden = draw.oneIn(2) ? 0 : 0.2};
        Scene scene;
        for (int top = draw.below(3); top >= 0; --top) addRandom(scene, draw, kind);
        const Tree tree = makeTree(scene);
        const Disagreements d = compare(scene, tree, draw, 3);
        CAPTURE(i);
        CHECK(d.distances == 0);
        leaves += d.leaves, points += d.points;
    }
    // Where two surfaces are equally near but for rounding, either may be named: rare, as points are drawn anywhere.
    CHECK(leaves <= points / 1000);
}

TEST_CASE("a wrong transform, scale, blend or order is seen") {
    const auto seen = [](auto change) {
        Draw draw(12);
        int wrong = 0;
        for (int i = 0; i < 30; ++i) {
            Scene scene;
            addRandom(scene, draw, {.levels = 3});
            Tree tree = makeTree(scene);
            if (tree.leaves.empty()) continue;
            change(tree);
            wrong += compare(scene, tree, draw, 3).distances > 0;
        }
        return wrong > 0;
    };
    CHECK_FALSE(seen([](Tree&) {}));
    CHECK(seen([](Tree& t) { t.leaves[0].position.x += 1e-9; }));
    CHECK(seen([](Tree& t) { t.leaves[0].rotation = glm::transpose(t.leaves[0].rotation); }));
    CHECK(seen([](Tree& t) { t.leaves[0].numbers[0] *= 1 + 1e-9; }));
    CHECK(seen([](Tree& t) { for (Branch& b : t.branches) b.blend *= 1.001; }));
    CHECK(seen([](Tree& t) { for (Branch& b : t.branches) b.numbers[0] *= 1.001; }));
    CHECK(seen([](Tree& t) { if (t.leaves.size() > 1) std::swap(t.leaves[0], t.leaves[1]); }));
}

TEST_CASE("a scale multiplies lengths and blends: a scene twice as large is the same scene") {
    Draw draw(13);
    for (int i = 0; i < times(100); ++i) {
        Scene scene;
        addRandom(scene, draw, {.levels = 4});
        Scene large = scene;
        large.objects[0].scale *= 2, large.objects[0].pos *= 2.0;
        for (int j = 0; j < 20; ++j) {
            const glm::dvec3 p = drawPoint(draw, 3);
            REQUIRE(distanceAt(large, 2.0 * p) == 2 * distanceAt(scene, p));  // by a power of two: to the bit
        }
    }
}

TEST_CASE("the scalars agree on whole trees") {
    Draw draw(14);
    for (int i = 0; i < times(200); ++i) {
        Scene scene;
        addRandom(scene, draw, {.levels = 4});
        const Tree tree = makeTree(scene);
        for (int j = 0; j < 20; ++j) {
            const glm::dvec3 p = drawPoint(draw, 3);
            const double d = distance<double>(tree, vec(p));
            CHECK(slope(tree, p).distance == d);
            CHECK(nearest<double>(tree, vec(p)).distance == d);
            CHECK(glm::length(slope(tree, p).gradient) <= 1 + 1e-9);
            const sdf::Vec3<float> q{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
            // Positions, rotations and numbers are rounded to float too: 32 ulps of the 10 m that everything lies in.
            const double error = static_cast<double>(distance<float>(tree, q)) - distance<double>(tree, {q.x, q.y, q.z});
            if (std::fabs(d) < 10) CHECK(std::fabs(error) < 32 * 0x1p-23 * 10);
            CHECK(nearest<float>(tree, q).distance == distance<float>(tree, q));

            const double half = draw.oneIn(3) ? 0 : draw.logUniform(1e-6, 1);
            const auto around = [&](double x) { return sdf::Interval(x - half, x + half); };
            const sdf::Interval bound = distance<sdf::Interval>(tree, {around(p.x), around(p.y), around(p.z)});
            const glm::dvec3 m{draw.member(p.x - half, p.x + half), draw.member(p.y - half, p.y + half), draw.member(p.z - half, p.z + half)};
            const double at = distance<double>(tree, vec(m));
            CHECK(bound.lo <= at);
            CHECK(at <= bound.hi);
        }
    }
}

TEST_CASE("nothing is 1e9 m away and no one's") {
    Scene scene;
    const auto empty = [&] {
        const Tree tree = makeTree(scene);
        CHECK(tree.program.empty());
        CHECK(distance<double>(tree, vec({1, 2, 3})) == kEmptyDistance);
        CHECK(nearest<float>(tree, {1, 2, 3}).leaf == -1);
        CHECK(slope(tree, {}).gradient == glm::dvec3(0));
        CHECK(bounds(tree).lo[0] > bounds(tree).hi[0]);
    };
    empty();
    addObject(scene, "sphere", {1});
    scene.objects[0].hidden = true;
    empty();
    scene = {};
    const int u = addObject(scene, "union", {});
    addObject(scene, "sphere", {1}, {}, u);
    scene.objects[1].hidden = true;
    empty();
    scene.objects[0].hidden = true, scene.objects[1].hidden = false;
    empty();
}

TEST_CASE("a hidden first child is an empty set to take away from") {
    Scene scene;
    const int s = addObject(scene, "subtract", {});
    addObject(scene, "sphere", {1}, {}, s);
    addObject(scene, "sphere", {0.5}, {1, 0, 0}, s);
    CHECK(distanceAt(scene, {-1, 0, 0}) == 0);
    CHECK(distanceAt(scene, {0.75, 0, 0}) == 0.25);
    scene.objects[2].hidden = true;
    CHECK(distanceAt(scene, {0.75, 0, 0}) == -0.25);
    scene.objects[1].hidden = true, scene.objects[2].hidden = false;
    CHECK(distanceAt(scene, {0.75, 0, 0}) == kEmptyDistance);

    // The same, where what is hidden is all of the operator that comes first.
    Scene nested;
    const int outer = addObject(nested, "subtract", {}), inner = addObject(nested, "union", {}, {}, outer);
    addObject(nested, "sphere", {1}, {}, inner);
    addObject(nested, "sphere", {0.5}, {1, 0, 0}, outer);
    CHECK(distanceAt(nested, {-1, 0, 0}) == 0);
    nested.objects[2].hidden = true;
    CHECK(distanceAt(nested, {0, 0, 0}) == kEmptyDistance);
}

TEST_CASE("an operator with one child is that child, and ties go to the first") {
    for (const Operator& op : operators()) {
        if (!op.blends) continue;
        Scene scene;
        const int o = addObject(scene, op.name, {0.3});
        addObject(scene, "sphere", {1}, {0.5, 0, 0}, o);
        CHECK(distanceAt(scene, {2, 0, 0}) == 0.5);
        if (op.first_only) continue;
        addObject(scene, "sphere", {1}, {0.5, 0, 0}, o);
        scene.objects[static_cast<std::size_t>(o)].numbers[0] = 0;
        CHECK(nearest<double>(makeTree(scene), vec({2, 1, 0})).leaf == 0);  // A∪A and A∩A are A, shown as the first
        CHECK(distanceAt(scene, {2, 0, 0}) == 0.5);
    }
    Scene pair;
    addObject(pair, "sphere", {1}), addObject(pair, "sphere", {1});
    CHECK(nearest<double>(makeTree(pair), vec({2, 1, 0})).leaf == 0);
}

TEST_CASE("a thing less itself has no inside") {
    Draw draw(15);
    for (int i = 0; i < times(50); ++i) {
        Scene scene;
        const int s = addObject(scene, "subtract", {});
        SceneKind kind{.levels = 2};
        addRandom(scene, draw, kind, s, 1);
        Object again = scene.objects[1];
        scene.objects.push_back(again);
        for (int j = 0; j < 20; ++j) {
            const glm::dvec3 p = drawPoint(draw, 3);
            Scene alone;
            alone.objects = {scene.objects[0], scene.objects[1]};
            REQUIRE(distanceAt(scene, p) == std::fabs(distanceAt(alone, p)));
        }
    }
}

TEST_CASE("trees as deep and as wide as a file may make them") {
    Scene deep;
    int parent = kNoParent;
    for (int level = 0; level < 31; ++level) parent = addObject(deep, "union", {}, {0.1, 0, 0}, parent);
    addObject(deep, "sphere", {1}, {0.1, 0, 0}, parent);
    CHECK(std::fabs(distanceAt(deep, {5.2, 0, 0}) - 1) < 1e-14);  // 32 steps of 0.1 m

    // Each level holds a shape before the next level: the stack grows by one value a level.
    Scene leaning;
    parent = kNoParent;
    for (int level = 0; level < 31; ++level) {
        parent = addObject(leaning, "union", {1e-6}, {}, parent);
        addObject(leaning, "sphere", {0.1}, {level * 1.0, 0, 0}, parent);
    }
    addObject(leaning, "sphere", {0.1}, {31, 0, 0}, parent);
    CHECK(makeTree(leaning).depth == 32);
    for (int level = 0; level < 32; ++level) CHECK(nearest<double>(makeTree(leaning), vec({level * 1.0, 0.3, 0})).leaf == level);

    Scene wide;
    const int u = addObject(wide, "union", {});
    for (int i = 0; i < 1000; ++i) addObject(wide, "sphere", {0.25}, {i * 1.0, 0, 0}, u);
    const Tree tree = makeTree(wide);
    CHECK(tree.depth == 2);
    for (int i = 0; i < 1000; i += 37) {
        const Nearest<double> n = nearest<double>(tree, vec({i * 1.0, 0.5, 0}));
        CHECK(n.leaf == i);
        CHECK(n.distance == 0.25);
    }
}

TEST_CASE("only what is wanted, and what cannot be evaluated says why") {
    Scene scene;
    addObject(scene, "sphere", {1}), addObject(scene, "box", {1, 1, 1, 0}, {5, 0, 0});
    const int u = addObject(scene, "union", {}, {0, 5, 0});
    addObject(scene, "sphere", {1}, {}, u);
    const Tree one = makeTree(scene, [](std::size_t i) { return i != 0; });
    CHECK(one.leaves.size() == 2);
    CHECK(one.leaves[0].object == 1);  // objects keep their numbers
    CHECK(one.leaves[1].object == 2);
    CHECK(one.leaves[1].index == 3);
    CHECK(makeTree(scene).fault == "");
    for (const Operator& op : operators()) {
        if (!op.warp_by) continue;
        Scene with = scene;
        const int warp = addObject(with, op.name, {0.1});
        addObject(with, "plane", {0, 1, 0, 0}, {}, warp);
        const Tree tree = makeTree(with);
        CHECK(tree.fault.find("without bounds") != std::string::npos);
        CHECK(tree.fault_object == 4u);
        CHECK(tree.program.empty());
        with.objects[4].hidden = true;
        CHECK(makeTree(with).fault == "");
    }
    Scene many;
    const int all = addObject(many, "repeat", {1, 1, 1, 1e6, 1e6, 1e6});
    addObject(many, "sphere", {0.1}, {}, all);
    CHECK(makeTree(many).fault.find("1e+18 copies") != std::string::npos);
}

TEST_CASE("copies are what they say, and a plain union's children are parts of the whole") {
    Scene scene;
    const int row = addObject(scene, "repeat", {1, 0, 0, 3, 5, 1}, {0, 1, 0});
    addObject(scene, "sphere", {0.25}, {0, 0, 0.5}, row);
    Tree tree = makeTree(scene);
    CHECK(tree.leaves.size() == 3);  // no copies along an axis whose cell is 0
    CHECK(tree.parts.size() == 3);
    for (const double x : {-1.0, 0.0, 1.0}) CHECK(distanceAt(scene, {x, 2, 0.5}) == 0.75);
    const int mirror = addObject(scene, "mirror", {2});
    const int both = addObject(scene, "union", {0}, {0, 0, 3}, mirror);
    addObject(scene, "cone", {0.5, 0, 1}, {0, 5, 0}, both), addObject(scene, "box", {1, 1, 1, 0}, {2, 5, 0}, both);
    tree = makeTree(scene);
    CHECK(tree.parts.size() == 7);
    CHECK(distanceAt(scene, {2, 5, -3}) == -0.5);
    CHECK(distanceAt(scene, {2, 5, 3}) == -0.5);
    CHECK(tree.branches.empty());
}
