// Every evaluated row of operators() held to its laws, and every law to rows that break it; then the algebra of sets.
#include "sdf/operator_laws.h"

#include <doctest/doctest.h>

#include <vector>

using namespace mb;

namespace {

const Operator& rowOf(std::string_view name) { return asOperator(*findShapeType(name)); }

std::string firstViolation(const OperatorLaw& law, const Operator& row, int rounds) {
    Draw draw(streamOf(row.name));
    for (int i = 0; i < rounds; ++i)
        if (std::string fault = law.violation(row, draw); !fault.empty()) return fault;
    return {};
}

/// A copy of the row with every evaluator replaced by `f`, a generic function of two distances and the blend.
template <class F> Operator with(std::string_view name, F) {
    Operator bad = rowOf(name);
    bad.fold_by.f32 = [](float a, float b, double k) { return F{}(a, b, static_cast<float>(k)); };
    bad.fold_by.f64 = [](double a, double b, double k) { return F{}(a, b, k); };
    bad.fold_by.dual = [](sdf::Dual a, sdf::Dual b, double k) { return F{}(a, b, sdf::Dual(k)); };
    bad.fold_by.interval = [](sdf::Interval a, sdf::Interval b, double k) { return F{}(a, b, sdf::Interval(k)); };
    return bad;
}

}  // namespace

TEST_CASE("every operator on two distances keeps every law") {
    int evaluated = 0;
    for (const Operator& row : operators()) {
        if (row.kind != Operator::Kind::fold) continue;
        ++evaluated;
        for (const OperatorLaw& law : operatorLaws()) {
            if (law.of_blends && !row.blends) continue;
            const std::string fault = firstViolation(law, row, times(5));
            CHECK_MESSAGE(fault.empty(), law.name << ": " << fault);
        }
    }
    CHECK(evaluated >= 4);
}

TEST_CASE("every law of operators fails on a row that breaks it") {
    using sdf::max, sdf::min;
    const auto claiming = [](std::string_view name, auto change) {
        Operator bad = rowOf(name);
        change(bad);
        return bad;
    };
    const auto always_round = [](auto a, auto b, auto) { return decltype(sdf::Sdf<decltype(a)>{}){}.opUnion(a, b, decltype(a)(0.25f)); };
    const auto twice_as_round = [](auto a, auto b, auto k) { return decltype(sdf::Sdf<decltype(a)>{}){}.opUnion(a, b, k + k); };
    const auto steep = [](auto a, auto b, auto k) { return decltype(sdf::Sdf<decltype(a)>{}){}.opUnion(a + a, b + b, k); };
    const auto never_round = [](auto a, auto b, auto) { return min(a, b); };

    struct Bad {
        std::string_view law;
        Operator row;
    };
    const std::vector<Bad> all = {
        {"without a blend it is the plain operator, to the bit", with("union", always_round)},
        {"without a blend it is the plain operator, to the bit", claiming("union", [](Operator& o) { o.intersects = true; })},
        {"a blend moves the surface by at most a quarter of it", with("union", twice_as_round)},
        {"a blend moves the surface by at most a quarter of it", with("union", never_round)},
        {"it is no steeper than its children", with("union", steep)},
        {"it is commutative if it says so", claiming("subtract", [](Operator& o) { o.commutative = true; })},
        {"it is commutative if it says so", claiming("union", [](Operator& o) { o.commutative = false; })},
        {"its result lies where its row says", claiming("union", [](Operator& o) { o.first_only = true; })},
        {"its result lies where its row says", claiming("subtract", [](Operator& o) { o.intersects = true; })},
        {"its result lies where its row says", claiming("intersect", [](Operator& o) { o.intersects = false; })},
        {"the share is the value's derivative by the second", claiming("subtract", [](Operator& o) { o.share_by = rowOf("union").share_by; })},
        {"the share is the value's derivative by the second", claiming("intersect", [](Operator& o) { o.share_by = rowOf("union").share_by; })},
        {"the share is the value's derivative by the second", claiming("morph", [](Operator& o) { o.share_by = rowOf("union").share_by; })},
        {"all scalars agree", claiming("union", [](Operator& o) { o.fold_by.f32 = rowOf("intersect").fold_by.f32; })},
        {"all scalars agree", claiming("union", [](Operator& o) { o.fold_by.dual = rowOf("intersect").fold_by.dual; })},
        {"all scalars agree", claiming("subtract", [](Operator& o) { o.fold_by.interval = rowOf("intersect").fold_by.interval; })},
        {"gradients match differences", claiming("subtract", [](Operator& o) { o.fold_by.dual = rowOf("intersect").fold_by.dual; })},
    };
    for (const OperatorLaw& law : operatorLaws()) {
        int tried = 0;
        for (const Bad& bad : all) {
            if (bad.law != law.name) continue;
            ++tried;
            CHECK_MESSAGE(!firstViolation(law, bad.row, 1).empty(), law.name << " does not see what is wrong with bad row " << tried);
        }
        CHECK_MESSAGE(tried > 0, law.name << " has no bad row");
    }
}

TEST_CASE("the algebra of sets holds to the bit without a blend") {
    const auto unite = [](double a, double b) { return rowOf("union").fold<double>(a, b, 0); };
    const auto share = [](double a, double b) { return rowOf("intersect").fold<double>(a, b, 0); };
    const auto less = [](double a, double b) { return rowOf("subtract").fold<double>(a, b, 0); };
    Draw draw(7);
    for (int i = 0; i < times(20000); ++i) {
        const double a = draw.uniform(-2, 2), b = draw.oneIn(4) ? (draw.oneIn(2) ? a : -a) : draw.uniform(-2, 2), c = draw.uniform(-2, 2);
        REQUIRE(unite(a, a) == a);
        REQUIRE(share(a, a) == a);
        REQUIRE(less(a, a) == std::fabs(a));
        REQUIRE(unite(unite(a, b), c) == unite(a, unite(b, c)));
        REQUIRE(share(share(a, b), c) == share(a, share(b, c)));
        REQUIRE(-unite(a, b) == share(-a, -b));
        REQUIRE(-share(a, b) == unite(-a, -b));
        REQUIRE(less(a, b) == share(a, -b));
        REQUIRE(less(less(a, b), c) == less(a, unite(b, c)));
        REQUIRE(share(a, unite(b, c)) == unite(share(a, b), share(a, c)));
        REQUIRE(unite(a, share(a, b)) == a);
    }
}

TEST_CASE("a blend that is no number or negative is the plain operator") {
    for (const Operator& row : operators()) {
        if (!row.blends) continue;
        for (const double k : {-1.0, -1e-9, 0.0, -0.0}) CHECK(row.fold<double>(0.25, -0.125, k) == row.fold<double>(0.25, -0.125, 0));
        CHECK(std::isfinite(row.fold<double>(0.25, -0.125, 1e-300)));
        CHECK(std::isfinite(row.fold<float>(0.25f, -0.125f, 1e-40)));
    }
}
