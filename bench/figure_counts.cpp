// What a picture takes in evaluations and primitives, and its march against the least possible: exact, and the same on
// every machine.
#include "bench/cover.h"
#include "bench/errors.h"
#include "bench/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mb::bench {
namespace {

constexpr double kTolerance = 1e-3;  // m: how near is a hit in a parallel view

/// Where the ray is inside the box; of a perspective view all of it, the ground having no box.
std::pair<double, double> reach(const Model& model, const Box& box, const Ray& ray) {
    double from = 0, to = model.far;
    if (model.camera.ortho <= 0) return {from, to};
    to = INFINITY;
    for (std::size_t i = 0; i < 3; ++i) {
        const int axis = static_cast<int>(i);
        const double a = (box.lo[i] - ray.origin[axis]) / ray.direction[axis];
        const double b = (box.hi[i] - ray.origin[axis]) / ray.direction[axis];
        from = std::max(from, std::min(a, b)), to = std::min(to, std::max(a, b));
    }
    return {from, to};
}

/// Means over the pixels asked: the least evaluations, those of plain sphere tracing, and what marchbox takes.
struct Marches {
    int stride = 1;
    double pixels = 0, least = 0, plain = 0, own = 0;
};
Marches marches(const Model& model, glm::ivec2 size, const Channels* channels) {
    const Tree tree = makeTree(sceneOf(model));
    const Box box = bounds(tree);
    const double pixel = 2 * viewOf(model.camera).half / size.y;
    const auto tolerance = [&](double t) { return model.camera.ortho > 0 ? kTolerance : std::max(1e-4, pixel / 2 * t); };
    Marches m;
    m.stride = std::max(4, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(size.x) * size.y * model.n / 1.7e7))));  // seconds
    for (int y = m.stride / 2; y < size.y; y += m.stride)
        for (int x = m.stride / 2; x < size.x; x += m.stride) {
            m.pixels += 1;
            if (channels) m.own += static_cast<double>(channels->steps[static_cast<std::size_t>(y * size.x + x)]);
            const Ray ray = cameraRay(model.camera, size, {x + 0.5, y + 0.5});
            const auto [from, to] = reach(model, box, ray);
            if (from >= to) continue;
            const auto along = [&](double t) {
                const glm::dvec3 p = ray.origin + t * ray.direction;
                return distance<double>(tree, {p.x, p.y, p.z});
            };
            const March traced = sphereTrace(along, from, to, tolerance);
            m.plain += traced.evaluations;
            m.least += static_cast<double>(leastEvaluations(along, from, traced, tolerance));
        }
    m.least /= m.pixels, m.plain /= m.pixels, m.own /= m.pixels;
    return m;
}

void count(Bench& bench, std::string_view family, int n) {
    bench.say(fmt::format("counts: {}, {} primitives", family, n));
    const Model model = makeModel(family, n, bench.options.seed);
    const Scene scene = sceneOf(model);
    Json line = lineOf(bench, "counts", model);
    Measured measured;
    const std::string why = bench.renderer.measure(scene, scene.cameras[0], bench.options.size, measured);
    if (why.empty()) {
        const double pixels = static_cast<double>(measured.counts.rays.primary);
        line["rays"] = {{"shadow", rounded(static_cast<double>(measured.counts.rays.shadow) / pixels)},
                        {"reflection", rounded(static_cast<double>(measured.counts.rays.reflection) / pixels)}};
        line["evaluations"] = toJson(evaluations(measured.counts));
        line["touched"] = toJson(touched(measured.counts));
        const TruthPicture truth = truthOf(model, bench.options.size);
        line["error"] = {{"marchbox", errorsOf(surfacesOf(measured.channels), truth)}};
        line["reference"] = truth.reference;
    } else {
        line["marchbox"] = {{"skipped", why.substr(0, why.find('\n'))}};
    }
    const Marches m = marches(model, bench.options.size, why.empty() ? &measured.channels : nullptr);
    Json& march = line["march"];
    march = {{"stride", m.stride}, {"least", rounded(m.least)}, {"plain", rounded(m.plain)}};
    march["plain_over_least"] = rounded(m.plain / m.least);
    if (why.empty()) march["marchbox"] = rounded(m.own), march["marchbox_over_least"] = rounded(m.own / m.least);
    bench.print(line);
}

}  // namespace

void countsFigure(Bench& bench) {
    for (const Family& family : families())
        for (const int n : sizesOf(bench, {10, 100, 1000})) count(bench, family.name, n);
}

}  // namespace mb::bench
