#pragma once
// The rows that describe every type of object: its name, its parameters and how to evaluate it. The text format, the
// menus, the sliders, the GLSL and the tests all walk these two tables and know nothing else of a type.
#include "core/sdf/glsl.h"

#include <array>
#include <span>
#include <string_view>

namespace mb {

/// One key of an object's type, as the scene file spells it. A value is 1 or 3 numbers, each within [lo, hi].
struct Parameter {
    enum class Kind { real, whole, word };
    std::string_view name, unit, tip;          // a unit of "m" makes it a length, which an object's scale multiplies
    int size = 1;
    std::array<double, 3> initial{};           // of a new object; of a file that leaves an optional key out
    double lo = 0, hi = 0;                     // the range a file may use
    double slider_lo = 0, slider_hi = 0;       // the range a slider offers
    bool optional = false;
    Kind kind = Kind::real;
    std::span<const std::string_view> words{};  // Kind::word: the value is an index into these
    bool isLength() const { return unit == "m"; }
};

inline constexpr int kMaxParameters = 6;       // numbers an object's own keys hold, of any type
inline constexpr int kMaxLeafNumbers = 4;      // numbers a primitive's GLSL function takes behind the point
using Numbers = std::array<double, kMaxParameters>;
using LeafNumbers = std::array<double, kMaxLeafNumbers>;

/// What primitives and operators have in common.
struct ShapeType {
    std::string_view name, tip;
    std::span<const Parameter> parameters;
    int min_children = 0, max_children = 0;    // 0, 0: a primitive
    bool isOperator() const { return max_children > 0; }
};

/// An axis-aligned box around a shape, in metres; infinite where the shape is, and empty where lo > hi.
struct Box {
    std::array<double, 3> lo, hi;
};

struct Primitive : ShapeType {
    std::string_view glsl;                     // the function: sdSphere
    std::string_view derived;                  // one more number behind the keys' own, or none: its name in the GLSL
    bool exact = true;                         // |gradient| is 1 almost everywhere, not only at most 1
    bool turns = true;                         // a rotation changes it; false for the ball alone
    void (*cook)(LeafNumbers&) = nullptr;      // makes the numbers the GLSL takes from the scaled ones of the file
    Box (*extent)(const LeafNumbers&) = nullptr;  // the tightest box around it, from cooked numbers
    double (*rises)(const LeafNumbers&) = nullptr;  // of a bound: at least how much a metre away from the shape adds to it
    float (*f32)(sdf::Vec3<float>, const double*) = nullptr;
    double (*f64)(sdf::Vec3<double>, const double*) = nullptr;
    sdf::Dual (*dual)(sdf::Vec3<sdf::Dual>, const double*) = nullptr;
    sdf::Interval (*interval)(sdf::Vec3<sdf::Interval>, const double*) = nullptr;

    template <class R> R distance(sdf::Vec3<R> p, const LeafNumbers& k) const {
        if constexpr (std::is_same_v<R, float>) return f32(p, k.data());
        else if constexpr (std::is_same_v<R, double>) return f64(p, k.data());
        else if constexpr (std::is_same_v<R, sdf::Dual>) return dual(p, k.data());
        else return interval(p, k.data());
    }
    /// How many numbers the GLSL function takes.
    int leafNumbers() const;
};

/// An operator folds its children's distances from the left, two at a time: f(f(a, b), c) …
struct Operator : ShapeType {
    std::string_view glsl;                     // the function: opUnion; empty: this version cannot evaluate it yet
    bool commutative = false;
    bool first_only = false;                   // the result lies within the first child (plus the blend)
    bool intersects = false;                   // the result lies within every child (plus the blend)
    float (*f32)(float, float, double) = nullptr;
    double (*f64)(double, double, double) = nullptr;
    sdf::Dual (*dual)(sdf::Dual, sdf::Dual, double) = nullptr;
    sdf::Interval (*interval)(sdf::Interval, sdf::Interval, double) = nullptr;

    bool evaluated() const { return !glsl.empty(); }
    /// Whether the surface is the second child's where their distances are a and b; the first one wins a tie.
    bool takesSecond(double a, double b) const { return intersects ? b > a : first_only ? -b > a : b < a; }
    template <class R> R fold(R a, R b, double blend) const {
        if constexpr (std::is_same_v<R, float>) return f32(a, b, blend);
        else if constexpr (std::is_same_v<R, double>) return f64(a, b, blend);
        else if constexpr (std::is_same_v<R, sdf::Dual>) return dual(a, b, blend);
        else return interval(a, b, blend);
    }
};

std::span<const Primitive> primitives();
std::span<const Operator> operators();

/// The row of that name in either table; null if there is none.
const ShapeType* findShapeType(std::string_view name);
inline const Primitive& asPrimitive(const ShapeType& t) { return static_cast<const Primitive&>(t); }
inline const Operator& asOperator(const ShapeType& t) { return static_cast<const Operator&>(t); }

/// The numbers of a new object of this type: each parameter's initial value, in the order of the keys.
Numbers initialNumbers(const ShapeType& type);

}  // namespace mb
