#include "bench/cover.h"

#include <algorithm>

namespace mb::bench {

March sphereTrace(const Along& distance, double start, double far, const Tolerance& tolerance) {
    constexpr int kBudget = 4096;
    March march;
    for (double t = start; t < far && march.evaluations < kBudget;) {
        const double f = distance(t);
        ++march.evaluations;
        if (f < tolerance(t)) return march.hit = true, march.end = t, march;
        t += f;
    }
    march.end = far;
    return march;
}

std::vector<Ball> leastCover(const Along& distance, double start, double end, double resolution) {
    std::vector<Ball> balls;
    double frontier = start;
    while (end - frontier > resolution) {
        // The last point whose interval begins at or before the frontier. That of the frontier itself always does.
        Ball best{frontier, distance(frontier)};
        double lo = frontier, hi = end;
        if (const double f = distance(end); end - f <= frontier) best = {end, f}, lo = end;
        while (hi - lo > resolution) {
            const double middle = lo + (hi - lo) / 2, f = distance(middle);
            if (middle - f <= frontier) lo = middle, best = {middle, f};
            else hi = middle;
        }
        balls.push_back(best);
        frontier = std::max(best.t + best.radius, frontier + resolution);  // inside a solid there is nothing to prove
    }
    return balls;
}

std::size_t leastEvaluations(const Along& distance, double start, const March& traced, const Tolerance& tolerance) {
    if (!traced.hit) return leastCover(distance, start, traced.end).size();
    return leastCover(distance, start, traced.end - tolerance(traced.end)).size() + 1;
}

}  // namespace mb::bench
