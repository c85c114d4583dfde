// How the time of a whole picture grows with the number of primitives. All sizes take turns in one run.
#include "bench/errors.h"
#include "bench/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <list>

namespace mb::bench {
namespace {

constexpr int kUnit = 100;  // primitives of the time that is 1

struct Size {
    Model model;
    Scene scene;
    Json line;
};

/// Those that can be drawn; the others are skipped.
std::list<Size> drawable(Bench& bench) {
    std::list<Size> sizes;
    for (const int n : {10, kUnit, 1000, 10'000}) {
        if (bench.options.quick && n > kUnit) break;
        bench.say(fmt::format("growth: {} primitives", n));
        Model model = makeModel("union", n, bench.options.seed);
        Scene scene = sceneOf(model);
        Json line = lineOf(bench, "growth", model);
        if (const std::string why = bench.renderer.draw(scene, scene.cameras[0], bench.options.size); why.empty())
            sizes.push_back({std::move(model), std::move(scene), std::move(line)});
        else skip(bench, std::move(line), why);
    }
    return sizes;
}

}  // namespace

void growthFigure(Bench& bench) {
    std::list<Size> sizes = drawable(bench);
    const auto unit = std::ranges::find(sizes, kUnit, [](const Size& s) { return s.model.n; });
    if (unit == sizes.end()) return;
    std::vector<Contender> contenders;
    for (const Size& size : sizes) contenders.push_back(marchbox(bench, size.scene));
    bench.say("growth: taking turns");
    const Turns turns = takeTurns(contenders, bench.options.rounds);

    const auto unit_at = static_cast<std::size_t>(std::distance(sizes.begin(), unit));
    for (std::size_t at = 0; Size& size : sizes) {
        const std::size_t own = at++;
        Measured measured;
        const Camera& camera = size.scene.cameras[0];
        if (const std::string why = bench.renderer.measure(size.scene, camera, bench.options.size, measured); !why.empty()) {
            skip(bench, size.line, why);
            continue;
        }
        addRatio(size.line, turns, fmt::format("n/{}", kUnit), own, unit_at);
        size.line["ms"] = {{"marchbox", rounded(median(turns.ms[own]))}};
        size.line["error"] = {{"marchbox", errorsOf(surfacesOf(measured.channels), truthOf(size.model, bench.options.size))}};
        bench.print(size.line);
    }
}

}  // namespace mb::bench
