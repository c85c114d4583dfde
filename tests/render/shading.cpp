// Light, shadow, reflection, pattern and camera against their formulas, written here in double.
#include "closed_forms.h"
#include "headless.h"
#include "scenes.h"

using namespace mb;

namespace {

constexpr glm::ivec2 kSize{160, 120};

glm::dvec3 phongOf(const Material& m, const Scene& scene, glm::dvec3 p, glm::dvec3 n, glm::dvec3 direction, glm::dvec3 base) {
    glm::dvec3 color = m.ka * base;
    for (const Light& light : scene.lights) {
        const glm::dvec3 l = glm::normalize(light.pos - p);
        if (glm::dot(n, l) <= 0) continue;
        const double mirrored = std::max(glm::dot(glm::reflect(-l, n), -direction), 0.0);
        color += light.color * light.intensity * (m.kd * glm::dot(n, l) * base + m.ks * std::pow(mirrored, m.c));
    }
    return color;
}

struct Worst {
    double value = 0;
    std::size_t beyond = 0;
    void add(glm::vec3 seen, glm::dvec3 wanted, double tolerance) {
        const glm::dvec3 d = glm::abs(glm::dvec3(seen) - wanted);
        const double e = std::max({d.x, d.y, d.z});
        value = std::max(value, e);
        beyond += e > tolerance;
    }
};

}  // namespace

TEST_CASE("a ball under three lights is Phong's") {
    HeadlessRenderer headless;
    Scene s;
    s.world.background = {0.1, 0.2, 0.3};
    s.materials.push_back({"m", {0.8, 0.5, 0.3}, {0, 0, 0}, Pattern::none, 0.1, 0.6, 0.4, 0, 20});
    s.lights = {{"", {4, 5, 6}, {1, 0.9, 0.8}, 0.7}, {"", {-5, 1, 3}, {0.2, 0.3, 1}, 0.5}, {"", {0, -6, 1}, {1, 1, 1}, 0.2}};
    addObject(s, "sphere", {1});
    s.objects[0].material = 0;
    const Camera camera = cameraAt({0.3, 0.8, 3.5}, {0, 0, 0});
    const auto picture = headless.draw(s, camera, kSize);
    Worst worst;
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
            const DoubleRay ray = pixelRay(camera, kSize, x, y);
            const auto hit = firstOf(sphereSpan(ray, {}, 1), 1e9);
            const glm::dvec3 wanted = hit ? phongOf(s.materials[0], s, ray.origin + hit->t * ray.direction, hit->normal, ray.direction, s.materials[0].color)
                                          : s.world.background;
            worst.add(picture[static_cast<std::size_t>(y * kSize.x + x)], wanted, 2e-3);
        }
    MESSAGE("worst difference " << worst.value);
    // The normal's 0.03 degrees times the highlight's slope, 0.4·20·5e-4, and the float's pow; the silhouette's one or two
    // undecided pixels may be taken for the background.
    CHECK(worst.beyond <= 3);
}

TEST_CASE("a ball's shadow on a plane has the edge that geometry gives it") {
    HeadlessRenderer headless;
    Scene s;
    s.materials.push_back({"m", {1, 1, 1}, {0, 0, 0}, Pattern::none, 0, 1, 0, 0, 1});
    s.lights = {{"", {2, 6, 1}, {1, 1, 1}, 1}};
    addObject(s, "plane", {0, 1, 0, 0});
    addObject(s, "sphere", {0.5}, {0, 1.2, 0});
    for (Object& o : s.objects) o.material = 0;
    const Camera camera = cameraAt({0, 7, 0.1}, {-0.3, 0, 0}, 40);
    const Measured m = headless.measure(s, camera, kSize);
    const auto picture = headless.draw(s, camera, kSize);
    std::size_t wrong = 0, shadowed = 0, compared = 0;
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
            const std::size_t i = static_cast<std::size_t>(y * kSize.x + x);
            if (m.channels.object[i] != 0) continue;
            const DoubleRay ray = pixelRay(camera, kSize, x, y);
            const auto hit = firstOf(halfSpaceSpan(ray, {0, 1, 0}, 0), 1e9);
            REQUIRE(hit);
            const glm::dvec3 p = ray.origin + hit->t * ray.direction, way = s.lights[0].pos - p;
            const double t = glm::dot(glm::dvec3{0, 1.2, 0} - p, glm::normalize(way));
            const double clearance = glm::length(p + glm::normalize(way) * t - glm::dvec3{0, 1.2, 0}) - 0.5;
            if (std::fabs(clearance) < 2e-3) continue;  // twice the bias of 1e-4 of 7 m, which moves the ray's start
            ++compared;
            const bool dark = picture[i].x == 0;
            shadowed += dark;
            wrong += dark != (clearance < 0);
        }
    CHECK(wrong == 0);
    CHECK(shadowed > 300);
    CHECK(compared > 10'000);
}

TEST_CASE("the lit side of a convex body is never in its own shadow, at any scale") {
    HeadlessRenderer headless;
    for (const double scale : {0.01, 1.0, 100.0}) {
        for (const double epsilon : {1e-2, 1e-3, 1e-4, 1e-5}) {
            CAPTURE(scale);
            CAPTURE(epsilon);
            Scene s;
            s.render.march_epsilon = epsilon, s.render.max_distance = 1000 * scale;
            s.materials.push_back({"m", {1, 1, 1}, {0, 0, 0}, Pattern::none, 0, 1, 0, 0, 1});
            s.lights = {{"", glm::dvec3{3, 5, 4} * scale, {1, 1, 1}, 1}};
            addObject(s, "sphere", {scale});
            s.objects[0].material = 0;
            const Camera camera = cameraAt(glm::dvec3{0, 0, 3} * scale, {0, 0, 0});
            const Measured m = headless.measure(s, camera, kSize);
            const auto picture = headless.draw(s, camera, kSize);
            std::size_t faced = 0, shadowed = 0;
            for (std::size_t i = 0; i < picture.size(); ++i) {
                if (m.channels.state[i] != 1) continue;
                const DoubleRay ray = pixelRay(camera, kSize, static_cast<int>(i) % kSize.x, static_cast<int>(i) / kSize.x);
                const glm::dvec3 p = ray.origin + ray.direction * static_cast<double>(m.channels.depth[i]);
                if (glm::dot(glm::normalize(p), glm::normalize(s.lights[0].pos - p)) < 0.01) continue;
                ++faced;
                shadowed += picture[i].x == 0;
            }
            CHECK(faced > 2000);
            CHECK(shadowed == 0);
        }
    }
}

TEST_CASE("a mirror shows what stands before it, bounce by bounce") {
    HeadlessRenderer headless;
    // Between two parallel mirrors every bounce adds Kr times the next: a geometric series of the ambient colour.
    Scene s;
    s.world.background = {0, 0, 0};
    s.materials.push_back({"mirror", {1, 1, 1}, {0, 0, 0}, Pattern::none, 0.5, 0, 0, 0.5, 1});
    addObject(s, "box", {40, 40, 0.1, 0}, {0, 0, -1});
    addObject(s, "box", {40, 40, 0.1, 0}, {0, 0, 3});
    for (Object& o : s.objects) o.material = 0;
    const Camera camera = cameraAt({0, 0, 2}, {0.001, 0, 0}, 10);
    for (const int bounces : {0, 1, 3, 6}) {
        s.render.reflections = bounces;
        const auto picture = headless.draw(s, camera, {16, 16});
        double wanted = 0;
        for (int i = 0; i <= bounces; ++i) wanted += 0.5 * std::pow(0.5, i);
        CAPTURE(bounces);
        CHECK(static_cast<double>(picture[8 * 16 + 8].x) == doctest::Approx(wanted).epsilon(1e-5));
    }
}

TEST_CASE("a checkerboard is fixed to its object and one metre wide") {
    HeadlessRenderer headless;
    Scene s;
    s.materials.push_back({"m", {1, 1, 1}, {0, 0, 0}, Pattern::checker, 1, 0, 0, 0, 1});
    addObject(s, "plane", {0, 1, 0, 0}, {0.3, 0, 0.2});
    s.objects[0].material = 0;
    const Camera camera = cameraAt({0, 6, 0.1}, {0, 0, 0}, 40);
    const auto picture = headless.draw(s, camera, kSize);
    std::size_t wrong = 0;
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
            const DoubleRay ray = pixelRay(camera, kSize, x, y);
            const glm::dvec3 p = ray.origin - ray.direction * (ray.origin.y / ray.direction.y) - glm::dvec3{0.3, 0, 0.2};
            const double to_border = std::min(std::fabs(p.x - std::round(p.x)), std::fabs(p.z - std::round(p.z)));
            if (to_border < 1e-3) continue;
            const bool odd = (static_cast<long>(std::floor(p.x)) + static_cast<long>(std::floor(p.z)) - 1) % 2 != 0;  // y lies below 0
            wrong += (picture[static_cast<std::size_t>(y * kSize.x + x)].x < 0.5f) != odd;
        }
    CHECK(wrong == 0);
}

TEST_CASE("an empty scene is its background, to the bit; and so is one whose objects are hidden") {
    HeadlessRenderer headless;
    Scene s;
    s.world.background = {0.25, 0.5, 0.125};
    s.lights = {{"", {2, 6, 1}, {1, 1, 1}, 1}};
    for (int i = 0; i < 2; ++i) {
        for (const glm::vec3& c : headless.draw(s, Camera{}, {32, 24})) REQUIRE(c == glm::vec3{0.25f, 0.5f, 0.125f});
        addObject(s, "sphere", {1}, {0, 1, 0});
        s.objects[0].hidden = true;
    }
}

TEST_CASE("the parallel camera and the depth buffer") {
    HeadlessRenderer headless;
    Scene s;
    addObject(s, "sphere", {1});
    Camera camera = cameraAt({0, 0, 5}, {0, 0, 0});
    camera.ortho = 3;
    const Measured m = headless.measure(s, camera, kSize);
    std::size_t wrong = 0;
    double worst = 0;
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
            const std::size_t i = static_cast<std::size_t>(y * kSize.x + x);
            const auto hit = firstOf(sphereSpan(pixelRay(camera, kSize, x, y), {}, 1), 200);
            if (m.channels.state[i] == 2) continue;
            wrong += hit.has_value() != (m.channels.state[i] == 1);
            if (hit) worst = std::max(worst, std::fabs(hit->t - static_cast<double>(m.channels.depth[i])));
        }
    CHECK(wrong == 0);
    CHECK(worst < 1e-4);

    headless.draw(s, camera, kSize);
    const std::vector<float> buffer = headless.renderer->picture().readDepth();
    const double reach = s.render.max_distance;
    for (std::size_t i = 0; i < buffer.size(); ++i) {
        const double wanted = m.channels.state[i] == 1 ? static_cast<double>(m.channels.depth[i]) / reach : 1.0;
        REQUIRE(static_cast<double>(buffer[i]) == doctest::Approx(wanted).epsilon(1e-6));
    }
}

TEST_CASE("an eye inside a solid sees its inside; far from the origin the picture is the same") {
    HeadlessRenderer headless;
    Scene s;
    s.lights = {{"", {0, 0.5, 0}, {1, 1, 1}, 1}};
    addObject(s, "sphere", {2});
    const Measured inside = headless.measure(s, cameraAt({0, 0, 0}, {0, 0, -1}), {32, 24});
    for (std::size_t i = 0; i < inside.channels.state.size(); ++i) {
        REQUIRE(inside.channels.state[i] == 1);
        REQUIRE(static_cast<double>(inside.channels.depth[i]) == doctest::Approx(2).epsilon(1e-5));
    }

    const auto near = headless.draw(s, cameraAt({0, 1, 6}, {0, 0, 0}), kSize);
    const glm::dvec3 away{1e6, 0, -1e6};
    s.objects[0].pos += away, s.lights[0].pos += away;
    const auto far = headless.draw(s, cameraAt(away + glm::dvec3{0, 1, 6}, away), kSize);
    float worst = 0;
    for (std::size_t i = 0; i < near.size(); ++i) worst = std::max(worst, std::fabs(near[i].x - far[i].x));
    CHECK(worst < 1.0f / 255);
}

TEST_CASE("more samples smooth an edge and keep the mean") {
    HeadlessRenderer headless;
    Scene s;
    s.materials.push_back({"m", {1, 1, 1}, {0, 0, 0}, Pattern::none, 1, 0, 0, 0, 1});
    addObject(s, "sphere", {1});
    s.objects[0].material = 0;
    const Camera camera = cameraAt({0, 0, 4}, {0, 0, 0});
    const auto mean = [](const std::vector<glm::vec3>& picture) {
        double sum = 0;
        for (const glm::vec3& c : picture) sum += static_cast<double>(c.x);
        return sum / static_cast<double>(picture.size());
    };
    const auto one = headless.draw(s, camera, kSize);
    s.render.samples = 16;
    const auto many = headless.draw(s, camera, kSize);
    CHECK(mean(many) == doctest::Approx(mean(one)).epsilon(0.005));
    std::size_t grey = 0;
    for (const glm::vec3& c : many) grey += c.x > 0.01f && c.x < 0.99f;
    CHECK(grey > 100);
}
