// Balls that fall into a bin and settle: marchbox against engines that step all bodies at once. One thread each.
#include "bench/figure_bins.h"

#include "bench/bin.h"
#include "bench/figure_pile.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb::bench {
namespace {

/// marchbox, then the peers that were asked for and are there. What is missing is said.
std::vector<const BinEngine*> enginesFor(PhysicsBench& bench) {
    std::vector<const BinEngine*> engines;
    for (const BinEngine& engine : binEngines()) {
        const bool own = engines.empty(), all = bench.options.only.empty();
        if (!own && !all && std::ranges::find(bench.options.only, engine.name) == bench.options.only.end()) continue;
        const std::string why = fmt::format("marchbox was built without it (Debian: apt-get install {}, then build)", engine.package);
        if (engine.make) engines.push_back(&engine);
        else bench.print({{"figure", "bin"}, {"engine", engine.name}, {"skipped", why}});
    }
    return engines;
}

/// A contender that lets a new bin run to its end; where the balls are then goes to `out_positions`.
Contender runOf(const BinEngine& engine, const SphereBin& bin, std::vector<glm::dvec3>& out_positions) {
    return [&engine, &bin, &out_positions] {
        const std::unique_ptr<BinPeer> peer = engine.make(bin);
        const double ms = timeOf([&] {
            for (int i = 0; i < SphereBin::kSteps; ++i) peer->step();
        });
        out_positions = peer->positions();
        return ms / SphereBin::kSteps;
    };
}

void compare(PhysicsBench& bench, std::span<const BinEngine* const> engines, int balls) {
    bench.say(fmt::format("bin: {} balls, {} engines in {} rounds and one before", balls, engines.size(), bench.options.rounds));
    const SphereBin bin = makeBin(balls, bench.options.seed);
    std::vector<std::vector<glm::dvec3>> ends(engines.size());
    std::vector<Contender> contenders;
    for (std::size_t i = 0; i < engines.size(); ++i) contenders.push_back(runOf(*engines[i], bin, ends[i]));
    const Turns turns = takeTurns(contenders, bench.options.rounds);
    for (std::size_t i = 0; i < engines.size(); ++i) {
        Json line{{"figure", "bin"}, {"balls", balls}, {"steps", SphereBin::kSteps}, {"engine", engines[i]->name}};
        if (!engines[i]->version.empty()) line["version"] = engines[i]->version;
        if (i > 0) addRatio(line, turns, fmt::format("{}/{}", engines[i]->name, engines[0]->name), i, 0);
        line["ms_a_step"] = rounded(median(turns.ms[i]));
        const Overlaps o = overlapsOf(bin, ends[i]);
        line["overlap"] = {{"largest", rounded(o.largest)}, {"mean", rounded(o.mean)}, {"count", o.count}};
        line["outside"] = o.outside;
        bench.print(line);
    }
}

}  // namespace

void runPhysics(PhysicsBench& bench) {
    bench.print({{"figure", "about"}, {"rounds", bench.options.rounds}, {"seed", bench.options.seed}});
    const std::vector<const BinEngine*> engines = enginesFor(bench);
    for (const int balls : bench.options.balls) compare(bench, engines, balls);
    for (const int dice : bench.options.dice) printPile(bench, dice);
}

std::string inWords(const Json& line) {
    if (!line.contains("ms_a_step")) return {};
    if (line["figure"] == "pile")
        return fmt::format("{:>6} carved dice{:>13} ms a step, {} of them asleep after {} s, overlaps {:.5f} m at most", line["dice"].get<int>(),
                           line["ms_a_step"].dump(), line["asleep"].get<int>(), line["seconds_to_rest"].dump(),
                           line["overlap"]["largest"].get<double>());
    const Json& overlap = line["overlap"];
    std::string text = fmt::format("{:>6} balls  {:<9}{:>9} ms a step, overlaps {:.4f} m at most, {:.5f} m in the mean",
                                   line["balls"].get<int>(), line["engine"].get<std::string>(), line["ms_a_step"].dump(),
                                   overlap["largest"].get<double>(), overlap["mean"].get<double>());
    if (line.contains("ratio")) text += fmt::format("; {} {}", line["ratio_of"].get<std::string>(), line["ratio"]["median"].dump());
    if (const int outside = line["outside"].get<int>(); outside > 0) text += fmt::format("; {} left the bin", outside);
    return text;
}

}  // namespace mb::bench
