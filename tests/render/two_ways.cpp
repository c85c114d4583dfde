// A scene as straight-line code and through the grid: the same distances, and but for grazing rays the same picture.
#include "headless.h"
#include "core/scene/text.h"
#include "scenes.h"
#include "sdf/draw.h"

#include <cmath>

using namespace mb;

namespace {

struct Case {
    std::string name;
    Scene scene;
};

Scene over(std::string_view type, std::initializer_list<double> numbers) {
    Scene scene;
    const int o = addObject(scene, type, numbers);
    addObject(scene, "box", {1, 1.4, 0.6, 0.1}, {0.2, 0, 0}, o);
    const Operator& op = asOperator(*findShapeType(type));
    if (op.max_children > 1) addObject(scene, "sphere", {0.5}, {0.5, 0.4, 0.3}, o), addObject(scene, "torus", {0.6, 0.2}, {-0.2, 0, 0}, o);
    addObject(scene, "plane", {0, 1, 0, -1});
    return scene;
}
std::vector<Case> cases() {
    std::vector<Case> all;
    for (const char* name : {"three_lights", "mirrors", "welcome"}) {
        LoadResult loaded = loadScene(std::string(MARCHBOX_SOURCE "/saves/") + name + ".txt");
        REQUIRE(loaded.ok());
        all.push_back({name, loaded.scene});
    }
    all.push_back({"a blend", over("union", {0.3})});
    all.push_back({"a subtract", over("subtract", {0})});
    for (const Operator& row : operators())
        if (row.kind != Operator::Kind::fold && row.name != "repeat") all.push_back({std::string(row.name), over(row.name, {})});
    Draw draw(81);
    Case many{"40 in a union", {}};
    const auto side = [&] { return draw.uniform(-2, 2); };
    // As straight-line code, hundreds take minutes to compile.
    for (int i = 0; i < 40; ++i) addObject(many.scene, i % 2 ? "sphere" : "box", {0.15, 0.2, 0.2}, {side(), side(), side()});
    all.push_back(many);
    return all;
}

struct Differences {
    int states = 0, objects = 0, depths = 0, pixels = 0;
};
Differences compare(const Channels& a, const Channels& b, double epsilon) {
    Differences d;
    for (std::size_t i = 0; i < a.state.size(); ++i) {
        ++d.pixels, d.states += a.state[i] != b.state[i], d.objects += a.object[i] != b.object[i];
        if (a.state[i] != 1 || b.state[i] != 1 || a.object[i] != b.object[i]) continue;
        d.depths += std::fabs(a.depth[i] - b.depth[i]) > 2 * epsilon * static_cast<double>(a.depth[i]);
    }
    return d;
}

/// Rays that graze: one way's pieces of emptiness overlap there and the other's do not.
constexpr double kGrazing = 0.0005;
/// m: 2 ulps of values below 4, as seen where space is warped, and in a scene with turned balls, probably because the grid
/// turns those and straight-line code does not (Primitive::turns). Elsewhere the two ways are equal to the bit.
constexpr double kRounding = 2 * 0x1p-22;

}  // namespace

TEST_CASE("a grid evaluates and renders as straight-line code does") {
    HeadlessRenderer headless;
    Draw draw(82);
    std::vector<glm::vec3> points(20'000);
    for (glm::vec3& p : points) p = glm::vec3(draw.uniform(-3, 3), draw.uniform(-3, 3), draw.uniform(-3, 3));
    for (const Case& c : cases()) {
        CAPTURE(c.name);
        std::vector<GpuSample> values[2];
        Measured pictures[2];
        for (const int way : {0, 1}) {
            headless.renderer->setEvaluation(way == 0 ? Evaluation::straight : Evaluation::grid);
            REQUIRE(headless.renderer->evaluate(c.scene, points, values[way]) == "");
            const Camera camera = c.scene.cameras.empty() ? cameraAt({3, 2.5, 6}, {0, 0, 0}) : c.scene.cameras[0];
            pictures[way] = headless.measure(c.scene, camera, {128, 96});
        }
        int differ = 0;
        double most = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const float a = values[0][i].distance, b = values[1][i].distance;
            differ += a != b, most = std::max(most, static_cast<double>(std::fabs(a - b)));
        }
        const Differences d = compare(pictures[0].channels, pictures[1].channels, c.scene.render.march_epsilon);
        MESSAGE(c.name << ": " << differ << " distances differ, by " << most << " m at most; of " << d.pixels << " pixels, states " << d.states << ", objects "
                       << d.objects << ", depths " << d.depths);
        const bool rounds = makeTree(c.scene).warps > 0 || c.name == "welcome";
        CHECK(most <= (rounds ? kRounding : 0));
        CHECK(d.states <= kGrazing * d.pixels);
        CHECK(d.objects <= kGrazing * d.pixels);
        CHECK(d.depths <= kGrazing * d.pixels);
    }
}
