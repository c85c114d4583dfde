#pragma once
// The charts of core/accuracy/chart.h over Dear ImGui: what the reports show, with points that can be pressed.
#include "core/accuracy/chart.h"

#include <cstddef>
#include <optional>
#include <span>

namespace mb::ui {

/// Draws them beside one another, as many as the width allows, and their legend below; faded where what they show is past. Returns
/// the run whose point was pressed, if one was.
std::optional<std::size_t> plots(std::span<const ChartPanel> panels, bool faded);

}  // namespace mb::ui
