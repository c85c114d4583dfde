// Cases 51 to 53: pixels that are no numbers, samples that converge, and pictures of odd sizes.
#include "hard/oracle.h"

#include "core/render/picture.h"

using namespace mb;
using namespace mb::hard;

namespace {

Scene whiteShapes() {
    Scene s;
    addObject(s, "sphere", {1}, {-0.7, 0, 0}), addObject(s, "box", {1.2, 1.2, 1.2, 0}, {1, 0.2, 0.1});
    paint(s, plain({1, 1, 1}));
    return s;
}
bool hitsShapes(const DoubleRay& r) { return !sphereSpan(r, {-0.7, 0, 0}, 1).empty() || !boxSpan(r, {1, 0.2, 0.1}, {1.2, 1.2, 1.2}).empty(); }

/// The share of each pixel that the shapes cover, by n·n rays of a grid in it.
std::vector<double> coverages(const Camera& camera, glm::ivec2 size, int n) {
    std::vector<double> all(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    const glm::ivec2 fine = size * n;
    for (int y = 0; y < fine.y; ++y)
        for (int x = 0; x < fine.x; ++x)
            if (hitsShapes(pixelRay(camera, fine, x, y))) all[static_cast<std::size_t>(y / n * size.x + x / n)] += 1.0 / (n * n);
    return all;
}

}  // namespace

TEST_CASE("case 51: a pixel that is no number stays one until it is shown, and no save holds any") {
    HeadlessRenderer headless;
    const glm::ivec2 size{64, 48};
    for (const double bad : {std::nan(""), static_cast<double>(INFINITY)}) {
        Scene s = whiteShapes();
        s.materials[0].color.y = bad;
        const auto picture = headless.draw(s, cameraAt({0, 1, 5}, {0, 0, 0}), size);
        std::size_t not_finite = 0;
        for (const glm::vec3& c : picture) not_finite += !finite(c);
        CHECK(not_finite > 300);
        // Shown as 8 bits they would pass for colours.
        const std::vector<std::uint8_t> shown = encodeSrgb(picture);
        CHECK(shown[1 + 3 * (24 * 64 + 25)] == (std::isnan(bad) ? 0 : 255));
        CHECK(firstFault("marchbox 1\nmaterial name:m color:0," + std::string(std::isnan(bad) ? "nan" : "inf") + ",0\n").starts_with("2:"));
    }
    std::size_t pixels = 0, not_finite = 0;
    for (const char* name : {"balls", "blends", "bowl", "die", "gallery", "marble_run", "mirrors", "three_lights", "welcome"}) {
        LoadResult loaded = loadScene(std::string("saves/") + name + ".txt");
        REQUIRE(loaded.ok());
        loaded.scene.render.samples = 1;
        for (const glm::vec3& c : headless.draw(loaded.scene, defaultCamera(loaded.scene), {160, 90})) ++pixels, not_finite += !finite(c);
    }
    MESSAGE(not_finite << " of " << pixels << " pixels of the saves are no numbers");
    CHECK(not_finite == 0);
}

TEST_CASE("case 52: more samples converge to the coverage, and keep the mean") {
    HeadlessRenderer headless;
    const Camera camera = cameraAt({0.3, 1.1, 4.5}, {0.1, 0, 0});
    const glm::ivec2 size{64, 48};
    const std::vector<double> truth = coverages(camera, size, 32);  // 1,024 rays a pixel
    Scene s = whiteShapes();
    double x_sum = 0, y_sum = 0, xx = 0, xy = 0, last = 0;
    const std::vector<int> counts{1, 4, 16, 64, 256};
    for (const int n : counts) {
        s.render.samples = n;
        const auto picture = headless.draw(s, camera, size);
        double squares = 0, drift = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const double e = static_cast<double>(picture[i].x) - truth[i];
            squares += e * e, drift += e;
        }
        const double rmse = std::sqrt(squares / static_cast<double>(truth.size())), x = std::log(n), y = std::log(rmse);
        drift /= static_cast<double>(truth.size());
        x_sum += x, y_sum += y, xx += x * x, xy += x * y, last = drift;
        MESSAGE(n << " samples: RMSE " << rmse << ", mean off by " << 255 * drift << "/255");
        if (n > 1) CHECK(std::fabs(drift) <= 0.5 / 255);
    }
    const double count = static_cast<double>(counts.size()), slope = (xy - x_sum * y_sum / count) / (xx - x_sum * x_sum / count);
    MESSAGE("slope " << slope);
    CHECK(slope <= -0.5);
    CHECK(std::fabs(last) <= 0.1 / 255);
}

TEST_CASE("case 53: pictures of one row, one column and odd widths are what their rays see") {
    HeadlessRenderer headless;
    const Scene s = whiteShapes();
    for (const glm::ivec2 size : {glm::ivec2{1, 1}, glm::ivec2{1, 4096}, glm::ivec2{4096, 1}, glm::ivec2{641, 479}, glm::ivec2{3, 5}}) {
        CAPTURE(size.x);
        CAPTURE(size.y);
        // As tall as it takes to see something in a picture of one column, and of one row.
        const Camera camera = cameraAt({0.3, 0.4, 5}, {0.1, 0.1, 0}, size.x > 100 * size.y ? 0.05 : 60);
        const auto picture = headless.draw(s, camera, size);
        REQUIRE(picture.size() == static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
        std::size_t wrong = 0, white = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const bool hit = hitsShapes(pixelRay(camera, size, x, y));
                white += hit, wrong += hit != (picture[static_cast<std::size_t>(y * size.x + x)].x > 0.5f);
            }
        MESSAGE(size.x << "x" << size.y << ": " << white << " white pixels, " << wrong << " wrong");
        CHECK(white > 0);
        CHECK(static_cast<double>(wrong) <= 1e-3 * static_cast<double>(picture.size()));
        const Measured m = headless.measure(s, camera, size);
        CHECK(m.channels.depth.size() == picture.size());
        CHECK(m.counts.pixels.hit + m.counts.pixels.miss + m.counts.pixels.undecided == picture.size());
    }
}

TEST_CASE("case 53: every third pixel of a picture three times as large is the small picture") {
    HeadlessRenderer headless;
    Scene s = whiteShapes();
    s.materials[0] = {"m", {0.8, 0.7, 0.6}, {0, 0, 0}, Pattern::none, 0.1, 0.7, 0.2, 0, 16};
    s.lights = {{"", {3, 5, 4}, {1, 1, 1}, 1}};
    const Camera camera = cameraAt({0.3, 0.9, 5}, {0.1, 0.1, 0});
    const glm::ivec2 size{107, 79};
    const auto small = headless.draw(s, camera, size), large = headless.draw(s, camera, 3 * size);
    std::size_t differ = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::vec3 d = glm::abs(small[static_cast<std::size_t>(y * size.x + x)] - large[static_cast<std::size_t>((3 * y + 1) * 3 * size.x + 3 * x + 1)]);
            differ += std::max({d.x, d.y, d.z}) > 1.0f / 255;
        }
    MESSAGE(differ << " of " << small.size() << " pixels differ by more than 1/255");
    CHECK(differ <= small.size() / 1000);
}

TEST_CASE("case 53: a picture larger than the driver draws is refused, and the last one stays") {
    HeadlessRenderer headless;
    const Scene s = whiteShapes();
    const auto before = headless.draw(s, cameraAt({0, 1, 5}, {0, 0, 0}), {16, 16});
    const int most = maxTargetSize();
    MESSAGE("the driver draws up to " << most << " pixels each way");
    for (const glm::ivec2 size : {glm::ivec2{most + 1, 1}, glm::ivec2{1, most + 1}, glm::ivec2{1 << 30, 1 << 30}}) {
        const std::string why = headless.renderer->draw(s, {}, size);
        CHECK_MESSAGE(why.find("between 1 and " + std::to_string(most)) != std::string::npos, why);
        CHECK(headless.renderer->readPicture() == before);
    }
}
