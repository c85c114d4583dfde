#pragma once
// What `marchbox bench physics` prints: balls in a bin, by marchbox and by other engines, and a pile of carved dice.
#include "bench/report.h"

namespace mb::bench {

struct PhysicsOptions {
    int rounds = 3;
    std::uint64_t seed = kSeed;
    std::vector<int> balls{500, 2000, 8000};  // of each bin
    std::vector<int> dice{500};               // of each pile
    std::vector<std::string> only;            // names of binEngines(), marchbox aside; none: all
};

struct PhysicsBench {
    const PhysicsOptions& options;
    std::function<void(const Json&)> print;       // a line of the report
    std::function<void(const std::string&)> say;  // what is being done, for a terminal
};

/// A line about the run, then of each bin a line an engine: the mean time of a step and how far balls overlap at the end; then a
/// line a pile.
void runPhysics(PhysicsBench& bench);
/// Such a line in words; of a line that holds no figure nothing.
std::string inWords(const Json& line);

}  // namespace mb::bench
