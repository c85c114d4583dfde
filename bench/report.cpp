#include "bench/report.h"

#include "core/render/gl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <memory>

namespace mb::bench {

double rounded(double x) { return std::strtod(fmt::format("{:.4g}", x).c_str(), nullptr); }

Json toJson(const Spread& s) { return {{"median", rounded(s.median)}, {"min", rounded(s.min)}, {"max", rounded(s.max)}}; }

Json lineOf(const Bench& bench, std::string_view figure, const Model& model) {
    return {{"figure", figure}, {"scene", model.family}, {"n", model.n}, {"width", bench.options.size.x}, {"height", bench.options.size.y}};
}

void skip(const Bench& bench, Json line, std::string_view why) {
    line["skipped"] = why.substr(0, why.find('\n'));
    bench.print(line);
}

std::vector<int> sizesOf(const Bench& bench, std::initializer_list<int> sizes) {
    constexpr int kQuick = 10;
    std::vector<int> wanted(sizes);
    if (bench.options.quick) std::erase_if(wanted, [](int n) { return n > kQuick; });
    return wanted;
}

void addRatio(Json& line, const Turns& turns, std::string_view ratio_of, std::size_t a, std::size_t b) {
    line["rounds"] = turns.ms[a].size();
    line["ratio_of"] = ratio_of;
    line["ratio"] = toJson(ratio(turns.ms[a], turns.ms[b]));
    if (turns.foreign_cores) line["foreign_cores"] = std::round(100 * *turns.foreign_cores) / 100;
}

double processorMs() { return 1000 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Contender marchbox(Bench& bench, const Scene& scene) {
    // A renderer of its own: the grid of the scene before it is not this one's to build again in each round.
    const auto renderer = std::make_shared<Renderer>();
    return [&bench, &scene, renderer] {
        return timeOf([&] {
            renderer->draw(scene, scene.cameras[0], bench.options.size);
            gl.Finish();
        });
    };
}

namespace {
PerPixel perPixel(const Counts& counts, const Counts::ByKind& kinds) {
    const double pixels = static_cast<double>(counts.rays.primary);
    const auto share = [&](std::uint64_t count) { return static_cast<double>(count) / pixels; };
    return {share(kinds.primary), share(kinds.normal), share(kinds.shadow), share(kinds.reflection)};
}
}  // namespace

PerPixel evaluations(const Counts& counts) {
    return perPixel(counts, counts.evaluations);
}

PerPixel touched(const Counts& counts) { return perPixel(counts, counts.touched); }

Json toJson(const PerPixel& c) {
    return {{"primary", rounded(c.primary)}, {"normal", rounded(c.normal)}, {"shadow", rounded(c.shadow)},
            {"reflection", rounded(c.reflection)}, {"all", rounded(c.primary + c.normal + c.shadow + c.reflection)}};
}

}  // namespace mb::bench
