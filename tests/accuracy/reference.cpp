// The true picture, held to closed forms and to itself.
#include "core/accuracy/reference.h"
#include "core/scene/text.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using namespace mb;

namespace {

constexpr double kPi = 3.14159265358979323846;

Scene sceneOf(const std::string& text) {
    const ReadResult read = readScene("marchbox 1\n" + text);
    REQUIRE_MESSAGE(read.ok(), (read.ok() ? "" : read.faults[0].message));
    return read.scene;
}
TruePicture truth(const Scene& scene, glm::ivec2 size, int stride = 1) {
    TruePictureWork work(scene, {defaultCamera(scene), size, stride});
    work.finish();
    return work.picture();
}
double linear(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }
double encoded(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }
glm::dvec3 linear(glm::dvec3 c) { return {linear(c.x), linear(c.y), linear(c.z)}; }

// A part of a scene: a camera that looks straight at the plane z = 0 with a parallel view 2 m high.
const std::string kFacing = "camera eye:0,0,5 target:0,0,0 ortho:2\n";
glm::dvec3 at(const TruePicture& p, int x, int y) { return linear(p.color[static_cast<std::size_t>(y * p.frame.size.x + x)]); }
/// The mean light of the whole picture, along one primary.
double meanOf(const TruePicture& p, int primary = 0) {
    double sum = 0;
    for (const glm::dvec3& c : p.color) sum += linear(c[primary]);
    return sum / static_cast<double>(p.pixels());
}

}  // namespace

TEST_CASE("reference: a lit wall is Phong's formula") {
    // White wall at z = 0, lamp at (1, 2, 3): what a point sends along +z, by hand.
    const Scene scene = sceneOf(kFacing + "light pos:1,2,3 intensity:0.8\nmaterial name:m color:0.5,0.6,0.7 Ka:0.1 Kd:0.5 Ks:0.3 C:8\nobject type:box material:m pos:0,0,-1 size:40,40,2\n");
    const glm::ivec2 size{24, 24};
    const TruePicture p = truth(scene, size);
    double worst = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::dvec3 here{(x + 0.5) / 12 - 1, 1 - (y + 0.5) / 12, 0}, way = glm::normalize(glm::dvec3(1, 2, 3) - here);
            // The mirrored direction of the light is (−x, −y, z); its cosine with the view is z.
            const glm::dvec3 wanted = 0.1 * glm::dvec3(0.5, 0.6, 0.7) + 0.8 * (0.5 * way.z * glm::dvec3(0.5, 0.6, 0.7) + 0.3 * std::pow(way.z, 8.0));
            worst = std::max(worst, glm::length(at(p, x, y) - wanted));
            const std::size_t i = static_cast<std::size_t>(y * size.x + x);
            CHECK(p.depth[i] == doctest::Approx(5).epsilon(1e-12));
            CHECK(p.smooth[i] == 1);
            CHECK(glm::length(p.normal[i] - glm::dvec3(0, 0, 1)) < 1e-12);
        }
    // A pixel's mean differs from its middle by the light's second derivative over a pixel of a twelfth of a metre.
    CHECK(worst < 3e-4);
}

TEST_CASE("reference: pixels that a straight edge cuts show the exact share") {
    // The edge of a half-plane at angle a through the picture, white on black, against the polygon's area of every pixel.
    const glm::ivec2 size{16, 16};
    for (const double degrees : {0.0, 7.0, 31.0, 45.0, 90.0}) {
        CAPTURE(degrees);
        const Scene scene = sceneOf(kFacing + "material name:w color:1,1,1 Ka:1 Kd:0 Ks:0\nobject type:box material:w rot:0,0," + std::to_string(degrees) + " pos:" +
                                    std::to_string(10 * std::sin(glm::radians(degrees))) + "," + std::to_string(-10 * std::cos(glm::radians(degrees))) + ",0 size:60,20.074,0.1\n");
        const TruePicture p = truth(scene, size);
        const glm::dvec2 up{-std::sin(glm::radians(degrees)), std::cos(glm::radians(degrees))};
        double worst = 0, sum = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                // The share of the pixel below the line, as the mean over 2000 columns, each exact.
                double share = 0;
                constexpr int kColumns = 2000;
                for (int k = 0; k < kColumns; ++k) {
                    const double px = (x + (k + 0.5) / kColumns) / 8 - 1, top = 1 - y / 8.0, bottom = top - 1 / 8.0;
                    if (std::fabs(up.y) < 1e-9) share += (up.x * px < 0.037) / static_cast<double>(kColumns);
                    else share += std::clamp((((0.037 - up.x * px) / up.y) - bottom) * 8, 0.0, 1.0) / kColumns;
                }
                const double d = at(p, x, y).x - share;
                worst = std::max(worst, std::fabs(d)), sum += d * d;
            }
        // 64 points of an even spread are off by three of them at the worst.
        CHECK(worst < 3.0 / 64);
        CHECK(std::sqrt(sum / (size.x * size.y)) < 0.008);  // a point of 64 in each of some sixth of the pixels
        CHECK(worst > 1e-9);
    }
}

TEST_CASE("reference: a ball covers its circle") {
    const Scene scene = sceneOf(kFacing + "material name:w color:1,1,1 Ka:1 Kd:0 Ks:0\nobject type:sphere material:w radius:0.71\n");
    const TruePicture p = truth(scene, {20, 20});
    CHECK(meanOf(p) == doctest::Approx(kPi * 0.71 * 0.71 / 4).epsilon(1e-3));  // some 60 pixels of the edge, each off by 1 %, by chance
    for (std::size_t i = 0; i < p.pixels(); ++i) {
        const glm::dvec2 c{(static_cast<double>(i % 20) + 0.5) / 10 - 1, 1 - (static_cast<double>(i / 20) + 0.5) / 10};
        const double r2 = glm::dot(c, c);
        CHECK((p.object[i] == 0) == (r2 < 0.71 * 0.71));
        if (p.object[i] == 0) CHECK(p.depth[i] == doctest::Approx(5 - std::sqrt(0.71 * 0.71 - r2)).epsilon(1e-12));
        else CHECK(std::isinf(p.depth[i]));
    }
}

TEST_CASE("reference: mirrors that face each other add up a geometric series") {
    // Two mirrors of Kr 0.6 and own light 0.05, the eye between them: 0.05 · (1 + 0.6 + 0.36 + …) = 0.125.
    const std::string walls = "material name:m color:1,1,1 Ka:0.05 Kd:0 Ks:0 Kr:0.6\nobject type:box material:m pos:0,0,-4 size:60,60,2\n";
    const std::string eye = "camera eye:0,0,1 target:0,0,0 ortho:0.5\n";
    const Scene facing = sceneOf(eye + "render reflections:1\n" + walls + "object type:box material:m pos:0,0,4 size:60,60,2\n");
    CHECK(at(truth(facing, {2, 2}), 0, 0).x == doctest::Approx(0.125).epsilon(2e-4));  // what is below kLeastWeight is left out
    // One of them alone shows a wall of a color behind the eye: 0.05 + 0.6 · (0.2, 0.4, 0.6).
    const Scene one = sceneOf(eye + walls + "material name:wall color:0.2,0.4,0.6 Ka:1 Kd:0 Ks:0\nobject type:box material:wall pos:0,0,4 size:60,60,2\n");
    const glm::dvec3 seen = at(truth(one, {2, 2}), 1, 1);
    CHECK(glm::length(seen - glm::dvec3(0.17, 0.29, 0.41)) < 1e-9);
    Scene blind = one;
    blind.render.reflections = 0;
    CHECK(at(truth(blind, {2, 2}), 0, 0).x == doctest::Approx(0.05).epsilon(1e-9));
}


TEST_CASE("reference: the edge of a point's shadow lies where the line through the roof's edge meets the floor") {
    // The lamp at (2, 3), the roof's edge at (0.5, 2): the line comes down at x = −2.5. Seen around there.
    const Scene scene = sceneOf("camera eye:-2.5,1,0 target:-2.5,0,0 ortho:1\nlight pos:2,3,0\nmaterial name:w color:1,1,1 Ka:0 Kd:1 Ks:0\nobject type:plane material:w\n"
                                "object type:box material:w pos:-9.5,2.05,0 size:20,0.1,60\n");
    const glm::ivec2 size{32, 8};
    const TruePicture p = truth(scene, size);
    for (int x = 0; x < size.x; ++x) {
        const double from = -2.5 + (x / 32.0 - 0.5) * 4;  // m, of 4 m across
        const double here = from + 2.0 / 32, lit = 3 / std::sqrt(9 + (2 - here) * (2 - here));
        CAPTURE(here);
        const double share = at(p, x, 4).x / lit;
        if (from >= -2.5) CHECK(share == doctest::Approx(1).epsilon(5e-3));
        else CHECK(share < 1e-9);
    }
}

TEST_CASE("reference: a disc's penumbra is the share of the disc over the edge") {
    // A small disc straight above: from x it is seen past the roof's edge at height h as a disc cut by a line. The lamp's disc faces the
    // point, so that in the small the line cuts it at (x/h·H − 0)/(size/2) of its radius.
    const double H = 20, h = 10, size = 0.4;
    const Scene scene = sceneOf("camera eye:0,1,0 target:0,0,0 ortho:0.3\nlight pos:0,20,0 size:0.4\nmaterial name:w color:1,1,1 Ka:0 Kd:1 Ks:0\nobject type:plane material:w\n"
                                "object type:box material:w pos:-30,10.001,0 size:60,0.002,60\n");
    const glm::ivec2 pixels{48, 12};
    const TruePicture p = truth(scene, pixels);
    double worst = 0, penumbra = 0;
    for (int x = 0; x < pixels.x; ++x) {
        const double here = ((x + 0.5) / 48 - 0.5) * 1.2;
        // The line from (x, 0) through (0, h) arrives at height H at x·(1 − H/h) = −x: the disc's points right of it are seen.
        const double cut = std::clamp(here * (1 - H / h) / (size / 2), -1.0, 1.0);
        const double seen = (std::acos(cut) - cut * std::sqrt(1 - cut * cut)) / kPi;
        const double got = at(p, x, 6).x;
        worst = std::max(worst, std::fabs(got - seen)), penumbra += seen > 0.01 && seen < 0.99;
    }
    CHECK(penumbra > 10);
    CHECK(worst < 0.02);  // a pixel is an eighth of the penumbra wide, and each of its 64 rays asks 16 points of the disc
}

TEST_CASE("reference: ambient light under a wall, and in a corner without end") {
    // The floor beside a wall that is higher than `ao` reaches: at a distance d the wall hides the directions that meet it within the
    // reach R; with c = d/R the share left, each weighed by its cosine, is 1 − (acos(c) − c·√(1 − c²))/π/2 … integrated below.
    const double reach = 2;
    const Scene scene = sceneOf("camera eye:1,5,0 target:1,0,0 ortho:2\nrender ao:2 ao_rays:16\nmaterial name:w color:1,1,1 Ka:1 Kd:0 Ks:0\nobject type:plane material:w\n"
                                "object type:box material:w pos:-5,10,0 size:10,40,60\n");
    const glm::ivec2 size{24, 24};
    const TruePicture p = truth(scene, size);
    double worst = 0;
    for (int x = 1; x < size.x; ++x) {
        const double d = 2 * (x + 0.5) / 24;
        if (d > 2.1) break;
        // Directions on the unit half-sphere, (sin θ cos φ, cos θ, sin θ sin φ), of weight cos θ: hidden where −x·R > d.
        double hidden = 0;
        constexpr int kParts = 400;
        for (int i = 0; i < kParts; ++i)
            for (int k = 0; k < kParts; ++k) {
                const double r = std::sqrt((i + 0.5) / kParts), phi = 2 * kPi * (k + 0.5) / kParts;  // Malley's disc
                hidden += -r * std::cos(phi) * reach > d;
            }
        double mean = 0;
        for (int y = 0; y < size.y; ++y) mean += at(p, x, y).x / size.y;
        worst = std::max(worst, std::fabs(mean - (1 - hidden / (kParts * kParts))));
    }
    CHECK(worst < 0.01);
    // Under a roof nearer than it reaches everything is dark but what lies beyond the reach: cos θ < h/R, a share of (h/R)².
    const Scene roofed = sceneOf("camera eye:0,0.5,0 target:0,0,0 ortho:0.2\nrender ao:2\nmaterial name:w color:1,1,1 Ka:1 Kd:0 Ks:0\nobject type:plane material:w\nobject type:box material:w pos:0,2,0 size:60,2,60\n");
    CHECK(meanOf(truth(roofed, {8, 8})) == doctest::Approx(0.25).epsilon(0.02));
}

TEST_CASE("reference: fog takes an exponential share, and the film bends what is left") {
    const std::string wall = kFacing + "material name:m color:0.8,0.8,0.8 Ka:1 Kd:0 Ks:0\nobject type:box material:m pos:0,0,-1 size:40,40,2\n";
    const Scene fog = sceneOf("world fog:0.2 background:0.1,0.2,0.3\n" + wall);
    const double clear = std::exp(-0.2 * 5);
    CHECK(glm::length(at(truth(fog, {2, 2}), 0, 0) - (clear * glm::dvec3(0.8) + (1 - clear) * glm::dvec3(0.1, 0.2, 0.3))) < 1e-9);
    const Scene film = sceneOf("render exposure:1.5\n" + wall);
    CHECK(at(truth(film, {2, 2}), 0, 0).x == doctest::Approx(1.2 / 2.2).epsilon(1e-9));
    const Scene bare = sceneOf(wall);
    CHECK(at(truth(bare, {2, 2}), 0, 0).x == doctest::Approx(0.8).epsilon(1e-9));
}

TEST_CASE("reference: in slices or on all cores, the same to the bit") {
    const LoadResult loaded = loadScene(MARCHBOX_SOURCE "/saves/evening.txt");
    REQUIRE(loaded.ok());
    const Frame frame{defaultCamera(loaded.scene), {24, 14}, 3};
    TruePictureWork sliced(loaded.scene, frame), whole(loaded.scene, frame), both(loaded.scene, frame);
    double before = 0;
    int slices = 0;
    while (sliced.step(0.01)) {
        CHECK(sliced.progress() > before);
        before = sliced.progress(), ++slices;
    }
    CHECK(slices > 5);
    whole.finish();
    both.step(0.01), both.finish();
    for (const TruePictureWork* other : {&whole, &both}) {
        const TruePicture &a = sliced.picture(), &b = other->picture();
        CHECK(a.color == b.color);
        CHECK(a.depth == b.depth);
        CHECK(a.normal == b.normal);
        CHECK(a.object == b.object);
        CHECK(a.smooth == b.smooth);
        CHECK(a.noise == b.noise);
        CHECK(other->progress() == 1);
    }
}

TEST_CASE("reference: a frame with a stride is a part of the large picture") {
    const LoadResult loaded = loadScene(MARCHBOX_SOURCE "/saves/die.txt");
    REQUIRE(loaded.ok());
    const TruePicture part = truth(loaded.scene, {20, 12}, 3), whole = truth(loaded.scene, {60, 36});
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 20; ++x) {
            const std::size_t i = static_cast<std::size_t>(y * 20 + x), k = static_cast<std::size_t>((3 * y + 1) * 60 + 3 * x + 1);
            CHECK(part.object[i] == whole.object[k]);
            if (part.object[i] >= 0) CHECK(part.depth[i] == doctest::Approx(whole.depth[k]).epsilon(1e-12));
            CHECK(part.smooth[i] == whole.smooth[k]);
            CHECK(glm::length(part.color[i] - whole.color[k]) < 0.02);  // other turns of their spirals; here there are none
        }
}

// (Of a square of samples, whose two halves are off together at an edge along its rows, the noise was said to be half of what it was.)
TEST_CASE("reference: its noise bounds how far it is from a picture of 9 times as many rays") {
    for (const char* name : {"welcome", "mirrors", "three_lights", "evening"}) {
        LoadResult loaded = loadScene(std::string(MARCHBOX_SOURCE "/saves/") + name + ".txt");
        REQUIRE(loaded.ok());
        // Light adds up, what a film made of it does not: so each has a film, which does not cut what is brighter than white.
        REQUIRE(setKnob(loaded.scene, "exposure=1.5") == std::nullopt);
        const auto light = [](double srgb) { return linear(srgb) / (1.5 * (1 - linear(srgb))); };
        const auto shown = [](double x) { return encoded(1.5 * x / (1 + 1.5 * x)); };
        const glm::ivec2 size{24, 14};
        constexpr int kFiner = 3;
        const TruePicture few = truth(loaded.scene, size), many = truth(loaded.scene, size * kFiner);
        double sum = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                glm::dvec3 mean{0};
                for (int k = 0; k < kFiner * kFiner; ++k)
                    for (int c = 0; c < 3; ++c)
                        mean[c] += light(many.color[static_cast<std::size_t>((y * kFiner + k / kFiner) * size.x * kFiner + x * kFiner + k % kFiner)][c]) / (kFiner * kFiner);
                const glm::dvec3 d = glm::dvec3(shown(mean.x), shown(mean.y), shown(mean.z)) - few.color[static_cast<std::size_t>(y * size.x + x)];
                sum += glm::dot(d, d) / 3;
            }
        const double off = std::sqrt(sum / static_cast<double>(few.pixels()));
        MESSAGE(std::string(name) << ": off by " << off << ", says " << few.noise);
        CHECK(off <= 1.3 * few.noise);  // a root mean square over few pixels
    }
}
