#pragma once
// Real roots of polynomials of low degree, and of any function whose sign is known to change, down to the last bit.
#include <array>
#include <cstddef>
#include <span>

namespace mb::accuracy {

/// Roots in ascending order.
struct Roots {
    std::array<double, 4> at{};
    std::size_t count = 0;
    const double* begin() const { return at.data(); }
    const double* end() const { return at.data() + count; }
    void add(double t) { at[count++] = t; }
};

/// The roots of c[0] + c[1]·t + … + c[n]·tⁿ, n ≤ 4, within [lo, hi]. A root of even order counts once where the value at the turning point
/// cannot be told from 0; leading coefficients may be 0. A polynomial that is 0 everywhere has none.
Roots realRoots(std::span<const double> c, double lo, double hi);

inline constexpr int kHalvings = 110;  // of a bracket: enough to the last bit of a root no nearer to 0 than 2⁻⁵⁰ of the bracket

/// Where f changes its sign between a and b, which it does: the end of the last bracket on b's side. `negative_at_a`: f's sign at a.
template <class F> double halve(F f, double a, double b, bool negative_at_a) {
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = a + (b - a) / 2;
        if (middle == a || middle == b) break;
        ((f(middle) < 0) == negative_at_a ? a : b) = middle;
    }
    return b;
}

}  // namespace mb::accuracy
