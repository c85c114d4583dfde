#pragma once
// The figure of a pile of carved dice.
#include "bench/figure_bins.h"

namespace mb::bench {

/// One run: until all sleep, or 30 s of the scene's time. A line with the time of a step, when all slept, and the overlaps then.
void printPile(PhysicsBench& bench, int dice);

}  // namespace mb::bench
