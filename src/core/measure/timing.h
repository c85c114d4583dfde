#pragma once
// Times that may be compared: contenders take turns (A, B, C, A, B, C, …), because on a shared machine a minute differs from
// the next by more than most contenders do. Only ratios within a round are figures.
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace mb {

/// Of an odd number of values the middle one, of an even number the mean of the middle two. The one reading of medians.
double median(std::vector<double> values);

struct Spread {
    double median, min, max;
};
Spread spread(const std::vector<double>& values);

/// A contender draws once and says how many ms that took.
using Contender = std::function<double()>;
struct Turns {
    std::vector<std::vector<double>> ms;   // [c][r] of contender c in round r
    std::optional<double> foreign_cores;   // how many other programs kept busy meanwhile; where the system tells
};
/// Each contender is called once before, for what it must compile or read.
Turns takeTurns(std::span<const Contender> contenders, int rounds);

/// a over b, round by round.
Spread ratio(const std::vector<double>& a, const std::vector<double>& b);

/// How long a call takes, in ms.
double timeOf(const std::function<void()>& call);

}  // namespace mb
