// Every row of primitives() held to its laws, and every law to rows that break it.
#include "sdf/primitive_laws.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <vector>

using namespace mb;

namespace {

std::string libraryText() {
    std::ifstream in(MARCHBOX_SOURCE "/shaders/sdf/primitives.glsl");
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

/// The first violation that some drawn shapes of the row show, or nothing.
std::string firstViolation(const PrimitiveLaw& law, const Primitive& row, int specimens) {
    Draw draw(streamOf(row.name));
    for (int i = 0; i < specimens; ++i) {
        const Specimen s = drawSpecimen(draw, row);
        if (std::string fault = law.violation(s, draw); !fault.empty()) return fault;
    }
    return {};
}

}  // namespace

TEST_CASE("every primitive keeps every law") {
    for (const PrimitiveLaw& law : primitiveLaws())
        for (const Primitive& row : primitives()) {
            const std::string fault = firstViolation(law, row, times(law.specimens));
            CHECK_MESSAGE(fault.empty(), law.name << ": " << fault);
        }
}

TEST_CASE("every primitive's function bears the names and types of its row") {
    const std::string text = libraryText();
    REQUIRE(!text.empty());
    for (const Primitive& row : primitives()) CHECK(signatureViolation(row, text) == "");
}

TEST_CASE("both tables are well formed") {
    CHECK(primitives().size() >= 10);
    for (const Primitive& row : primitives()) {
        CHECK(nameViolation(row) == "");
        CHECK(rangeViolation(row.parameters) == "");
        CHECK(!row.isOperator());
        CHECK(row.leafNumbers() <= kMaxLeafNumbers);
    }
    for (const Operator& row : operators()) {
        CHECK(nameViolation(row) == "");
        CHECK(rangeViolation(row.parameters) == "");
        CHECK(row.isOperator());
        CHECK(row.min_children >= 1);
        CHECK(row.min_children <= row.max_children);
        // makeTree reads a fold's blend from its first number, and scales it.
        if (row.blends) CHECK((row.parameters.size() == 1 && row.parameters[0].name == "blend" && row.parameters[0].isLength()));
        if (row.kind == Operator::Kind::fold) CHECK(row.parameters[0].size == 1);
        CHECK((row.kind == Operator::Kind::copies) == row.glsl.empty());
    }
}

TEST_CASE("a new object's numbers are its row's initial values, and make a sound shape") {
    for (const Primitive& row : primitives()) {
        const auto k = cooked(row, initialNumbers(row));
        REQUIRE(k);
        CHECK(row.distance<double>(sdf::Vec3<double>(100), *k) > 0);
    }
}

// --- the laws' twins ------------------------------------------------------------------------------------------------------

namespace {

const Primitive& rowOf(std::string_view name) { return asPrimitive(*findShapeType(name)); }

/// A copy of the row with every evaluator replaced by `f`, a generic function of a point and the numbers.
template <class F> Primitive with(std::string_view name, F) {
    Primitive bad = rowOf(name);
    bad.f32 = [](sdf::Vec3<float> p, const double* k) { return F{}(p, k); };
    bad.f64 = [](sdf::Vec3<double> p, const double* k) { return F{}(p, k); };
    bad.dual = [](sdf::Vec3<sdf::Dual> p, const double* k) { return F{}(p, k); };
    bad.interval = [](sdf::Vec3<sdf::Interval> p, const double* k) { return F{}(p, k); };
    return bad;
}
template <class R> R number(double x) { return static_cast<R>(x); }

struct BadRow {
    std::string_view law;
    Primitive row;
};
std::vector<BadRow> badRows() {
    std::vector<BadRow> all;
    const auto add = [&](std::string_view law, std::string_view name, auto change) {
        Primitive bad = rowOf(name);
        change(bad);
        all.push_back({law, bad});
    };
    add("the extent is the tightest box", "sphere", [](Primitive& p) {
        p.extent = [](const LeafNumbers& k) { return Box{{-2 * k[0], -k[0], -k[0]}, {k[0], k[0], k[0]}}; };
    });
    add("the extent is the tightest box", "sphere", [](Primitive& p) {
        p.extent = [](const LeafNumbers& k) { return Box{{-k[0], -k[0], -k[0]}, {k[0], k[0], k[0] * 0.999}}; };
    });
    add("the extent is the tightest box", "plane", [](Primitive& p) {
        p.extent = [](const LeafNumbers&) { return Box{{-1, -1, -1}, {1, 1, 1}}; };
    });
    add("gradients match differences", "box", [](Primitive& p) {
        p.dual = [](sdf::Vec3<sdf::Dual> q, const double* k) { return rowOf("box").dual(q, k) * sdf::Dual(1) + sdf::Dual(0, 1e-6, 0, 0); };
    });
    add("gradients match differences", "box", [](Primitive& p) {
        p.dual = [](sdf::Vec3<sdf::Dual> q, const double* k) { return rowOf("box").dual(q, k) * sdf::Dual(1 + 0x1p-52); };
    });
    add("intervals hold every sample of their box", "torus", [](Primitive& p) {
        p.interval = [](sdf::Vec3<sdf::Interval> q, const double* k) {
            const sdf::Interval r = rowOf("torus").interval(q, k);
            return sdf::Interval(r.lo + 1e-3 * (r.hi - r.lo), r.hi);
        };
    });
    add("intervals are of use", "torus", [](Primitive& p) {
        p.interval = [](sdf::Vec3<sdf::Interval>, const double*) { return sdf::Interval(-1e9, 1e9); };
    });
    add("float agrees with double", "capsule", [](Primitive& p) {
        p.f32 = [](sdf::Vec3<float> q, const double* k) { return rowOf("capsule").f32(q, k) + 1e-5f * static_cast<float>(k[0]); };
    });
    // The distance scaled, without its sign, of another ball; two numbers in the wrong order; a bound called exact.
    const auto steep = []<class R>(sdf::Vec3<R> p, const double* k) { return (length(p) - number<R>(k[0])) * number<R>(1.1); };
    const auto flat = []<class R>(sdf::Vec3<R> p, const double* k) { return (length(p) - number<R>(k[0])) * number<R>(0.9); };
    const auto unsigned_ = []<class R>(sdf::Vec3<R> p, const double* k) {
        using sdf::abs;
        return abs(length(p) - number<R>(k[0]));
    };
    const auto large = []<class R>(sdf::Vec3<R> p, const double* k) { return length(p) - number<R>(2 * k[0]); };
    const auto swapped = []<class R>(sdf::Vec3<R> p, const double* k) { return sdf::Sdf<R>{}.sdTorus(p, number<R>(k[1]), number<R>(k[0])); };
    all.push_back({"the slope is one, or at most one", with("sphere", steep)});
    all.push_back({"the slope is one, or at most one", with("sphere", flat)});
    all.push_back({"no pair is steeper than one", with("sphere", steep)});
    all.push_back({"the distance is that to the surface", with("sphere", flat)});
    all.push_back({"the distance is that to the surface", with("sphere", unsigned_)});
    all.push_back({"the extent is the tightest box", with("sphere", large)});
    all.push_back({"the extent is the tightest box", with("torus", swapped)});
    add("the slope is one, or at most one", "ellipsoid", [](Primitive& p) { p.exact = true; });
    add("the distance is that to the surface", "ellipsoid", [](Primitive& p) { p.exact = true; });
    add("what is called convex is", "torus", [](Primitive& p) { p.convex = true; });
    add("what is called convex is", "ellipsoid", [](Primitive& p) { p.convex = true; });
    add("the value rises with the distance from the shape", "ellipsoid", [](Primitive& p) { p.rises = nullptr; });
    return all;
}

}  // namespace

TEST_CASE("every law fails on a row that breaks it") {
    const std::vector<BadRow> bad = badRows();
    for (const PrimitiveLaw& law : primitiveLaws()) {
        int tried = 0;
        for (const BadRow& b : bad) {
            if (b.law != law.name) continue;
            ++tried;
            CHECK_MESSAGE(!firstViolation(law, b.row, 20).empty(), law.name << " does not see what is wrong with bad row " << tried);
        }
        CHECK_MESSAGE(tried > 0, law.name << " has no bad row");
    }
}

TEST_CASE("the checks of names and ranges fail on bad rows") {
    const std::string text = libraryText();
    Primitive swapped = rowOf("torus");
    const Parameter wrong_order[] = {swapped.parameters[1], swapped.parameters[0]};
    swapped.parameters = wrong_order;
    CHECK(signatureViolation(swapped, text) != "");
    Primitive underived = rowOf("prism");
    underived.derived = {};
    CHECK(signatureViolation(underived, text) != "");

    ShapeType renamed = rowOf("prism");
    CHECK(nameViolation(renamed).find("another row") != std::string::npos);
    renamed.name = {};
    CHECK(nameViolation(renamed) == "no name or tip");

    const auto fault = [](auto change) {  // of a prism's parameters: sides, radius, height
        std::vector<Parameter> parameters(rowOf("prism").parameters.begin(), rowOf("prism").parameters.end());
        change(parameters);
        return rangeViolation(parameters);
    };
    CHECK(fault([](auto&) {}) == "");
    CHECK(fault([](auto& p) { p[1].name = p[2].name; }) == "height: twice");
    CHECK(fault([](auto& p) { p[1].name = {}; }) == ": no name, or neither 1 nor 3 numbers");
    CHECK(fault([](auto& p) { p[1].size = 2; }) == "radius: no name, or neither 1 nor 3 numbers");
    CHECK(fault([](auto& p) { p[1].size = p[2].size = 3, p[1].initial = p[2].initial = {1, 1, 1}; }) == "height: too many numbers");
    CHECK(fault([](auto& p) { std::swap(p[0].lo, p[0].hi); }) == "sides: an empty range");
    CHECK(fault([](auto& p) { p[1].slider_lo = p[1].lo / 2; }) == "radius: the slider leaves the range");
    CHECK(fault([](auto& p) { p[0].lo = 2.5; }) == "sides: a whole number's range is not whole");
    CHECK(fault([](auto& p) { p[0].initial[0] = 4.5; }) == "sides: the initial value is not whole");
    CHECK(fault([](auto& p) { p[0].initial[0] = 13; }) == "sides: the initial value is out of range");
}
