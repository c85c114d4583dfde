// Polynomials made from known roots.
#include "core/accuracy/roots.h"
#include "sdf/draw.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

using namespace mb;
using accuracy::realRoots;

namespace {

/// The coefficients of the product of (t − r), and of (t − re)² + im² for each pair that is not real, in long double.
std::vector<double> fromRoots(const std::vector<double>& real, const std::vector<std::pair<double, double>>& pairs, double leading) {
    std::vector<long double> c{static_cast<long double>(leading)};
    const auto times = [&](std::vector<long double> factor) {
        std::vector<long double> product(c.size() + factor.size() - 1, 0);
        for (std::size_t i = 0; i < c.size(); ++i)
            for (std::size_t j = 0; j < factor.size(); ++j) product[i + j] += c[i] * factor[j];
        c = product;
    };
    for (const double r : real) times({-static_cast<long double>(r), 1});
    for (const auto& [re, im] : pairs) times({static_cast<long double>(re) * re + static_cast<long double>(im) * im, -2 * static_cast<long double>(re), 1});
    std::vector<double> rounded(c.size());
    std::ranges::transform(c, rounded.begin(), [](long double x) { return static_cast<double>(x); });
    return rounded;
}

/// Real roots at least a tenth apart.
std::vector<double> drawApart(Draw& draw, int count) {
    std::vector<double> roots;
    while (static_cast<int>(roots.size()) < count) {
        const double r = draw.uniform(-3, 3);
        if (std::ranges::all_of(roots, [&](double x) { return std::fabs(x - r) > 0.1; })) roots.push_back(r);
    }
    std::ranges::sort(roots);
    return roots;
}

}  // namespace

TEST_CASE("roots: the roots a polynomial was made from, and no other") {
    Draw draw(streamOf("roots"));
    for (int trial = 0; trial < times(5000); ++trial) {
        const int pairs = draw.below(3), degree = 2 * pairs + draw.below(5 - 2 * pairs);
        if (degree == 0) continue;
        const std::vector<double> wanted = drawApart(draw, degree - 2 * pairs);
        std::vector<std::pair<double, double>> others;
        for (int i = 0; i < pairs; ++i) others.push_back({draw.uniform(-3, 3), draw.uniform(0.2, 2)});
        const std::vector<double> c = fromRoots(wanted, others, draw.logUniform(1e-6, 1e6));
        const accuracy::Roots found = realRoots(c, -4, 4);
        REQUIRE(found.count == wanted.size());
        for (std::size_t i = 0; i < wanted.size(); ++i) CHECK(std::fabs(found.at[i] - wanted[i]) < 1e-10);
    }
}

TEST_CASE("roots: only those within the interval, its ends included") {
    const std::vector<double> c = fromRoots({-1, 0, 1, 2}, {}, 3);
    CHECK(realRoots(c, -0.5, 1.5).count == 2);
    CHECK(realRoots(c, 0, 1).count == 2);
    CHECK(realRoots(c, 0.25, 0.75).count == 0);
    CHECK(realRoots(c, -10, 10).count == 4);
}

TEST_CASE("roots: a double root counts once, and one lifted off or pushed through as it is") {
    Draw draw(streamOf("double roots"));
    for (int trial = 0; trial < times(2000); ++trial) {
        // Eighths, so that the coefficients are exact.
        const double twice = (draw.below(33) - 16) / 8.0, once = twice + (draw.below(16) + 1) / 8.0;
        std::vector<double> c = fromRoots({twice, twice, once}, {}, 1);
        const accuracy::Roots found = realRoots(c, -10, 10);
        REQUIRE(found.count == 2);
        CHECK(std::fabs(found.at[0] - twice) < 1e-6);
        CHECK(std::fabs(found.at[1] - once) < 1e-12);
        // Near the double root the cubic is negative: raised by a little it has two roots there, lowered none.
        c[0] += 1e-6;
        CHECK(realRoots(c, -10, 10).count == 3);
        c[0] -= 2e-6;
        CHECK(realRoots(c, -10, 10).count == 1);
    }
}

TEST_CASE("roots: leading coefficients that are 0, or as good as 0") {
    for (const double leading : {0.0, 1e-300, -1e-18}) {
        const double quadratic[] = {-2, 1, leading};
        REQUIRE(realRoots(quadratic, -100, 100).count == 1);
        CHECK(realRoots(quadratic, -100, 100).at[0] == doctest::Approx(2).epsilon(1e-14));
        const double quartic[] = {2, -3, 1, leading, leading};
        REQUIRE(realRoots(quartic, -100, 100).count == 2);
        CHECK(realRoots(quartic, -100, 100).at[0] == doctest::Approx(1).epsilon(1e-13));
    }
    const double none[] = {0, 0, 0}, constant[] = {1, 0, 0};
    CHECK(realRoots(none, -1, 1).count == 0);
    CHECK(realRoots(constant, -1, 1).count == 0);
}
