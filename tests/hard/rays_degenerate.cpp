// Cases 8 to 12, 14 and 15: eyes in and on solids, rays without a direction, signed zeros, touches, the far end, nothing.
#include "hard/oracle.h"

#include "core/sdf/raycast.h"

#include <cstring>

using namespace mb;
using namespace mb::hard;

namespace {

constexpr glm::ivec2 kSize{64, 48};

/// A block with a hollow, and a ball with a bite taken out: places to stand inside of.
Scene hollows() {
    Scene s;
    const int block = addObject(s, "subtract", {});
    addObject(s, "box", {6, 4, 5, 0}, {}, block);
    addObject(s, "sphere", {1.5}, {0.3, 0.1, -0.2}, block);
    const int ball = addObject(s, "subtract", {}, {8, 0, 0});
    addObject(s, "sphere", {2}, {}, ball);
    addObject(s, "box", {2, 2, 2, 0}, {1.5, 0, 0}, ball);
    return s;
}
std::optional<Hit> hollowsTruth(const DoubleRay& r) {
    const Inside block = less(insideOf(boxSpan(r, {0, 0, 0}, {6, 4, 5})), insideOf(sphereSpan(r, {0.3, 0.1, -0.2}, 1.5)));
    const Inside ball = less(insideOf(sphereSpan(r, {8, 0, 0}, 2)), insideOf(boxSpan(r, {9.5, 0, 0}, {2, 2, 2})));
    return firstAhead(joined(block, ball), 200);
}

bool sameBits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Pixels of a picture of states and depths that are not the mirror image of themselves, to the bit.
std::size_t unmirrored(const Channels& c) {
    std::size_t wrong = 0;
    for (int y = 0; y < c.size.y; ++y)
        for (int x = 0; x < c.size.x; ++x) {
            const std::size_t i = static_cast<std::size_t>(y * c.size.x + x), j = static_cast<std::size_t>(y * c.size.x + c.size.x - 1 - x);
            wrong += !sameBits(c.depth[i], c.depth[j]) || c.state[i] != c.state[j];
        }
    return wrong;
}

}  // namespace

TEST_CASE("case 8: an eye inside a solid, a cavity or a bite sees the surface around it") {
    HeadlessRenderer headless;
    const Scene s = hollows();
    for (const glm::dvec3 eye : {glm::dvec3{2.4, 1.2, 1.6}, glm::dvec3{0.3, 0.1, -0.2}, glm::dvec3{0.5, 0.9, -0.6}, glm::dvec3{8.9, 0.2, 0.1}, glm::dvec3{7, 0.1, 0}}) {
        for (const glm::dvec3 way : {glm::dvec3{1, 0.1, 0.2}, glm::dvec3{-1, 0.2, -0.3}, glm::dvec3{0.1, -0.3, 1}}) {
            const Camera camera = cameraAt(eye, eye + way, 90);
            const Measured m = headless.measure(s, camera, kSize);
            const Compared c = compare(m, camera, hollowsTruth);
            CAPTURE(eye.x);
            CHECK(c.false_hits + c.false_misses == 0);
            CHECK(c.undecided <= c.pixels / 200);
            CHECK(c.deep <= c.pixels / 1000);
            for (std::size_t i = 0; i < c.pixels; ++i) {
                REQUIRE(!std::isnan(m.channels.depth[i]));
                REQUIRE(m.channels.steps[i] <= static_cast<float>(s.render.march_steps));
            }
        }
    }
}

TEST_CASE("case 8: seen from inside, a mirrored scene is the mirrored picture") {
    HeadlessRenderer headless;
    Scene s;
    const int block = addObject(s, "subtract", {});
    addObject(s, "box", {6, 4, 5, 0}, {}, block);
    addObject(s, "sphere", {1.5}, {0, 0.1, -0.2}, block);
    for (const glm::dvec3 eye : {glm::dvec3{0, 0.2, 0.1}, glm::dvec3{0, -1.8, 0}}) {  // in the hollow, in the block
        const Channels c = headless.measure(s, cameraAt(eye, eye - glm::dvec3{0, 0, 1}, 90), {64, 64}).channels;
        CHECK(unmirrored(c) == 0);
    }
}

TEST_CASE("case 9: an eye on the surface sees past it, or through it to the other side") {
    HeadlessRenderer headless;
    Scene s;
    addObject(s, "sphere", {1});
    const Tree tree = makeTree(s);
    const double close = 2 * s.render.march_epsilon;
    Draw draw(91);
    int most_steps = 0;
    for (int i = 0; i < times(40); ++i) {
        // Most of these points are not on the ball in floats, but a rounding beside it, on either side.
        const glm::dvec3 out = i == 0 ? glm::dvec3{0, 1, 0} : glm::normalize(glm::dvec3{draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)});
        const glm::dvec3 along = glm::normalize(glm::cross(out, glm::dvec3{0.36, 0.48, 0.8}));
        CHECK(shoot(headless, s, out, out).state == 0);
        CHECK(shoot(headless, s, out, out + 0.3 * along).state == 0);
        CHECK(shoot(headless, s, out, along).state != 1);
        const OneRay in = shoot(headless, s, out, -out);
        CHECK(in.state == 1);
        CHECK(in.t == doctest::Approx(2).epsilon(close));
        most_steps = std::max(most_steps, in.steps);

        CHECK(raycast(tree, out, out, 100).state == RayState::miss);
        CHECK(raycast(tree, out, along, 100).state != RayState::hit);
        const RayEnd through = raycast(tree, out, -out, 100);
        CHECK(through.state == RayState::hit);
        CHECK(through.t == doctest::Approx(2).epsilon(1e-9));
    }
    MESSAGE("through the ball in at most " << most_steps << " evaluations");
    CHECK(most_steps < 100);
}

TEST_CASE("case 10: views that a file may not hold are refused, and sizes without pixels") {
    for (const char* key : {"fov:0", "fov:180", "fov:-1", "fov:nan", "fov:inf", "eye:nan,0,0", "eye:0,inf,0", "target:0,0,1e10", "ortho:-1"}) {
        CAPTURE(key);
        CHECK(firstFault(std::string("marchbox 1\ncamera ") + key + "\n").starts_with("2:"));
    }
    HeadlessRenderer headless;
    Scene s;
    addObject(s, "sphere", {1});
    for (const glm::ivec2 size : {glm::ivec2{0, 48}, glm::ivec2{64, 0}, glm::ivec2{-1, 5}}) {
        Measured m;
        CHECK(headless.renderer->draw(s, {}, size).find("each side") != std::string::npos);
        CHECK(headless.renderer->measure(s, {}, size, m).find("each side") != std::string::npos);
    }
}

TEST_CASE("case 10: degenerate rays store no NaN and take no longer than others") {
    HeadlessRenderer headless;
    Scene s;
    addObject(s, "plane", {0, 1, 0, -1});
    addObject(s, "sphere", {1}, {0, 0, -4});
    const Camera usual = cameraAt({0, 0, 0}, {0, -0.1, -1}, 60);
    const double normal = static_cast<double>(headless.measure(s, usual, kSize).counts.evaluations.primary);
    constexpr double kMost = 2.5;  // times the evaluations of the usual view: what Embree allows its NaN and infinite rays
    for (const Camera& camera : {cameraAt({0, 0, 0}, {0, 0, 0}), cameraAt({0, 0, 0}, {0, 5, 0}), cameraAt({0, 0, 0}, {0, -5, 0}),
                                 cameraAt({0, 0, 0}, {0, 0, -1}, 1e-3), cameraAt({0, 0, 0}, {0, 0, -1}, 1e-6), cameraAt({0, 0, 0}, {0, 0, -1}, 179),
                                 cameraAt({0, 0, 0}, {0, 0, -1}, 180), cameraAt({0, 0, 0}, {0, 0, -1}, 0)}) {
        CAPTURE(camera.fov);
        const Measured m = headless.measure(s, camera, kSize);
        CHECK(static_cast<double>(m.counts.evaluations.primary) <= kMost * normal);
        for (std::size_t i = 0; i < m.channels.depth.size(); ++i) REQUIRE((!std::isnan(m.channels.depth[i]) && finite(m.channels.normal[i])));
    }
    const Tree tree = makeTree(s);
    const double nan = std::nan(""), usual_evaluations = raycast(tree, {0, 0, 0}, {0, -0.1, -1}, 200).evaluations;
    for (const glm::dvec3 way : {glm::dvec3{0, 0, 0}, glm::dvec3{nan, 0, 1}, glm::dvec3{0, INFINITY, 1}, glm::dvec3{1e-300, 0, 0}, glm::dvec3{1e300, 0, 0}}) {
        const RayEnd end = raycast(tree, {0, 0, 0}, way, 200);
        CHECK(std::isfinite(end.t));
        CHECK(end.evaluations <= kMost * usual_evaluations);
    }
}

TEST_CASE("case 11: signed zeros and rays along faces end as their mirror images do, to the bit") {
    Scene s;
    addObject(s, "box", {2, 1, 1, 0});
    addObject(s, "cylinder", {0.5, 1, 0}, {0, 3, 0});
    addObject(s, "plane", {0, 1, 0, -4});
    const Tree tree = makeTree(s);
    int compared = 0;
    for (const double y : {0.0, 0.5, -0.5, 0.25, 3.0, 3.5, -3.0})
        for (const double z : {0.0, 0.5, 0.3})
            for (const double zero : {0.0, -0.0}) {
                const RayEnd right = raycast(tree, {4, y, z}, {-1, zero, -zero}, 100), left = raycast(tree, {-4, y, -z}, {1, -zero, zero}, 100);
                CAPTURE(y);
                CAPTURE(z);
                CHECK(right.state == left.state);
                CHECK(std::memcmp(&right.t, &left.t, sizeof right.t) == 0);
                CHECK(right.index == left.index);
                ++compared;
            }
    CHECK(compared == 42);

    // On the GPU: parallel rays along the axes, the outermost ones in the planes of the box's side faces.
    HeadlessRenderer headless;
    for (const glm::dvec3 eye : {glm::dvec3{0, 0, 6}, glm::dvec3{0, 3, 6}, glm::dvec3{0, 2, 6}}) {
        Camera camera = cameraAt(eye, eye - glm::dvec3{0, 0, 1});
        camera.ortho = 2 * 32 / 31.0;  // pixel k's centre lies at (2k − 31)/31 m
        const Channels c = headless.measure(s, camera, {32, 32}).channels;
        CHECK(unmirrored(c) == 0);
        for (const float depth : c.depth) CHECK(!std::isnan(depth));
    }
}

TEST_CASE("case 12: a ray past a ball is a hit just when its line meets the ball") {
    HeadlessRenderer headless;
    Scene s;
    addObject(s, "sphere", {1});
    constexpr double kFrom = 2;
    const double eps = s.render.march_epsilon * kFrom;  // where a ray is close
    for (const double off : {1e-2, 1e-3, 1e-4, 1e-6})
        for (const double side : {1.0, -1.0}) {
            const double b = 1 + side * off;
            CAPTURE(b);
            Camera camera = cameraAt({b, 0, kFrom}, {b, 0, 0});
            camera.ortho = 1e-9;
            const Channels c = headless.measure(s, camera, {1, 1}).channels;
            if (off > eps) CHECK(c.state[0] == (b < 1 ? 1 : 0));
            else CHECK(c.state[0] != (b < 1 ? 0 : 1));  // undecided, or right
            if (c.state[0] != 1) continue;
            const double t = kFrom - std::sqrt(std::max(1 - b * b, 0.0));
            MESSAGE("b - 1 = " << b - 1 << ": t off by " << static_cast<double>(c.depth[0]) - t);
            CHECK(std::fabs(static_cast<double>(c.depth[0]) - t) <= std::sqrt(2 * eps) + 1e-3);
        }
}

TEST_CASE("case 14: a wall just within reach is seen, one just beyond is not, and nothing else changes") {
    HeadlessRenderer headless;
    for (const double far : {20.0, 200.0}) {
        Scene s;
        s.render.max_distance = far;
        addObject(s, "box", {far, far, 1, 0}, {far / 2, 0, 0});  // over the right half of the view
        addObject(s, "sphere", {0.5}, {-1, 0, -5});
        Camera camera = cameraAt({0, 0, 0}, {0, 0, -1});
        camera.ortho = 4;
        const auto with_wall_at = [&](double z) {
            s.objects[0].pos.z = -z - 0.5;
            return headless.measure(s, camera, kSize).channels;
        };
        const Channels within = with_wall_at(0.999 * far), beyond = with_wall_at(1.001 * far);
        std::size_t seen = 0;
        for (std::size_t i = 0; i < within.state.size(); ++i) {
            if (within.state[i] == beyond.state[i]) {
                CHECK(sameBits(within.depth[i], beyond.depth[i]));
                continue;
            }
            ++seen;
            CHECK(within.state[i] == 1);
            CHECK(beyond.state[i] == 0);
            CHECK(static_cast<double>(within.depth[i]) == doctest::Approx(0.999 * far).epsilon(1e-6));
        }
        CHECK(seen == within.state.size() / 2);
    }
}

TEST_CASE("case 15: nothing, nothing shown and nothing left are the background everywhere, and a finite distance") {
    HeadlessRenderer headless;
    Scene none, hidden, taken;
    for (const char* type : {"union", "subtract", "intersect"}) addObject(hidden, "sphere", {1}, {}, addObject(hidden, type, {}));
    for (Object& o : hidden.objects) o.hidden = o.parent == kNoParent;
    const int all = addObject(taken, "subtract", {});
    addObject(taken, "sphere", {1}, {}, all), addObject(taken, "sphere", {2}, {}, all);
    for (Scene* s : {&none, &hidden, &taken}) {
        s->world.background = {0.25, 0.5, 0.125};
        s->lights = {{"", {2, 6, 1}, {1, 1, 1}, 1}};
        for (const glm::vec3& c : headless.draw(*s, Camera{}, kSize)) REQUIRE(c == glm::vec3{0.25f, 0.5f, 0.125f});
        CHECK(headless.renderer->countUndecided() == 0);
        std::vector<GpuSample> samples;
        REQUIRE(headless.renderer->evaluate(*s, {{0, 0, 0}, {1, 2, 3}}, samples) == "");
        for (const GpuSample& g : samples) CHECK((std::isfinite(g.distance) && g.distance > 0 && finite(g.gradient)));
    }
    CHECK(distance<double>(makeTree(none), vec({1, 2, 3})) == 1e9);
    CHECK(distance<double>(makeTree(hidden), vec({1, 2, 3})) == 1e9);
}
