#pragma once
// The least number of evaluations that any march needs which knows the scene only through its distance at points.
//
// Asked at t, a distance f(t) of slope at most 1 proves that the ray is empty on (t - f(t), t + f(t)), and nothing else. To
// prove the ray empty from its start to where it ends, such intervals must cover it. Which points to ask is an interval
// cover problem, and taking from each frontier the interval that reaches furthest is optimal. Since the slope is at most 1,
// t - f(t) and t + f(t) never fall: the furthest reaching interval that begins at or before the frontier is that of the
// last t with t - f(t) <= frontier, found by halving.
#include <functional>
#include <vector>

namespace mb::bench {

/// The distance along a ray; its slope is at most 1.
using Along = std::function<double(double t)>;
/// How near is a hit, at t.
using Tolerance = std::function<double(double t)>;

/// A point asked and the distance there.
struct Ball {
    double t, radius;
};

struct March {
    int evaluations = 0;
    bool hit = false;
    double end = 0;  // of a hit: where the distance first fell below the tolerance
};
/// Plain sphere tracing from `start` until the distance falls below the tolerance or t passes `far`; at most 4096 steps.
March sphereTrace(const Along& distance, double start, double far, const Tolerance& tolerance);

/// The least balls whose intervals cover [start, end], points being told apart to `resolution`: what is left uncovered, at the
/// end, is shorter.
std::vector<Ball> leastCover(const Along& distance, double start, double end, double resolution = 1e-6);

/// The least evaluations of a march that ends as `traced` did: the balls to within the tolerance of a hit and the one more
/// that finds the hit, or the balls to the end.
std::size_t leastEvaluations(const Along& distance, double start, const March& traced, const Tolerance& tolerance);

}  // namespace mb::bench
