// What the render record's knobs do: each changes what it says, and no more.
#include "headless.h"
#include "scenes.h"

#include "core/scene/camera.h"
#include "sdf/draw.h"

#include <glm/geometric.hpp>

#include <cmath>

using namespace mb;

namespace {

constexpr glm::ivec2 kSize{120, 80};
const Camera kCamera = cameraAt({1.2, 2.2, 4.5}, {0, 0.5, 0});

/// A floor, a ball that melts into a box, and a torus, under a lamp: what is blended has no spans to look ahead by.
Scene blended() {
    Scene s;
    s.materials = {{"m", {0.8, 0.6, 0.5}, {0.1, 0.1, 0.2}, Pattern::none, 0.2, 0.6, 0, 0, 20}};
    s.lights = {{"", {3, 5, 4}, {1, 1, 1}, 0.8}};
    addObject(s, "plane", {0, 1, 0, 0});
    const int both = addObject(s, "union", {0.3}, {-0.4, 0.5, 0});
    addObject(s, "sphere", {0.5}, {}, both);
    addObject(s, "box", {0.6, 0.5, 0.7, 0.05}, {0.6, 0, 0}, both);
    addObject(s, "torus", {0.4, 0.1}, {0.9, 0.3, 1});
    for (Object& o : s.objects) o.material = 0;
    return s;
}
/// A ball over a floor, without blends: one copy of each.
Scene plain() {
    Scene s = blended();
    s.objects.clear();
    addObject(s, "plane", {0, 1, 0, 0});
    addObject(s, "sphere", {0.8}, {0, 0.8, 0});
    for (Object& o : s.objects) o.material = 0;
    return s;
}
std::size_t pixelsOf(glm::ivec2 size) { return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y); }

/// The largest difference of two pictures, and in how many pixels they differ by more than `tolerance`.
struct Apart {
    float largest = 0;
    std::size_t beyond = 0;
};
Apart apart(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b, float tolerance) {
    REQUIRE(a.size() == b.size());
    Apart d;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const glm::vec3 c = glm::abs(a[i] - b[i]);
        const float most = std::max({c.x, c.y, c.z});
        d.largest = std::max(d.largest, most), d.beyond += most > tolerance;
    }
    return d;
}

}  // namespace

TEST_CASE("relaxation: plain sphere tracing takes more evaluations and finds the same surfaces") {
    HeadlessRenderer headless;
    Scene s = blended();
    const Measured whole = headless.measure(s, kCamera, kSize);
    std::uint64_t before = whole.counts.evaluations.primary;
    for (const double share : {0.5, 0.0}) {
        s.render.relaxation = share;
        const Measured less = headless.measure(s, kCamera, kSize);
        CAPTURE(share);
        CHECK(less.counts.evaluations.primary > before);
        before = less.counts.evaluations.primary;
        std::size_t others = 0, deep = 0, hit = 0;
        for (std::size_t i = 0; i < pixelsOf(kSize); ++i) {
            if (whole.channels.state[i] == 2 || less.channels.state[i] == 2) continue;
            others += whole.channels.state[i] != less.channels.state[i] || whole.channels.object[i] != less.channels.object[i];
            if (whole.channels.state[i] != 1 || less.channels.state[i] != 1) continue;
            ++hit, deep += std::fabs(whole.channels.depth[i] - less.channels.depth[i]) > s.render.march_epsilon * whole.channels.depth[i];
        }
        CHECK(others <= 2);  // where two objects are equally near
        CHECK(deep <= 2);
        CHECK(hit > pixelsOf(kSize) / 2);
    }
    MESSAGE(whole.counts.evaluations.primary << " evaluations, without relaxation " << before);
    CHECK(static_cast<double>(before) > 1.15 * static_cast<double>(whole.counts.evaluations.primary));
}

TEST_CASE("normal_taps: fewer than six are four, and the normals of a ball stay within a twentieth of a degree") {
    HeadlessRenderer headless;
    for (const Evaluation evaluation : {Evaluation::straight, Evaluation::grid}) {
        headless.renderer->setEvaluation(evaluation);
        Scene s = plain();
        const Measured six = headless.measure(s, kCamera, kSize);
        s.render.normal_taps = 5;
        const Measured five = headless.measure(s, kCamera, kSize);
        s.render.normal_taps = 4;
        const Measured four = headless.measure(s, kCamera, kSize);
        CHECK(five.channels.normal == four.channels.normal);
        CHECK(six.counts.evaluations.primary == four.counts.evaluations.primary);
        // A hit takes its normal and one look at whose the surface is; through the grid a leaf's own distance alone, which
        // is no evaluation of the scene's: there the primitives touched tell.
        const Counts::ByKind &of_six = six.counts.evaluations, &of_four = four.counts.evaluations;
        if (evaluation == Evaluation::straight) CHECK(7 * of_four.normal == 5 * of_six.normal);
        else CHECK(6 * four.counts.touched.normal == 4 * six.counts.touched.normal);
        double worst[2] = {0, 0};
        std::size_t seen = 0;
        for (int y = 0; y < kSize.y; ++y)
            for (int x = 0; x < kSize.x; ++x) {
                const std::size_t i = static_cast<std::size_t>(y * kSize.x + x);
                if (four.channels.object[i] != 1 || four.channels.state[i] != 1) continue;
                const auto ray = cameraRay(kCamera, kSize, {x + 0.5, y + 0.5});
                const glm::dvec3 p = ray.origin + static_cast<double>(four.channels.depth[i]) * ray.direction, n = glm::normalize(p - glm::dvec3{0, 0.8, 0});
                if (glm::dot(n, ray.direction) > -0.1) continue;  // at the rim it may be turned to face the ray
                ++seen;
                const auto angle = [&](glm::vec3 normal) { return std::asin(std::min(1.0, glm::length(glm::cross(n, glm::normalize(glm::dvec3(normal)))))) * 57.29578; };
                worst[0] = std::max(worst[0], angle(six.channels.normal[i])), worst[1] = std::max(worst[1], angle(four.channels.normal[i]));
            }
        MESSAGE("worst angle " << worst[0] << " degrees with six, " << worst[1] << " with four");
        CHECK(seen > 500);
        CHECK(worst[1] < 0.05);
    }
}

TEST_CASE("bias: near the usual one the picture stays but for rims, far from it shadows change") {
    HeadlessRenderer headless;
    Scene s = plain();
    const auto usual = headless.draw(s, kCamera, kSize);
    for (const double bias : {1.0, 4.0}) {
        s.render.bias = bias;
        const Apart d = apart(headless.draw(s, kCamera, kSize), usual, 0.02f);
        CAPTURE(bias);
        CHECK(d.beyond < pixelsOf(kSize) / 200);  // the shadow's rim
    }
    // Half a metre from the floor a shadow ray starts above what would have been in its way, or in it.
    s.render.bias = 1000;
    const Apart far = apart(headless.draw(s, kCamera, kSize), usual, 0.02f);
    CHECK(far.beyond > pixelsOf(kSize) / 200);
}

TEST_CASE("grid_scale: other cells, the same values to the bit, and the same picture") {
    HeadlessRenderer headless;
    headless.renderer->setEvaluation(Evaluation::grid);
    Scene s = plain();
    Draw draw(91);
    for (int i = 0; i < 200; ++i) addObject(s, i % 2 ? "sphere" : "box", {0.1, 0.15, 0.1}, {draw.uniform(-2, 2), draw.uniform(0, 2), draw.uniform(-2, 2)});
    std::vector<glm::vec3> points;
    for (int i = 0; i < 5000; ++i) points.push_back({draw.uniform(-3, 3), draw.uniform(-1, 3), draw.uniform(-3, 3)});
    std::vector<GpuSample> one, other;
    REQUIRE(headless.renderer->evaluate(s, points, one) == "");
    const auto usual = headless.measure(s, kCamera, kSize);
    const std::size_t cells = headless.renderer->gridWork().cells;
    for (const double scale : {0.5, 2.0}) {
        s.render.grid_scale = scale;
        CAPTURE(scale);
        REQUIRE(headless.renderer->evaluate(s, points, other) == "");
        std::size_t differ = 0;
        for (std::size_t i = 0; i < points.size(); ++i) differ += one[i].distance != other[i].distance || one[i].leaf != other[i].leaf;
        CHECK(differ == 0);
        const auto scaled = headless.measure(s, kCamera, kSize);
        CHECK(headless.renderer->gridWork().whole);
        CHECK((headless.renderer->gridWork().cells > cells) == (scale > 1));
        std::size_t others = 0;
        for (std::size_t i = 0; i < pixelsOf(kSize); ++i) others += usual.channels.object[i] != scaled.channels.object[i];
        CHECK(others <= 4);  // rays that are undecided, or see two equally near
    }
}

TEST_CASE("scale: a share of the pixels is drawn, counted and enlarged to the size asked for") {
    HeadlessRenderer headless;
    Scene s = plain();
    const auto full = headless.draw(s, kCamera, kSize);
    const Measured measured = headless.measure(s, kCamera, kSize);
    const auto half_size = headless.draw(s, kCamera, kSize / 2);
    const Measured half_measured = headless.measure(s, kCamera, kSize / 2);

    s.render.scale = 0.5;
    const auto enlarged_picture = headless.draw(s, kCamera, kSize);
    CHECK(headless.renderer->picture().size() == kSize / 2);
    CHECK(enlarged_picture == enlarged(half_size, kSize / 2, kSize));
    CHECK(headless.renderer->readShown() == enlarged_picture);
    const Apart d = apart(enlarged_picture, full, 0.1f);
    CHECK(d.beyond < pixelsOf(kSize) / 12);  // the edges
    const Measured m = headless.measure(s, kCamera, kSize);
    CHECK(m.counts.evaluations.total() == half_measured.counts.evaluations.total());
    CHECK(static_cast<double>(m.counts.evaluations.total()) == doctest::Approx(0.25 * static_cast<double>(measured.counts.evaluations.total())).epsilon(0.05));
    CHECK(m.counts.pixels.hit + m.counts.pixels.miss + m.counts.pixels.undecided == pixelsOf(kSize) / 4);
    CHECK(m.channels.size == kSize);
    REQUIRE(m.channels.depth.size() == pixelsOf(kSize));
    CHECK(m.channels.depth == enlargedByNearest(half_measured.channels.depth, kSize / 2, kSize));

    s.render.scale = 0.05;
    CHECK(headless.draw(s, kCamera, {7, 3}).size() == 21);
    CHECK(headless.renderer->picture().size() == glm::ivec2{1, 1});
}

TEST_CASE("enlarged: a slope stays one, pixels' centres stay where they are, the edges are held") {
    const auto ramp = [](glm::ivec2 size) {
        std::vector<glm::vec3> picture;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) picture.push_back({(static_cast<float>(x) + 0.5f) / static_cast<float>(size.x), (static_cast<float>(y) + 0.5f) / static_cast<float>(size.y), 1});
        return picture;
    };
    for (const auto& [few, many] : {std::pair{glm::ivec2{8, 5}, glm::ivec2{24, 15}}, {{8, 5}, {19, 11}}, {{1, 1}, {4, 3}}, {{8, 5}, {8, 5}}}) {
        const auto large = enlarged(ramp(few), few, many), wanted = ramp(many);
        REQUIRE(large.size() == wanted.size());
        for (std::size_t i = 0; i < large.size(); ++i) {
            const glm::vec3 margin = 0.5f / glm::vec3(static_cast<float>(few.x), static_cast<float>(few.y), 1);
            CHECK(glm::length(large[i] - glm::clamp(wanted[i], margin, 1.0f - margin * glm::vec3(1, 1, 0))) < 1e-6f);
        }
    }
    CHECK(rasterOf({7, 3}, 0.05).drawn == glm::ivec2{1, 1});
    CHECK(rasterOf({101, 50}, 0.5).drawn == glm::ivec2{51, 25});
    CHECK(rasterOf({0, 3}).drawn == glm::ivec2{0, 3});
}

TEST_CASE("a sparse picture is the large one's pixels: an odd stride's to what rounding makes of the rays") {
    HeadlessRenderer headless;
    Renderer& renderer = *headless.renderer;
    const glm::ivec2 few{40, 27};
    for (const int samples : {1, 4})
        for (const Scene& scene : {plain(), blended()}) {
            Scene s = scene;
            s.render.samples = samples;
            const auto before = headless.draw(s, kCamera, few);
            for (const int k : {3, 5}) {
                const auto large = headless.draw(s, kCamera, few * k);
                renderer.setStride(k);
                const auto sparse = headless.draw(s, kCamera, few);
                renderer.setStride(1);
                std::vector<glm::vec3> wanted;
                for (int j = 0; j < few.y; ++j)
                    for (int i = 0; i < few.x; ++i) wanted.push_back(large[static_cast<std::size_t>(j * k + k / 2) * static_cast<std::size_t>(few.x * k) + static_cast<std::size_t>(i * k + k / 2)]);
                CAPTURE(samples); CAPTURE(k);
                // A ray's direction differs in its last bits, so a hit by some 1e-6 m, and a colour by that much; at a silhouette
                // or a shadow's rim a pixel may fall to the other side.
                const Apart d = apart(sparse, wanted, 2e-3f);
                MESSAGE("largest difference " << d.largest << ", " << d.beyond << " beyond");
                CHECK(d.beyond <= 2);
                if (samples == 1) CHECK(apart(sparse, before, 2e-3f).beyond <= 10);  // the same rays, of wider pixels
                else CHECK(apart(sparse, before, 2e-3f).beyond > 10);                // samples lie closer together
            }
            CHECK(headless.draw(s, kCamera, few) == before);
        }
}
