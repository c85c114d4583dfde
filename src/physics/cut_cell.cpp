#include "physics/cut_cell.h"

#include <glm/common.hpp>

#include <cmath>
#include <utility>

namespace mb {
namespace {

/// tⁿ/n! where t is positive, 0 elsewhere: n times the integral of a step at 0.
double ramp(double t, int n) {
    if (!(t > 0)) return 0;
    double r = 1;
    for (int k = 1; k <= n; ++k) r *= t / k;
    return r;
}

/// The mean over a cell of a step, axis by axis. With u the place along an axis, a the slope there and R(n) = ramp(t, n),
/// R⁺ and R⁻ the same at t + a and t − a, the means over u from −1 to 1 are
///     of   ramp(t − a·u, n)   (R⁺(n + 1) − R⁻(n + 1))/(2·a)
///     of u·ramp(t − a·u, n)   ((R⁺(n + 2) − R⁻(n + 2))/(2·a) − (R⁺(n + 1) + R⁻(n + 1))/2)/a
/// which rounding would spoil where a is next to 0: there they are R(n) and −a/3·R(n − 1), to the order a².
/// The axes are in turn from the steepest, so that n is never negative.
struct Mean {
    glm::dvec3 slope;   // not negative
    int weighed = -1;   // the axis whose place is averaged; −1: none, the step itself is

    double of(double t, int n = 0, int axis = 0) const {
        if (axis == 3) return ramp(t, n);
        const double a = slope[axis];
        constexpr double kThin = 1e-3;
        if (a <= kThin * slope[0]) return axis == weighed ? -a / 3 * of(t, n - 1, axis + 1) : of(t, n, axis + 1);
        const double above = of(t + a, n + 1, axis + 1), below = of(t - a, n + 1, axis + 1);
        if (axis != weighed) return (above - below) / (2 * a);
        return ((of(t + a, n + 2, axis + 1) - of(t - a, n + 2, axis + 1)) / (2 * a) - (above + below) / 2) / a;
    }
};

}  // namespace

Cut behindPlane(const glm::dvec3& slope, double level) {
    const glm::dvec3 steep = glm::abs(slope);
    const double reach = steep.x + steep.y + steep.z;
    if (level <= -reach) return {};
    if (level >= reach) return {1, {}};

    int order[3] = {0, 1, 2};
    if (steep[order[1]] > steep[order[0]]) std::swap(order[0], order[1]);
    if (steep[order[2]] > steep[order[0]]) std::swap(order[0], order[2]);
    // Of the two parts the smaller: opposite planes give opposite parts to the bit.
    Mean mean{{steep[order[0]], steep[order[1]], steep[order[2]]}};
    const double near = -std::fabs(level);
    Cut cut;
    cut.part = level > 0 ? 1 - mean.of(near) : mean.of(near);
    for (mean.weighed = 0; mean.weighed < 3; ++mean.weighed) {
        const int axis = order[mean.weighed];
        const double first = mean.of(near);
        cut.first[axis] = slope[axis] < 0 ? -first : first;
    }
    return cut;
}

}  // namespace mb
