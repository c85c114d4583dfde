#pragma once
// The figures of `marchbox bench render`, one row each, and that of `marchbox bench effects`.
#include "bench/report.h"

#include <span>

namespace mb::bench {

struct Figure {
    std::string_view name, what;
    void (*run)(Bench&);  // prints its lines
};
std::span<const Figure> figures();

/// A line about the run, then the figures asked for. Names that are no figure's are the caller's to refuse.
void run(Bench& bench);
/// A line about the run, then what the effects cost that scenes do not call for.
void runEffects(Bench& bench);

void seedFigure(Bench&);
void growthFigure(Bench&);
void movedFigure(Bench&);
void countsFigure(Bench&);
void povrayFigure(Bench&);
void effectsFigure(Bench&);

}  // namespace mb::bench
