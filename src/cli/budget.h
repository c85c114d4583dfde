#pragma once
// A picture's setting picked for a budget: render --max-error and --max-ms.
#include "cli/cli.h"

#include "core/render/budget.h"

namespace mb::cli {

/// The budget that the words of the two options ask for; a failure with code 2 where they make no sense.
Budget parseBudget(const std::string& most_error, double most_ms);

/// The scene with the setting that the budget picks for a picture of that size. Says on standard error what was picked, what it
/// reaches, and, where the budget cannot be met, that it is the best that can.
Scene withinBudget(const Scene& scene, const Camera& camera, glm::ivec2 size, Budget budget, Renderer& renderer, const Common& common);

}  // namespace mb::cli
