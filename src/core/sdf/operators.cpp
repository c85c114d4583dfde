// The table of operators. To add one: its function in shaders/sdf/operators.glsl, and a row here.
#include "core/sdf/call.h"
#include "core/sdf/shape.h"

namespace mb {
namespace {

constexpr Parameter number(std::string_view name, std::string_view unit, std::string_view tip, double initial, double lo,
                           double hi, double slider_lo, double slider_hi, bool optional) {
    return {.name = name, .unit = unit, .tip = tip, .size = 1, .initial = {initial}, .lo = lo, .hi = hi,
            .slider_lo = slider_lo, .slider_hi = slider_hi, .optional = optional};
}
constexpr std::string_view kAxes[] = {"x", "y", "z"};

constexpr Parameter kBlend[] = {number("blend", "m", "rounds the seam over this length", 0, 0, 1e6, 0, 1, true)};
constexpr Parameter kMorph[] = {number("t", "", "0: the first shape, 1: the second", 0.5, 0, 1, 0, 1, true)};
constexpr Parameter kShell[] = {number("thickness", "m", "of the wall", 0.05, 1e-6, 1e6, 0.005, 1, false)};
constexpr Parameter kRound[] = {number("radius", "m", "how far it swells", 0.05, 0, 1e6, 0, 1, false)};
constexpr Parameter kRepeat[] = {
    {.name = "cell", .unit = "m", .tip = "the distance between copies; 0: none along this axis", .size = 3,
     .initial = {1, 0, 0}, .lo = 0, .hi = 1e6, .slider_lo = 0, .slider_hi = 5},
    {.name = "count", .unit = "", .tip = "how many copies along each axis", .size = 3, .initial = {3, 1, 1}, .lo = 1, .hi = 1e6,
     .slider_lo = 1, .slider_hi = 20, .kind = Parameter::Kind::whole}};
constexpr Parameter kMirror[] = {{.name = "axis", .unit = "", .tip = "the plane's normal", .size = 1, .initial = {0}, .lo = 0,
                                  .hi = 2, .kind = Parameter::Kind::word, .words = kAxes}};
constexpr Parameter kTwist[] = {number("turns", "turns/m", "along y", 0.1, -1e3, 1e3, -1, 1, false)};
constexpr Parameter kBend[] = {number("angle", "degrees/m", "along x; the ends rise where it is positive", 30, -1e5, 1e5, -180, 180, false)};
constexpr Parameter kDisplace[] = {number("amplitude", "m", "of the waves, up and down", 0.02, 0, 1e6, 0, 0.5, false),
                                   number("frequency", "1/m", "waves a metre, along each axis", 2, 0, 1e6, 0, 30, false)};

constexpr double kPi = 3.14159265358979323846;

#define MB_FUNCTION(name) [](auto s) { return &decltype(s)::name; }

/// Evaluators of one library function for every scalar; `f` names the member of Sdf<real>.
template <class F> constexpr ForScalars<FoldFunction> folding(F) {
    using sdf::Dual, sdf::Interval, sdf::Sdf;
    return {[](float a, float b, double k) { return (Sdf<float>{}.*F{}(Sdf<float>{}))(a, b, static_cast<float>(k)); },
            [](double a, double b, double k) { return (Sdf<double>{}.*F{}(Sdf<double>{}))(a, b, k); },
            [](Dual a, Dual b, double k) { return (Sdf<Dual>{}.*F{}(Sdf<Dual>{}))(a, b, k); },
            [](Interval a, Interval b, double k) { return (Sdf<Interval>{}.*F{}(Sdf<Interval>{}))(a, b, k); }};
}
template <class R, class F> R shareWith(R a, R b, double k, double tie) {
    return (sdf::Sdf<R>{}.*F{}(sdf::Sdf<R>{}))(a, b, sdf::plain<R>(k), sdf::plain<R>(tie));
}
template <class F> constexpr ForScalars<ShareFunction> sharing(F) {
    return {shareWith<float, F>, shareWith<double, F>, shareWith<sdf::Dual, F>, shareWith<sdf::Interval, F>};
}
template <class R, class F> R wrapWith(R d, sdf::Vec3<R> p, const double* k) { return sdf::wrap(F{}(sdf::Sdf<R>{}), d, p, k); }
template <class F> constexpr ForScalars<WrapFunction> wrapping(F) {
    return {wrapWith<float, F>, wrapWith<double, F>, wrapWith<sdf::Dual, F>, wrapWith<sdf::Interval, F>};
}
template <class R, class F> sdf::Vec3<R> warpWith(sdf::Vec3<R> p, const double* k) { return sdf::warp(F{}(sdf::Sdf<R>{}), p, k); }
template <class F> constexpr ForScalars<WarpFunction> warping(F) {
    return {warpWith<float, F>, warpWith<double, F>, warpWith<sdf::Dual, F>, warpWith<sdf::Interval, F>};
}

template <int N, class F, class S, class O, class I>
constexpr Operator fold(Operator o, const Parameter (&parameters)[N], F f, S share, O, I) {
    if (N != 1 || parameters[0].size != 1) throw "a fold takes one number";
    o.kind = Operator::Kind::fold, o.parameters = parameters;
    o.fold_by = folding(f), o.share_by = sharing(share);
    using Span = sdf::Vec2<double>;
    o.span_by = [](Span a, Span a_inner, Span b, Span b_inner) { return (sdf::Sdf<double>{}.*O{}(sdf::Sdf<double>{}))(a, a_inner, b, b_inner); };
    o.inner_by = [](Span a, Span a_inner, Span b, Span b_inner) { return (sdf::Sdf<double>{}.*I{}(sdf::Sdf<double>{}))(a, a_inner, b, b_inner); };
    return o;
}
/// A row whose parameters, with the derived ones, do not match the GLSL function does not compile.
template <int N, class F> constexpr Operator wrap(Operator o, const Parameter (&parameters)[N], F f) {
    int declared = 0;
    for (const Parameter& p : parameters) declared += p.size;
    for (const std::string_view name : o.derived) declared += name.empty() ? 0 : 1;
    if (declared != sdf::wrapNumbers(f(sdf::Sdf<float>{})) || declared > kMaxLeafNumbers)
        throw "the parameters do not match the GLSL function";
    o.kind = Operator::Kind::wrap, o.parameters = parameters, o.min_children = o.max_children = 1;
    o.takes_point = sdf::takesPoint(f(sdf::Sdf<float>{}));
    o.wrap_by = wrapping(f);
    return o;
}
template <int N, class F, class W> constexpr Operator warp(Operator o, const Parameter (&parameters)[N], F f, W w) {
    if (!o.cook || !o.steepness || !o.extent) throw "a warp must say how it stretches space, and where its child comes to lie";
    o.warp_by = warping(w);
    return wrap(o, parameters, f);
}
template <int N> constexpr Operator copies(Operator o, const Parameter (&parameters)[N]) {
    o.kind = Operator::Kind::copies, o.parameters = parameters, o.min_children = o.max_children = 1;
    return o;
}

double largest(const Box& box, std::size_t axis) {
    return box.lo[axis] > box.hi[axis] ? 0 : std::max(std::fabs(box.lo[axis]), std::fabs(box.hi[axis]));
}
/// A part in a million for the rounding of what is computed with it.
constexpr double kSlack = 1 + 1e-6;

/// Turning a plane by an angle that grows by t radians a metre along a direction moves a point at the radius r sideways by
/// t·r. Across that direction (a twist) this is a shear, whose greatest stretch is (t·r + √((t·r)² + 4))/2; along it (a
/// bend) the two add up to 1 + t·r.
void cookTwist(LeafNumbers& k, const Box& child) {
    k[1] = std::hypot(largest(child, 0), largest(child, 2));
    const double shear = 2 * kPi * std::fabs(k[0]) * k[1];
    k[2] = 2 / ((shear + std::sqrt(shear * shear + 4)) * kSlack);
}
void cookBend(LeafNumbers& k, const Box& child) {
    k[0] /= 360;
    k[1] = std::hypot(largest(child, 0), largest(child, 1));
    k[2] = 1 / ((1 + 2 * kPi * std::fabs(k[0]) * k[1]) * kSlack);
}
void cookDisplace(LeafNumbers& k, const Box&) { k[2] = 1 / ((1 + 2 * kPi * k[0] * k[1]) * kSlack); }
double eased(const LeafNumbers& k) { return 1 / k[2]; }

double axisCount(const Numbers& k, std::size_t axis) { return k[axis] > 0 ? k[axis + 3] : 1; }
/// On a grid whose middle is the operator's origin.
Copy gridCopy(const Numbers& k, std::size_t i) {
    Copy copy;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto n = static_cast<std::size_t>(axisCount(k, axis));
        copy.offset[axis] = k[axis] * (static_cast<double>(i % n) - 0.5 * static_cast<double>(n - 1));
        i /= n;
    }
    return copy;
}
Copy mirrorCopy(const Numbers& k, std::size_t i) {
    Copy copy;
    if (i == 1) copy.mirror[static_cast<std::size_t>(k[0])] = -1;
    return copy;
}

constexpr Operator about(std::string_view name, std::string_view glsl, std::string_view tip, std::string_view share = {},
                         std::string_view span = {}, std::string_view inner = {}) {
    Operator o{};
    o.name = name, o.glsl = glsl, o.tip = tip, o.share = share, o.span = span, o.inner = inner, o.min_children = 1, o.max_children = 100'000;
    return o;
}
template <class Claim> constexpr Operator claims(Operator o, Claim claim) { return claim(o), o; }

constexpr Operator kOperators[] = {
    fold(claims(about("union", "opUnion", "All of the children together", "shareUnion", "spanUnion", "innerUnion"), [](Operator& o) { o.commutative = o.blends = true; }),
         kBlend, MB_FUNCTION(opUnion), MB_FUNCTION(shareUnion), MB_FUNCTION(spanUnion), MB_FUNCTION(innerUnion)),
    fold(claims(about("intersect", "opIntersect", "What all the children share", "shareIntersect", "spanIntersect", "innerIntersect"),
                [](Operator& o) { o.commutative = o.blends = o.intersects = true; }),
         kBlend, MB_FUNCTION(opIntersect), MB_FUNCTION(shareIntersect), MB_FUNCTION(spanIntersect), MB_FUNCTION(innerIntersect)),
    fold(claims(about("subtract", "opSubtract", "The first child less all the others", "shareSubtract", "spanSubtract", "innerSubtract"),
                [](Operator& o) { o.blends = o.first_only = true; }),
         kBlend, MB_FUNCTION(opSubtract), MB_FUNCTION(shareSubtract), MB_FUNCTION(spanSubtract), MB_FUNCTION(innerSubtract)),
    fold(claims(about("morph", "opMorph", "A shape between two shapes", "shareMorph", "spanMorph", "innerMorph"), [](Operator& o) { o.min_children = o.max_children = 2; }),
         kMorph, MB_FUNCTION(opMorph), MB_FUNCTION(shareMorph), MB_FUNCTION(spanMorph), MB_FUNCTION(innerMorph)),
    wrap(about("shell", "opShell", "Hollows a shape: its wall lies inside its surface"), kShell, MB_FUNCTION(opShell)),
    wrap(claims(about("round", "opRound", "Swells a shape"), [](Operator& o) { o.grows = [](const LeafNumbers& k) { return k[0]; }; }), kRound,
         MB_FUNCTION(opRound)),
    copies(claims(about("repeat", "", "Copies on a grid"),
                  [](Operator& o) {
                      o.count = [](const Numbers& k) { return axisCount(k, 0) * axisCount(k, 1) * axisCount(k, 2); };
                      o.copy = gridCopy;
                  }),
           kRepeat),
    copies(claims(about("mirror", "", "A shape and its mirror image"),
                  [](Operator& o) { o.count = [](const Numbers&) { return 2.0; }, o.copy = mirrorCopy; }),
           kMirror),
    warp(claims(about("twist", "opTwist", "Twists around y"),
                [](Operator& o) {
                    o.warp = "warpTwist", o.derived = {"reach", "ease"}, o.cook = cookTwist, o.steepness = eased;
                    o.extent = [](const LeafNumbers& k, const Box& child) { return Box{{-k[1], child.lo[1], -k[1]}, {k[1], child.hi[1], k[1]}}; };
                }),
         kTwist, MB_FUNCTION(opTwist), MB_FUNCTION(warpTwist)),
    warp(claims(about("bend", "opBend", "Bends a bar along x up, in the plane of x and y"),
                [](Operator& o) {
                    o.warp = "warpBend", o.derived = {"reach", "ease"}, o.cook = cookBend, o.steepness = eased;
                    o.extent = [](const LeafNumbers& k, const Box& child) { return Box{{-k[1], -k[1], child.lo[2]}, {k[1], k[1], child.hi[2]}}; };
                }),
         kBend, MB_FUNCTION(opBend), MB_FUNCTION(warpBend)),
    wrap(claims(about("displace", "opDisplace", "Waves on the surface"),
                [](Operator& o) { o.derived = {"ease", ""}, o.cook = cookDisplace, o.grows = [](const LeafNumbers& k) { return k[0]; }; }),
         kDisplace, MB_FUNCTION(opDisplace)),
};

}  // namespace

std::span<const Operator> operators() { return kOperators; }

int Operator::wrapNumbers() const {
    int n = 0;
    for (const Parameter& p : parameters) n += p.size;
    for (const std::string_view extra : derived) n += extra.empty() ? 0 : 1;
    return n;
}

const ShapeType* findShapeType(std::string_view name) {
    for (const Primitive& p : primitives()) if (p.name == name) return &p;
    for (const Operator& o : operators()) if (o.name == name) return &o;
    return nullptr;
}

Numbers initialNumbers(const ShapeType& type) {
    Numbers numbers{};
    unsigned at = 0;
    for (const Parameter& p : type.parameters)
        for (int i = 0; i < p.size; ++i) numbers[at++] = p.initial[static_cast<unsigned>(i)];
    return numbers;
}

}  // namespace mb
