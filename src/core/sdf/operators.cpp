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
constexpr Parameter kBend[] = {number("angle", "degrees/m", "", 30, -1e5, 1e5, -180, 180, false)};
constexpr Parameter kDisplace[] = {number("amplitude", "m", "", 0.05, 0, 1e6, 0, 0.5, false),
                                   number("frequency", "1/m", "", 5, 0, 1e6, 0, 30, false)};

struct About {
    std::string_view name, glsl, tip;
    bool commutative = false, first_only = false, intersects = false;
};

template <int N, class F> constexpr Operator fold(const About& about, const Parameter (&parameters)[N], F) {
    Operator o{};
    o.name = about.name, o.tip = about.tip, o.parameters = parameters, o.min_children = 1, o.max_children = 100'000;
    o.glsl = about.glsl, o.commutative = about.commutative, o.first_only = about.first_only, o.intersects = about.intersects;
    o.f32 = [](float a, float b, double k) { return (sdf::Sdf<float>{}.*F{}(sdf::Sdf<float>{}))(a, b, static_cast<float>(k)); };
    o.f64 = [](double a, double b, double k) { return (sdf::Sdf<double>{}.*F{}(sdf::Sdf<double>{}))(a, b, k); };
    o.dual = [](sdf::Dual a, sdf::Dual b, double k) { return (sdf::Sdf<sdf::Dual>{}.*F{}(sdf::Sdf<sdf::Dual>{}))(a, b, k); };
    o.interval = [](sdf::Interval a, sdf::Interval b, double k) {
        return (sdf::Sdf<sdf::Interval>{}.*F{}(sdf::Sdf<sdf::Interval>{}))(a, b, k);
    };
    return o;
}
/// An operator that files may hold and the editor keeps, but that no evaluator of this version knows.
template <int N>
constexpr Operator unevaluated(std::string_view name, std::string_view tip, const Parameter (&parameters)[N], int children) {
    Operator o{};
    o.name = name, o.tip = tip, o.parameters = parameters, o.min_children = children, o.max_children = children;
    return o;
}
#define MB_FUNCTION(name) [](auto s) { return &decltype(s)::name; }

constexpr Operator kOperators[] = {
    fold({"union", "opUnion", "All of the children together", true}, kBlend, MB_FUNCTION(opUnion)),
    fold({"intersect", "opIntersect", "What all the children share", true, false, true}, kBlend, MB_FUNCTION(opIntersect)),
    fold({"subtract", "opSubtract", "The first child less all the others", false, true}, kBlend, MB_FUNCTION(opSubtract)),
    unevaluated("morph", "A shape between two shapes", kMorph, 2),
    unevaluated("shell", "Hollows a shape", kShell, 1),
    unevaluated("round", "Swells a shape", kRound, 1),
    unevaluated("repeat", "Copies on a grid", kRepeat, 1),
    unevaluated("mirror", "A shape and its mirror image", kMirror, 1),
    unevaluated("twist", "Twists around y", kTwist, 1),
    unevaluated("bend", "Bends", kBend, 1),
    unevaluated("displace", "Waves on the surface", kDisplace, 1),
};

}  // namespace

std::span<const Operator> operators() { return kOperators; }

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
