#pragma once
// As much of GLSL as shaders/sdf/ uses, for any scalar, and the library itself compiled for it.
#include "core/sdf/scalar.h"

namespace mb::sdf {

template <class T> struct Vec2 {
    T x, y;
    explicit Vec2(T s) : x(s), y(s) {}
    Vec2(T x_, T y_) : x(x_), y(y_) {}
    friend Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
    friend Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
    friend Vec2 operator*(Vec2 a, Vec2 b) { return {a.x * b.x, a.y * b.y}; }
    friend Vec2 operator+(Vec2 a, T s) { return a + Vec2(s); }
    friend Vec2 operator-(Vec2 a, T s) { return a - Vec2(s); }
    friend Vec2 operator*(Vec2 a, T s) { return a * Vec2(s); }
    friend Vec2 abs(Vec2 a) { return {abs(a.x), abs(a.y)}; }
    friend Vec2 max(Vec2 a, T s) { return {max(a.x, s), max(a.y, s)}; }
    friend T length(Vec2 a) { return sqrt(square(a.x) + square(a.y)); }
};

template <class T> struct Vec3 {
    T x, y, z;
    Vec3() = default;
    explicit Vec3(T s) : x(s), y(s), z(s) {}
    Vec3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
    friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
    friend Vec3 operator/(Vec3 a, Vec3 b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }
    friend Vec3 operator+(Vec3 a, T s) { return a + Vec3(s); }
    friend Vec3 operator-(Vec3 a, T s) { return a - Vec3(s); }
    friend Vec3 operator*(Vec3 a, T s) { return a * Vec3(s); }
    friend Vec3 abs(Vec3 a) { return {abs(a.x), abs(a.y), abs(a.z)}; }
    friend Vec3 max(Vec3 a, T s) { return {max(a.x, s), max(a.y, s), max(a.z, s)}; }
    friend T dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    friend T length(Vec3 a) { return sqrt(square(a.x) + square(a.y) + square(a.z)); }
};

/// The GLSL library, compiled for one scalar. The files are the ones that the GPU compiles.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"  // a family of functions takes the same numbers, needed or not
template <class real> struct Sdf {
    using vec2 = Vec2<real>;
    using vec3 = Vec3<real>;
#include "../../../shaders/sdf/domains.glsl"
#include "../../../shaders/sdf/operators.glsl"
#include "../../../shaders/sdf/primitives.glsl"
};
#pragma GCC diagnostic pop

}  // namespace mb::sdf
