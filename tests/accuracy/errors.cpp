// The errors of drawn pictures, held to a recomputation that shares nothing with src/core/accuracy: rays by the tests' own formula,
// surfaces by the program's double field, normals by dual numbers, light by the model of docs/SCENE_FORMAT.md written once more.
#include "core/accuracy/knobs.h"
#include "core/render/picture_sweep.h"
#include "core/scene/text.h"
#include "core/sdf/raycast.h"
#include "render/closed_forms.h"
#include "render/headless.h"
#include "sdf/draw.h"

#include <algorithm>
#include <atomic>
#include <thread>

using namespace mb;

namespace {

double encoded(double light) {
    const double x = std::clamp(light, 0.0, 1.0);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

/// What a point is made of.
struct Paint {
    glm::dvec3 color{0};
    double ka = 0, kd = 0, ks = 0, kr = 0, c = 0;
};
Paint mixed(const Paint& a, const Paint& b, double s) {
    const auto mix = [s](auto x, auto y) { return x * (1 - s) + y * s; };
    return {mix(a.color, b.color), mix(a.ka, b.ka), mix(a.kd, b.kd), mix(a.ks, b.ks), mix(a.kr, b.kr), mix(a.c, b.c)};
}

/// A scene in double by the program's field: what its pixels show.
class World2 {
public:
    explicit World2(const Scene& scene) : scene_(scene), tree_(makeTree(scene)) { grid_.follow(tree_); }

    struct Met {
        double t = 0;
        glm::dvec3 at{0}, normal{0};
        int leaf = -1, object = -1;
    };
    std::optional<Met> meet(const DoubleRay& ray) const {
        const RayEnd end = raycast(grid_, ray.origin, ray.direction, scene_.render.max_distance);
        if (end.state != RayState::hit) return std::nullopt;
        Met met{end.t, ray.origin + end.t * ray.direction, {}, end.leaf, tree_.leaves[static_cast<std::size_t>(end.leaf)].object};
        met.normal = normalAt(met.at);
        if (glm::dot(met.normal, ray.direction) > 0) met.normal = -met.normal;
        return met;
    }
    glm::dvec3 light(DoubleRay ray) const {
        glm::dvec3 sum{0};
        double weight = 1;
        for (int bounce = 0; bounce < 24; ++bounce) {
            const std::optional<Met> met = meet(ray);
            if (!met) return sum + weight * scene_.world.background;
            const Paint paint = paintAt(*met);
            const glm::dvec3 off = met->at + 1e-7 * (1 + met->t) * met->normal;
            sum += weight * paint.ka * paint.color;
            for (const Light& l : scene_.lights) sum += weight * fromLight(l, *met, off, paint, ray.direction);
            weight *= scene_.render.reflections > 0 ? paint.kr : 0;
            if (weight < 1e-5) return sum;
            ray = {off, ray.direction - 2 * glm::dot(ray.direction, met->normal) * met->normal};
        }
        return sum;
    }

private:
    /// On a crease the dual numbers' slope may be 0: then that of a point beside it.
    glm::dvec3 normalAt(glm::dvec3 at) const {
        glm::dvec3 g = slope(tree_, at).gradient;
        for (int k = 0; k < 8 && glm::length(g) < 0.1; ++k)
            g = slope(tree_, at + 1e-9 * glm::dvec3(k & 1 ? 1 : -1.1, k & 2 ? 1.2 : -1.3, k & 4 ? 1.4 : -1.5)).gradient;
        return glm::normalize(g);
    }
    glm::dvec3 fromLight(const Light& l, const Met& met, glm::dvec3 off, const Paint& paint, glm::dvec3 direction) const {
        const double far = glm::length(l.pos - met.at);
        const glm::dvec3 to = (l.pos - met.at) / far;
        const double cosine = glm::dot(met.normal, to);
        if (cosine <= 0) return glm::dvec3{0};
        if (scene_.render.shadow_steps > 0 && raycast(grid_, off, l.pos - off, glm::length(l.pos - off)).state == RayState::hit) return glm::dvec3{0};
        const glm::dvec3 mirrored = 2 * cosine * met.normal - to;
        const double shine = std::max(-glm::dot(mirrored, direction), 0.0);
        return l.intensity * l.color * (paint.kd * cosine * paint.color + glm::dvec3(shine > 0 ? paint.ks * std::pow(shine, paint.c) : 0));
    }
    Paint paintOf(const Leaf& leaf, glm::dvec3 world) const {
        const Material& m = materialOf(scene_, leaf.material);
        const glm::dvec3 p = glm::transpose(leaf.rotation) * (world - leaf.position) - 1e-3;
        const long field = std::lround(std::floor(p.x) + std::floor(p.y) + std::floor(p.z));
        return {m.pattern == Pattern::checker && field % 2 != 0 ? m.color2 : m.color, m.ka, m.kd, m.ks, m.kr, m.c};
    }
    /// Of a blend, each by how much the value moves with that child's (shape.h: from 0, the first child alone, to 1, the second
    /// alone; a plain fold's first child where both are as near). By differences of the fold itself. No scene here has a warp.
    Paint paintAt(const Met& met) const {
        struct Value {
            double distance;
            Paint paint;
        };
        std::vector<Value> stack;
        const double tie = 1e-9 * (met.t + glm::length(met.at)) + 1e-9, h = 1e-6;
        for (const Instruction& step : tree_.program) {
            if (step.kind == Instruction::Kind::leaf) {
                const Leaf& leaf = tree_.leaves[step.index];
                const glm::dvec3 p = glm::transpose(leaf.rotation) * (met.at - leaf.position);
                stack.push_back({leaf.primitive->distance<double>({p.x, p.y, p.z}, leaf.numbers), paintOf(leaf, met.at)});
                continue;
            }
            const Value b = stack.back();
            stack.pop_back();
            Value& a = stack.back();
            if (step.kind == Instruction::Kind::join) {
                if (b.distance < a.distance - tie) a.paint = b.paint;
                a.distance = std::min(a.distance, b.distance);
                continue;
            }
            const Branch& branch = tree_.branches[step.index];
            const auto fold = [&](double x, double y) { return branch.op->fold<double>(x, y, branch.blend); };
            double share = std::fabs(fold(a.distance, b.distance + h) - fold(a.distance, b.distance - h)) / (2 * h);
            if (branch.blend <= 0) share = std::fabs(fold(a.distance, b.distance) - a.distance) > tie;
            a = {fold(a.distance, b.distance), mixed(a.paint, b.paint, std::clamp(share, 0.0, 1.0))};
        }
        return stack.back().paint;
    }

    const Scene& scene_;
    Tree tree_;
    Grid grid_;
};

struct Pixel {
    bool hit = false, smooth = false;
    double depth = 0;
    glm::dvec3 normal{0}, color{0}, middle{0};
    int object = -1;
};

/// The ray through a point of the picture, in pixels from its top left corner: the middle of a pixel of a much finer picture.
DoubleRay borderRay(const Camera& c, glm::ivec2 size, double x, double y) {
    constexpr int kFine = 1 << 20;
    return pixelRay(c, size * kFine, static_cast<int>(x * kFine), static_cast<int>(y * kFine));
}

/// A pixel's middle, whether its corners and the middles of its sides show the same smooth surface, and the mean of its own grid of
/// rays: 5 by 5, or 12 by 12 where these differ.
Pixel pixelOf(const World2& world, const Camera& camera, glm::ivec2 size, int x, int y) {
    Pixel pixel;
    const auto ray = [&](int side, int i, int j) { return pixelRay(camera, size * side, x * side + i, y * side + j); };
    const glm::dvec3 at_middle = world.light(ray(1, 0, 0));
    pixel.middle = {encoded(at_middle.x), encoded(at_middle.y), encoded(at_middle.z)};
    if (const auto middle = world.meet(ray(1, 0, 0))) {
        pixel.hit = pixel.smooth = true, pixel.depth = middle->t, pixel.normal = middle->normal, pixel.object = middle->object;
        for (int k = 0; k < 9 && pixel.smooth; ++k) {
            const auto met = world.meet(borderRay(camera, size, x + 0.5 * (k % 3), y + 0.5 * (k / 3)));
            pixel.smooth = met && met->object == pixel.object && glm::degrees(std::acos(std::min(glm::dot(met->normal, pixel.normal), 1.0))) < 15;
        }
    }
    for (const int side : {5, 12}) {
        glm::dvec3 sum{0}, least{1e9}, most{-1e9};
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i) {
                const glm::dvec3 light = world.light(ray(side, i, j));
                sum += light, least = glm::min(least, light), most = glm::max(most, light);
            }
        const glm::dvec3 mean = sum / static_cast<double>(side * side);
        pixel.color = {encoded(mean.x), encoded(mean.y), encoded(mean.z)};
        if (encoded(most.x) - encoded(least.x) + encoded(most.y) - encoded(least.y) + encoded(most.z) - encoded(least.z) < 2.0 / 255) break;
    }
    return pixel;
}
std::vector<Pixel> truthOf(const Scene& scene, const Camera& camera, glm::ivec2 size) {
    const World2 world(scene);
    std::vector<Pixel> pixels(static_cast<std::size_t>(size.x * size.y));
    std::atomic<int> next{0};
    const auto work = [&] {
        for (int y = next++; y < size.y; y = next++)
            for (int x = 0; x < size.x; ++x) pixels[static_cast<std::size_t>(y * size.x + x)] = pixelOf(world, camera, size, x, y);
    };
    std::vector<std::thread> threads;
    for (unsigned i = 1; i < std::max(1u, std::thread::hardware_concurrency()); ++i) threads.emplace_back(work);
    work();
    for (std::thread& t : threads) t.join();
    return pixels;
}

/// The definitions of picture_errors.h, computed once more.
Values<Error> recomputed(const DrawnPicture& drawn, const std::vector<Pixel>& truth) {
    double color = 0, shade = 0, depth = 0, normal = 0;
    int wrong = 0, smooth = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const Pixel& p = truth[i];
        for (int c = 0; c < 3; ++c) {
            color += std::pow(encoded(drawn.shown[i][c]) - p.color[c], 2) / 3;
            shade += std::pow(encoded(drawn.middle[i][c]) - p.middle[c], 2) / 3;
        }
        const double state = drawn.channels.state[i], d = drawn.channels.depth[i];
        const bool other = state == 2 || (state == 1) != p.hit || (p.hit && (drawn.channels.object[i] != static_cast<float>(p.object) || std::fabs(d / p.depth - 1) > 0.1));
        wrong += other;
        if (other || !p.smooth) continue;
        const glm::dvec3 n(drawn.channels.normal[i]);
        depth += std::pow((d - p.depth) / p.depth, 2);
        normal += std::pow(glm::degrees(std::atan2(glm::length(glm::cross(n, p.normal)), glm::dot(n, p.normal))), 2);
        ++smooth;
    }
    const double n = static_cast<double>(truth.size());
    Values<Error> errors;
    errors[Error::color] = std::sqrt(color / n), errors[Error::shade] = std::sqrt(shade / n), errors[Error::state] = wrong / n;
    errors[Error::depth] = smooth ? std::sqrt(depth / smooth) : 0, errors[Error::normal] = smooth ? std::sqrt(normal / smooth) : 0;
    return errors;
}

Setting randomSetting(Draw& draw, const Scene& scene) {
    Setting setting = settingOf(scene);
    for (const Knob* knob : knobsOf(scene, false)) {
        std::vector<double> values;
        for (const double v : knob->values)
            if (knob->key != "samples" || v <= 4) values.push_back(v);
        setting = turned(setting, *knob, values[static_cast<std::size_t>(draw.below(static_cast<int>(values.size())))]);
    }
    return setting;
}

}  // namespace

// A color differs by what the two grids of rays make of edges (some 2 % of an error); states, depths and normals by nothing that can be
// seen. An error below the least of its row counts as that.
TEST_CASE("errors: 50 random settings on six scenes, as recomputed by other means, within 5 %") {
    HeadlessRenderer headless;
    const glm::ivec2 size{40, 22};
    Values<Error> worst;
    int settings = 0;
    for (const char* name : {"welcome", "mirrors", "three_lights", "die", "blends", "gallery"}) {
        INFO(std::string(name));
        const LoadResult loaded = loadScene(std::string(MARCHBOX_SOURCE "/saves/") + name + ".txt");
        REQUIRE(loaded.ok());
        const Scene& scene = loaded.scene;
        const Camera camera = defaultCamera(scene);
        TruePictureWork work(scene, {camera, size, 1});
        work.finish();
        const std::vector<Pixel> truth = truthOf(scene, camera, size);
        double apart = 0;
        int smooth = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const glm::dvec3 d = truth[i].color - work.picture().color[i];
            apart += glm::dot(d, d) / 3, smooth += truth[i].smooth != static_cast<bool>(work.picture().smooth[i]);
        }
        MESSAGE(std::string(name) << ": the two truths' colors are " << std::sqrt(apart / static_cast<double>(truth.size())) << " apart, the reference says " << work.picture().noise << "; smooth differs in " << smooth);
        Draw draw(streamOf(name));
        for (int k = 0; k < (settings < 18 ? 9 : 8); ++k, ++settings) {
            const Scene set = withSetting(scene, randomSetting(draw, scene));
            DrawnPicture picture;
            Values<Cost> costs;
            REQUIRE(drawn(*headless.renderer, set, {camera, size, 1}, picture, costs) == "");
            const Values<Error> measured = errorsOf(picture, work.picture()), again = recomputed(picture, truth);
            for (const Error e : {Error::color, Error::shade, Error::state, Error::depth, Error::normal}) {
                const double floor = std::max(rowOf(e).least, 1e-9), a = std::max(measured[e], floor), b = std::max(again[e], floor);
                const double off = std::fabs(a - b) / std::max(a, b);
                if (std::isnan(worst[e]) || off > worst[e]) worst[e] = off;
                CHECK(off <= 0.05);  // false for NaN too
                if (!(off <= 0.05)) MESSAGE(std::string(name) << " " << rowOf(e).name << ": " << measured[e] << " against " << again[e] << " at " << differences(settingOf(set), settingOf(scene)));
            }
        }
    }
    for (const Error e : {Error::color, Error::shade, Error::state, Error::depth, Error::normal}) MESSAGE("worst " << rowOf(e).name << ": " << worst[e]);
    CHECK(settings == 50);
}
