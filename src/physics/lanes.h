#pragma once
// Four doubles that are worked on at once: lane by lane what a double would be, to the bit, on every machine. (Four are one
// register of AVX2, or two of SSE2; no operation mixes lanes, and none is fused.)
#include <glm/vec3.hpp>

#include <cmath>

#pragma GCC diagnostic ignored "-Wpsabi"  // what is passed in registers is inlined, and has no convention to keep

#define MB_INLINE [[gnu::always_inline]] inline
#define MB_INLINE_CALL __attribute__((always_inline))  // of a lambda, behind what it takes

namespace mb {

// Of one double, the same by the same name.
MB_INLINE double larger(double a, double b) { return a < b ? b : a; }
MB_INLINE double rootOf(double a) { return std::sqrt(a); }
MB_INLINE double largest(double a) { return a; }
MB_INLINE double sum(double a) { return a; }
template <class S> MB_INLINE S all(double x) { return x; }

inline constexpr int kLanes = 4;
using Lanes = double __attribute__((vector_size(32)));

template <> MB_INLINE Lanes all<Lanes>(double x) { return Lanes{x, x, x, x}; }
MB_INLINE Lanes larger(const Lanes& a, const Lanes& b) { return a < b ? b : a; }
MB_INLINE Lanes rootOf(const Lanes& a) { return Lanes{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])}; }
MB_INLINE double largest(const Lanes& a) { return std::fmax(std::fmax(a[0], a[1]), std::fmax(a[2], a[3])); }
MB_INLINE double sum(const Lanes& a) { return (a[0] + a[1]) + (a[2] + a[3]); }

struct alignas(32) LaneVec {
    Lanes x{}, y{}, z{};
};
MB_INLINE LaneVec operator+(const LaneVec& a, const LaneVec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
MB_INLINE LaneVec operator-(const LaneVec& a, const LaneVec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
MB_INLINE LaneVec operator*(const Lanes& s, const LaneVec& a) { return {s * a.x, s * a.y, s * a.z}; }
MB_INLINE LaneVec operator*(double s, const LaneVec& a) { return {s * a.x, s * a.y, s * a.z}; }
MB_INLINE Lanes dot(const LaneVec& a, const LaneVec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
MB_INLINE LaneVec cross(const LaneVec& a, const LaneVec& b) {
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
MB_INLINE void setLane(LaneVec& io_v, int lane, const glm::dvec3& v) { io_v.x[lane] = v.x, io_v.y[lane] = v.y, io_v.z[lane] = v.z; }
MB_INLINE glm::dvec3 laneOf(const LaneVec& v, int lane) { return {v.x[lane], v.y[lane], v.z[lane]}; }

/// x, y and z of four vectors that lie each in a register of its own, with a number w, and back.
MB_INLINE LaneVec transposed(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d, Lanes& out_w) {
    const Lanes ab_lo = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_hi = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Lanes cd_lo = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_hi = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    out_w = __builtin_shufflevector(ab_hi, cd_hi, 2, 3, 6, 7);
    return {__builtin_shufflevector(ab_lo, cd_lo, 0, 1, 4, 5), __builtin_shufflevector(ab_hi, cd_hi, 0, 1, 4, 5),
            __builtin_shufflevector(ab_lo, cd_lo, 2, 3, 6, 7)};
}
MB_INLINE void transposeBack(const LaneVec& v, const Lanes& w, Lanes& out_a, Lanes& out_b, Lanes& out_c, Lanes& out_d) {
    const Lanes xy_lo = __builtin_shufflevector(v.x, v.y, 0, 4, 2, 6), xy_hi = __builtin_shufflevector(v.x, v.y, 1, 5, 3, 7);
    const Lanes z_lo = __builtin_shufflevector(v.z, w, 0, 4, 2, 6), z_hi = __builtin_shufflevector(v.z, w, 1, 5, 3, 7);
    out_a = __builtin_shufflevector(xy_lo, z_lo, 0, 1, 4, 5), out_b = __builtin_shufflevector(xy_hi, z_hi, 0, 1, 4, 5);
    out_c = __builtin_shufflevector(xy_lo, z_lo, 2, 3, 6, 7), out_d = __builtin_shufflevector(xy_hi, z_hi, 2, 3, 6, 7);
}

}  // namespace mb
