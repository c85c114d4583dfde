// The same field on the GPU and on the CPU: every row, every operator, at 100,000 points.
#include "headless.h"
#include "sdf/random_scene.h"

#include <cmath>

using namespace mb;

namespace {

struct Case {
    std::string name;
    Scene scene;
};

/// One object of each type, turned, moved and scaled, and trees with and without blends.
std::vector<Case> cases() {
    std::vector<Case> all;
    Draw draw(31);
    const SceneKind kind{};
    for (const Primitive& row : primitives()) {
        Case c{std::string(row.name), {}};
        for (int i = 0; i < 3; ++i) {
            Object o = drawObject(draw, kind, row, 0);
            o.id = c.scene.newId(), o.rot = {20.0 + 50 * i, -35, 110}, o.scale = 0.7 + 0.4 * i;
            c.scene.objects.push_back(o);
        }
        all.push_back(std::move(c));
    }
    for (const Operator& row : operators()) {
        if (!row.blends) continue;
        for (const double blend : {0.0, 0.3}) {
            Case c{std::string(row.name) + (blend > 0 ? " with a blend" : ""), {}};
            const int o = addObject(c.scene, row.name, {blend}, {0.1, -0.2, 0.3});
            c.scene.objects[0].rot = {10, 20, 30}, c.scene.objects[0].scale = 1.4;
            addObject(c.scene, "sphere", {1}, {0.2, 0, 0}, o);
            const int inner = addObject(c.scene, row.name, {blend}, {0, 0.1, 0}, o);
            c.scene.objects.back().rot = {0, 45, 0}, c.scene.objects.back().scale = 0.9;
            addObject(c.scene, "box", {1.4, 1.2, 1, 0.1}, {0, 0.3, 0}, inner);
            addObject(c.scene, "torus", {0.7, 0.2}, {0, 0.2, 0.1}, inner);
            addObject(c.scene, "capsule", {0.3, 1}, {-0.3, 0, 0}, o);
            all.push_back(std::move(c));
        }
    }
    for (const Operator& row : operators()) {
        if (row.blends) continue;
        Case c{std::string(row.name), {}};
        Object o = drawObject(draw, kind, row, 0);
        o.id = c.scene.newId(), o.pos = {0.1, -0.2, 0.3}, o.rot = {10, 20, 30}, o.scale = 1.4;
        c.scene.objects.push_back(o);
        addObject(c.scene, "box", {1.4, 1.2, 1, 0.1}, {0, 0.3, 0}, 0);
        if (row.min_children > 1) addObject(c.scene, "torus", {0.7, 0.2}, {0, 0.2, 0.1}, 0);
        all.push_back(std::move(c));
    }
    for (int i = 0; i < 6; ++i) {
        Case c{"random tree " + std::to_string(i), {}};
        for (int top = 0; top < 2; ++top) addRandom(c.scene, draw, {.hidden = 0.1});
        all.push_back(std::move(c));
    }
    all.push_back({"nothing", {}});
    return all;
}

struct Errors {
    double distance = 0, angle = 0;      // the worst: metres, radians
    int unequal = 0, leaves = 0, slopes = 0, empty = 0;
};

/// Both evaluate in float from the same rounded numbers; they may order and contract the operations differently.
Errors compare(const Scene& scene, const std::vector<glm::vec3>& points, const std::vector<GpuSample>& gpu, double bound) {
    Errors e;
    const Tree tree = makeTree(scene);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const sdf::Vec3<float> p{points[i].x, points[i].y, points[i].z};
        const Nearest<float> cpu = nearest<float>(tree, p);
        e.distance = std::max(e.distance, std::fabs(static_cast<double>(gpu[i].distance) - static_cast<double>(cpu.distance)));
        e.unequal += gpu[i].distance != gpu[i].found_distance;
        if (gpu[i].leaf < 0) {
            ++e.empty;
            continue;
        }

        // Where two leaves are equally near but for rounding, either may be named; and of copies of one, any.
        const auto seen = [&](int leaf) { return leaf < 0 ? -1 : tree.leaves[static_cast<std::size_t>(leaf)].object; };
        const auto of = [&](int leaf) { return leaf < 0 ? scene.objects.size() : tree.leaves[static_cast<std::size_t>(leaf)].index; };
        if (of(gpu[i].leaf) != of(cpu.leaf)) {
            int differs = 1;
            for (const glm::dvec3 by : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
                for (const double way : {-4 * bound, 4 * bound}) {
                    const glm::dvec3 q = glm::dvec3(points[i]) + by * way;
                    if (nearest<double>(tree, {q.x, q.y, q.z}).leaf == gpu[i].leaf) differs = 0;
                }
            e.leaves += differs;
        }
        e.leaves += gpu[i].object != seen(gpu[i].leaf);

        // The GPU's gradient is by differences over some millimetres: compared where the field is smooth that far around.
        const glm::dvec3 at(points[i]), exact = slope(tree, at).gradient;
        bool smooth = glm::length(exact) > 0.05;
        for (const glm::dvec3 by : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
            for (const double way : {-8e-3, 8e-3}) smooth = smooth && glm::distance(slope(tree, at + by * way).gradient, exact) < 0.05;
        if (!smooth) continue;
        const glm::dvec3 measured(gpu[i].gradient);
        ++e.slopes;
        e.angle = std::max(e.angle, glm::length(glm::cross(measured, exact)) / (glm::length(measured) * glm::length(exact)));
    }
    return e;
}

/// 4 ulps of the coordinates, which reach 10 m from an object's centre scaled and turned: one each for the difference, the
/// rotation, the primitive and the operators above it.
constexpr double kBound = 4 * 0x1p-23 * 10;

}  // namespace

TEST_CASE("the GPU and the CPU agree on every primitive and every operator") {
    HeadlessRenderer headless;
    const std::vector<Case> all = cases();
    const std::size_t each = static_cast<std::size_t>(times(100'000)) / all.size() + 1;
    Draw draw(32);
    double worst = 0, angle = 0;
    for (const Case& c : all) {
        CAPTURE(c.name);
        std::vector<glm::vec3> points(each);
        for (glm::vec3& p : points) p = glm::vec3(draw.uniform(-3, 3), draw.uniform(-3, 3), draw.uniform(-3, 3));
        std::vector<GpuSample> gpu;
        REQUIRE(headless.renderer->evaluate(c.scene, points, gpu) == "");
        REQUIRE(gpu.size() == points.size());
        const Errors e = compare(c.scene, points, gpu, kBound);
        CHECK(e.distance <= kBound);
        CHECK(e.unequal == 0);
        CHECK(e.leaves == 0);
        CHECK(e.angle < 0.02);  // a difference of two such values, over a millimetre: 2e-6 / 1e-3, and the curvature's share
        const bool nothing = makeTree(c.scene).program.empty();
        CHECK(e.empty == (nothing ? static_cast<int>(points.size()) : 0));
        CHECK((nothing || e.slopes > static_cast<int>(points.size()) / 4));
        worst = std::max(worst, e.distance), angle = std::max(angle, e.angle);
    }
    MESSAGE((each * all.size()) << " points of " << all.size() << " scenes: worst difference " << worst << " m, worst angle " << angle << " rad");
}

TEST_CASE("a field that differs on the CPU is seen") {
    HeadlessRenderer headless;
    Scene scene;
    addObject(scene, "torus", {1, 0.25});
    addObject(scene, "sphere", {0.4}, {0.5, 0, 0});
    std::vector<glm::vec3> points;
    Draw draw(33);
    for (int i = 0; i < 1000; ++i) points.emplace_back(draw.uniform(-3, 3), draw.uniform(-3, 3), draw.uniform(-3, 3));
    std::vector<GpuSample> gpu;
    REQUIRE(headless.renderer->evaluate(scene, points, gpu) == "");
    CHECK(compare(scene, points, gpu, kBound).distance <= kBound);
    Scene other = scene;
    other.objects[0].numbers[1] += 1e-4;
    CHECK(compare(other, points, gpu, kBound).distance > kBound);
    std::swap(other.objects[0], other.objects[1]);
    CHECK(compare(other, points, gpu, kBound).leaves > 0);
    other = scene;
    other.objects[0].rot = {10, 0, 0};
    CHECK(compare(other, points, gpu, kBound).angle > 0.02);
}
