#pragma once
// The scalars a distance is evaluated with on the CPU: float (as the GPU does), double, Dual (value and gradient) and
// Interval (bounds). Each offers the functions of the dialect that shaders/sdf/ is written in, and nothing else.
#include <algorithm>
#include <cmath>
#include <type_traits>

namespace mb::sdf {

template <class T> concept Plain = std::is_floating_point_v<T>;
template <Plain T> T sqrt(T x) { return std::sqrt(x); }
template <Plain T> T abs(T x) { return std::fabs(x); }
template <Plain T> T square(T x) { return x * x; }
template <Plain A, Plain B> std::common_type_t<A, B> min(A a, B b) { return b < a ? b : a; }
template <Plain A, Plain B> std::common_type_t<A, B> max(A a, B b) { return a < b ? b : a; }
template <Plain T> T nearestWhole(T x) { return std::floor(x + T(0.5)); }
/// The dialect's only branch: a where s is negative, b elsewhere.
template <Plain S, Plain A, Plain B> std::common_type_t<A, B> pick(S s, A a, B b) { return s < 0 ? a : b; }

/// A value and its gradient in x, y, z: forward-mode differentiation. Where a function has a crease it gives the
/// gradient of one side; the gradient of sqrt at 0 is 0, so that no NaN appears at the centre of a sphere.
struct Dual {
    double v = 0, dx = 0, dy = 0, dz = 0;
    Dual() = default;
    Dual(double value) : v(value) {}
    Dual(double value, double x, double y, double z) : v(value), dx(x), dy(y), dz(z) {}

    friend Dual operator-(Dual a) { return {-a.v, -a.dx, -a.dy, -a.dz}; }
    friend Dual operator+(Dual a, Dual b) { return {a.v + b.v, a.dx + b.dx, a.dy + b.dy, a.dz + b.dz}; }
    friend Dual operator-(Dual a, Dual b) { return {a.v - b.v, a.dx - b.dx, a.dy - b.dy, a.dz - b.dz}; }
    friend Dual operator*(Dual a, Dual b) {
        return {a.v * b.v, a.dx * b.v + a.v * b.dx, a.dy * b.v + a.v * b.dy, a.dz * b.v + a.v * b.dz};
    }
    friend Dual operator/(Dual a, Dual b) {
        const double q = a.v / b.v;
        return {q, (a.dx - q * b.dx) / b.v, (a.dy - q * b.dy) / b.v, (a.dz - q * b.dz) / b.v};
    }
    friend Dual sqrt(Dual a) {
        const double r = std::sqrt(a.v), h = r > 0 ? 0.5 / r : 0;
        return {r, a.dx * h, a.dy * h, a.dz * h};
    }
    friend Dual square(Dual a) { return a * a; }
    friend Dual abs(Dual a) { return a.v < 0 ? -a : a; }
    friend Dual nearestWhole(Dual a) { return std::floor(a.v + 0.5); }
    friend Dual min(Dual a, Dual b) { return b.v < a.v ? b : a; }
    friend Dual max(Dual a, Dual b) { return a.v < b.v ? b : a; }
    friend Dual pick(Dual s, Dual a, Dual b) { return s.v < 0 ? a : b; }
};

/// Every value an expression can take while its inputs range over a box: [lo, hi] holds them all, whatever the rounding,
/// since each operation moves its ends outwards by more than it can have rounded them inwards.
struct Interval {
    double lo = 0, hi = 0;
    Interval() = default;
    Interval(double value) : lo(value), hi(value) {}
    Interval(double l, double h) : lo(l), hi(h) {}

    friend Interval operator-(Interval a) { return {-a.hi, -a.lo}; }
    friend Interval operator+(Interval a, Interval b) { return outward(a.lo + b.lo, a.hi + b.hi); }
    friend Interval operator-(Interval a, Interval b) { return outward(a.lo - b.hi, a.hi - b.lo); }
    friend Interval operator*(Interval a, Interval b) {
        const auto [l, h] = std::minmax({a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi});
        return outward(l, h);
    }
    friend Interval operator/(Interval a, Interval b) {
        if (b.lo <= 0 && b.hi >= 0) return {-INFINITY, INFINITY};
        const auto [l, h] = std::minmax({a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi});
        return outward(l, h);
    }
    friend Interval sqrt(Interval a) {
        const Interval r = outward(std::sqrt(std::max(a.lo, 0.0)), std::sqrt(std::max(a.hi, 0.0)));
        return {std::max(r.lo, 0.0), r.hi};
    }
    friend Interval abs(Interval a) {
        if (a.lo >= 0) return a;
        if (a.hi <= 0) return -a;
        return {0, std::max(-a.lo, a.hi)};
    }
    friend Interval nearestWhole(Interval a) { return {std::floor(a.lo + 0.5), std::floor(a.hi + 0.5)}; }
    /// Tighter than a * a, which forgets that both factors are the same number.
    friend Interval square(Interval a) {
        const Interval m = abs(a), r = outward(m.lo * m.lo, m.hi * m.hi);
        return {std::max(r.lo, 0.0), r.hi};
    }
    friend Interval min(Interval a, Interval b) { return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)}; }
    friend Interval max(Interval a, Interval b) { return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)}; }
    friend Interval pick(Interval s, Interval a, Interval b) {
        if (s.hi < 0) return a;
        if (s.lo >= 0) return b;
        return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
    }

private:
    /// A correctly rounded result errs by at most half an ulp, at most 2⁻⁵³ of it or half the least denormal.
    static Interval outward(double l, double h) {
        constexpr double ulp = 0x1p-52, tiny = 0x1p-1074;
        return {l - std::fabs(l) * ulp - tiny, h + std::fabs(h) * ulp + tiny};
    }
};

}  // namespace mb::sdf
