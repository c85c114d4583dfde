// The least cover covers, and no fewer balls would.
#include "bench/cover.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace mb::bench;

namespace {

/// Whether the balls' intervals leave nothing of [start, end] uncovered, and say of no point more than its distance.
bool covers(const std::vector<Ball>& balls, const Along& distance, double start, double end, double slack) {
    double frontier = start;
    for (const Ball& ball : balls) {
        if (ball.radius > distance(ball.t) + 1e-12 || ball.t - ball.radius > frontier + slack) return false;
        frontier = std::max(frontier, ball.t + ball.radius);
    }
    return frontier >= end - slack;
}

/// A distance of slope at most 1 along a line: to random points of a plane that the line misses.
Along randomDistance(std::mt19937& random) {
    std::vector<std::pair<double, double>> points;
    std::uniform_real_distribution<double> at(-1, 11), beside(0.05, 1.5);
    for (int i = 0; i < 12; ++i) points.emplace_back(at(random), beside(random));
    return [points](double t) {
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [x, y] : points) least = std::min(least, std::hypot(t - x, y));
        return least;
    };
}

/// The least number of intervals about sampled points that cover all of the points, by dynamic programming: least[k] is
/// that for the first k points.
std::size_t leastBySamples(const Along& distance, double start, double end, int samples) {
    std::vector<double> t, f;
    for (int i = 0; i < samples; ++i) t.push_back(start + (end - start) * i / (samples - 1)), f.push_back(distance(t.back()));
    const auto count = static_cast<std::size_t>(samples);
    std::vector<std::size_t> least(count + 1, count);
    least[0] = 0;
    for (std::size_t first = 0; first < count; ++first) {
        for (std::size_t c = 0; c < count; ++c) {
            if (t[c] - f[c] > t[first] || t[c] + f[c] < t[first]) continue;
            std::size_t reached = first;
            while (reached < count && t[reached] <= t[c] + f[c]) ++reached;
            for (std::size_t k = first + 1; k <= reached; ++k) least[k] = std::min(least[k], least[first] + 1);
        }
    }
    return least[count];
}

}  // namespace

TEST_CASE("by hand: a wall ahead, and a corridor") {
    // Towards a wall one ball suffices however far it is: half way it reaches from the start to the wall.
    const Along wall = [](double t) { return 10 - t; };
    const std::vector<Ball> one = leastCover(wall, 0, 10);
    REQUIRE(one.size() == 1);
    CHECK(std::fabs(one[0].t - 5) < 1e-5);
    // Plain tracing asks at the start, and at the wall; so must any march that is to find the wall.
    const March traced = sphereTrace(wall, 0, 20, [](double) { return 1e-3; });
    CHECK(traced.hit);
    CHECK(traced.evaluations == 2);
    CHECK(leastEvaluations(wall, 0, traced, [](double) { return 1e-3; }) == 2);

    // Between two walls, each ball covers twice their distance: 10 m in steps of 1 m, where plain tracing steps 0.5 m.
    const Along corridor = [](double) { return 0.5; };
    CHECK(leastCover(corridor, 0, 9.9).size() == 10);
    const March through = sphereTrace(corridor, 0, 9.9, [](double) { return 1e-3; });
    CHECK(!through.hit);
    CHECK(through.evaluations == 20);
    CHECK(leastEvaluations(corridor, 0, through, [](double) { return 1e-3; }) == 10);
}

TEST_CASE("the balls cover, and no fewer do: against dynamic programming over sampled points") {
    std::mt19937 random(7);
    for (int i = 0; i < 200; ++i) {
        CAPTURE(i);
        const Along distance = randomDistance(random);
        const std::vector<Ball> balls = leastCover(distance, 0, 10);
        CHECK(covers(balls, distance, 0, 10, 2e-6));
        // Sampled points have to be covered only, not what lies between them, which may save balls; centres have to be
        // sampled points, which may cost some: at this spacing never more than one of either.
        const std::size_t sampled = leastBySamples(distance, 0, 10, 400);
        CHECK(balls.size() <= sampled + 1);
        CHECK(sampled <= balls.size() + 1);
        CHECK(balls.size() <= static_cast<std::size_t>(sphereTrace(distance, 0, 10, [](double) { return 1e-9; }).evaluations));
    }
}

TEST_CASE("the check of a cover fails on one with a ball taken out, or too large") {
    std::mt19937 random(8);
    for (int i = 0; i < 50; ++i) {
        const Along distance = randomDistance(random);
        std::vector<Ball> balls = leastCover(distance, 0, 10);
        for (std::size_t k = 0; k < balls.size(); ++k) {
            std::vector<Ball> fewer = balls;
            fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
            CHECK(!covers(fewer, distance, 0, 10, 2e-6));
        }
        balls[0].radius += 0.01;
        CHECK(!covers(balls, distance, 0, 10, 2e-6));
    }
}
