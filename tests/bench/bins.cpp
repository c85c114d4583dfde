// Every engine that is there is given the same bin, and keeps its balls in it.
#include "bench/figure_bins.h"

#include "bench/bin.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace mb;
using namespace mb::bench;

TEST_CASE("overlaps are counted once, between balls and at walls") {
    SphereBin bin;
    bin.inner = 4, bin.height = 5;
    const double nan = std::nan("");
    const std::vector<glm::dvec3> inside = {{0, 0.4, 0}, {0.9, 0.5, 0}, {0, 2, 1.7}, {0, 2, 0.7}}, outside = {{3, 1, 0}, {0, -0.1, 0}, {nan, nan, nan}};
    std::vector<glm::dvec3> balls = inside;
    balls.insert(balls.end(), outside.begin(), outside.end());
    const Overlaps o = overlapsOf(bin, balls);
    CHECK(o.outside == 3);
    CHECK(o.count == 3);
    CHECK(o.largest == doctest::Approx(0.2));  // at the wall z = 2
    CHECK(o.mean == doctest::Approx((0.2 + 0.1 + 1 - std::hypot(0.9, 0.1)) / 3));
    CHECK(overlapsOf(bin, {}).mean == 0);
}

TEST_CASE("a bin's balls begin apart, inside, and where a float can be") {
    for (const int n : {1, 27, 500}) {
        CAPTURE(n);
        const SphereBin bin = makeBin(n, 7);
        REQUIRE(bin.balls.size() == static_cast<std::size_t>(n));
        const Overlaps o = overlapsOf(bin, bin.balls);
        CHECK(o.count == 0);
        CHECK(o.outside == 0);
        for (const glm::dvec3& p : bin.balls) CHECK(glm::dvec3(glm::vec3(p)) == p);
        CHECK(makeBin(n, 7).balls == bin.balls);
        CHECK(makeBin(n, 8).balls != bin.balls);
    }
    CHECK(makeBin(500, 1).inner == 10);
    CHECK(makeBin(8000, 1).inner == 25);
}

TEST_CASE("each engine begins with the same balls, steps them, and keeps them in the bin") {
    const SphereBin bin = makeBin(27, 1);
    for (const BinEngine& engine : binEngines()) {
        if (!engine.make) continue;  // it is not among what the tests install
        CAPTURE(engine.name);
        const auto peer = engine.make(bin);
        CHECK(peer->positions() == bin.balls);
        peer->step();
        const double fall = SphereBin::kGravity * SphereBin::kStep * SphereBin::kStep;  // of a step; engines differ in its half
        for (std::size_t i = 0; i < 27; ++i) {
            CHECK(bin.balls[i].y - peer->positions()[i].y >= 0.4 * fall);
            CHECK(bin.balls[i].y - peer->positions()[i].y <= 1.1 * fall);
        }
        for (int i = 1; i < SphereBin::kSteps; ++i) peer->step();
        const Overlaps o = overlapsOf(bin, peer->positions());
        CHECK(o.outside == 0);
        CHECK(std::isfinite(o.largest));
        CHECK(o.largest < 0.1);
        // They have come down.
        const std::vector<glm::dvec3> end = peer->positions();
        CHECK(std::ranges::max(end, {}, &glm::dvec3::y).y < std::ranges::max(bin.balls, {}, &glm::dvec3::y).y - 0.3);
        CHECK(std::ranges::min(end, {}, &glm::dvec3::y).y == doctest::Approx(SphereBin::kRadius).epsilon(0.05));
    }
}

TEST_CASE("a line an engine, the peers' with a ratio, and what is not there is said") {
    PhysicsOptions options;
    options.balls = {8}, options.dice = {8};
    std::vector<Json> lines;
    PhysicsBench bench{options, [&](const Json& line) { lines.push_back(line); }, [](const std::string&) {}};
    runPhysics(bench);
    REQUIRE(lines.size() == 2 + binEngines().size());
    CHECK(lines[0]["figure"] == "about");
    for (const Json& line : lines) {
        if (line["figure"] == "about" || line.contains("skipped")) {
            CHECK(inWords(line).empty());
            continue;
        }
        if (line["figure"] == "pile") {
            CHECK(line["asleep"] == 8);
            CHECK(line["overlap"]["largest"].get<double>() < 1e-3);
            CHECK(inWords(line).find("8 of them asleep") != std::string::npos);
            continue;
        }
        CHECK(line["outside"] == 0);
        CHECK(line.contains("ratio") == (line["engine"] != "marchbox"));
        CHECK(inWords(line).find(line["engine"].get<std::string>()) != std::string::npos);
    }
    options.only = {"bullet"};
    lines.clear();
    runPhysics(bench);
    CHECK(lines.size() == 4);  // the pile too: dice are asked for
}
