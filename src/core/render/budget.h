#pragma once
// A picture for a budget: the cheapest setting whose error stays within a limit, or the least wrong one whose frame does.
#include "core/render/picture_sweep.h"

namespace mb {

struct Budget {
    Error error = Error::color;          // of a picture
    std::optional<double> most_error;    // of that error
    std::optional<double> most_ms;       // a frame
    bool sampled = false;                // the runs were measured at a part of the picture's pixels
    bool isAsked() const { return most_error || most_ms; }
};

/// What was picked from a sweep's runs, and what it reaches there.
struct Picked {
    std::size_t run = 0;
    bool met = false;                    // within the budget; else it is the best that can: the least wrong, or the cheapest
};
/// None if no run has a picture that counts. `times_ms` turns the runs' milliseconds into the picture's.
std::optional<Picked> pick(std::span<const Run> runs, const Budget& budget, double times_ms = 1);
/// In a sentence, and as `--set` takes it: what was picked, what it reaches, and whether that meets the budget.
std::string says(std::span<const Run> runs, const Picked& picked, const Budget& budget, double times_ms = 1);

/// A frame of a picture of that size as a sweep measures it: all of it, or every k-th pixel of every k-th row, so that it has no more
/// pixels than can be paid for.
Frame frameOf(const Camera& camera, glm::ivec2 size, glm::ivec2 affordable);

}  // namespace mb
