#include "bench/pile.h"

#include "core/sdf/grid.h"
#include "physics/random.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mb::bench {
namespace {

constexpr double kRound = 0.04, kPip = 0.05;

Object& add(Scene& scene, std::string_view type, glm::dvec3 pos, std::initializer_list<double> numbers, int parent = kNoParent) {
    Object& o = scene.objects.emplace_back();
    o.id = scene.newId(), o.type = findShapeType(type), o.pos = pos, o.parent = parent;
    o.numbers = initialNumbers(*o.type);
    std::copy(numbers.begin(), numbers.end(), o.numbers.begin());
    return o;
}

void addTray(Scene& scene, double inner, double height) {
    constexpr double kWall = 0.2;
    const int tray = static_cast<int>(scene.objects.size());
    add(scene, "subtract", {}, {}).name = "tray";
    add(scene, "box", {0, 0.5 * height - kWall, 0}, {inner + 2 * kWall, height, inner + 2 * kWall, 0}, tray);
    add(scene, "box", {0, 0.5 * height, 0}, {inner, height, inner, 0}, tray);
}

void addDie(Scene& scene, glm::dvec3 pos, glm::dvec3 rot) {
    const int die = static_cast<int>(scene.objects.size());
    Object& o = add(scene, "subtract", pos, {});
    o.rot = rot, o.density = 900;
    add(scene, "box", {}, {kDie, kDie, kDie, kRound}, die);
    constexpr double kFace = 0.5 * kDie;
    for (const glm::dvec3 at : {glm::dvec3{0, kFace, 0}, {kFace, 0.1, 0.1}, {kFace, -0.1, -0.1}, {-kFace, 0.1, 0.1}, {-kFace, 0, 0}, {-kFace, -0.1, -0.1}})
        add(scene, "sphere", at, {kPip}, die);
}

/// Points of a die's surface, in its frame: a grid on each face of its box, each brought onto the surface.
std::vector<glm::dvec3> surfaceOf(const Tree& die) {
    constexpr int kAlong = 32;
    std::vector<glm::dvec3> points;
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 2 * kAlong * kAlong; ++i) {
            const auto place = [](int k) { return kDie * ((k + 0.5) / kAlong - 0.5); };
            glm::dvec3 p{0};
            p[axis] = i % 2 ? 0.5 * kDie : -0.5 * kDie, p[(axis + 1) % 3] = place(i / 2 % kAlong), p[(axis + 2) % 3] = place(i / 2 / kAlong);
            Slope s = slope(die, p);
            for (int step = 0; step < 4 && std::fabs(s.distance) > 1e-12; ++step) p -= s.distance * s.gradient, s = slope(die, p);
            if (std::fabs(s.distance) <= 1e-9) points.push_back(p);
        }
    return points;
}

}  // namespace

Scene pileScene(int dice, std::uint64_t seed) {
    int row = 1;
    while (row * row * row < dice) ++row;
    Scene scene;
    scene.world.friction = 0.5, scene.world.restitution = 0.2;
    add(scene, "plane", {0, -1, 0}, {0, 1, 0, 0}).name = "ground";
    addTray(scene, 0.95 * row + 0.2, 0.5 * row);
    Random random(seed);
    for (int i = 0; i < dice; ++i) {
        const glm::dvec3 cell{i % row - 0.5 * (row - 1), i / row / row, i / row % row - 0.5 * (row - 1)};
        glm::dvec3 pos = kDieApart * cell + glm::dvec3{0, 1, 0}, rot{0};
        for (int axis = 0; axis < 3; ++axis) pos[axis] += random.in(-0.05, 0.05);
        for (int axis = 0; axis < 3; ++axis) rot[axis] = random.in(0, 90);
        addDie(scene, pos, rot);
    }
    return scene;
}

double deepestOverlap(const Scene& pile) {
    struct One {
        Tree tree;
        Box box;
        std::size_t object;
    };
    std::vector<One> all;
    for (std::size_t i = 0; i < pile.objects.size(); i = subtreeEnd(pile, i)) {
        Tree tree = makeTreeOf(pile, i);
        const Box box = bounds(tree);
        all.push_back({std::move(tree), box, i});
    }
    Scene upright;
    addDie(upright, {}, {});
    const std::vector<glm::dvec3> surface = surfaceOf(makeTreeOf(upright, 0));
    double deepest = 0;
    for (const One& die : all) {
        const Object& o = pile.objects[die.object];
        if (!o.isBody()) continue;
        const glm::dmat3 turn = rotationFromDegrees(o.rot);
        for (const One& other : all) {
            if (&other == &die || distanceTo(other.box, o.pos) > kDie) continue;
            for (const glm::dvec3& s : surface) {
                const glm::dvec3 p = o.pos + turn * s;
                if (distanceTo(other.box, p) <= 0) deepest = std::max(deepest, -distance<double>(other.tree, {p.x, p.y, p.z}));
            }
        }
    }
    return deepest;
}

}  // namespace mb::bench
