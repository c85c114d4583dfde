// Cases 28 to 33: scales, deep and wide trees, rotations, sizes, numbers that are none, and the edges of GLSL's functions.
#include "hard/oracle.h"

#include "physics/world.h"
#include "sdf/random_scene.h"

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

using namespace mb;
using namespace mb::hard;

namespace {

constexpr glm::ivec2 kSize{96, 72};

std::string object(const std::string& keys) { return "marchbox 1\nobject " + keys + "\n"; }

/// The worst difference between the GPU's distances and the CPU's in double, at points within `reach`.
double worstOnGpu(HeadlessRenderer& headless, const Scene& s, double reach, std::string& why) {
    Draw draw(29);
    std::vector<glm::vec3> points;
    for (int i = 0; i < 1000; ++i) points.emplace_back(draw.uniform(-reach, reach), draw.uniform(-reach, reach), draw.uniform(-reach, reach));
    std::vector<GpuSample> gpu;
    why = headless.renderer->evaluate(s, points, gpu);
    if (!why.empty()) return 0;
    const Tree tree = makeTree(s);
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        worst = std::max(worst, std::fabs(static_cast<double>(gpu[i].distance) - distance<double>(tree, vec(glm::dvec3(points[i])))));
    return worst;
}

}  // namespace

TEST_CASE("case 28: a scale is uniform and positive; any other is refused with its place") {
    for (const char* scale : {"1,1,0.1", "1,1,0", "-1,1,1", "0", "-1", "nan", "1e7", "1e-7"}) {
        const std::string fault = firstFault(object(std::string("type:sphere radius:1 scale:") + scale));
        CAPTURE(fault);
        CHECK(fault.starts_with("2:35: 'scale'"));
    }
    for (const char* scale : {"1e6", "1e-6"}) CHECK(firstFault(object(std::string("type:sphere radius:1 scale:") + scale)) == "");
}

TEST_CASE("case 28: at the smallest and the largest scale the slope stays 1 and the picture the same") {
    HeadlessRenderer headless;
    const auto scene = [](double scale) {
        Scene s;
        const int o = addObject(s, "subtract", {});
        s.objects[0].scale = scale;
        addObject(s, "box", {1, 1, 1, 0.1}, {}, o), addObject(s, "sphere", {0.6}, {0.5, 0.4, 0.3}, o);
        s.lights = {{"", glm::dvec3{2, 3, 4} * scale, {1, 1, 1}, 1}};
        s.render.max_distance = std::clamp(10 * scale, 1e-3, 1e6);
        return s;
    };
    Draw draw(28);
    for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
        const Scene s = scene(scale);
        const Tree tree = makeTree(s);
        double steepest = 0;
        for (int i = 0; i < times(20'000); ++i) {
            const glm::dvec3 p = scale * glm::dvec3{draw.uniform(-2, 2), draw.uniform(-2, 2), draw.uniform(-2, 2)};
            const glm::dvec3 q = p + scale * glm::dvec3{draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)};
            steepest = std::max(steepest, std::fabs(distance<double>(tree, vec(p)) - distance<double>(tree, vec(q))) / glm::distance(p, q));
        }
        CHECK(steepest <= 1 + 1e-3);
        if (scale == 1e6) continue;  // a million metres would fit, but max_distance ends there

        const auto one = headless.draw(scene(1), cameraAt({1.6, 1.8, 2}, {0, 0, 0}), kSize);
        const auto other = headless.draw(s, cameraAt(scale * glm::dvec3{1.6, 1.8, 2}, {0, 0, 0}), kSize);
        std::size_t differ = 0;
        for (std::size_t i = 0; i < one.size(); ++i) differ += std::fabs(one[i].x - other[i].x) > 1.0f / 255;
        MESSAGE("scale " << scale << ": slope at most " << steepest << ", " << differ << " pixels differ");
        CHECK(differ <= one.size() / 200);
    }
}

TEST_CASE("case 29: chains, deep and wide trees are what the CPU says in double; deeper than 32 is refused") {
    HeadlessRenderer headless;
    constexpr double kReach = 4, kTolerance = 1e-5 * kReach;
    std::string why;
    for (const int n : {100, 200, 1000, 1024}) {
        Scene chain;
        const int o = addObject(chain, "subtract", {});
        addObject(chain, "box", {6, 6, 6, 0}, {}, o);
        Draw draw(291);
        for (int i = 0; i < n; ++i) addObject(chain, "sphere", {0.3}, {draw.uniform(-3, 3), draw.uniform(-3, 3), draw.uniform(-3, 3)}, o);
        const double worst = worstOnGpu(headless, chain, kReach, why);
        MESSAGE(n << " subtractions: off by at most " << worst << " m");
        CHECK(why == "");
        CHECK(worst <= kTolerance);
    }

    // Leaning to the left and to the right, as deep as a file may go.
    for (const bool right : {false, true}) {
        std::string text = "marchbox 1\n", indent;
        std::vector<std::string> after;
        for (int level = 0; level < 31; ++level, indent += "  ") {
            const std::string ball = indent + "  object type:sphere radius:0.2 pos:" + std::to_string(level % 5 - 2) + ",0.1,0\n";
            text += indent + "object type:union\n";
            if (right) text += ball;
            else after.push_back(ball);
        }
        text += indent + "object type:sphere radius:0.4\n";
        while (!after.empty()) text += after.back(), after.pop_back();
        CHECK(firstFault(text) == "");
        const double worst = worstOnGpu(headless, readScene(text).scene, kReach, why);
        CHECK(why == "");
        CHECK(worst <= kTolerance);
    }
    for (const int levels : {33, 1000, 2000}) {
        std::string text = "marchbox 1\n";
        for (int level = 0; level < levels; ++level) text += std::string(2 * static_cast<std::size_t>(level), ' ') + "object type:union\n";
        int too_deep = 0;
        for (const Fault& f : readScene(text).faults) too_deep += f.message.find("expected at most 32") != std::string::npos;
        CHECK(too_deep > 0);
    }
}

TEST_CASE("case 30: every rotation a file can hold is one; what cannot turn into one is refused") {
    for (const char* keys : {"type:box size:1,1,1 rot:nan,0,0", "type:box size:1,1,1 rot:0,inf,0", "type:box size:1,1,1 rot:0,0,1e10", "type:plane normal:0,0,0",
                             "type:plane normal:1e-20,0,0", "type:plane normal:nan,0,1", "type:sphere radius:1 mass:1 spin:nan,0,0", "type:sphere radius:1 mass:1 spin:1e20,0,0"})
        CHECK(firstFault(object(keys)).starts_with("2:"));
    Draw draw(30);
    double worst = 0;
    for (int i = 0; i < times(20'000); ++i) {
        const auto angle = [&] { return draw.oneIn(3) ? 90.0 * draw.below(5) : draw.uniform(-1, 1) * draw.logUniform(1e-20, 1e9); };
        const glm::dmat3 r = rotationFromDegrees({angle(), angle(), angle()}), unit = glm::transpose(r) * r;
        for (int k = 0; k < 3; ++k) worst = std::max(worst, glm::length(unit[k] - glm::dmat3(1)[k]));
        CHECK(glm::determinant(r) > 0);
    }
    CHECK(worst < 1e-14);

    // A body that has spun as fast as a file allows for a thousand steps still has a rotation.
    Scene s;
    addObject(s, "sphere", {0.5});
    s.objects[0].mass = 1, s.objects[0].spin = {1e5, -1e5, 1e5}, s.world.gravity = 0;
    PhysicsWorld world(s);
    for (int i = 0; i < 1000; ++i) world.step();
    world.writeTo(s);
    for (int k = 0; k < 3; ++k) CHECK(std::isfinite(s.objects[0].rot[k]));
}

TEST_CASE("case 31: sizes that are none are refused; the smallest and the largest are drawn where they are") {
    for (const char* keys : {"type:sphere radius:0", "type:sphere radius:-1", "type:sphere radius:1e-8", "type:sphere radius:1e8", "type:sphere radius:nan",
                             "type:box size:1,0,1", "type:box size:1,-1,1", "type:torus major:1 minor:0", "type:cylinder radius:1 height:0", "type:ellipsoid radii:1,0,1"})
        CHECK(firstFault(object(keys)).starts_with("2:"));
    HeadlessRenderer headless;
    for (const auto& [radius, eye] : {std::pair{1e-6, 4e-6}, std::pair{1e-3, 4e-3}, std::pair{1e3, 4e3}, std::pair{1e5, 4e5}}) {
        Scene s;
        addObject(s, "sphere", {radius});
        s.render.max_distance = std::max(10 * radius, 1e-3);
        const Camera camera = cameraAt({0, 0.1 * eye, eye}, {0, 0, 0});
        const double r = radius;
        const Compared c = compare(headless.measure(s, camera, kSize), camera, [&](const DoubleRay& ray) { return firstOf(sphereSpan(ray, {}, r), 1e9); });
        MESSAGE("radius " << radius << ": IoU " << c.iou() << ", " << c.false_hits << " false hits, worst depth " << c.worst_depth);
        CHECK(c.false_hits + c.false_misses == 0);
        CHECK(c.iou() >= 0.999);
        CHECK(c.worst_depth <= 1e-3);
    }
}

TEST_CASE("case 32: a shape with a number that is none is refused before it is drawn") {
    HeadlessRenderer headless;
    for (const double bad : {std::nan(""), static_cast<double>(INFINITY)})
        for (int what = 0; what < 3; ++what) {
            Scene s;
            for (int i = 0; i < 10; ++i) addObject(s, "sphere", {0.4}, {i - 5.0, 0, 0});
            Object& o = s.objects[4];
            (what == 0 ? o.numbers[0] : what == 1 ? o.pos.y : o.rot.z) = bad;
            Measured m;
            const std::string why = headless.renderer->measure(s, {}, kSize, m);
            CAPTURE(what);
            CHECK_MESSAGE(why.find("sphere 4") != std::string::npos, why);
            CHECK(headless.renderer->draw(s, {}, kSize) == why);
            std::vector<GpuSample> samples;
            CHECK(headless.renderer->evaluate(s, {{0, 0, 0}}, samples) == why);
        }
}

TEST_CASE("case 33: the distances use none of the functions whose edges differ between machines") {
    // Measured on llvmpipe: atan(0, 0) is 2.356, pow(0, 0) is 0, fract(-1e-9) is 1, mod(1, 0) and normalize(0) are NaN, log is
    // 256 units in the last place off near 1, acos is off by 1.6e-4.
    const std::regex edged(R"(\b(atan|acos|asin|pow|log|log2|fract|mod|normalize|tan|int|inversesqrt)\s*\()");
    const std::regex comment("//[^\n]{0,400}");
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator("shaders/sdf")) {
        std::stringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        const std::string code = std::regex_replace(text.str(), comment, "");
        CHECK(code.size() > 100);
        std::smatch found;
        CHECK_MESSAGE(!std::regex_search(code, found, edged), entry.path().string() << " uses " << found.str());
        ++files;
    }
    CHECK(files >= 4);
}

TEST_CASE("case 33: the GPU's distance lies in the interval of the CPU's, a few roundings wide") {
    HeadlessRenderer headless;
    constexpr double kWidth = 6 * 0x1p-23;  // of the coordinates: of the point, the position, the rotation and the numbers
    Draw draw(33);
    int outside = 0, compared = 0;
    std::vector<Scene> scenes;
    for (const Primitive& row : primitives()) addObject(scenes.emplace_back(), row.name, {}, {0.1, -0.2, 0.3});
    for (const Operator& op : operators()) {
        Scene& s = scenes.emplace_back();
        const int o = addObject(s, op.name, {}, {0.1, -0.2, 0.3});
        for (int i = 0; i < std::min(op.max_children, 2); ++i) addObject(s, "box", {1, 1.6, 0.8, 0}, {0.3 * i, 0.2, 0}, o);
    }
    for (Scene& s : scenes) {
        s.objects[0].rot = {20, 30, 40};
        std::vector<glm::vec3> points;
        for (int i = 0; i < times(2000); ++i) points.emplace_back(draw.uniform(-2, 2), draw.uniform(-2, 2), draw.uniform(-2, 2));
        for (const float edge : {0.0f, -0.0f, 1e-30f, 1e-42f}) points.emplace_back(edge, edge, edge), points.emplace_back(0.1f, -0.2f, edge);
        std::vector<GpuSample> gpu;
        REQUIRE(headless.renderer->evaluate(s, points, gpu) == "");
        const Tree tree = makeTree(s);
        CAPTURE(s.objects[0].type->name);
        for (std::size_t i = 0; i < points.size(); ++i, ++compared) {
            const glm::dvec3 p(points[i]);
            const double w = kWidth * (glm::length(p) + 1);
            const sdf::Interval bound = distance<sdf::Interval>(tree, {{p.x - w, p.x + w}, {p.y - w, p.y + w}, {p.z - w, p.z + w}});
            const double f = static_cast<double>(gpu[i].distance);
            outside += !(f >= bound.lo - w && f <= bound.hi + w);
        }
    }
    MESSAGE(compared << " points of " << scenes.size() << " rows: " << outside << " outside their interval");
    CHECK(outside == 0);
}
