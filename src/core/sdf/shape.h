#pragma once
// The rows that describe every type of object: its name, its parameters and how to evaluate it. The text format, the
// menus, the sliders, the GLSL and the tests all walk these two tables and know nothing else of a type.
#include "core/sdf/glsl.h"

#include <array>
#include <optional>
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
    /// A number of this key, of an object scaled by that much: lengths grow, and what counts per metre shrinks.
    double scaled(double x, double scale) const { return isLength() ? x * scale : unit.ends_with("/m") ? x / scale : x; }
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

/// How a primitive's matter lies, for density 1. Its frame's axes, moved to the centre of mass, are principal ones.
struct Matter {
    double volume = 0;                         // m³
    double centre_y = 0;                       // m: of the centre of mass, which lies on the frame's y axis
    std::array<double, 3> spread{};            // m²: the mean square of the distance from the centre along x, y and z
};

struct Primitive : ShapeType {
    std::string_view glsl;                     // the function: sdSphere
    std::string_view derived;                  // one more number behind the keys' own, or none: its name in the GLSL
    bool exact = true;                         // |gradient| is 1 almost everywhere, not only at most 1
    bool convex = false;                       // of an exact one: the point nearest to a place outside is the only one that is nearest around
    bool turns = true;                         // a rotation changes it; false for the ball alone
    void (*cook)(LeafNumbers&) = nullptr;      // makes the numbers the GLSL takes from the scaled ones of the file
    Box (*extent)(const LeafNumbers&) = nullptr;  // the tightest box around it, from cooked numbers
    void (*moveOrigin)(LeafNumbers&, const std::array<double, 3>& by) = nullptr;  // of one without bounds: the same shape seen from another origin
    double (*rises)(const LeafNumbers&) = nullptr;  // of a bound: at least how much a metre away from the shape adds to it
    std::optional<Matter> (*matter)(const LeafNumbers&) = nullptr;  // its closed form, where there is one for these numbers
    float (*f32)(sdf::Vec3<float>, const double*) = nullptr;
    double (*f64)(sdf::Vec3<double>, const double*) = nullptr;
    sdf::Dual (*dual)(sdf::Vec3<sdf::Dual>, const double*) = nullptr;
    sdf::Interval (*interval)(sdf::Vec3<sdf::Interval>, const double*) = nullptr;
    std::string_view span;                     // spanSphere: where a ray may be inside; empty: not known
    sdf::Vec2<float> (*span_f32)(sdf::Vec3<float> o, sdf::Vec3<float> d, const double*) = nullptr;
    sdf::Vec2<double> (*span_f64)(sdf::Vec3<double> o, sdf::Vec3<double> d, const double*) = nullptr;
    std::string_view inner;                    // innerSphere: where a ray is inside for certain; empty: not known
    sdf::Vec2<float> (*inner_f32)(sdf::Vec3<float> o, sdf::Vec3<float> d, const double*) = nullptr;
    sdf::Vec2<double> (*inner_f64)(sdf::Vec3<double> o, sdf::Vec3<double> d, const double*) = nullptr;

    template <class R> R distance(sdf::Vec3<R> p, const LeafNumbers& k) const {
        if constexpr (std::is_same_v<R, float>) return f32(p, k.data());
        else if constexpr (std::is_same_v<R, double>) return f64(p, k.data());
        else if constexpr (std::is_same_v<R, sdf::Dual>) return dual(p, k.data());
        else return interval(p, k.data());
    }
    /// How many numbers the GLSL function takes.
    int leafNumbers() const;
};

/// The four evaluators of one function of the GLSL library.
template <template <class> class Signature> struct ForScalars {
    Signature<float> f32 = nullptr;
    Signature<double> f64 = nullptr;
    Signature<sdf::Dual> dual = nullptr;
    Signature<sdf::Interval> interval = nullptr;
    template <class R> Signature<R> of() const {
        if constexpr (std::is_same_v<R, float>) return f32;
        else if constexpr (std::is_same_v<R, double>) return f64;
        else if constexpr (std::is_same_v<R, sdf::Dual>) return dual;
        else return interval;
    }
    explicit operator bool() const { return f64 != nullptr; }
};
template <class R> using FoldFunction = R (*)(R a, R b, double k);
template <class R> using ShareFunction = R (*)(R a, R b, double k, double tie);
/// A span of the result, from the two children's spans and inner spans.
using SpanFunction = sdf::Vec2<double> (*)(sdf::Vec2<double> a, sdf::Vec2<double> a_inner, sdf::Vec2<double> b, sdf::Vec2<double> b_inner);
template <class R> using WrapFunction = R (*)(R d, sdf::Vec3<R> p, const double* k);
template <class R> using WarpFunction = sdf::Vec3<R> (*)(sdf::Vec3<R> p, const double* k);

/// A copy of a child: point = turn·p + offset, `turn` a rotation or a reflection.
struct Copy {
    std::array<double, 3> mirror{1, 1, 1};     // the diagonal of the turn: ±1
    std::array<double, 3> offset{};
};

/// An operator is of one of three kinds. A fold joins its children's distances from the left, two at a time: f(f(a, b), c) …
/// A wrap changes one child's distance, and where it warps space, the point that the child is asked at. Copies stand for
/// their plain union.
struct Operator : ShapeType {
    enum class Kind { fold, wrap, copies } kind = Kind::fold;
    std::string_view glsl;                     // the function on distances: opUnion, opTwist; none of copies
    std::string_view share;                    // of a fold: how much of the second child shows, shareUnion
    std::string_view span, inner;              // of a fold: of its children's spans, spanUnion and innerUnion
    std::string_view warp;                     // of a wrap that warps space: warpTwist
    std::array<std::string_view, 2> derived{}; // names of the numbers a wrap's cook adds behind the file's
    bool commutative = false;
    bool first_only = false;                   // the result lies within the first child (plus the blend); the second is taken away
    bool intersects = false;                   // the result lies within every child (plus the blend)
    bool blends = false;                       // its first parameter is a blend: at 0 it is the plain operator
    bool takes_point = false;                  // the wrap's function asks where it is
    ForScalars<FoldFunction> fold_by;
    ForScalars<ShareFunction> share_by;
    SpanFunction span_by = nullptr, inner_by = nullptr;
    ForScalars<WrapFunction> wrap_by;
    ForScalars<WarpFunction> warp_by;
    void (*cook)(LeafNumbers&, const Box& child) = nullptr;  // of a wrap: the GLSL's numbers from the scaled ones of the file
    double (*grows)(const LeafNumbers&) = nullptr;           // of a wrap: how far out the surface may move, m
    double (*steepness)(const LeafNumbers&) = nullptr;       // of a warp: by how much it stretches space at most; the value is divided by it
    Box (*extent)(const LeafNumbers&, const Box& child) = nullptr;     // of a warp: the box of the warped child
    double (*count)(const Numbers&) = nullptr;               // of copies: how many
    Copy (*copy)(const Numbers&, std::size_t) = nullptr;     // the one of that number

    template <class R> R fold(R a, R b, double k) const { return fold_by.of<R>()(a, b, k); }
    /// From 0, the first child alone, to 1, the second alone; the first where they differ by no more than `tie`, a blend apart.
    template <class R> R shareOfSecond(R a, R b, double k, double tie = 0) const { return share_by.of<R>()(a, b, k, tie); }
    template <class R> R wrap(R d, sdf::Vec3<R> p, const LeafNumbers& k) const { return wrap_by.of<R>()(d, p, k.data()); }
    template <class R> sdf::Vec3<R> warped(sdf::Vec3<R> p, const LeafNumbers& k) const { return warp_by.of<R>()(p, k.data()); }
    /// How many numbers the wrap's GLSL functions take.
    int wrapNumbers() const;
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
