// marchbox bench: the benchmarks of bench/, as JSON lines.
#include "cli/cli.h"

#include "bench/bin.h"
#include "bench/figure_bins.h"
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

/// The names of a table's rows.
template <class Row> std::string namesOf(std::span<const Row> rows) {
    std::string names;
    for (const Row& row : rows) names += fmt::format("{}{}", names.empty() ? "" : ", ", row.name);
    return names;
}
template <class Row> void checkNames(const std::vector<std::string>& only, std::span<const Row> rows) {
    for (const std::string& name : only)
        if (std::ranges::find(rows, name, &Row::name) == rows.end())
            throw Failure{kCommandFault, fmt::format("--only {}: there are {}", name, namesOf(rows))};
}
std::span<const bench::BinEngine> peers() { return bench::binEngines().subspan(1); }

std::uint32_t parseSeed(const Common& common) {
    if (common.seed > std::numeric_limits<std::uint32_t>::max())
        throw Failure{kCommandFault, fmt::format("--seed {}: the scenes' generator takes 32 bits", common.seed)};
    return static_cast<std::uint32_t>(common.seed);
}

/// What is being done, on a line that overwrites itself where standard error is a terminal.
class Doing {
public:
    explicit Doing(const Common& common) : terminal_(!common.quiet && isatty(STDERR_FILENO)) {}
    ~Doing() { say({}); }
    bool terminal() const { return terminal_; }
    void say(const std::string& what) const {
        if (!terminal_) return;
        fmt::print(stderr, "\r\033[K{}", what);
        std::fflush(stderr);
    }

private:
    bool terminal_;
};

void printLine(const bench::Json& line) { writeText("-", line.dump() + '\n'); }

/// Makes the pictures of `figures` with a context of their own.
void draw(const FigureOptions& options, const Common& common, void (*figures)(bench::Bench&)) {
    const auto context = headlessContext();
    checkSize(options.bench.size);
    Renderer renderer;
    const Doing doing(common);
    bench::Bench bench{options.bench, renderer, printLine, [&](const std::string& what) { doing.say(what); }};
    figures(bench);
}

/// Lets the engines of physics run, and tells a terminal at the end what came out.
void collide(const bench::PhysicsOptions& options, const Common& common) {
    std::string words;
    const Doing doing(common);
    bench::PhysicsBench bench{options,
                              [&](const bench::Json& line) {
                                  printLine(line);
                                  if (const std::string text = bench::inWords(line); !text.empty()) words += text + '\n';
                              },
                              [&](const std::string& what) { doing.say(what); }};
    bench::runPhysics(bench);
    doing.say({});
    if (doing.terminal()) fmt::print(stderr, "{}", words);
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
    render->add_option("--only", r->bench.only, "the figures wanted, a list with commas, of " + namesOf(bench::figures()))->delimiter(',');
    render->add_flag("--quick", r->bench.quick, "small scenes and pictures only: does it work?");

    CLI::App* effects = app.add_subcommand("effects", "what the effects cost that a scene does not call for: against shaders that never had them");
    effects->footer("Example:\n  marchbox bench effects --rounds 51");
    const auto e = std::make_shared<FigureOptions>();
    e->bench.rounds = 21;  // to tell 2 %
    addOptions(*effects, *e);
    effects->add_flag("--quick", e->bench.quick, "small pictures and five rounds: does it work?");

    CLI::App* physics = app.add_subcommand("physics", "balls in a bin against Bullet and ODE, and a pile of carved dice: time a step and overlaps");
    physics->footer("Example:\n  marchbox bench physics --only bullet --balls 500,2000");
    const auto p = std::make_shared<bench::PhysicsOptions>();
    physics->fallthrough();
    physics->add_option("--rounds", p->rounds, "turns each engine takes")->capture_default_str()->check(within(3, 1000));
    physics->add_option("--balls", p->balls, "how many in each bin, a list with commas")->delimiter(',')->capture_default_str()
        ->check(within(1, 100'000));
    physics->add_option("--dice", p->dice, "how many carved dice in each pile, a list with commas")->delimiter(',')->capture_default_str()
        ->check(within(1, 10'000));
    physics->add_option("--only", p->only, "the engines compared with, a list with commas, of " + namesOf(peers()) + "; no pile then, but with --dice")->delimiter(',');
    const auto quick = std::make_shared<bool>(false);
    physics->add_flag("--quick", *quick, "one bin of 27 balls, one pile of 27 dice: does it work?");
    return [=, &app, &common] {
        readSize(*r), readSize(*e);
        if (app.count("--seed") > 0) r->bench.seed = parseSeed(common), p->seed = common.seed;
        if (!p->only.empty() && physics->count("--dice") == 0) p->dice.clear();
        if (*quick) p->balls = {27}, p->dice.assign(p->dice.empty() ? 0 : 1, 27);
        checkNames(r->bench.only, bench::figures()), checkNames(p->only, peers());
        if (e->bench.quick && effects->count("--rounds") == 0) e->bench.rounds = 5;
        if (*physics) collide(*p, common);
        else if (*effects) draw(*e, common, bench::runEffects);
        else draw(*r, common, bench::run);
    };
}

}  // namespace

const Command kBench{"bench", "benchmarks, as JSON lines", "marchbox bench render --only seed,growth", make};

}  // namespace mb::cli
