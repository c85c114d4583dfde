#include "cli/budget.h"

#include "core/measure/timing.h"
#include "core/render/gl.h"
#include "core/scene/text_lex.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb::cli {
namespace {

/// The names of a picture's errors, as a list with commas.
std::string errorNames() {
    std::string names;
    for (const auto& row : errorRows())
        if (!row.motion) names += fmt::format("{}{}", names.empty() ? "" : ", ", row.name);
    return names;
}

/// ms of a frame at its full size: the least of a few, after one that does not count.
double frameMs(Renderer& renderer, const Scene& scene, const Camera& camera, glm::ivec2 size) {
    constexpr int kDraws = 3;
    double least = INFINITY;
    for (int i = 0; i <= kDraws; ++i) {
        std::string why;
        const double ms = timeOf([&] {
            why = renderer.draw(scene, camera, size);
            gl.Finish();
        });
        if (!why.empty()) throw Failure{kInputFault, why};
        if (i > 0) least = std::min(least, ms);
    }
    return least;
}

}  // namespace

Budget parseBudget(const std::string& most_error, double most_ms) {
    Budget budget;
    if (!most_error.empty() && most_ms > 0) throw Failure{kCommandFault, "--max-error and --max-ms: one of them at a time"};
    if (most_ms > 0) budget.most_ms = most_ms;
    if (most_error.empty()) return budget;
    const std::size_t equals = most_error.find('=');
    const std::string name = equals == std::string::npos ? std::string(rowOf(Error::color).name) : most_error.substr(0, equals);
    const auto row = std::ranges::find(errorRows(), name, &Quantity<Error>::name);
    if (row == errorRows().end() || row->motion) throw Failure{kCommandFault, fmt::format("--max-error {}: there are {}", most_error, errorNames())};
    bool overflow = false;
    const std::optional<double> limit = text::parseNumber(equals == std::string::npos ? most_error : most_error.substr(equals + 1), overflow);
    if (!limit || *limit < 0) throw Failure{kCommandFault, fmt::format("--max-error {}: expected E or NAME=E, E being a number from 0 up, NAME one of {}", most_error, errorNames())};
    budget.error = row->row, budget.most_error = limit;
    return budget;
}

Scene withinBudget(const Scene& scene, const Camera& camera, glm::ivec2 size, Budget budget, Renderer& renderer, const Common& common) {
    PictureSweep::Affordable affordable = PictureSweep::affordable(scene, camera, size, renderer);
    if (!affordable.why.empty()) throw Failure{kInputFault, affordable.why};
    affordable.plan.alone = false;
    const Frame frame = frameOf(camera, size, affordable.size);
    budget.sampled = frame.stride > 1;
    if (budget.most_error) affordable.plan.aim = Search::Aim{budget.error, *budget.most_error, budget.sampled};
    PictureSweep sweep(scene, frame, affordable.plan);
    {
        constexpr std::uint64_t kParts = 1000;
        Progress progress("finding a setting", kParts, common);
        const auto show = [&](double share) { progress.show(static_cast<std::uint64_t>(share * static_cast<double>(kParts))); };
        sweep.finishTruth([&](double share) { show(0.2 * share); });
        while (sweep.step(renderer)) show(sweep.progress());
    }

    // A large picture takes about as many times as long as it has more pixels; how long it takes is then measured, and tried again.
    double times_ms = static_cast<double>(size.x) * size.y / (static_cast<double>(frame.size.x) * frame.size.y);
    constexpr int kTries = 4;  // then the fastest is taken
    for (int attempt = 1;; ++attempt) {
        Budget asked = budget;
        if (budget.most_ms && attempt > kTries) asked.most_ms = 0;
        const std::optional<Picked> picked = pick(sweep.runs(), asked, times_ms);
        if (!picked) throw Failure{kInputFault, "no setting gives a picture that counts: " + sweep.runs()[kOwnRun].failure};
        const Run& run = sweep.runs()[picked->run];
        const Scene chosen = withSetting(scene, run.setting);
        const double ms = frameMs(renderer, chosen, camera, size), expected = run.costs[Cost::ms] * times_ms;
        if (budget.most_ms && picked->met && ms > *budget.most_ms) {
            times_ms *= ms / expected;
            continue;
        }
        if (!common.quiet)
            fmt::print(stderr, "{}; the frame took {:.3g} ms; errors measured at {} of {} pixels\n", says(sweep.runs(), *picked, budget, times_ms), ms, frame.size.x * frame.size.y, size.x * size.y);
        return chosen;
    }
}

}  // namespace mb::cli
