// marchbox bench: the benchmarks of bench/, as JSON lines.
#include "cli/cli.h"

#include "bench/figures.h"
#include "core/render/gl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include <unistd.h>

namespace mb::cli {
namespace {

struct FigureOptions {
    bench::Options bench;
    std::string size;
};

std::string figureNames() {
    std::string names;
    for (const bench::Figure& figure : bench::figures()) names += fmt::format("{}{}", names.empty() ? "" : ", ", figure.name);
    return names;
}

void checkNames(const std::vector<std::string>& only) {
    for (const std::string& name : only)
        if (std::ranges::find(bench::figures(), name, &bench::Figure::name) == bench::figures().end())
            throw Failure{kCommandFault, fmt::format("--only {}: there are {}", name, figureNames())};
}

std::uint32_t parseSeed(const Common& common) {
    if (common.seed > std::numeric_limits<std::uint32_t>::max())
        throw Failure{kCommandFault, fmt::format("--seed {}: the scenes' generator takes 32 bits", common.seed)};
    return static_cast<std::uint32_t>(common.seed);
}

/// Makes the pictures of `figures` with a context of their own.
void draw(const FigureOptions& options, const Common& common, void (*figures)(bench::Bench&)) {
    const auto context = headlessContext();
    checkSize(options.bench.size);
    Renderer renderer;
    const bool terminal = !common.quiet && isatty(STDERR_FILENO);
    bench::Bench bench{options.bench, renderer,
                       [](const bench::Json& line) { writeText("-", line.dump() + '\n'); },
                       [&](const std::string& what) {
                           if (!terminal) return;
                           fmt::print(stderr, "\r\033[K{}", what);
                           std::fflush(stderr);
                       }};
    figures(bench);
    if (terminal) fmt::print(stderr, "\r\033[K");
}

/// The options that all figures of pictures have.
void addOptions(CLI::App& figures, FigureOptions& o) {
    figures.fallthrough();
    figures.add_option("--rounds", o.bench.rounds, "turns each contender takes")->capture_default_str()->check(within(5, 1000));
    figures.add_option("--size", o.size, "WxH pixels (512x512; 64x64 with --quick)");
}
void readSize(FigureOptions& o) {
    if (!o.size.empty()) o.bench.size = parseSize(o.size);
    else if (o.bench.quick) o.bench.size = {64, 64};
}

std::function<void()> make(CLI::App& app, Common& common) {
    app.require_subcommand(1);
    CLI::App* render = app.add_subcommand("render", "pictures: against the first shader, against POV-Ray, and in counts");
    render->footer("Example:\n  marchbox bench render --only counts");
    const auto r = std::make_shared<FigureOptions>();
    addOptions(*render, *r);
    render->add_option("--only", r->bench.only, "the figures wanted, a list with commas, of " + figureNames())->delimiter(',');
    render->add_flag("--quick", r->bench.quick, "small scenes and pictures only: does it work?");

    CLI::App* effects = app.add_subcommand("effects", "what the effects cost that a scene does not call for: against shaders that never had them");
    effects->footer("Example:\n  marchbox bench effects --rounds 51");
    const auto e = std::make_shared<FigureOptions>();
    e->bench.rounds = 21;  // to tell 2 %
    addOptions(*effects, *e);
    effects->add_flag("--quick", e->bench.quick, "small pictures and five rounds: does it work?");
    return [=, &app, &common] {
        readSize(*r), readSize(*e);
        if (app.count("--seed") > 0) r->bench.seed = parseSeed(common);
        checkNames(r->bench.only);
        if (e->bench.quick && effects->count("--rounds") == 0) e->bench.rounds = 5;
        if (*effects) draw(*e, common, bench::runEffects);
        else draw(*r, common, bench::run);
    };
}

}  // namespace

const Command kBench{"bench", "benchmarks, as JSON lines", "marchbox bench render --only seed,growth", make};

}  // namespace mb::cli
