// The other contenders draw the same scene, times are read in one way, and errors are counted as they say.
#include "bench/errors.h"
#include "bench/povray.h"
#include "bench/report.h"
#include "bench/seed.h"
#include "render/headless.h"

#include <algorithm>
#include <cmath>

using namespace mb;
using namespace mb::bench;

TEST_CASE("medians and ratios") {
    CHECK(median({3, 1, 2}) == 2);
    CHECK(median({4, 1, 2, 3}) == 2.5);
    CHECK(median({7}) == 7);
    const Spread s = ratio({2, 8, 3}, {1, 2, 3});
    CHECK(s.median == 2);
    CHECK(s.min == 1);
    CHECK(s.max == 4);
    CHECK(rounded(1.23456e-5) == 1.235e-5);
}

TEST_CASE("contenders take turns, after one call each that does not count") {
    std::string order;
    const Contender contenders[] = {[&] { order += 'a'; return 1.0; }, [&] { order += 'b'; return 2.0; }};
    const Turns turns = takeTurns(contenders, 3);
    CHECK(order == "abababab");
    CHECK(turns.ms[0] == std::vector<double>{1, 1, 1});
    CHECK(turns.ms[1] == std::vector<double>{2, 2, 2});
}

TEST_CASE("errors: each pixel is counted once") {
    TruthPicture truth{{3, 2}, 1, {Hit{1, 0}, Hit{2, 1}, std::nullopt, std::nullopt, Hit{5, 2}, Hit{6, 2}}};
    Surfaces s{{0, 0, 4, -1, -1, 2}, {1.5f, 2, 3, 0, 0, 6}, {}, {}};
    s.undecided = {false, false, false, false, true, false};
    s.left_out = {false, false, false, false, false, true};
    const Errors e = errorsOf(s, truth);
    CHECK(e.pixels == 6);
    CHECK(e.wrong == doctest::Approx(1 / 6.0));         // a hit where there is nothing
    CHECK(e.wrong_object == doctest::Approx(1 / 6.0));  // object 0 for 1
    CHECK(e.undecided == doctest::Approx(1 / 6.0));
    CHECK(e.left_out == doctest::Approx(1 / 6.0));
    CHECK(e.depth_max == doctest::Approx(0.5));
    CHECK(e.wrong_depth == doctest::Approx(1 / 6.0));
    CHECK(noWorse(e, e));
    Errors worse = e;
    worse.undecided += 0.1;
    CHECK(!noWorse(worse, e));

    truth = {{5, 4}, 2, {}};
    CHECK(truth.pixel(0) == 0);
    CHECK(truth.pixel(2) == 4);
    CHECK(truth.pixel(3) == 10);
}

TEST_CASE("the seed's shader draws the scene, and knows which pixels the driver did not let it finish") {
    HeadlessRenderer headless;
    for (const int n : {10, 1000}) {
        CAPTURE(n);
        const Model model = makeModel("union", n, kSeed);
        Seed seed(model, {48, 48});
        REQUIRE(seed.prepare() == "");
        seed.draw();
        const SeedPicture picture = seed.read();
        Surfaces surfaces{picture.object, picture.depth, {}, {}};
        for (const bool whole : picture.whole) surfaces.left_out.push_back(!whole);
        const Errors errors = errorsOf(surfaces, truthOf(model, {48, 48}));
        CHECK(errors.wrong < 0.02);
        CHECK(errors.depth_max < 0.2);
        if (n == 10) CHECK(errors.left_out == 0);
        if (headless.renderer->rendererName().find("llvmpipe") == std::string::npos) continue;
        for (std::size_t i = 0; i < picture.whole.size(); ++i)
            if (picture.whole[i]) CHECK(picture.iterations[i] <= 65535);
        if (n == 1000) CHECK(errors.left_out > 0);
    }
    const Model carved = makeModel("carved", 10, kSeed);
    CHECK(Seed(carved, {8, 8}).prepare() != "");
}

TEST_CASE("the seed's picture and marchbox's have the same colours but along edges") {
    HeadlessRenderer headless;
    const Model model = makeModel("union", 10, kSeed);
    const Scene scene = sceneOf(model, 2);
    Seed seed(model, {96, 96});
    REQUIRE(seed.prepare() == "");
    seed.draw();
    const std::vector<glm::vec3> theirs = seed.read().color, ours = headless.draw(scene, scene.cameras[0], {96, 96});
    const auto far = [](const glm::vec3& a, const glm::vec3& b) { return glm::length(a - b) > 0.05f; };
    std::size_t count = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) count += far(ours[i], theirs[i]);
    CHECK(static_cast<double>(count) < 0.1 * static_cast<double>(ours.size()));
}

TEST_CASE("POV-Ray's text and the times it prints") {
    const Model model = makeModel("tree", 8, kSeed);
    const std::string text = povText(model, false);
    for (const char* needed : {"orthographic", "difference", "union", "sphere", "box", "cylinder", "light_source", "phong", "reflection"})
        CHECK_MESSAGE(text.find(needed) != std::string::npos, needed);
    CHECK(povText(model, true).find("light_source") == std::string::npos);
    CHECK(povText(makeModel("ground", 2, kSeed), false).find("plane { y, -1") != std::string::npos);

    PovTimes times;
    CHECK(readPovTimes("Ray Tracer Version 3.7.0.10.unofficial (g++)\nParse Time: 0 hours (0.500 seconds)\n"
                       "  Trace Time:       0 hours  0 minutes  1 seconds (1.061 seconds)\n"
                       "              using 2 thread(s) with 1.091 CPU-seconds total\n",
                       times));
    CHECK(times.trace_ms == doctest::Approx(1061));
    CHECK(times.cpu_ms == doctest::Approx(1091));
    CHECK(times.version == "3.7.0.10");
    CHECK(!readPovTimes("Parse Error: no such thing", times));
}

TEST_CASE("POV-Ray sees the same surfaces through the same pixels") {
    if (!Povray::available()) return;  // it is not among what the tests install
    for (const std::string_view family : {"union", "ground", "carved", "tree"}) {
        CAPTURE(family);
        Model model = makeModel(family, 30, kSeed);
        model.far = 1e9;  // POV-Ray sees the ground as far as it goes
        Povray povray(model, {160, 120});
        Surfaces surfaces;
        REQUIRE(povray.objects(surfaces.object) == "");
        const Errors errors = errorsOf(surfaces, truthOf(model, {160, 120}));
        CHECK(errors.wrong <= 0.0005);
        CHECK(errors.wrong_object <= 0.0005);
    }
}
