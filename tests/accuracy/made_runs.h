#pragma once
// Runs of a sweep drawn at random, for the laws of fronts, searches and reports.
#include "core/accuracy/front.h"
#include "sdf/draw.h"

namespace mb {

/// A few values each, so that ties are frequent; one in twelve failed, one in twelve not measured.
inline std::vector<Run> drawRuns(Draw& draw, int n, int values) {
    std::vector<Run> runs;
    for (int i = 0; i < n; ++i) {
        Run run;
        for (const Error e : {Error::color, Error::shade, Error::state, Error::depth, Error::normal}) run.errors[e] = draw.oneIn(9) ? 0 : std::pow(10.0, -draw.below(values) / 4.0);
        run.costs[Cost::evaluations] = std::pow(1.3, draw.below(values));
        run.costs[Cost::ms] = run.costs[Cost::evaluations] * draw.uniform(0.8, 1.2);
        if (draw.oneIn(12)) run.failure = "made to fail";
        if (draw.oneIn(12)) run.aside = true;
        if (draw.oneIn(12)) run.errors[Error::color] = kNotMeasured;
        runs.push_back(run);
    }
    return runs;
}

}  // namespace mb
