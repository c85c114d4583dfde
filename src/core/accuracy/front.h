#pragma once
// Which settings nothing beats: the Pareto front of errors and a cost.
#include "core/accuracy/run.h"

#include <optional>

namespace mb {

/// The runs every sweep begins with: the scene's own setting, and the program's defaults.
inline constexpr std::size_t kOwnRun = 0, kDefaultRun = 1;

/// What runs are compared by. Of a picture the errors are color, shade, state, depth and normal; of a motion the others.
struct Terms {
    std::span<const Error> errors;
    Cost cost = Cost::evaluations;
    Values<Error> least;                 // what is smaller counts as this: what nobody sees, or what the truth itself may be off by
};
/// What the truth may be off by itself: `color` of a true picture; `place` (m) and `energy` of a true motion.
Terms pictureTerms(double color = 0);
Terms motionTerms(double place = 0, double energy = 0);

/// Whether a beats b: no error greater and no dearer, and one of them less by more than kSame of it and, of an error, by more than
/// chance makes of b's (Run::off): one pixel more or less decides nothing. An error below the terms' `least`
/// counts as that. What failed or stands aside beats
/// nothing.
bool beats(const Run& a, const Run& b, const Terms& terms);
inline constexpr double kSame = 0.05;

/// The runs that did not fail and that no other beats, by number; and of those that are within about kSame of one another in
/// everything, the first alone.
std::vector<std::size_t> unbeaten(std::span<const Run> runs, const Terms& terms);
std::vector<std::size_t> distinct(std::span<const Run> runs, std::span<const std::size_t> of, const Terms& terms);

/// The line of one error alone: the runs than which none is both cheaper and less wrong, the cheapest first.
std::vector<std::size_t> frontOf(std::span<const Run> runs, Error error, Cost cost);

/// What an error is at most: where it is known from a part of the pixels, two standard errors more.
double surely(const Run& run, Error error, bool sampled);

/// The cheapest run whose error is within the limit; the least wrong one that costs no more than the limit. None if there is none.
std::optional<std::size_t> cheapestWithin(std::span<const Run> runs, Error error, double most, Cost cost);
std::optional<std::size_t> leastWrongWithin(std::span<const Run> runs, Cost cost, double most, Error error);
/// The least wrong of all; the cheapest of all. None if all failed.
std::optional<std::size_t> leastWrong(std::span<const Run> runs, Error error, Cost cost);
std::optional<std::size_t> cheapest(std::span<const Run> runs, Cost cost, Error error);

/// Of what beats a run, the one that differs least from it in its errors and its cost, each compared by its ratio. None if nothing
/// does.
std::optional<std::size_t> nearestBetter(std::span<const Run> runs, std::size_t own, const Terms& terms);

}  // namespace mb
