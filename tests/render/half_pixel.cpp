// What is drawn is what collides: a ball that came to rest on a part shows at most half a pixel of gap or overlap.
//
// Read off pictures, not off the physics: seen from the side, the part and the ball are each drawn alone, cut at a plane through the
// ball's centre, so that the pixels at the plane's distance are the cross-section. The first pair of pictures has 640x480
// pixels and says where the two are nearest; the second is of that place, 32 times as near, and says by how much they are apart.
#include "headless.h"

#include "core/scene/camera.h"
#include "physics/scenes.h"

#include <glm/geometric.hpp>

#include <optional>
#include <string>

using namespace mb;
using namespace mb::test;

namespace {

constexpr glm::ivec2 kSize{640, 480};
constexpr double kZoom = 32, kAway = 3;  // m: of the eye from the plane
constexpr double kRadius = 0.2;

/// The plane through `centre` across `towards`, looked at from that side; `high` m of it.
Camera facing(glm::dvec3 centre, glm::dvec3 towards, double high) {
    return {.name = "", .eye = centre + kAway * towards, .target = centre, .ortho = high};
}

/// The pixels that show the plane: where the scene, of one object, is solid in it.
std::vector<char> section(HeadlessRenderer& headless, const Scene& scene, std::size_t object, const Camera& camera) {
    const glm::dvec3 towards = glm::normalize(camera.eye - camera.target);
    Scene cut;
    cut.render = scene.render, cut.world = scene.world;
    add(cut, "subtract", {}, {0});
    for (std::size_t i = object; i < subtreeEnd(scene, object); ++i) {
        Object o = scene.objects[i];
        o.parent = o.parent == kNoParent ? 0 : o.parent - static_cast<int>(object) + 1;
        o.mass = o.density = 0;
        cut.objects.push_back(o);
    }
    add(cut, "plane", {}, {-towards.x, -towards.y, -towards.z, -glm::dot(towards, camera.target)}, 0);
    const Measured seen = headless.measure(cut, camera, kSize);
    std::vector<char> solid(seen.channels.depth.size());
    for (std::size_t i = 0; i < solid.size(); ++i) solid[i] = seen.channels.state[i] == 1 && std::fabs(static_cast<double>(seen.channels.depth[i]) - kAway) <= 2e-4;
    return solid;
}

glm::dvec2 pixel(std::size_t i) {
    const auto x = static_cast<int>(i) % kSize.x, y = static_cast<int>(i) / kSize.x;
    return {x + 0.5, y + 0.5};
}

/// The distance in pixels from a point to the nearest pixel of a section, and which that is; and to the furthest.
struct Reach {
    double nearest = INFINITY, furthest = 0;
    glm::dvec2 at{0};
};
Reach reachOf(const std::vector<char>& solid, glm::dvec2 from) {
    Reach reach;
    for (std::size_t i = 0; i < solid.size(); ++i) {
        if (!solid[i]) continue;
        const double d = glm::length(pixel(i) - from);
        if (d < reach.nearest) reach.nearest = d, reach.at = pixel(i);
        reach.furthest = std::max(reach.furthest, d);
    }
    return reach;
}

/// The gap between the ball, the last object, and the part, the first, in pixels of the first pictures; negative: overlap.
double gapInPixels(HeadlessRenderer& headless, const Scene& scene, glm::dvec3 towards) {
    const std::size_t ball = scene.objects.size() - 1;
    const double high = 6 * kRadius;
    const Camera far = facing(scene.objects[ball].pos, towards, high);
    // The ball's middle, of all its pixels; and where the part is nearest to it.
    const std::vector<char> disc = section(headless, scene, ball, far);
    glm::dvec2 middle{0};
    double pixels = 0;
    for (std::size_t i = 0; i < disc.size(); ++i)
        if (disc[i]) middle += pixel(i), ++pixels;
    middle /= pixels;
    CHECK(pixels == doctest::Approx(kPi * 80 * 80).epsilon(2e-3));
    const Reach near = reachOf(section(headless, scene, 0, far), middle);
    CHECK(std::fabs(near.nearest - 80) <= 2);

    // From there 32 times as near. The middle lies outside that picture.
    const View view = viewOf(far);
    const glm::dvec2 from_centre = (near.at - glm::dvec2(kSize) / 2.0) * (high / kSize.y);
    const Camera close = facing(far.target + from_centre.x * view.right - from_centre.y * view.up, towards, high / kZoom);
    const std::optional<glm::dvec2> centre = pictureOf(close, kSize, far.target + [&] {
        const glm::dvec2 off = (middle - glm::dvec2(kSize) / 2.0) * (high / kSize.y);
        return off.x * view.right - off.y * view.up;
    }());
    REQUIRE(centre);
    const Reach part = reachOf(section(headless, scene, 0, close), *centre), edge = reachOf(section(headless, scene, ball, close), *centre);
    REQUIRE(part.nearest < INFINITY);
    REQUIRE(edge.furthest > 0);
    return (part.nearest - edge.furthest) / kZoom;
}

struct Rest {
    std::string_view name;
    void (*part)(Scene&);
    glm::dvec3 ball;              // where it is let fall
    glm::dvec3 towards{0, 0, 1};  // the eye, across the plane in which it will touch
};

void block(Scene& s, glm::dvec3 size, int parent, glm::dvec3 at = {0, 0, 0}) { add(s, "box", at, {size.x, size.y, size.z, 0}, parent); }

const Rest kRests[] = {
    {"union: the valley between two balls", [](Scene& s) {
        add(s, "union", {}, {0});
        add(s, "sphere", {-0.35, 0, 0}, {0.4}, 0), add(s, "sphere", {0.35, 0, 0}, {0.4}, 0);
        add(s, "box", {0, -0.3, 0.35}, {1.4, 0.9, 0.06, 0}, 0), add(s, "box", {0, -0.3, -0.35}, {1.4, 0.9, 0.06, 0}, 0);
     }, {0.02, 0.7, 0}},
    {"subtract: on the two edges of a slot", [](Scene& s) {
        add(s, "subtract", {}, {0});
        block(s, {1.4, 0.5, 1.4}, 0), block(s, {0.3, 0.6, 2}, 0, {0.1, 0.2, 0});
     }, {0.1, 0.6, 0}},
    {"subtract: in a spherical hollow", [](Scene& s) {
        add(s, "subtract", {}, {0});
        block(s, {1.4, 0.6, 1.4}, 0), add(s, "sphere", {0, 0.5, 0}, {0.55}, 0);
     }, {0.05, 0.4, 0}},
    {"subtract: on the rim of a round hole", [](Scene& s) {
        add(s, "subtract", {}, {0});
        block(s, {1.4, 0.4, 1.4}, 0), add(s, "cylinder", {}, {0.15, 2, 0}, 0);
     }, {0, 0.45, 0}},
    {"subtract: on the floor of a recess whose cutter hardly stands out of it", [](Scene& s) {
        add(s, "subtract", {}, {0});
        block(s, {1.4, 0.4, 1.4}, 0), block(s, {1, 0.12, 1}, 0, {0, 0.16, 0});
     }, {0.1, 0.6, 0}},
    {"subtract: on the rim of a round hole whose cutter is almost flush", [](Scene& s) {
        add(s, "subtract", {}, {0});
        block(s, {1.4, 0.1, 1.4}, 0), add(s, "cylinder", {}, {0.15, 0.102, 0}, 0);
     }, {0, 0.45, 0}},
    {"displace: between waves", [](Scene& s) {
        add(s, "displace", {}, {0.05, 6});
        block(s, {1.4, 0.4, 1.4}, 0);
     }, {0.1, 0.6, 0.1}},
    {"intersect: between the rims of two lenses", [](Scene& s) {
        add(s, "union", {}, {0});
        for (const double x : {-0.3, 0.3}) {
            const int lens = static_cast<int>(s.objects.size());
            add(s, "intersect", {x, 0, 0}, {0}, 0);
            add(s, "cylinder", {-0.2, 0, 0}, {0.4, 0.8, 0}, lens), add(s, "cylinder", {0.2, 0, 0}, {0.4, 0.8, 0}, lens);
            s.objects[s.objects.size() - 1].rot = s.objects[s.objects.size() - 2].rot = {90, 0, 0};
        }
     }, {0, 0.5, 0}},
    {"intersect: on the flat face of a cut ball", [](Scene& s) {
        add(s, "intersect", {}, {0});
        add(s, "sphere", {}, {0.6}, 0), block(s, {2, 0.5, 2}, 0);
     }, {0.1, 0.5, 0}},
    {"blend: the seam of two cylinders", [](Scene& s) {
        add(s, "union", {}, {0.25});
        for (const double x : {-0.3, 0.3}) add(s, "cylinder", {x, 0, 0}, {0.35, 1.4, 0}, 0).rot = {90, 0, 0};
     }, {0.03, 0.7, 0}},
    {"blend: a hollow with a soft rim", [](Scene& s) {
        add(s, "subtract", {}, {0.2});
        block(s, {1.6, 0.6, 1.6}, 0), add(s, "sphere", {0, 0.5, 0}, {0.5}, 0);
     }, {0.05, 0.5, 0}},
    {"rotated: a groove carved by a turned box", [](Scene& s) {
        add(s, "subtract", {}, {0}).rot = {0, 0, 12};
        block(s, {1.6, 0.8, 1.4}, 0);
        add(s, "box", {0, 0.4, 0}, {0.7, 0.7, 2, 0}, 0).rot = {0, 0, 40};
     }, {-0.05, 0.9, 0}},
    {"rotated and scaled: a hollow in a block turned about all axes", [](Scene& s) {
        Object& o = add(s, "subtract", {0.1, 0, 0.2}, {0});
        o.rot = {12, 40, -15}, o.scale = 1.7;
        block(s, {0.8, 0.4, 0.8}, 0), add(s, "sphere", {0, 0.3, 0}, {0.33}, 0);
     }, {0.2, 0.8, 0.2}},
    {"scaled: on a rounded, hollowed box", [](Scene& s) {
        add(s, "shell", {}, {0.1}).scale = 0.6;
        add(s, "box", {}, {2, 0.8, 2, 0.1}, 0);
     }, {0.1, 0.6, 0}},
};

}  // namespace

TEST_CASE("a ball at rest on any part shows at most half a pixel of gap or overlap") {
    HeadlessRenderer headless;
    double worst = 0;
    for (const Rest& rest : kRests) {
        const std::string name(rest.name);
        CAPTURE(name);
        Scene s = scene(1.0 / 120, 0.2, 0.6);
        s.physics.substeps = 2;
        s.world.rolling = 0.01;  // so that it does not sway for long
        rest.part(s);
        ball(s, rest.ball, kRadius);
        PhysicsWorld w(s);
        REQUIRE(w.bodies().size() == 1);
        while (w.time_s() < 20 && w.awake() > 0) w.step();
        CHECK(w.awake() == 0);
        REQUIRE(w.bodies().size() == 1);
        w.writeTo(s);
        // The plane is to hold the place where they touch: across the way from the centre to the part, by the field of the part alone.
        Scene part = s;
        removeSubtree(part, s.objects.size() - 1);
        const glm::dvec3 c = s.objects.back().pos;
        const Slope slope = mb::slope(makeTree(part), c);
        const glm::dvec3 up = glm::normalize(slope.gradient);
        const glm::dvec3 across = rest.towards - glm::dot(rest.towards, up) * up;
        const double gap = gapInPixels(headless, s, glm::normalize(across));
        CHECK(std::fabs(gap) <= 0.5);
        worst = std::max(worst, std::fabs(gap));
        MESSAGE(name, ": ", gap, " pixels");
    }
    MESSAGE("at most ", worst, " pixels of 2.5 mm");
}

TEST_CASE("the measure tells a ball that hangs or is sunk in by a pixel from one that rests") {
    HeadlessRenderer headless;
    for (const double off : {-1.0, -0.25, 0.0, 0.25, 1.0}) {
        Scene s;
        add(s, "subtract", {}, {0});
        block(s, {1.4, 0.6, 1.4}, 0), add(s, "sphere", {0, 0.5, 0}, {0.55}, 0);
        const double pixel = 6 * kRadius / kSize.y;
        ball(s, {0, 0.5 - 0.55 + kRadius + off * pixel, 0}, kRadius);
        CHECK(gapInPixels(headless, s, {0, 0, 1}) == doctest::Approx(off).epsilon(0.06));
    }
}
