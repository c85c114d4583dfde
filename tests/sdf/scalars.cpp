// The scalars' own operations: intervals hold their members, duals differentiate, and all of them are the plain numbers'.
#include "core/sdf/scalar.h"
#include "sdf/draw.h"

#include <doctest/doctest.h>

#include <string>

using namespace mb;
using sdf::Dual;
using sdf::Interval;

namespace {

/// Each operation once, for every scalar: a name, and a generic function of three numbers.
template <class Visit> void eachOperation(Visit visit) {
    using sdf::abs, sdf::max, sdf::min, sdf::pick, sdf::sqrt, sdf::square;
    visit("a + b", [](auto a, auto b, auto) { return a + b; });
    visit("a - b", [](auto a, auto b, auto) { return a - b; });
    visit("a * b", [](auto a, auto b, auto) { return a * b; });
    visit("a / b", [](auto a, auto b, auto) { return a / b; });
    visit("-a", [](auto a, auto, auto) { return -a; });
    visit("abs(a)", [](auto a, auto, auto) { return abs(a); });
    visit("square(a)", [](auto a, auto, auto) { return square(a); });
    visit("sqrt(a)", [](auto a, auto, auto) { return sqrt(abs(a)); });
    visit("min(a, b)", [](auto a, auto b, auto) { return min(a, b); });
    visit("max(a, b)", [](auto a, auto b, auto) { return max(a, b); });
    visit("pick(c, a, b)", [](auto a, auto b, auto c) { return pick(c, a, b); });
}

Interval drawInterval(Draw& draw) {
    const double size = draw.logUniform(1e-12, 1e12), a = draw.uniform(-size, size);
    switch (draw.below(7)) {
        case 0: return {a, a};
        case 1: return {0, 0};
        case 2: return {0, std::fabs(a)};
        case 3: return {-std::fabs(a), 0};
        case 4: return {-std::fabs(a), size};
        case 5: return {-1e12, 1e12};
        default: return {std::min(a, a + size), std::max(a, a + size)};
    }
}

/// How many of some draws an interval operation g fails to hold the operation f on its members.
template <class F, class G> int leaks(F f, G g, Draw draw) {
    int leaked = 0;
    for (int i = 0; i < times(3000); ++i) {
        const Interval a = drawInterval(draw), b = drawInterval(draw), c = drawInterval(draw), r = g(a, b, c);
        for (int j = 0; j < 12; ++j) {
            const double x = f(draw.member(a.lo, a.hi), draw.member(b.lo, b.hi), draw.member(c.lo, c.hi));
            leaked += !std::isnan(x) && !(r.lo <= x && x <= r.hi);
        }
    }
    return leaked;
}

}  // namespace

TEST_CASE("every interval operation holds the operation on its members, without slack") {
    eachOperation([](const char* name, auto f) {
        CHECK_MESSAGE(leaks(f, f, Draw(1)) == 0, name);
    });
}

TEST_CASE("intervals round outwards: the exact result is inside, not only the rounded one") {
    // Of two doubles, long double holds the sum and the product with 11 bits to spare, enough to see on which side a bound lies.
    Draw draw(2);
    for (int i = 0; i < times(20000); ++i) {
        const double a = draw.uniform(-1, 1) * draw.logUniform(1e-9, 1e9), b = draw.uniform(-1, 1) * draw.logUniform(1e-9, 1e9);
        const auto holds = [](Interval r, long double exact) { return r.lo <= exact && exact <= r.hi; };
        const long double x = a, y = b;
        REQUIRE(holds(Interval(a) + Interval(b), x + y));
        REQUIRE(holds(Interval(a) - Interval(b), x - y));
        REQUIRE(holds(Interval(a) * Interval(b), x * y));
        REQUIRE(holds(Interval(a) / Interval(b), x / y));
        REQUIRE(holds(square(Interval(a)), x * x));
        REQUIRE(holds(sqrt(Interval(std::fabs(a))), std::sqrt(std::fabs(x))));
    }
}

TEST_CASE("intervals are tight: a few roundings wider than the values, no more") {
    const auto close = [](Interval r, double lo, double hi) {
        return r.lo <= lo && hi <= r.hi && r.lo >= lo - 4e-16 * std::fabs(lo) - 1e-300 && r.hi <= hi + 4e-16 * std::fabs(hi) + 1e-300;
    };
    const Interval across(-2, 3), right(2, 5), left(-5, -2);
    CHECK(close(across + right, 0, 8));
    CHECK(close(across - right, -7, 1));
    CHECK(close(across * right, -10, 15));
    CHECK(close(across * left, -15, 10));
    CHECK(close(right / left, -2.5, -0.4));
    CHECK(close(-across, -3, 2));
    CHECK(close(abs(across), 0, 3));
    CHECK(close(abs(left), 2, 5));
    CHECK(close(abs(right), 2, 5));
    CHECK(close(square(across), 0, 9));
    CHECK(close(square(left), 4, 25));
    CHECK(close(sqrt(Interval(4, 9)), 2, 3));
    CHECK(close(sqrt(Interval(-4, 9)), 0, 3));
    CHECK(close(min(across, right), -2, 3));
    CHECK(close(max(across, right), 2, 5));
    CHECK(close(pick(left, across, right), -2, 3));
    CHECK(close(pick(right, across, right), 2, 5));
    CHECK(close(pick(across, left, right), -5, 5));
    CHECK(close(pick(Interval(0), left, right), 2, 5));
    CHECK(std::isinf((right / across).lo));
    CHECK(std::isinf((right / across).hi));
    CHECK(square(across).lo >= 0);
    CHECK(sqrt(Interval(0)).lo == 0);
}

TEST_CASE("duals have the plain value to the bit, and the derivative by differences") {
    eachOperation([](const char* name, auto f) {
        Draw draw(3);
        for (int i = 0; i < times(2000); ++i) {
            // Away from the creases and from the root at 0, where a difference would mean nothing.
            const double a = draw.uniform(0.5, 2) * (draw.oneIn(2) ? 1 : -1), b = draw.uniform(2.1, 4) * (draw.oneIn(2) ? 1 : -1);
            const double c = draw.oneIn(2) ? 1 : -1, h = 1e-6;
            const Dual r = f(Dual(a, 1, 0, 0), Dual(b, 0, 1, 0), Dual(c, 0, 0, 1));
            INFO(name, " of ", a, ", ", b, ", ", c);
            REQUIRE(r.v == f(a, b, c));
            // Third derivatives stay below 10 here and values below 20: h² and a rounding divided by h.
            REQUIRE(std::fabs(r.dx - (f(a + h, b, c) - f(a - h, b, c)) / (2 * h)) < 1e-8);
            REQUIRE(std::fabs(r.dy - (f(a, b + h, c) - f(a, b - h, c)) / (2 * h)) < 1e-8);
            REQUIRE(std::fabs(r.dz) < 1e-8);
        }
    });
}

TEST_CASE("no NaN appears at the places where a slope is not defined") {
    const Dual zero(0, 1, 0, 0);
    CHECK(sqrt(square(zero)).dx == 0);
    CHECK(std::fabs(abs(zero).dx) == 1);
    CHECK(min(zero, Dual(0, 0, 1, 0)).dx == 1);  // the first of equals
    CHECK(max(zero, Dual(0, 0, 1, 0)).dx == 1);
}

TEST_CASE("pick takes its first value where the sign is negative, and only there") {
    CHECK(sdf::pick(-1e-300, 1.0, 2.0) == 1);
    CHECK(sdf::pick(0.0, 1.0, 2.0) == 2);
    CHECK(sdf::pick(-0.0, 1.0, 2.0) == 2);
    CHECK(pick(Dual(-0.0), Dual(1), Dual(2)).v == 2);
    CHECK(pick(Interval(-0.0, 0.0), Interval(1), Interval(2)).lo == 2);
}

TEST_CASE("a leaking interval operation is seen") {
    const auto sum = [](auto a, auto b, auto) { return a + b; };
    const auto inward = [](Interval a, Interval b, Interval) { return Interval(a.lo + b.lo, std::nextafter(a.hi + b.hi, -INFINITY)); };
    const auto swapped = [](Interval a, Interval b, Interval) { return Interval(a.lo - b.lo, a.hi - b.hi); };
    const auto forgetful = [](Interval a, Interval, Interval) { return Interval(std::fabs(a.lo), std::fabs(a.hi)); };
    CHECK(leaks(sum, inward, Draw(4)) > 0);
    CHECK(leaks([](double a, double b, double) { return a - b; }, swapped, Draw(4)) > 0);
    CHECK(leaks([](double a, double, double) { return std::fabs(a); }, forgetful, Draw(4)) > 0);
}
