// The whole picture against POV-Ray's: the same solids, camera, light, Phong, shadows and one reflection.
#include "bench/errors.h"
#include "bench/figures.h"
#include "bench/povray.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mb::bench {
namespace {

/// The share of pixels that differ by more than eight steps of 256 in some channel.
double differing(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    if (a.size() != b.size()) return 1;
    constexpr float kSteps = 8.5f / 255;
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        bool far = false;
        for (int k = 0; k < 3; ++k)
            far = far || !(std::fabs(std::clamp(a[i][k], 0.0f, 1.0f) - std::clamp(b[i][k], 0.0f, 1.0f)) <= kSteps);
        count += far;
    }
    return static_cast<double>(count) / static_cast<double>(a.size());
}

void compare(Bench& bench, std::string_view family, int n) {
    bench.say(fmt::format("povray: {}, {} primitives", family, n));
    const Model model = makeModel(family, n, bench.options.seed);
    const Scene scene = sceneOf(model);
    const Camera& camera = scene.cameras[0];
    Json line = lineOf(bench, "povray", model);
    std::string why;
    if (why = bench.renderer.draw(scene, camera, bench.options.size); !why.empty()) return skip(bench, line, why);

    Povray povray(model, bench.options.size);
    PovTimes times;
    std::vector<double> own_cpu, pov_cpu;
    const Contender draws = marchbox(bench, scene);
    const Contender contenders[] = {
        [&] {
            const double before = processorMs(), ms = draws();
            own_cpu.push_back(processorMs() - before);
            return ms;
        },
        [&] {
            if (std::string fault = povray.draw(times); !fault.empty()) why = fault;
            pov_cpu.push_back(times.cpu_ms);
            return times.trace_ms;
        }};
    const Turns turns = takeTurns(contenders, bench.options.rounds);
    const std::vector<glm::vec3> picture = bench.renderer.readPicture();
    Surfaces pov;
    Measured measured;
    if (why.empty()) why = povray.objects(pov.object);
    if (why.empty()) why = bench.renderer.measure(scene, camera, bench.options.size, measured);
    if (!why.empty()) return skip(bench, line, why);

    const TruthPicture truth = truthOf(model, bench.options.size);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < pov.object.size(); ++i) differ += pov.object[i] != measured.channels.object[i];
    addRatio(line, turns, "povray/marchbox", 1, 0);
    line["ms"] = {{"marchbox", rounded(median(turns.ms[0]))}, {"povray", rounded(median(turns.ms[1]))}};
    line["cpu_ms"] = {{"marchbox", rounded(median(own_cpu))}, {"povray", rounded(median(pov_cpu))}};
    line["error"] = {{"marchbox", errorsOf(surfacesOf(measured.channels), truth)}, {"povray", errorsOf(pov, truth)}};
    line["surfaces_differ"] = rounded(static_cast<double>(differ) / static_cast<double>(pov.object.size()));
    line["colors_differ"] = rounded(differing(picture, povray.picture()));
    line["povray"] = times.version;
    bench.print(line);
}

}  // namespace

void povrayFigure(Bench& bench) {
    if (!Povray::available())
        return bench.print({{"figure", "povray"}, {"skipped", "there is no povray on PATH (Debian: apt-get install povray)"}});
    for (const int n : sizesOf(bench, {10, 100, 1000, 10'000})) compare(bench, "union", n);
    if (bench.options.quick) return;
    for (const std::string_view family : {"carved", "tree"})
        for (const int n : sizesOf(bench, {10, 100, 1000})) compare(bench, family, n);
}

}  // namespace mb::bench
