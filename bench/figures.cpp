#include "bench/figures.h"

#include <algorithm>
#include <thread>

namespace mb::bench {
namespace {

constexpr Figure kFigures[] = {
    {"seed", "time against the shader marchbox began from, which asks every object at every step", seedFigure},
    {"growth", "time against that of 100 primitives", growthFigure},
    {"moved", "what one moved body of 10,000 costs, of a frame", movedFigure},
    {"counts", "evaluations and primitives a pixel, and the march against the least possible; the same on every machine", countsFigure},
    {"povray", "time against POV-Ray, which meets the same solids by their equations", povrayFigure},
};

}  // namespace

std::span<const Figure> figures() { return kFigures; }

namespace {
Json about(const Bench& bench) {
    return {{"figure", "about"}, {"renderer", bench.renderer.rendererName()}, {"threads", std::thread::hardware_concurrency()},
            {"rounds", bench.options.rounds}, {"seed", bench.options.seed}, {"quick", bench.options.quick}};
}
}  // namespace

void run(Bench& bench) {
    bench.print(about(bench));
    const auto& only = bench.options.only;
    for (const Figure& figure : kFigures)
        if (only.empty() || std::ranges::find(only, figure.name) != only.end()) figure.run(bench);
}

void runEffects(Bench& bench) {
    Json line = about(bench);
    line.erase("seed");  // these scenes are files
    bench.print(line);
    effectsFigure(bench);
}

}  // namespace mb::bench
