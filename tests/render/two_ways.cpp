// A scene as straight-line code and through the grid: the same values to the bit, and the same picture.
//
// Both ways call the same functions of shaders/sdf/ with the same records in the same order, and a pruned list leaves out
// only what cannot change a bit of the value. Two things would still make an ulp's difference, and are kept out of the text:
// a ball asked at a point that was turned first, and a warped point that the driver regroups with what is taken from it
// next, (a - b) - c as (a - c) - b. The marches ask at other points of a ray, so pictures are compared by what was found.
#include "headless.h"
#include "core/scene/text.h"
#include "sdf/random_scene.h"

#include <array>
#include <cmath>

using namespace mb;

namespace {

struct Case {
    std::string name;
    Scene scene;
    glm::ivec2 picture{320, 240};  // pixels; 0: none, where it would take long to compile
};

/// Every operator of that kind over what it takes, side by side, turned and scaled, above a floor.
Scene operatorsOf(Operator::Kind kind) {
    Scene scene;
    double x = -2.5;
    for (const Operator& row : operators()) {
        if (row.kind != kind) continue;
        const int o = addObject(scene, row.name, {}, {x += 0.8, 0.1, -0.2});
        scene.objects.back().rot = {10, 25, -15}, scene.objects.back().scale = 0.7;
        addObject(scene, "box", {1, 1.4, 0.6, 0.1}, {0.2, 0, 0}, o);
        if (row.max_children == 1) continue;
        addObject(scene, "sphere", {0.5}, {0.5, 0.4, 0.3}, o);
        addObject(scene, "torus", {0.6, 0.2}, {-0.2, 0, 0}, o);
        scene.objects.back().rot = {40, 0, 70};
    }
    addObject(scene, "plane", {0, 1, 0, -1});
    return scene;
}

/// n shapes in a cube: half of them a patch of a ball and a box, repeated and mirrored, the others each on its own.
Scene crowd(int n) {
    Scene scene;
    Draw draw(81);
    const auto side = [&] { return draw.uniform(-2, 2); };
    const int mirror = addObject(scene, "mirror", {}, {0.1, 0, 0}), across = std::max(n / 16, 1);
    const int repeat = addObject(scene, "repeat", {0.35, 0.9, 0.8, static_cast<double>(across), 2, 1}, {0, 0.6, 0}, mirror);
    const int patch = addObject(scene, "union", {0.02}, {0, 0, 0}, repeat);
    addObject(scene, "sphere", {0.12}, {0.05, 0, 0}, patch);
    addObject(scene, "box", {0.15, 0.3, 0.2}, {0, 0.15, 0}, patch);
    scene.objects.back().rot = {0, 30, 20};
    for (int left = n - 8 * across; left > 0; --left) {
        addObject(scene, left % 2 ? "sphere" : "box", {0.15, 0.2, 0.2}, {side(), side(), side()});
        scene.objects.back().rot = {side() * 40, side() * 40, 0};
    }
    return scene;
}

/// Objects of any type nested four deep, two of them side by side.
Scene nested(Draw& draw) {
    constexpr std::size_t kFewest = 4, kMost = 24;  // leaves: as straight-line code, more take long to compile
    for (;;) {
        Scene scene;
        for (int top = 0; top < 2; ++top) addRandom(scene, draw, {.hidden = 0.1});
        const std::size_t leaves = makeTree(scene).leaves.size();
        if (leaves >= kFewest && leaves <= kMost) return scene;
    }
}

/// Half-spaces alone. A grid has no cells for what has no bounds, and must not be read as the one before it.
Scene boundless() {
    Scene scene;
    const int o = addObject(scene, "intersect", {0.1});
    for (const auto& [x, y, z] : {std::array{1.0, 0.4, 0.1}, {-1.0, 0.2, 0.3}, {0.1, 1.0, -0.2}}) addObject(scene, "plane", {x, y, z, 0.5}, {}, o);
    return scene;
}

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const char* name : {"three_lights", "mirrors", "welcome"}) {
        LoadResult loaded = loadScene(std::string(MARCHBOX_SOURCE "/saves/") + name + ".txt");
        REQUIRE(loaded.ok());
        all.push_back({name, loaded.scene});
    }
    all.push_back({"folds", operatorsOf(Operator::Kind::fold)});
    all.push_back({"wraps", operatorsOf(Operator::Kind::wrap)});
    all.push_back({"copies", operatorsOf(Operator::Kind::copies)});
    Draw draw(83);
    for (int i = 0; i < times(8); ++i) all.push_back({"nested " + std::to_string(i), nested(draw), i < 2 ? glm::ivec2{128, 96} : glm::ivec2{0}});
    all.push_back({"a crowd of 40", crowd(40)});
    all.push_back({"without bounds", boundless()});
    // As straight-line code, 100 take 3 s to compile, 200 take 11 s and 300 take 23 s.
    all.push_back({"a larger crowd", crowd(times(100)), {0, 0}});
    return all;
}

std::vector<GpuSample> sampled(HeadlessRenderer& headless, const Scene& scene, Evaluation way) {
    Draw draw(82);
    std::vector<glm::vec3> points(20'000);
    for (glm::vec3& p : points) p = glm::vec3(draw.uniform(-3, 3), draw.uniform(-3, 3), draw.uniform(-3, 3));
    headless.renderer->setEvaluation(way);
    std::vector<GpuSample> samples;
    REQUIRE(headless.renderer->evaluate(scene, points, samples) == "");
    return samples;
}
Channels seen(HeadlessRenderer& headless, const Scene& scene, glm::ivec2 size, Evaluation way) {
    headless.renderer->setEvaluation(way);
    return headless.measure(scene, scene.cameras.empty() ? cameraAt({3, 2.5, 6}, {0, 0, 0}) : scene.cameras[0], size).channels;
}

/// Points at which the two ways do not say the same, to the bit.
int differing(const std::vector<GpuSample>& a, const std::vector<GpuSample>& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += !(a[i].distance == b[i].distance && a[i].found_distance == b[i].found_distance && a[i].gradient == b[i].gradient && a[i].leaf == b[i].leaf &&
                   a[i].object == b[i].object);
    return count;
}

/// Pixels of two pictures that differ. A march steps over what is thinner than closeAt() (tolerance.glsl), and which surface it
/// then finds depends on where it asked; but the two lie no further apart than that.
struct Differences {
    int pixels = 0;
    int decided = 0;    // a hit for a miss, or two hits further apart: one of the ways is wrong
    int beside = 0;     // another object's surface, no further away
    int undecided = 0;  // one of the ways does not know: it ran out of steps along a surface
};
Differences compare(const Channels& a, const Channels& b, double epsilon) {
    Differences d;
    for (std::size_t i = 0; i < a.state.size(); ++i) {
        ++d.pixels;
        if (a.state[i] == 2 || b.state[i] == 2) d.undecided += a.state[i] != b.state[i];
        else if (a.state[i] != b.state[i]) ++d.decided;
        else if (a.state[i] == 1) {
            d.decided += std::fabs(a.depth[i] - b.depth[i]) > epsilon * static_cast<double>(a.depth[i]);
            d.beside += a.object[i] != b.object[i];
        }
    }
    return d;
}

}  // namespace

TEST_CASE("a grid evaluates and renders as straight-line code does") {
    HeadlessRenderer headless;
    Differences sum;
    long points = 0;
    for (const Case& c : cases()) {
        CAPTURE(c.name);
        const std::vector<GpuSample> straight = sampled(headless, c.scene, Evaluation::straight), grid = sampled(headless, c.scene, Evaluation::grid);
        CHECK(differing(straight, grid) == 0);
        points += static_cast<long>(straight.size());
        if (c.picture.x == 0) continue;
        const Differences d = compare(seen(headless, c.scene, c.picture, Evaluation::straight), seen(headless, c.scene, c.picture, Evaluation::grid),
                                      c.scene.render.march_epsilon);
        CHECK(d.decided == 0);
        CHECK(d.beside <= 0.0001 * d.pixels);
        CHECK(d.undecided <= 0.002 * d.pixels);
        sum.pixels += d.pixels, sum.beside += d.beside, sum.undecided += d.undecided;
    }
    MESSAGE(points << " points; of " << sum.pixels << " pixels, " << sum.beside << " show the surface beside and " << sum.undecided << " are decided one way only");
}

TEST_CASE("a grid of another scene is caught: of one whose shape is moved, or left out, or turned, or has another number") {
    HeadlessRenderer headless;
    const Scene scene = crowd(24);
    const std::vector<GpuSample> straight = sampled(headless, scene, Evaluation::straight);
    const auto values = [&](const Scene& other) { return differing(straight, sampled(headless, other, Evaluation::grid)); };
    CHECK(values(scene) == 0);
    for (std::size_t i = 3; i < scene.objects.size(); i += 4) {  // but the operators
        CAPTURE(i);
        Scene other = scene;
        other.objects[i].pos.y += 1e-6;
        CHECK(values(other) > 0);
        other = scene;
        other.objects[i].numbers[0] += 1e-6;
        CHECK(values(other) > 0);
        other = scene;
        other.objects.erase(other.objects.begin() + static_cast<std::ptrdiff_t>(i));
        CHECK(values(other) > 0);
        if (scene.objects[i].type->name == "sphere") continue;
        other = scene;
        other.objects[i].rot.y += 1e-3;
        CHECK(values(other) > 0);
    }

    const Channels picture = seen(headless, scene, {128, 96}, Evaluation::straight);
    const auto pixels = [&](const Scene& other) { return compare(picture, seen(headless, other, {128, 96}, Evaluation::grid), scene.render.march_epsilon); };
    CHECK(pixels(scene).decided == 0);
    int changes = 0, caught = 0;
    for (std::size_t i = 5; i < scene.objects.size(); i += 3, changes += 2) {  // but the patch
        Scene other = scene;
        other.objects[i].hidden = true;
        caught += pixels(other).decided > 0;
        other = scene;
        other.objects[i].pos.y += 0.01;
        caught += pixels(other).decided > 0;
    }
    CHECK(caught == changes);
}
