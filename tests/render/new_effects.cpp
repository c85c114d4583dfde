// Soft shadow, ambient occlusion, fog, emission and the film against their formulas, computed here in double.
#include "closed_forms.h"
#include "headless.h"
#include "scenes.h"

using namespace mb;

namespace {

constexpr glm::ivec2 kSize{160, 120};

double& extra(Extra& numbers, std::string_view effect, std::size_t key = 0) { return numbers[slotOf(effectNamed(effect).keys[key])]; }

/// White, diffuse and nothing else.
Material matte(double ka, double kd) { return {"m", {1, 1, 1}, {0, 0, 0}, Pattern::none, ka, kd, 0, 0, 1}; }

/// Where a pixel's ray meets the floor y = 0, if it does.
std::optional<glm::dvec3> onFloor(const Camera& camera, int x, int y) {
    const DoubleRay ray = pixelRay(camera, kSize, x, y);
    const auto hit = firstOf(halfSpaceSpan(ray, {0, 1, 0}, 0), 1e9);
    if (!hit) return std::nullopt;
    return ray.origin + hit->t * ray.direction;
}

/// The share of a ball-shaped light's disc that is seen past a ball, by many points of the disc.
double discSeen(glm::dvec3 p, glm::dvec3 light, double size, glm::dvec3 ball, double radius) {
    const glm::dvec3 way = glm::normalize(light - p), x = glm::normalize(glm::cross(way, glm::dvec3{0.3, 0.1, 1})), y = glm::cross(way, x);
    constexpr int kSide = 64;
    int inside = 0, seen = 0;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const double u = 2 * (i + 0.5) / kSide - 1, v = 2 * (j + 0.5) / kSide - 1;
            if (u * u + v * v > 1) continue;
            ++inside;
            const glm::dvec3 d = glm::normalize(light + 0.5 * size * (u * x + v * y) - p), to_ball = ball - p;
            const double along = glm::dot(to_ball, d);
            seen += along < 0 || glm::length(to_ball - along * d) > radius;
        }
    return static_cast<double>(seen) / inside;
}

}  // namespace

TEST_CASE("a ball's soft shadow is the share of the light's disc that is seen") {
    HeadlessRenderer headless;
    Scene s;
    s.materials = {matte(0, 1)};
    s.lights = {{"", {1, 6, 0.5}, {1, 1, 1}, 1}};
    s.render.shadow_steps = 128;  // more, times 256 rays, would be refused
    extra(s.lights[0].extra, "soft shadow") = 1.6, extra(s.render.extra, "soft shadow", 1) = 256;
    addObject(s, "plane", {0, 1, 0, 0});
    addObject(s, "sphere", {0.6}, {0, 1.5, 0});
    for (Object& o : s.objects) o.material = 0;
    const Camera camera = cameraAt({0, 7, 0.1}, {-0.3, 0, 0}, 40);
    const Measured m = headless.measure(s, camera, kSize);
    const auto picture = headless.draw(s, camera, kSize);
    double worst = 0, sum = 0;
    int compared = 0, between = 0;
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
            const std::size_t i = static_cast<std::size_t>(y * kSize.x + x);
            const auto p = onFloor(camera, x, y);
            if (!p || m.channels.object[i] != 0) continue;
            const glm::dvec3 way = s.lights[0].pos - *p;
            const double wanted = discSeen(*p, s.lights[0].pos, 1.6, {0, 1.5, 0}, 0.6);
            const double seen = static_cast<double>(picture[i].x) / (way.y / glm::length(way));
            const double error = std::fabs(seen - wanted);
            worst = std::max(worst, error), sum += error, ++compared, between += wanted > 0.02 && wanted < 0.98;
        }
    MESSAGE(between << " of " << compared << " in the penumbra; worst difference " << worst << ", mean " << sum / compared);
    CHECK(between > 1000);
    // 256 spread points miss a half-disc's share by at most about 1/sqrt(256) times a little: the edge cuts some 20 of them.
    CHECK(worst < 0.04);
    CHECK(sum / compared < 3e-3);
    CHECK(m.counts.rays.soft > 0);
    CHECK(m.counts.rays.shadow == 0);
}

TEST_CASE("a light as small as a point has a point's shadow; one of any size lets through from none to all") {
    HeadlessRenderer headless;
    Scene s;
    s.materials = {matte(0, 1)};
    s.lights = {{"", {1, 6, 0.5}, {1, 1, 1}, 1}};
    addObject(s, "plane", {0, 1, 0, 0});
    addObject(s, "sphere", {0.6}, {0, 1.5, 0});
    for (Object& o : s.objects) o.material = 0;
    const Camera camera = cameraAt({0, 7, 0.1}, {-0.3, 0, 0}, 40);
    const auto hard = headless.draw(s, camera, kSize);
    for (const double size : {1e-6, 0.5, 2.0}) {
        extra(s.lights[0].extra, "soft shadow") = size;
        const auto soft = headless.draw(s, camera, kSize);
        std::size_t other = 0;
        for (std::size_t i = 0; i < soft.size(); ++i) {
            REQUIRE((soft[i].x >= 0 && soft[i].x <= 1));
            other += std::fabs(soft[i].x - hard[i].x) > 1e-6f;
        }
        if (size < 1e-3) CHECK(other <= soft.size() / 1000);  // of the edge's own pixels, which a micrometre of light may tip
    }
}

TEST_CASE("beside a wall half the sky is open, as far as ambient occlusion reaches") {
    HeadlessRenderer headless;
    Scene s;
    s.materials = {matte(1, 0)};
    addObject(s, "plane", {0, 1, 0, 0});
    addObject(s, "plane", {1, 0, 0, 0});  // solid where x < 0
    for (Object& o : s.objects) o.material = 0;
    s.render.shadow_steps = 128;
    extra(s.render.extra, "ambient occlusion") = 2, extra(s.render.extra, "ambient occlusion", 1) = 256;
    const Camera camera = cameraAt({4, 5, 0.5}, {1.2, 0, 0}, 40);
    const auto picture = headless.draw(s, camera, kSize);
    const Measured m = headless.measure(s, camera, kSize);
    double worst = 0;
    int compared = 0;
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
            const auto p = onFloor(camera, x, y);
            const std::size_t i = static_cast<std::size_t>(y * kSize.x + x);
            if (!p || m.channels.object[i] != 0 || p->x < 0.01) continue;
            // Through Malley's disc: a direction (u, h, w) meets the wall within the reach where -u > x/reach, so that what is cut
            // from the unit disc is the segment beyond x/reach.
            const double c = std::min(p->x / 2, 1.0);
            const double wanted = 1 - (std::acos(c) - c * std::sqrt(1 - c * c)) / 3.14159265358979323846;
            worst = std::max(worst, std::fabs(static_cast<double>(picture[i].x) - wanted)), ++compared;
        }
    MESSAGE(compared << " points, worst difference " << worst);
    CHECK(compared > 3000);
    CHECK(worst < 0.04);  // as above
    CHECK(m.counts.rays.occlusion > 0);
    CHECK(m.counts.evaluations.shadow + m.counts.evaluations.soft == 0);
}

TEST_CASE("fog takes its share at every metre, emission adds, and the film bends what is bright") {
    HeadlessRenderer headless;
    Scene s;
    s.world.background = {0.2, 0.5, 0.9};
    s.materials = {matte(0.5, 0)};
    s.materials[0].color = {1, 0.5, 0.25};
    addObject(s, "plane", {0, 1, 0, 0});
    s.objects[0].material = 0;
    const double fog = 0.08, emission = 1.5, exposure = 0.7;
    extra(s.world.extra, "fog") = fog, extra(s.materials[0].extra, "emission") = emission, extra(s.render.extra, "tone mapping") = exposure;
    const Camera camera = cameraAt({0, 2, 5}, {0, 0.5, 0}, 60);
    REQUIRE(headless.renderer->draw(s, camera, kSize).empty());
    const auto linear = headless.renderer->readPicture(), shown = headless.renderer->readShown();
    double worst = 0;
    int hits = 0, misses = 0;
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
            const DoubleRay ray = pixelRay(camera, kSize, x, y);
            const auto p = onFloor(camera, x, y);
            const double t = p ? glm::length(*p - ray.origin) : 0, clear = p && t < s.render.max_distance ? std::exp(-fog * t) : 0;
            ++(clear > 0 ? hits : misses);
            const std::size_t i = static_cast<std::size_t>(y * kSize.x + x);
            for (int k = 0; k < 3; ++k) {
                const double light = clear * (0.5 + emission) * s.materials[0].color[k] + (1 - clear) * s.world.background[k];
                worst = std::max(worst, std::fabs(static_cast<double>(linear[i][k]) - light));
                worst = std::max(worst, std::fabs(static_cast<double>(shown[i][k]) - exposure * light / (1 + exposure * light)));
            }
        }
    MESSAGE("worst difference " << worst);
    CHECK(hits > 5000);
    CHECK(misses > 1000);
    CHECK(worst < 2e-5);  // the distance is float's, exp() a few of its steps
}

TEST_CASE("bounces are planned to the one whose weight is a step of the picture, and the picture misses nothing by that") {
    HeadlessRenderer headless;
    Scene s;
    s.world.background = {1, 1, 1};
    s.materials = {{"mirror", {1, 1, 1}, {0, 0, 0}, Pattern::none, 0, 0, 0, 0.2, 1}};
    addObject(s, "box", {40, 40, 0.1, 0}, {0, 0, -1});
    addObject(s, "box", {40, 40, 0.1, 0}, {0, 0, 3});
    for (Object& o : s.objects) o.material = 0;
    const auto bounces = [&](double kr) {
        s.materials[0].kr = kr, s.render.reflections = 64;
        return makePlan(s, makeTree(s)).bounces;
    };
    // The least n with k^n < 1/255 is 4, 8, 25 and 53 (HARD_CASES 49): the bounce before it is the last that is followed.
    CHECK(bounces(0.2) == 3);
    CHECK(bounces(0.5) == 7);
    CHECK(bounces(0.8) == 24);
    CHECK(bounces(0.9) == 52);
    CHECK(bounces(1) == 64);
    CHECK(bounces(0) == 0);
}

TEST_CASE("what no record calls for is not in the text, and is used exactly never") {
    HeadlessRenderer headless;
    Scene s;
    s.materials = {matte(0.5, 0.5)};
    s.lights = {{"", {2, 6, 1}, {1, 1, 1}, 1}};
    addObject(s, "plane", {0, 1, 0, 0});
    addObject(s, "sphere", {0.5}, {0, 0.5, 0});
    for (Object& o : s.objects) o.material = 0;
    const std::string text = headless.renderer->textOf(s);
    CHECK(text.find("hardShadow") != text.npos);
    for (const char* absent : {"softShadow", "openness", "highlight", "throughFog", "reflected", "emitted", "isDarkField", "mixed", "opSubtract",
                               "sdBox", "sdTorus", "warpTwist", "#ifdef EFFECT", "LEAST_WEIGHT", "spiral", "skipEmpty"})
        CHECK_MESSAGE(text.find(absent) == text.npos, absent);
    Measured measured;
    for (const Effect& effect : effects()) {
        if (effect.ofMotion() || effect.counts.empty()) continue;
        REQUIRE(headless.renderer->measure(s, cameraAt({0, 2, 5}, {0, 0.5, 0}), {64, 48}, measured, &effect).empty());
        const bool called = effect.name == "hard shadow" || effect.name == "light";
        CHECK_MESSAGE((measured.counts.uses > 0) == called, effect.name);
    }
    CHECK(measured.counts.evaluations.soft + measured.counts.evaluations.occlusion + measured.counts.evaluations.reflection == 0);
}
