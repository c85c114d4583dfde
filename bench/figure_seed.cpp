// The whole picture against the shader marchbox began from: the same scene, camera, light, reflections and pixels.
#include "bench/errors.h"
#include "bench/figures.h"
#include "bench/seed.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb::bench {
namespace {

constexpr int kReflections = 2;  // the seed's loop of three rays: what is seen, and two reflections

Surfaces seedSurfaces(const SeedPicture& picture) {
    Surfaces s{picture.object, picture.depth, {}, {}};
    for (const bool whole : picture.whole) s.left_out.push_back(!whole);
    return s;
}

void compare(Bench& bench, int n) {
    const Model model = makeModel("union", n, bench.options.seed);
    const Scene scene = sceneOf(model, kReflections);
    Json line = lineOf(bench, "seed", model);
    bench.say(fmt::format("seed: {} primitives", n));
    const Camera& camera = scene.cameras[0];
    const glm::ivec2 size = bench.options.size;
    if (const std::string why = bench.renderer.draw(scene, camera, size); !why.empty()) return skip(bench, line, why);
    Seed seed(model, size);
    if (const std::string why = seed.prepare(); !why.empty()) return skip(bench, line, why);

    const Contender contenders[] = {marchbox(bench, scene), [&] { return timeOf([&] { seed.draw(); }); }};
    const Turns turns = takeTurns(contenders, bench.options.rounds);
    Measured measured;
    if (const std::string why = bench.renderer.measure(scene, camera, size, measured); !why.empty()) return skip(bench, line, why);

    const TruthPicture truth = truthOf(model, size);
    const SeedPicture picture = seed.read();
    const Errors ours = errorsOf(surfacesOf(measured.channels), truth), seeds = errorsOf(seedSurfaces(picture), truth);
    const double whole = static_cast<double>(std::ranges::count(picture.whole, true)) / static_cast<double>(picture.whole.size());
    addRatio(line, turns, "seed/marchbox", 1, 0);
    line["ms"] = {{"marchbox", rounded(median(turns.ms[0]))}, {"seed", rounded(median(turns.ms[1]))}};
    line["error"] = {{"marchbox", ours}, {"seed", seeds}};
    line["no_worse"] = noWorse(ours, seeds);
    line["seed_whole"] = rounded(whole);
    if (whole < 1)
        line["note"] = "the driver ended the seed's shader early in some pixels: its time is a lower bound, its error of whole pixels only";
    bench.print(line);
}

}  // namespace

void seedFigure(Bench& bench) {
    for (const int n : sizesOf(bench, {10, 100, 1000})) compare(bench, n);
}

}  // namespace mb::bench
