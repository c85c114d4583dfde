#pragma once
// What the figures share: what was asked for, and the lines they print.
#include "bench/scenes.h"
#include "core/measure/timing.h"
#include "core/render/renderer.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace mb::bench {

using Json = nlohmann::ordered_json;

struct Options {
    int rounds = 5;
    glm::ivec2 size{512, 512};
    std::uint32_t seed = kSeed;
    bool quick = false;               // the smaller scenes only
    std::vector<std::string> only;    // names of figures; none: all
};

struct Bench {
    const Options& options;
    Renderer& renderer;
    std::function<void(const Json&)> print;             // a line of the report
    std::function<void(const std::string&)> say;        // what is being done, for a terminal
};

/// Four significant digits: more are noise, and shorter lines are read.
double rounded(double x);
Json toJson(const Spread& spread);

/// The beginning of a figure's line.
Json lineOf(const Bench& bench, std::string_view figure, const Model& model);
/// The line of a figure that cannot be had, with the reason's first line.
void skip(const Bench& bench, Json line, std::string_view why);

/// Those of the numbers of primitives that were asked for.
std::vector<int> sizesOf(const Bench& bench, std::initializer_list<int> sizes);

/// Adds to a line the ratio of contender a's times to b's, and what else is said of turns.
void addRatio(Json& line, const Turns& turns, std::string_view ratio_of, std::size_t a, std::size_t b);

/// Processor time that this program took so far, in ms: of all its threads.
double processorMs();

/// Draws a scene with marchbox, to the last pixel. The scene must have been drawn once.
Contender marchbox(Bench& bench, const Scene& scene);

/// Something counted a pixel, by what asked.
struct PerPixel {
    double primary, normal, shadow, reflection;
};
PerPixel evaluations(const Counts& counts);
/// Primitives evaluated for that.
PerPixel touched(const Counts& counts);
Json toJson(const PerPixel& counts);

}  // namespace mb::bench
