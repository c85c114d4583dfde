// A fault in the GLSL of a primitive shows as a picture that is far from the oracle, while the picture of the program as it is is near.
// Only distances are changed: the spans beside them stay, and what a fault makes larger than its span is drawn where the span begins.
#include "core/accuracy/implicit.h"
#include "core/render/compose.h"
#include "rays.h"
#include "render/headless.h"

#include <string>

using namespace mb;

namespace {

/// One fault of a list that the laws of primitives were tried on too. `shows`: in pictures; else only in values, for the surface is
/// drawn where it was.
struct Mutant {
    const char *name, *from, *to, *type;
    std::initializer_list<double> numbers;
    bool from_inside = false;  // where the eye is
    bool shows = true;
};
const Mutant kMutants[] = {
    {"box loses its interior term", "return length(max(q, 0.0f)) + min(max(q.x, max(q.y, q.z)), 0.0f);", "return length(max(q, 0.0f));", "box", {2, 2, 2, 0}, true},
    {"box forgets to shrink by round", "abs(p) - size * real(0.5f) + r", "abs(p) - size * real(0.5f)", "box", {1, 1, 1, 0.3}},
    {"box does not clamp round", "real r = min(round, 0.5f * min(size.x, min(size.y, size.z)));\n    return outside", "real r = round;\n    return outside", "box",
     {1, 1, 1, 0.9}},
    {"torus swaps major and minor", "- major, p.y)) - minor;", "- minor, p.y)) - major;", "torus", {0.7, 0.2}},
    {"sphere radius doubled", "return length(p) - radius;", "return length(p) - 2.0f * radius;", "sphere", {0.8}, true},
    // From outside a ray goes on where the span begins, which is the true surface, and there the value is negative at once.
    {"sphere radius doubled, seen from outside", "return length(p) - radius;", "return length(p) - 2.0f * radius;", "sphere", {0.8}, false, false},
    {"cylinder min becomes max", "real r = min(round, min(radius, 0.5f * height));", "real r = max(round, min(radius, 0.5f * height));", "cylinder", {0.6, 1, 0.1}},
    {"capsule unclamped below", "max(abs(p.y) - 0.5f * height, 0.0f)", "abs(p.y) - 0.5f * height", "capsule", {0.3, 0.8}},
    {"torus distance scaled by 0.9", "return length(vec2(length(vec2(p.x, p.z)) - major, p.y)) - minor;",
     "return 0.9f * (length(vec2(length(vec2(p.x, p.z)) - major, p.y)) - minor);", "torus", {0.7, 0.2}, false, false},
    {"torus lies in xy", "vec2(length(vec2(p.x, p.z)) - major, p.y)) - minor", "vec2(length(vec2(p.x, p.y)) - major, p.z)) - minor", "torus", {0.7, 0.2}},
    {"capsule is half as tall", "max(abs(p.y) - 0.5f * height, 0.0f)", "max(abs(p.y) - 0.25f * height, 0.0f)", "capsule", {0.3, 0.8}},
};

Texts mutated(const Mutant& mutant) {
    Texts texts = shaderLibrary();
    std::string& text = texts.find("sdf/primitives.glsl")->second;
    const std::size_t at = text.find(mutant.from);
    REQUIRE_MESSAGE(at != text.npos, mutant.name);
    text.replace(at, std::string_view(mutant.from).size(), mutant.to);
    return texts;
}

Scene sceneOf(const Mutant& mutant) {
    Scene scene;
    addObject(scene, mutant.type, mutant.numbers);
    scene.objects[0].rot = {10, 20, 5};
    return scene;
}

/// The share of pixels, of those where either sees something, whose state is another or whose depth is off by a thousandth.
double wrongShare(HeadlessRenderer& headless, const Scene& scene, bool from_inside) {
    const Oracle oracle(scene);
    const Camera camera = cameraAt(from_inside ? glm::dvec3(0.2, 0.3, 0.4) : glm::dvec3(0.6, 0.9, 3), {0, 0, 0}, 50);
    const glm::ivec2 size{64, 48};
    const Measured m = headless.measure(scene, camera, size);
    int seen = 0, wrong = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const auto i = static_cast<std::size_t>(y * size.x + x);
            const std::optional<TrueHit> truth = oracle.firstHit(cameraRay(camera, size, {x + 0.5, y + 0.5}), 1e3);
            const bool hit = m.channels.state[i] == 1;
            seen += truth || m.channels.state[i] != 0;
            wrong += hit != truth.has_value() || (hit && std::fabs(static_cast<double>(m.channels.depth[i]) / truth->t - 1) > 1e-3);
        }
    REQUIRE(seen > 100);
    return static_cast<double>(wrong) / seen;
}

/// How far the GPU's values at points around are from the oracle's own, at most.
double worstValue(HeadlessRenderer& headless, const Scene& scene) {
    const accuracy::KnownTree known(makeTree(scene));
    const accuracy::Implicit own(known, known.tree.program);
    Draw draw(streamOf("values"));
    std::vector<glm::vec3> points;
    for (int i = 0; i < 500; ++i) points.push_back(glm::vec3(drawPoint(draw, 1)));
    std::vector<GpuSample> samples;
    const std::string refused = headless.renderer->evaluate(scene, points, samples);
    REQUIRE_MESSAGE(refused.empty(), refused);
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i) worst = std::max(worst, std::fabs(static_cast<double>(samples[i].distance) - own.value(glm::dvec3(points[i]))));
    return worst;
}

}  // namespace

TEST_CASE("mutants: pictures and values of the program as it is are near the oracle, and of each seeded fault far") {
    HeadlessRenderer headless;
    for (const Mutant& mutant : kMutants) {
        const std::string name = mutant.name;
        CAPTURE(name);
        const Scene scene = sceneOf(mutant);
        headless.renderer->setLibrary(shaderLibrary());
        const double right = wrongShare(headless, scene, mutant.from_inside), right_value = worstValue(headless, scene);
        headless.renderer->setLibrary(mutated(mutant));
        const double wrong = wrongShare(headless, scene, mutant.from_inside), wrong_value = worstValue(headless, scene);
        MESSAGE(name << ": wrong pixels " << 100 * right << " % and with it " << 100 * wrong << " %; values off by " << right_value << " and " << wrong_value << " m");
        CHECK(right <= 0.005);
        CHECK(right_value < 1e-5);
        CHECK(wrong_value > 0.01);
        if (mutant.shows) CHECK(wrong > 0.05);
        else CHECK(wrong <= 0.005);  // no picture can see it
    }
}
