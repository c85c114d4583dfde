#include "core/render/budget.h"

#include <fmt/format.h>

#include <cmath>

namespace mb {

std::optional<Picked> pick(std::span<const Run> runs, const Budget& budget, double times_ms) {
    const Error error = budget.error;
    std::optional<std::size_t> within, best;
    if (budget.most_error) {
        // A run's error is known from a part of the pixels: what it may be off by must fit into the limit too.
        std::vector<Run> careful(runs.begin(), runs.end());
        for (Run& run : careful) run.errors[error] = surely(run, error, budget.sampled);
        within = cheapestWithin(careful, error, *budget.most_error, Cost::evaluations);
        best = leastWrong(runs, error, Cost::evaluations);
    } else if (budget.most_ms) {
        within = leastWrongWithin(runs, Cost::ms, *budget.most_ms / times_ms, error);
        best = cheapest(runs, Cost::ms, error);
    }
    if (!within && !best) return std::nullopt;
    return Picked{within.value_or(best.value_or(0)), within.has_value()};
}

std::string says(std::span<const Run> runs, const Picked& picked, const Budget& budget, double times_ms) {
    const Run& run = runs[picked.run];
    const std::string set = differences(run.setting, runs[kOwnRun].setting);
    std::string text = fmt::format("picked {}: {} error {:.3g}", set.empty() ? "the scene's own setting" : set, rowOf(budget.error).name, run.errors[budget.error]);
    if (budget.most_error) text += fmt::format(" of {:.3g} allowed", *budget.most_error);
    text += fmt::format(", {:.3g} evaluations a pixel", run.costs[Cost::evaluations]);
    const double ms = run.costs[Cost::ms] * times_ms;
    if (std::isfinite(ms)) text += fmt::format(", about {:.3g} ms", ms);
    if (budget.most_ms) text += fmt::format(" of {:.3g} allowed", *budget.most_ms);
    if (!picked.met) text += fmt::format("; the budget cannot be met: this is the {} of {} settings tried", budget.most_error ? "least wrong" : "fastest", runs.size());
    return text;
}

Frame frameOf(const Camera& camera, glm::ivec2 size, glm::ivec2 affordable) {
    const double ratio = static_cast<double>(size.x) * size.y / (static_cast<double>(affordable.x) * affordable.y);
    const int stride = std::max(1, static_cast<int>(std::ceil(std::sqrt(ratio) - 1e-6)));
    return {camera, glm::max(size / stride, glm::ivec2(1)), stride};
}

}  // namespace mb
