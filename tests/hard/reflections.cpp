// Cases 46 to 50: mirrors that face one another, meet in a corner, curve, dim, and dim less than they may.
#include "hard/oracle.h"

using namespace mb;
using namespace mb::hard;

namespace {

/// A mirror of full strength, which shows its own colour once a bounce.
Material mirror(glm::dvec3 color, glm::dvec3 color2, double kr = 1, double ka = 1) {
    return {"mirror", color, color2, Pattern::checker, ka, 0, 0, kr, 1};
}
/// The checkerboard's field of a point, in the object's frame: dark is color2.
bool dark(glm::dvec3 p) { return static_cast<long>(std::floor(p.x) + std::floor(p.y) + std::floor(p.z)) % 2 != 0; }

/// The one pixel of a narrow view along a direction.
glm::vec3 colorAlong(HeadlessRenderer& headless, const Scene& s, glm::dvec3 eye, glm::dvec3 way) {
    return headless.draw(s, cameraAt(eye, eye + way), {1, 1})[0];
}

/// Two facing mirrors at z = 0 and z = 2; the first is red, the second green, and their dark fields lack blue. Each lies in
/// the middle of a layer of fields, half a metre from its object's origin.
Scene facing() {
    Scene s;
    s.materials = {mirror({1, 0, 1}, {1, 0, 0}), mirror({0, 1, 1}, {0, 1, 0})};
    s.materials[1].name = "other";
    addObject(s, "plane", {0, 0, 1, 0.5}, {0, 0, -0.5}), addObject(s, "plane", {0, 0, -1, -2.5}, {0, 0, -0.5});
    s.objects[0].material = 0, s.objects[1].material = 1;
    return s;
}

}  // namespace

TEST_CASE("case 46: between parallel mirrors a ray alternates 64 times, each time where geometry says") {
    HeadlessRenderer headless;
    Scene s = facing();
    constexpr double kAside = 0.37, kEye = 0.7;  // m along x for each 2 m between the mirrors
    constexpr double kInset = 1e-3;              // by which the pattern's borders may be moved
    const glm::dvec3 eye{0.21, 0.5, kEye}, way{-kAside, 0, -2};
    int wrong_mirror = 0, wrong_field = 0, compared = 0, first_wrong = 65;
    glm::vec3 before{0};
    for (int n = 0; n <= 64; ++n) {
        s.render.reflections = n;
        const glm::vec3 sum = colorAlong(headless, s, eye, way), hit = sum - before;
        before = sum;
        wrong_mirror += hit.x != (n % 2 == 0 ? 1.0f : 0.0f) || hit.y != (n % 2 == 0 ? 0.0f : 1.0f);
        const double x = eye.x - kAside * (kEye / 2 + n);
        // A segment that is 1e-3 of its 2 m off shifts the next hit by kAside/2 of that, and so all that follow.
        if (std::fabs(x - std::round(x)) < kInset + 1e-3 * kAside / 2 * (n + 1)) continue;
        ++compared;
        const bool wrong = (hit.z < 0.5f) != dark({x, 0.5, 0.5});
        wrong_field += wrong;
        if (wrong) first_wrong = std::min(first_wrong, n);
    }
    MESSAGE("65 hits: " << wrong_mirror << " of the wrong mirror, " << wrong_field << " of " << compared << " in another field than geometry says"
                        << (wrong_field > 0 ? ", the first at bounce " + std::to_string(first_wrong) : std::string()));
    CHECK(wrong_mirror == 0);
    CHECK(compared > 55);
    CHECK(wrong_field == 0);
}

TEST_CASE("case 47: two mirrors at a right angle send a ray back as it came") {
    HeadlessRenderer headless;
    constexpr double kDegrees = 0.1, kBehind = 15, kAway = 12;
    for (const double turn : {20.0, 45.0, 75.0}) {
        const double a = glm::radians(turn);
        const glm::dvec3 d{-std::sin(a), 0, -std::cos(a)}, eye = -kAway * d + glm::dvec3{0, 0.3, 0};
        Scene s;
        s.materials = {mirror({0, 0, 0}, {0, 0, 0}), {"wall", {1, 1, 1}, {0, 0, 0}, Pattern::checker, 1, 0, 0, 0, 1}};
        addObject(s, "plane", {1, 0, 0, 0}), addObject(s, "plane", {0, 0, 1, 0}), addObject(s, "plane", {0, 0, 1, 0}, eye - kBehind * d);
        s.objects[0].material = s.objects[1].material = 0, s.objects[2].material = 1;
        s.objects[2].rot = {0, 180 + turn, 0};  // faces along d
        const glm::dmat3 wall = rotationFromDegrees(s.objects[2].rot);
        const glm::ivec2 size{160, 120};
        Camera camera = cameraAt(eye, eye + d);
        camera.ortho = 6;
        const auto picture = headless.draw(s, camera, size);
        std::size_t wrong = 0, compared = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const glm::dvec3 o = pixelRay(camera, size, x, y).origin;
                if (o.x < 0.1 || o.z < 0.1) continue;  // it starts in a mirror
                // In the plane of the mirrors' normals the way back is the way there turned by 180 degrees around the corner.
                const glm::dvec3 back{-o.x, o.y, -o.z}, end = glm::transpose(wall) * (back - s.objects[2].pos);
                const double drift = std::tan(glm::radians(kDegrees)) * (2 * kAway + kBehind);
                const double edge = std::fabs(glm::cross(o, d).y), bias = 2 * s.render.march_epsilon * kAway;
                if (std::fabs(end.x - std::round(end.x)) < drift || std::fabs(end.y - std::round(end.y)) < drift || edge < 2 * bias) continue;
                ++compared;
                wrong += (picture[static_cast<std::size_t>(y * size.x + x)].x < 0.5f) != dark({end.x, end.y, -0.5});
            }
        MESSAGE("turned by " << turn << " degrees: " << wrong << " of " << compared << " rays do not come back within " << kDegrees << " degrees");
        CHECK(compared > 10'000);
        CHECK(wrong == 0);
    }
}

TEST_CASE("case 48: a mirror ball shows the checkerboard that a double ray tracer sees in it") {
    HeadlessRenderer headless;
    constexpr double kHalf = 6;  // of the floor, m: further out the ball shows fields smaller than a pixel
    const glm::dvec3 centre{0, 1.2, 0};
    const glm::ivec2 size{320, 240};
    Scene s;
    s.world.background = {0.5, 0.5, 0.5};
    s.materials = {{"floor", {1, 1, 1}, {0, 0, 0}, Pattern::checker, 1, 0, 0, 0, 1}, mirror({0, 0, 0}, {0, 0, 0})};
    addObject(s, "box", {2 * kHalf, 1, 2 * kHalf, 0}, {0, -0.5, 0}), addObject(s, "sphere", {1}, centre);
    s.objects[0].material = 0, s.objects[1].material = 1;
    const Camera camera = cameraAt({0.5, 2.5, 4}, centre, 40);
    const Measured m = headless.measure(s, camera, size);
    const auto picture = headless.draw(s, camera, size);
    std::size_t shared = 0, either = 0, not_floor = 0, shifted = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const std::size_t i = static_cast<std::size_t>(y * size.x + x);
            const DoubleRay r = pixelRay(camera, size, x, y);
            const Span ball = sphereSpan(r, centre, 1);
            if (ball.empty() || m.channels.state[i] != 1 || m.channels.object[i] != 1) continue;
            const glm::dvec3 p = r.origin + ball.enter * r.direction, d = glm::reflect(r.direction, ball.enter_normal);
            const double t = d.y < 0 ? -p.y / d.y : 1e9;  // a ray upwards ends far beyond the rim
            const glm::dvec3 q = p + t * d;
            const double to_rim = kHalf - std::max(std::fabs(q.x), std::fabs(q.z)), to_border = std::min(std::fabs(q.x - std::round(q.x)), std::fabs(q.z - std::round(q.z)));
            const bool is_dark = picture[i].x < 0.25f, should = to_rim > 0 && dark({q.x, 0.4, q.z});
            const double allowed = 10 * s.render.march_epsilon * (ball.enter + t) / std::fabs(d.y);  // along the floor
            shared += is_dark && should, either += is_dark || should;
            not_floor += to_rim > allowed && std::fabs(picture[i].x - 0.5f) < 0.1f;
            shifted += to_rim > allowed && to_border > allowed && is_dark != should;
        }
    const double iou = static_cast<double>(shared) / static_cast<double>(either);
    MESSAGE("dark fields in the ball: IoU " << iou << " of " << either << " pixels, " << shifted << " shifted by more than 10 epsilon, " << not_floor
                                            << " show the sky for the floor");
    CHECK(either > 2000);
    CHECK(iou >= 0.995);
    CHECK(shifted == 0);
    CHECK(not_floor == 0);
}

TEST_CASE("case 49: a mirror of strength k adds at most k to the power of the bounces, up to what one more can show") {
    HeadlessRenderer headless;
    // Each surface radiates 1 − k: after n bounces the sum is 1 − k^(n+1). The format ends at 64 bounces, which is what
    // k = 0.91 takes to come within 1/255.
    for (const std::pair<double, int>& mirrored : {std::pair{0.2, 4}, std::pair{0.5, 8}, std::pair{0.8, 25}, std::pair{0.9, 53}, std::pair{0.95, 64}, std::pair{0.99, 64}}) {
        const double k = mirrored.first;
        const int bounces = mirrored.second;
        Scene s;
        s.materials = {mirror({1, 1, 1}, {1, 1, 1}, k, 1 - k)};
        addObject(s, "plane", {0, 0, 1, 0}), addObject(s, "plane", {0, 0, -1, -2});
        for (Object& o : s.objects) o.material = 0;
        double last = 0;
        for (int n = 0; n <= bounces; ++n) {
            s.render.reflections = n;
            const double value = static_cast<double>(colorAlong(headless, s, {0, 0, 1}, {0.3, 0.1, 1}).x), step = value - last;
            CAPTURE(k);
            CAPTURE(n);
            CHECK(step >= 0);
            CHECK(step <= std::pow(k, n) + 1e-6);
            // Where the rest is fainter than 1/512 the path ends early.
            CHECK(std::fabs(value - (1 - std::pow(k, n + 1))) <= 1.0 / 512 + 1e-5);
            last = value;
        }
        MESSAGE("k = " << k << ", " << bounces << " bounces: " << 255 * (1 - last) << "/255 short of 1");
        if (k <= 0.9) CHECK(1 - last <= 1.0 / 255);
    }
}

TEST_CASE("case 49: in a white furnace nothing is seen") {
    HeadlessRenderer headless;
    Scene s;
    s.world.background = {1, 1, 1};
    s.materials = {mirror({1, 1, 1}, {1, 1, 1}, 0.6, 0.4)};
    addObject(s, "sphere", {1}, {0, 1, 0}), addObject(s, "box", {1, 1, 1, 0}, {1.8, 0.5, 0.3}), addObject(s, "plane", {0, 1, 0, 0});
    for (Object& o : s.objects) o.material = 0;
    s.render.reflections = 12;
    double worst = 0;
    for (const glm::vec3& c : headless.draw(s, cameraAt({1, 2, 5}, {0.5, 0.7, 0}), {160, 120})) worst = std::max(worst, std::fabs(static_cast<double>(c.x) - 1));
    MESSAGE("the picture differs from white by at most " << 255 * worst << "/255");
    CHECK(worst <= 1.0 / 255);
}

TEST_CASE("case 50: a reflectance out of its range is refused, and the strongest does not brighten") {
    for (const char* kr : {"-1", "1.5", "1.0000001", "nan", "inf"}) CHECK(firstFault(std::string("marchbox 1\nmaterial name:m Kr:") + kr + "\n").starts_with("2:20: 'Kr' is "));
    HeadlessRenderer headless;
    Scene s;
    s.world.background = {0.7, 0.7, 0.7};
    s.materials = {mirror({1, 1, 1}, {1, 1, 1}, 1, 0)};
    addObject(s, "sphere", {1}, {0, 1, 0}), addObject(s, "sphere", {1}, {2.1, 1, 0}), addObject(s, "plane", {0, 1, 0, 0});
    for (Object& o : s.objects) o.material = 0;
    for (const int bounces : {1, 4, 16}) {
        s.render.reflections = bounces;
        for (const glm::vec3& c : headless.draw(s, cameraAt({1, 2, 5}, {1, 0.7, 0}), {96, 72})) REQUIRE(c.x <= 0.7f);
    }
}
