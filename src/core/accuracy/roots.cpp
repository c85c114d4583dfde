#include "core/accuracy/roots.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mb::accuracy {
namespace {

/// A value with a bound of its rounding: Horner's scheme carries at most 2n roundings of the sum of the magnitudes (Higham,
/// "Accuracy and Stability of Numerical Algorithms", 2002, section 5.1). `grain` is what t itself is known to.
struct Valued {
    double value = 0, rounding = 0;
    bool isZero() const { return std::fabs(value) <= rounding; }
};
Valued valueAt(std::span<const double> c, double t, double grain) {
    double value = 0, magnitude = 0;
    for (std::size_t i = c.size(); i-- > 0;) value = value * t + c[i], magnitude = magnitude * (std::fabs(t) + grain) + std::fabs(c[i]);
    return {value, 2 * static_cast<double>(c.size()) * std::numeric_limits<double>::epsilon() * magnitude};
}

std::span<const double> withoutLeadingZeros(std::span<const double> c) {
    while (!c.empty() && c.back() == 0) c = c.first(c.size() - 1);
    return c;
}

}  // namespace

// Between the roots of its derivative a polynomial is monotone: there each change of sign is one root, and no other is left.
Roots realRoots(std::span<const double> coefficients, double lo, double hi) {
    const std::span<const double> c = withoutLeadingZeros(coefficients);
    Roots roots;
    if (c.size() < 2) return roots;

    std::array<double, 4> derivative{};
    for (std::size_t i = 1; i < c.size(); ++i) derivative[i - 1] = static_cast<double>(i) * c[i];
    const Roots turns = realRoots(std::span(derivative).first(c.size() - 1), lo, hi);

    const double grain = std::numeric_limits<double>::epsilon() * std::max(std::fabs(lo), std::fabs(hi));
    double from = lo;
    Valued before = valueAt(c, lo, grain);
    if (before.isZero()) roots.add(lo);
    for (std::size_t i = 0; i <= turns.count; ++i) {
        const double to = i < turns.count ? turns.at[i] : hi;
        if (!(to > from)) continue;
        const Valued after = valueAt(c, to, grain);
        if (roots.count == c.size() - 1) break;  // no more than its degree
        if (after.isZero()) {
            // Two turns as near to one another as rounding are one root.
            if (!before.isZero()) roots.add(to);
        } else if (!before.isZero() && (before.value < 0) != (after.value < 0)) {
            roots.add(halve([&](double t) { return valueAt(c, t, grain).value; }, from, to, before.value < 0));
        }
        from = to, before = after;
    }
    return roots;
}

}  // namespace mb::accuracy
