// The table of primitives. To add one: its function in shaders/sdf/primitives.glsl, and a row here.
#include "core/sdf/call.h"
#include "core/sdf/primitive_matter.h"

namespace mb {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = 3.14159265358979323846;

constexpr Parameter length(std::string_view name, std::string_view tip, double initial) {
    return {.name = name, .unit = "m", .tip = tip, .size = 1, .initial = {initial}, .lo = 1e-6, .hi = 1e6,
            .slider_lo = 0.01, .slider_hi = 5};
}
constexpr Parameter lengths(std::string_view name, std::string_view tip, double initial) {
    Parameter p = length(name, tip, initial);
    p.size = 3, p.initial = {initial, initial, initial};
    return p;
}
/// A length that may be 0 and may be left out.
constexpr Parameter extra(std::string_view name, std::string_view tip) {
    Parameter p = length(name, tip, 0);
    p.lo = 0, p.slider_lo = 0, p.slider_hi = 1, p.optional = true;
    return p;
}

constexpr Parameter kSphere[] = {length("radius", "", 0.5)};
constexpr Parameter kBox[] = {lengths("size", "the three edge lengths", 1), extra("round", "radius of the edges")};
constexpr Parameter kPlane[] = {
    {.name = "normal", .unit = "", .tip = "points out of the solid; of any length but 0", .size = 3, .initial = {0, 1, 0},
     .lo = -1e6, .hi = 1e6, .slider_lo = -1, .slider_hi = 1, .optional = true},
    {.name = "offset", .unit = "m", .tip = "normal·p <= offset is solid", .size = 1, .initial = {0}, .lo = -1e9, .hi = 1e9,
     .slider_lo = -5, .slider_hi = 5, .optional = true}};
constexpr Parameter kTorus[] = {length("major", "from the centre to the middle of the tube", 0.5),
                                length("minor", "radius of the tube", 0.15)};
constexpr Parameter kCylinder[] = {length("radius", "", 0.5), length("height", "", 1), extra("round", "radius of the edges")};
constexpr Parameter kCapsule[] = {length("radius", "", 0.3), length("height", "between the two centres", 0.6)};
constexpr Parameter kCone[] = {length("radius", "of the base", 0.5), extra("radius2", "of the top"), length("height", "", 1)};
constexpr Parameter kEllipsoid[] = {lengths("radii", "along x, y and z", 0.5)};
constexpr Parameter kOctahedron[] = {length("radius", "from the centre to each corner", 0.6)};
constexpr Parameter kPrism[] = {{.name = "sides", .unit = "", .tip = "", .size = 1, .initial = {6}, .lo = 3, .hi = 12,
                                 .slider_lo = 3, .slider_hi = 12, .kind = Parameter::Kind::whole},
                                length("radius", "to a corner", 0.5), length("height", "", 1)};

constexpr Box around(double x, double y, double z) { return {{-x, -y, -z}, {x, y, z}}; }

/// The file's half-space n·p <= offset, with n made a unit vector.
void cookPlane(LeafNumbers& k) {
    const double n = std::sqrt(k[0] * k[0] + k[1] * k[1] + k[2] * k[2]);
    for (double& x : k) x /= n;
}
Box planeExtent(const LeafNumbers& k) {
    Box box = around(kInfinity, kInfinity, kInfinity);
    for (unsigned i = 0; i < 3; ++i) {
        if (k[i] == 1) box.hi[i] = k[3];
        if (k[i] == -1) box.lo[i] = -k[3];
    }
    return box;
}
/// n·(p + v) <= offset is n·p <= offset − n·v.
void movePlane(LeafNumbers& k, const std::array<double, 3>& v) { k[3] -= k[0] * v[0] + k[1] * v[1] + k[2] * v[2]; }
void cookPrism(LeafNumbers& k) { k[3] = k[1] * std::cos(kPi / k[0]); }
Box prismExtent(const LeafNumbers& k) {
    Box box = around(0, 0.5 * k[2], 0);
    const int sides = static_cast<int>(k[0]);
    for (int i = 0; i < sides; ++i) {
        const double angle = (2 * i + 1) * kPi / sides, x = k[1] * std::cos(angle), z = k[1] * std::sin(angle);
        box.lo[0] = std::min(box.lo[0], x), box.hi[0] = std::max(box.hi[0], x);
        box.lo[2] = std::min(box.lo[2], z), box.hi[2] = std::max(box.hi[2], z);
    }
    return box;
}

/// Slowest along the longest axis.
double ellipsoidRises(const LeafNumbers& k) { return std::min({k[0], k[1], k[2]}) / std::max({k[0], k[1], k[2]}); }

struct About {
    std::string_view name, glsl, tip;
    bool exact = true;
    void (*cook)(LeafNumbers&) = nullptr;
    std::string_view derived = {};
    bool turns = true;
    double (*rises)(const LeafNumbers&) = nullptr;
};

/// `f` names one function of Sdf<real> for every real: from it come the evaluators. A row whose parameters do not match
/// the GLSL function does not compile.
template <int N, class F>
constexpr Primitive row(const About& about, const Parameter (&parameters)[N], F f, Box (*extent)(const LeafNumbers&)) {
    int declared = about.derived.empty() ? 0 : 1;
    for (const Parameter& p : parameters) declared += p.size;
    if (declared != sdf::argumentNumbers(f(sdf::Sdf<float>{})) || declared > kMaxLeafNumbers)
        throw "the parameters do not match the GLSL function";
    if (about.exact != (about.rises == nullptr)) throw "a bound must say how fast it rises, and only a bound";
    Primitive p{};
    p.name = about.name, p.tip = about.tip, p.parameters = parameters;
    p.glsl = about.glsl, p.derived = about.derived, p.exact = about.exact, p.turns = about.turns, p.cook = about.cook, p.extent = extent, p.rises = about.rises;
    p.f32 = [](sdf::Vec3<float> q, const double* k) { return sdf::call(F{}(sdf::Sdf<float>{}), q, k); };
    p.f64 = [](sdf::Vec3<double> q, const double* k) { return sdf::call(F{}(sdf::Sdf<double>{}), q, k); };
    p.dual = [](sdf::Vec3<sdf::Dual> q, const double* k) { return sdf::call(F{}(sdf::Sdf<sdf::Dual>{}), q, k); };
    p.interval = [](sdf::Vec3<sdf::Interval> q, const double* k) { return sdf::call(F{}(sdf::Sdf<sdf::Interval>{}), q, k); };
    return p;
}
#define MB_FUNCTION(name) [](auto s) { return &decltype(s)::name; }

/// The row of a shape without bounds.
constexpr Primitive boundless(void (*move_origin)(LeafNumbers&, const std::array<double, 3>&), Primitive p) {
    p.moveOrigin = move_origin;
    return p;
}

template <class F> constexpr void checkSpan(const Primitive& p, F f) {
    int declared = p.derived.empty() ? 0 : 1;
    for (const Parameter& parameter : p.parameters) declared += parameter.size;
    if (declared != sdf::spanNumbers(f(sdf::Sdf<float>{}))) throw "the parameters do not match the span's";
}
template <class R, class F> sdf::Vec2<R> spanWith(sdf::Vec3<R> o, sdf::Vec3<R> d, const double* k) { return sdf::span(F{}(sdf::Sdf<R>{}), o, d, k); }
/// The row with its span: where a ray may be inside it.
template <class F> constexpr Primitive spanned(std::string_view span, F f, Primitive p) {
    checkSpan(p, f);
    p.span = span, p.span_f32 = spanWith<float, F>, p.span_f64 = spanWith<double, F>;
    return p;
}
/// And with its inner span: where a ray is inside it for certain.
template <class F> constexpr Primitive filled(std::string_view inner, F f, Primitive p) {
    checkSpan(p, f);
    p.inner = inner, p.inner_f32 = spanWith<float, F>, p.inner_f64 = spanWith<double, F>;
    return p;
}
#define MB_SPAN(name) #name, MB_FUNCTION(name)

/// The row with its volume and inertia in closed form; without, they are integrated.
constexpr Primitive weighed(std::optional<Matter> (*matter)(const LeafNumbers&), Primitive p) {
    p.matter = matter;
    return p;
}

/// The row of a convex one.
constexpr Primitive convex(Primitive p) {
    p.convex = true;
    return p;
}

constexpr Primitive kPrimitives[] = {
    convex(weighed(sphereMatter, filled(MB_SPAN(innerSphere), spanned(MB_SPAN(spanSphere), row({.name = "sphere", .glsl = "sdSphere", .tip = "A ball", .turns = false}, kSphere, MB_FUNCTION(sdSphere),
        [](const LeafNumbers& k) { return around(k[0], k[0], k[0]); }))))),
    convex(weighed(boxMatter, filled(MB_SPAN(innerBox), spanned(MB_SPAN(spanBox), row({"box", "sdBox", "A box, its edges rounded if wished"}, kBox, MB_FUNCTION(sdBox),
        [](const LeafNumbers& k) { return around(k[0] / 2, k[1] / 2, k[2] / 2); }))))),
    convex(filled(MB_SPAN(spanPlane), spanned(MB_SPAN(spanPlane), boundless(movePlane, row({"plane", "sdPlane", "Everything below a plane", true, cookPlane}, kPlane, MB_FUNCTION(sdPlane), planeExtent))))),
    weighed(torusMatter, spanned(MB_SPAN(spanTorus), row({"torus", "sdTorus", "A ring around y"}, kTorus, MB_FUNCTION(sdTorus),
        [](const LeafNumbers& k) { return around(k[0] + k[1], k[1], k[0] + k[1]); }))),
    convex(weighed(cylinderMatter, filled(MB_SPAN(innerCylinder), spanned(MB_SPAN(spanCylinder), row({"cylinder", "sdCylinder", "An upright cylinder"}, kCylinder, MB_FUNCTION(sdCylinder),
        [](const LeafNumbers& k) { return around(k[0], k[1] / 2, k[0]); }))))),
    convex(weighed(capsuleMatter, filled(MB_SPAN(innerCapsule), spanned(MB_SPAN(spanCapsule), row({"capsule", "sdCapsule", "An upright cylinder with round ends"}, kCapsule, MB_FUNCTION(sdCapsule),
        [](const LeafNumbers& k) { return around(k[0], k[0] + k[1] / 2, k[0]); }))))),
    convex(weighed(coneMatter, spanned(MB_SPAN(spanCone), row({"cone", "sdCone", "An upright cone, whole or cut off"}, kCone, MB_FUNCTION(sdCone),
        [](const LeafNumbers& k) { return around(std::max(k[0], k[1]), k[2] / 2, std::max(k[0], k[1])); })))),
    weighed(ellipsoidMatter, spanned(MB_SPAN(spanEllipsoid), row({.name = "ellipsoid", .glsl = "sdEllipsoid", .tip = "A ball stretched along the axes", .exact = false, .rises = ellipsoidRises},
        kEllipsoid, MB_FUNCTION(sdEllipsoid),
        [](const LeafNumbers& k) { return around(k[0], k[1], k[2]); }))),
    convex(weighed(octahedronMatter, spanned(MB_SPAN(spanOctahedron), row({"octahedron", "sdOctahedron", "Eight triangles"}, kOctahedron, MB_FUNCTION(sdOctahedron),
        [](const LeafNumbers& k) { return around(k[0], k[0], k[0]); })))),
    convex(weighed(prismMatter, filled(MB_SPAN(innerPrism), spanned(MB_SPAN(spanPrism), row({"prism", "sdPrism", "An upright column of 3 to 12 sides", true, cookPrism, "apothem"}, kPrism, MB_FUNCTION(sdPrism),
        prismExtent))))),
};

}  // namespace

std::span<const Primitive> primitives() { return kPrimitives; }

int Primitive::leafNumbers() const {
    int n = derived.empty() ? 0 : 1;
    for (const Parameter& p : parameters) n += p.size;
    return n;
}

}  // namespace mb
