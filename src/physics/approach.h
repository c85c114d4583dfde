#pragma once
// When two things moving along known paths first touch.
#include <cmath>

namespace mb {

/// The gap between them at one time.
struct GapAt {
    double gap = 0;         // m; where `measured` is false, a lower bound
    double rate = 0;        // m/s, of the nearest points; negative: approaching
    bool measured = false;
};

struct ApproachLimits {
    double speed = 0;       // no point of theirs is faster against the other, m/s
    double stride = 0;      // no obstacle is passed over unseen that is met deeper than its stride²/(8 r), m
    double bounce = 0;      // an approach faster than this is an impact wherever the gap becomes negative, m/s
    double depth = 0;       // a slower one is let in as deep as this, m: where it rests, the solver keeps it up
    double noise = 0;       // of the depth: what two measured gaps may err by against one another
};

struct Meeting {
    bool found = false;     // they touch at `time`
    bool stuck = false;     // the search gave up: free until `time`, and not known after it
    double time = 0;
    int samples = 0;
};

/// Whether firstMeeting is certain to find nothing within `duration`, for a gap that begins with at least `clear` and limits that
/// hold for all of it: no more is travelled than is clear. Then the gap is positive at every sample, and so is the meeting
/// point of two tangents, as no rate exceeds the speed v: with rates −r and s at samples t apart and gaps g and g' ≥ g − v·t
/// they meet at (s·g + r·g' − r·s·t) / (r + s) ≥ g − r·(s + v)·t / (r + s) ≥ g − v·t, as r ≤ v.
/// (Over thousands of radii the search may run out of samples first, which is an answer of its own.)
inline bool cannotReach(double clear, double duration, const ApproachLimits& limits, double radius) {
    const double travel = limits.speed * duration;
    return travel < clear && travel < 1e3 * radius;
}

/// The same, for two that rest on one another or are near: nothing approaches faster than `bounce`, and the gap, which errs by
/// `error`, cannot shrink by more than a quarter of `depth`, where the search lets it shrink by half of it. The meeting point
/// of two tangents lies no lower, as above.
inline bool restsThrough(double duration, const ApproachLimits& limits, double error) {
    return limits.speed * (1 + 1e-12) <= limits.bounce && limits.speed * duration + error <= 0.25 * limits.depth;
}

/// The first time in [from, to] when they touch: the gap is 0, or it is negative at `from` already and they approach.
///
/// Conservative advancement (Mirtich, "Impulse-based Dynamic Simulation of Rigid Body Systems", 1996) as long as there is
/// a free gap to cross; near contact strides of at most `stride`, between whose ends the gap is held against the meeting
/// point of its two tangents, which lies below it wherever the obstacle is convex (and where it is concave the least gap
/// is at an end); then a bracketed root (Illinois' variant of regula falsi; Dowell, Jarratt, 1971).
template <class Gap> Meeting firstMeeting(Gap gap_at, double from, double to, const ApproachLimits& limits) {
    constexpr int kMostSamples = 20'000;
    constexpr double kDeep = 0.1;  // of the noise: else a corner that slides along a hollow would sink in by so much at every impact
    Meeting m;
    const auto sample = [&](double t) { return ++m.samples, gap_at(t); };
    GapAt here = sample(from);
    double t = from;
    const double floor = std::fmin(-limits.depth, here.gap - 0.5 * limits.depth);
    const auto inside = [&](const GapAt& s, double rate) { return s.gap < floor || (s.gap < 0 && rate < -limits.bounce); };
    if (here.measured && here.gap <= 0 && here.rate < -limits.bounce) return m.found = true, m.time = from, m;

    // The time between t and t1 when the gap passes 0; where it is about 0 at t already, since they rest on one another
    // there and meet elsewhere, when it passes a little less; and hardly less where it is too deep already.
    const auto root = [&](GapAt a, double t1, GapAt b) {
        const double noise = (a.gap < -limits.depth ? kDeep : 1) * limits.noise * limits.depth, level = a.gap > noise ? 0 : a.gap - noise;
        double lo = t, hi = t1, ga = a.gap - level, gb = b.gap - level;
        if (gb >= 0) return t1;
        for (int i = 0, side = 0; i < 100 && hi - lo > 1e-15; ++i) {
            double mid = lo + (hi - lo) * (ga / (ga - gb));
            if (!(mid > lo && mid < hi)) mid = 0.5 * (lo + hi);
            const double g = sample(mid).gap - level;
            if (std::fabs(g) <= 1e-11) return mid;
            if (g > 0) {
                lo = mid, ga = g;
                if (side == 1) gb *= 0.5;
                side = 1;
            } else {
                hi = mid, gb = g;
                if (side == -1) ga *= 0.5;
                side = -1;
            }
        }
        return hi;  // the gap jumps there: what is met is seen from then on
    };

    while (t < to) {
        if (m.samples > kMostSamples) return m.stuck = true, m.time = t, m;
        const double length = std::fmax(std::fmax(here.gap, 0.0), here.measured ? limits.stride : 0.0);
        double next = limits.speed > 0 && t + length / limits.speed < to ? t + length / limits.speed : to;
        if (!(next > t)) next = to;
        GapAt there = sample(next);
        bool met = inside(there, std::fmin(here.rate, there.rate));
        if (!met && here.measured && there.measured && here.rate < 0 && there.rate > 0) {
            const double at = t + (there.gap - here.gap - there.rate * (next - t)) / (here.rate - there.rate);
            const double low = here.gap + here.rate * (at - t);
            if (low < floor || (low < 0 && here.rate < -limits.bounce)) {
                const double edge = 1e-3 * (next - t);
                next = std::fmin(std::fmax(at, t + edge), next - edge);
                there = sample(next);
                met = inside(there, here.rate);
            }
        }
        if (met) return m.found = true, m.time = root(here, next, there), m;
        t = next, here = there;
    }
    m.time = to;
    return m;
}

}  // namespace mb
