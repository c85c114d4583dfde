// Cases 34 to 37: normals near a crease, far from the eye, without a slope, and over every hit of some pictures.
#include "hard/oracle.h"

#include "core/sdf/tree.h"

using namespace mb;
using namespace mb::hard;

namespace {

double degreesBetween(glm::dvec3 a, glm::dvec3 b) { return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b))); }

/// The worst angle between the picture's normals and those of the unit ball, at the points it found.
double worstOnBall(const Measured& m, const Camera& camera, glm::dvec3 centre, std::size_t& hits) {
    double worst = 0;
    const glm::ivec2 size = m.channels.size;
    hits = 0;
    for (std::size_t i = 0; i < m.channels.state.size(); ++i) {
        if (m.channels.state[i] != 1) continue;
        const DoubleRay r = pixelRay(camera, size, static_cast<int>(i) % size.x, static_cast<int>(i) / size.x);
        ++hits;
        const glm::dvec3 at = r.origin + static_cast<double>(m.channels.depth[i]) * r.direction;
        worst = std::max(worst, degreesBetween(glm::dvec3(m.channels.normal[i]), at - centre));
    }
    return worst;
}

}  // namespace

TEST_CASE("case 34: a crease smears a normal over no more than the reach of its differences, less than half a pixel") {
    HeadlessRenderer headless;
    Scene s;
    addObject(s, "box", {2, 2, 2, 0});
    for (const double away : {4.0, 40.0}) {
        // A narrow view straight at the edge x = 1 of the front face, some 40 of its pixels the reach.
        constexpr glm::ivec2 kSize{256, 8};
        Camera camera = cameraAt({1, 0, 1 + away}, {1, 0, 1});
        const double reach_at_most = s.render.normal_epsilon * away;
        camera.ortho = 8.0 / 256 * 6 * reach_at_most;
        const Channels c = headless.measure(s, camera, kSize).channels;
        double smeared = 0, at_edge = 0, least = 1e9;
        for (int x = 0; x < kSize.x; ++x) {
            const std::size_t i = static_cast<std::size_t>(4 * kSize.x + x);
            const DoubleRay r = pixelRay(camera, kSize, x, 4);
            const double inside = 1 - r.origin.x;  // how far the point of the face is from the edge
            if (c.state[i] != 1 || inside <= 0) continue;
            const double angle = degreesBetween(glm::dvec3(c.normal[i]), {0, 0, 1});
            if (angle > 0.1) smeared = std::max(smeared, inside);
            if (inside < least) least = inside, at_edge = angle;
        }
        const double half_pixel = std::tan(glm::radians(30.0)) / 720 * away;  // of 720 rows and 60 degrees
        MESSAGE(away << " m away: smeared over " << smeared << " m, reach at most " << reach_at_most << ", half a pixel " << half_pixel << "; " << at_edge
                     << " degrees beside the edge");
        CHECK(at_edge > 30);  // 45 at the edge itself: the setup does look there
        CHECK(smeared <= reach_at_most);
        CHECK(reach_at_most <= half_pixel);
    }
}

TEST_CASE("case 35: a normal is right to a tenth of a degree up to a kilometre from the eye or from the origin") {
    HeadlessRenderer headless;
    constexpr double kMost = 0.1;  // degrees
    const glm::ivec2 size{96, 72};
    for (const double p : {0.0, 1e2, 1e3}) {  // from the origin, near the eye
        Scene s;
        addObject(s, "sphere", {1}, {p, 0, p});
        const Camera camera = cameraAt({p + 1, 1, p + 4}, {p, 0, p});
        std::size_t hits = 0;
        const double worst = worstOnBall(headless.measure(s, camera, size), camera, {p, 0, p}, hits);
        MESSAGE("a ball " << p << " m from the origin: normals within " << worst << " degrees");
        CHECK(hits > 1000);
        CHECK(worst <= kMost);
    }
    for (const double t : {10.0, 1e2, 1e3}) {  // from the eye, through a lens that brings it near
        Scene s;
        s.render.max_distance = 1e4;
        addObject(s, "sphere", {1}, {0, 0, 0});
        Camera camera = cameraAt({0.2 * t, 0.3 * t, t}, {0, 0, 0});
        camera.fov = 2 * glm::degrees(std::atan(1.3 / t));
        std::size_t hits = 0;
        const double worst = worstOnBall(headless.measure(s, camera, size), camera, {0, 0, 0}, hits);
        MESSAGE("a ball " << t << " m from the eye: normals within " << worst << " degrees");
        CHECK(hits > 1000);
        CHECK(worst <= kMost);
    }
}

TEST_CASE("case 36: where the field has no slope there is a finite gradient and a unit normal") {
    HeadlessRenderer headless;
    Scene ball, twins, lens, box;
    addObject(ball, "sphere", {1});
    for (const double x : {-1.5, 1.5}) addObject(twins, "sphere", {1}, {x, 0, 0});
    const int o = addObject(lens, "intersect", {});
    for (const double x : {-0.9, 0.9}) addObject(lens, "sphere", {1}, {x, 0, 0}, o);
    addObject(box, "box", {2, 2, 2, 0});
    const std::vector<glm::vec3> points{{0, 0, 0}, {0, 0.3f, 0}, {0, 2, 1}, {0, -0.4358899f, 0}, {0.5f, 0.5f, 0.5f}};
    for (const Scene* s : {&ball, &twins, &lens, &box}) {
        std::vector<GpuSample> gpu;
        REQUIRE(headless.renderer->evaluate(*s, points, gpu) == "");
        const Tree tree = makeTree(*s);
        for (std::size_t i = 0; i < points.size(); ++i) {
            CHECK(std::isfinite(gpu[i].distance));
            CHECK(finite(gpu[i].gradient));
            CHECK(glm::length(gpu[i].gradient) <= 1 + 1e-3f);
            const Slope exact = slope(tree, glm::dvec3(points[i]));
            CHECK(std::isfinite(glm::length(exact.gradient)));
        }
    }

    // A sheet thinner than the differences reach: at its middle they cancel, and the normal is against the ray.
    Scene sheet;
    addObject(sheet, "box", {4, 2e-5, 4, 0});
    const OneRay ray = shoot(headless, sheet, {0, 3, 0}, {0.01, -1, 0});
    MESSAGE("on a sheet of 20 micrometres: state " << ray.state << ", normal " << ray.normal.x << ", " << ray.normal.y << ", " << ray.normal.z);
    CHECK(std::isfinite(glm::length(ray.normal)));
    if (ray.state == 1) CHECK(glm::length(ray.normal) == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("case 37: over every hit of every save, a normal has unit length and faces the eye") {
    HeadlessRenderer headless;
    std::size_t hits = 0, long_or_short = 0, away = 0;
    double worst_length = 0, worst_facing = -1;
    for (const char* name : {"balls", "blends", "bowl", "die", "gallery", "marble_run", "mirrors", "three_lights", "welcome"}) {
        const LoadResult loaded = loadScene(std::string("saves/") + name + ".txt");
        REQUIRE(loaded.ok());
        const Camera camera = defaultCamera(loaded.scene);
        const glm::ivec2 size{320, 180};
        const Channels c = headless.measure(loaded.scene, camera, size).channels;
        for (std::size_t i = 0; i < c.state.size(); ++i) {
            if (c.state[i] != 1) continue;
            ++hits;
            const glm::dvec3 n(c.normal[i]);
            const double length = std::fabs(glm::length(n) - 1);
            const double facing = glm::dot(n, pixelRay(camera, size, static_cast<int>(i) % size.x, static_cast<int>(i) / size.x).direction);
            worst_length = std::max(worst_length, length), worst_facing = std::max(worst_facing, facing);
            long_or_short += length > 1e-5, away += facing > 1e-3;
        }
    }
    MESSAGE(hits << " hits: lengths within " << worst_length << " of 1; " << away << " normals turned away, the furthest by a cosine of " << worst_facing);
    CHECK(hits > 100'000);
    CHECK(long_or_short == 0);
    CHECK(away == 0);
}
