// What the effects cost that a scene does not call for: its picture against the same one by a shader written by hand, which
// never had them, and by the general shader, which has them all. And their counters, which must say 0.
#include "bench/figures.h"
#include "bench/twin.h"
#include "core/render/gl.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace mb::bench {
namespace {

constexpr double kLimit = 1.02;  // of the twin's time

/// What asks for the scene's distance on behalf of a row.
struct Kind {
    std::string_view row;
    std::uint64_t Counts::ByKind::*evaluations;
};
constexpr Kind kKinds[] = {{"ambient occlusion", &Counts::ByKind::occlusion}, {"hard shadow", &Counts::ByKind::shadow},
                           {"soft shadow", &Counts::ByKind::soft}, {"reflection", &Counts::ByKind::reflection}};

/// Pixels whose color or depth is not the same to the bit.
std::size_t differing(const Targets& a, const Targets& b) {
    const std::vector<float> colors = a.read(0), others = b.read(0), depths = a.readDepth(), other_depths = b.readDepth();
    std::size_t count = 0;
    for (std::size_t i = 0; i < depths.size(); ++i)
        count += depths[i] != other_depths[i] || !std::equal(&colors[4 * i], &colors[4 * i] + 4, &others[4 * i]);
    return count;
}

Json lineOf(const Bench& bench, std::string_view figure, const TwinRow& row) {
    return {{"figure", figure}, {"scene", row.name}, {"what", row.what}, {"width", bench.options.size.x}, {"height", bench.options.size.y}};
}

/// Adds which rows of the picture and which operators the scene goes without, how often each was used nonetheless, and what was
/// evaluated on its behalf; and how often those were used that are called for, to show that the counters count.
std::string addRows(Bench& bench, const Scene& scene, Json& line) {
    Json left_out = Json::array(), uses = Json::object(), asked = Json::object(), uses_called = Json::object();
    const Plan plan = makePlan(scene, makeTree(scene));
    for (const Effect& effect : effects()) {
        if (effect.ofMotion()) continue;
        const bool called = plan.has(effect.name);
        if (!called) left_out.push_back(effect.name);
        if (effect.counts.empty()) continue;
        Measured measured;
        if (std::string why = bench.renderer.measure(scene, scene.cameras[0], bench.options.size, measured, &effect); !why.empty()) return why;
        (called ? uses_called : uses)[std::string(effect.name)] = measured.counts.uses;
        const auto kind = std::ranges::find(kKinds, effect.name, &Kind::row);
        if (!called && kind != std::end(kKinds)) asked[std::string(effect.name)] = measured.counts.evaluations.*kind->evaluations;
    }
    line["rows_left_out"] = left_out, line["uses"] = uses, line["evaluations"] = asked, line["uses_called"] = uses_called;
    return {};
}

/// Draws with a contender and keeps how long that took. What it says itself is what a figure compares: where the processor
/// draws, its time, which other programs take next to nothing of; else the clock's.
class Drawer {
public:
    Drawer(bool by_processor, std::function<void()> draw) : by_processor_(by_processor), draw_(std::move(draw)) {}
    double operator()() {
        const double before = processorMs(), ms = timeOf(draw_), processor = processorMs() - before;
        wall_.push_back(ms), processor_.push_back(processor);
        return by_processor_ ? processor : ms;
    }
    double ms() const { return median(wall_); }
    double processor() const { return median(processor_); }

private:
    bool by_processor_;
    std::function<void()> draw_;
    std::vector<double> wall_, processor_;
};

/// What a line says of two contenders, after the turns.
struct Named {
    std::string_view name;
    std::size_t turn;
};
void add(Json& line, const Turns& turns, std::span<const Drawer> drawers, Named a, Named b) {
    addRatio(line, turns, fmt::format("{}/{}", a.name, b.name), a.turn, b.turn);
    const auto both = [&](double (Drawer::*time)() const) {
        return Json{{a.name, rounded((drawers[a.turn].*time)())}, {b.name, rounded((drawers[b.turn].*time)())}};
    };
    line["ms"] = both(&Drawer::ms), line["cpu_ms"] = both(&Drawer::processor);
}

void compare(Bench& bench, const TwinRow& row) {
    bench.say(fmt::format("effects: {}", row.name));
    const Scene scene = sceneOf(row);
    const glm::ivec2 size = bench.options.size;
    Json line = lineOf(bench, "effects", row);
    Twin twin(row, scene, size);
    if (const std::string fault = twin.fault(); !fault.empty()) return skip(bench, line, fault);
    Renderer special, general;
    general.choose({everyEffect(), {}});
    std::string why;
    const auto drawnBy = [&](Renderer& renderer) {
        return [&] {
            if (std::string fault = renderer.draw(scene, scene.cameras[0], size); !fault.empty()) why = fault;
            gl.Finish();
        };
    };
    const bool by_processor = bench.renderer.rendererName().find("llvmpipe") != std::string::npos;
    Drawer drawers[] = {{by_processor, drawnBy(special)}, {by_processor, [&] { twin.draw(); }}, {by_processor, drawnBy(general)}};
    const Contender contenders[] = {std::ref(drawers[0]), std::ref(drawers[1]), std::ref(drawers[2])};
    const Turns turns = takeTurns(contenders, bench.options.rounds);
    if (why.empty()) why = addRows(bench, scene, line);
    if (!why.empty()) return skip(bench, line, why);

    line["times"] = by_processor ? "of the processor" : "of the clock";
    add(line, turns, drawers, {"marchbox", 0}, {"twin", 1});
    line["limit"] = kLimit;
    line["within"] = ratio(turns.ms[0], turns.ms[1]).median <= kLimit;
    line["pixels_differ"] = differing(special.picture(), twin.picture());
    bench.print(line);
    Json whole = lineOf(bench, "general", row);
    add(whole, turns, drawers, {"general", 2}, {"marchbox", 0});
    whole["pixels_differ"] = differing(special.picture(), general.picture());
    bench.print(whole);
}

}  // namespace

void effectsFigure(Bench& bench) {
    for (const TwinRow& row : twins()) compare(bench, row);
}

}  // namespace mb::bench
