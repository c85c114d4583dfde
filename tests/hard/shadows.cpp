// Cases 38 to 45: what is lit and what is not, near and far from the light, and Phong's terms at their limits.
#include "hard/oracle.h"

#include "core/render/picture.h"

using namespace mb;
using namespace mb::hard;

namespace {

constexpr glm::ivec2 kSize{160, 120};

std::size_t index(int x, int y, glm::ivec2 size = kSize) { return static_cast<std::size_t>(y * size.x + x); }

/// Whether a ball stands between a point and a light.
bool behind(glm::dvec3 p, glm::dvec3 light, glm::dvec3 centre, double radius) {
    const double far = glm::distance(light, p);
    const Span s = sphereSpan({p, (light - p) / far}, centre, radius);
    return !s.empty() && s.leave > 0 && s.enter < far;
}

glm::dvec3 drawWay(Draw& draw) {
    return glm::normalize(glm::dvec3{draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)} + glm::dvec3{1e-3, 0, 0});
}

/// Calls `see(value, ray, point)` for every pixel whose ray hits, with the picture's red and the true point that `span` gives.
template <class SpanOf, class See>
void eachHit(HeadlessRenderer& headless, const Scene& s, const Camera& camera, glm::ivec2 size, SpanOf span, See see) {
    const Measured m = headless.measure(s, camera, size);
    const auto picture = headless.draw(s, camera, size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const DoubleRay r = pixelRay(camera, size, x, y);
            const std::size_t i = index(x, y, size);
            const Span found = span(r);
            if (m.channels.state[i] == 1 && !found.empty()) see(static_cast<double>(picture[i].x), r, r.origin + found.enter * r.direction);
        }
}

}  // namespace

TEST_CASE("case 38: a ball's lit side has no acne, whatever the epsilon and the light") {
    HeadlessRenderer headless;
    Draw draw(38);
    for (const double eps : {1e-2, 1e-3, 1e-4}) {
        Scene s;
        addObject(s, "sphere", {1});
        paint(s, diffuse());
        s.render.march_epsilon = eps;
        std::size_t faced = 0, dark = 0;
        for (int i = 0; i < times(8); ++i) {
            const glm::dvec3 light = draw.uniform(1.5, 20) * drawWay(draw);
            s.lights = {{"", light, {1, 1, 1}, 1}};
            const glm::dvec3 eye = 4.0 * glm::normalize(glm::normalize(light) + 0.8 * drawWay(draw));  // on the lit side
            eachHit(headless, s, cameraAt(eye, {0, 0, 0}), kSize, [](const DoubleRay& r) { return sphereSpan(r, {}, 1); },
                    [&](double value, const DoubleRay&, glm::dvec3 p) {
                        if (glm::dot(glm::normalize(p), glm::normalize(light - p)) < 0.01) return;
                        ++faced, dark += value == 0;
                    });
        }
        MESSAGE("epsilon " << eps << ": " << dark << " of " << faced << " lit points in a false shadow");
        CHECK(faced > 10'000);
        CHECK(static_cast<double>(dark) <= 1e-3 * static_cast<double>(faced));
    }
}

TEST_CASE("case 39: a ball's shadow starts at the ball") {
    HeadlessRenderer headless;
    const glm::dvec3 light{20, 20, 0};
    const Camera camera = cameraAt({-2, 5, 6}, {0, 0, 0}, 40);
    const glm::ivec2 size{320, 240};
    for (const double eps : {1e-4, 1e-3, 5e-3}) {
        Scene s;
        addObject(s, "plane", {0, 1, 0, 0});
        addObject(s, "sphere", {1}, {0, 1, 0});
        paint(s, diffuse());
        s.lights = {{"", light, {1, 1, 1}, 1}};
        s.render.march_epsilon = eps;
        const Measured m = headless.measure(s, camera, size);
        const auto picture = headless.draw(s, camera, size);
        std::size_t shadowed = 0, lit_in_shadow = 0, beyond = 0;
        double widest = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const std::size_t i = index(x, y, size);
                if (m.channels.state[i] != 1 || m.channels.object[i] != 0) continue;
                const DoubleRay r = pixelRay(camera, size, x, y);
                const double t = -r.origin.y / r.direction.y, bias = 2 * eps * t;
                const glm::dvec3 p = r.origin + t * r.direction;
                if (!behind(p, light, {0, 1, 0}, 1)) continue;
                ++shadowed;
                if (picture[i].x == 0) continue;
                ++lit_in_shadow;
                // How far inside the shadow: the nearest of some circles around it that leaves it.
                double inside = 0;
                for (double d = bias / 8; inside == 0; d += bias / 8)
                    for (int k = 0; k < 32; ++k)
                        if (!behind(p + d * glm::dvec3{std::cos(k * kPi / 16), 0, std::sin(k * kPi / 16)}, light, {0, 1, 0}, 1)) inside = d;
                widest = std::max(widest, inside / bias);
                beyond += inside > 2 * bias;
            }
        const double pixel = 2 * std::tan(glm::radians(30.0)) / 720, ring_per_way = 2 * eps * widest;
        MESSAGE("epsilon " << eps << ": " << lit_in_shadow << " of " << shadowed << " shadowed points lit, up to " << widest << " biases inside, "
                           << ring_per_way / pixel << " pixels of 720 rows");
        CHECK(shadowed > 1000);
        CHECK(beyond == 0);
        if (eps == 1e-4) CHECK(ring_per_way <= 2 * pixel);
    }
}

TEST_CASE("case 40: a light on a surface, in a solid and at the end of the floats") {
    HeadlessRenderer headless;
    Scene s;
    addObject(s, "plane", {0, 1, 0, 0});
    addObject(s, "sphere", {1}, {0, 1, 0});
    paint(s, {"m", {1, 1, 1}, {0, 0, 0}, Pattern::none, 0, 1, 0.5, 0, 8});
    const Camera camera = cameraAt({0, 3, 6}, {0, 1, 0});
    const auto brightest = [&](glm::dvec3 light) {
        s.lights = {{"", light, {1, 1, 1}, 1}};
        float most = 0;
        for (const glm::vec3& c : headless.draw(s, camera, kSize)) {
            REQUIRE(finite(c));
            most = std::max(most, c.x);
        }
        return most;
    };
    const DoubleRay middle = pixelRay(camera, kSize, 80, 100);
    const glm::dvec3 on_floor = middle.origin - middle.direction * (middle.origin.y / middle.direction.y);
    for (const double off : {0.0, 1e-20, 1e-7, 1e-3}) brightest(on_floor + glm::dvec3{0, off, 0});
    for (const double far : {1e9, 1e20, 1e30, 1e300}) brightest({0, far, far});
    CHECK(brightest({0, 1e9, 1e9}) > 0.9f);          // the furthest that a file may hold still lights
    CHECK(brightest({0, -1, 0}) == 0);               // under the floor

    // In the ball all is in its shadow; but from the far floor a ray so flat may run out of steps, which counts as lit and
    // as undecided.
    constexpr std::size_t kFew = 160 * 120 / 100;
    for (const glm::dvec3 light : {glm::dvec3{0, 1, 0}, glm::dvec3{0.5, 1.2, 0.3}}) {
        brightest(light);
        const auto undecided = headless.measure(s, camera, kSize).counts.undecided_rays.shadow;
        std::size_t lit = 0;
        for (const glm::vec3& c : headless.draw(s, camera, kSize)) lit += c.x > 0;
        MESSAGE("a light in the ball: " << lit << " of " << kSize.x * kSize.y << " pixels lit, " << undecided << " shadow rays undecided");
        CHECK(lit <= undecided);
        CHECK(lit <= kFew);
    }
    s.render.shadow_steps = 4096;
    CHECK(brightest({0, 1, 0}) == 0);
    CHECK(brightest({0.5, 1.2, 0.3}) == 0);
}

TEST_CASE("case 41: what stands beyond the light makes no shadow, what stands just before it does") {
    HeadlessRenderer headless;
    constexpr double kLight = 4;
    for (const double at : {1.01, 0.99}) {
        Scene s;
        addObject(s, "plane", {0, 1, 0, 0});
        addObject(s, "box", {30, 0.02, 30, 0}, {0, kLight * at + (at > 1 ? 0.01 : -0.01), 0});  // its near side at `at`
        paint(s, diffuse());
        s.lights = {{"", {0, kLight, 0}, {1, 1, 1}, 1}};
        std::size_t lit = 0, seen = 0;
        eachHit(headless, s, cameraAt({0, 2, 3}, {0, 0, -1}), kSize, [](const DoubleRay& r) { return halfSpaceSpan(r, {0, 1, 0}, 0); },
                [&](double value, const DoubleRay&, glm::dvec3 p) {
                    if (p.y > 1e-6 || glm::length(p) > 10) return;
                    ++seen, lit += value > 0;
                });
        MESSAGE("a wall at " << at << " of the light's distance: " << lit << " of " << seen << " points lit");
        CHECK(seen > 5000);
        CHECK(lit == (at > 1 ? seen : 0));
    }
}

TEST_CASE("case 42: at the terminator the light fades evenly") {
    HeadlessRenderer headless;
    constexpr double kStep = 2.0 / 255, kNormal = 1e-3;  // a quarter of 1/255: the normal's own error, in radians
    Scene s;
    addObject(s, "sphere", {1});
    paint(s, diffuse());
    s.lights = {{"", {1000, 0, 0}, {1, 1, 1}, 1}};
    Camera camera = cameraAt({0, 0, 4}, {0, 0, 0});  // the terminator in the middle of the view
    camera.ortho = 0.002;
    const glm::ivec2 size{160, 16};
    std::size_t speckles = 0, lit_behind = 0, near = 0;
    double last = 0, last_facing = -1, backwards = 0;
    eachHit(headless, s, camera, size, [](const DoubleRay& r) { return sphereSpan(r, {}, 1); },
            [&](double value, const DoubleRay&, glm::dvec3 p) {
                const double facing = glm::dot(p, glm::normalize(s.lights[0].pos - p));
                if (std::fabs(facing) < 0.01) ++near;
                speckles += std::fabs(value - std::max(facing, 0.0)) > kStep;
                lit_behind += facing < -kNormal && value > 0;
                const bool same_row = facing > last_facing;
                if (same_row) backwards = std::max(backwards, last - value), speckles += last_facing > -1 && std::fabs(value - last) > kStep;
                last = value, last_facing = facing;
            });
    MESSAGE(near << " points within 0.01 of the terminator: " << speckles << " off Lambert's law or their neighbour by 2/255; at most "
                 << backwards << " darker than the neighbour that faces the light less");
    CHECK(near > 1000);
    CHECK(speckles == 0);
    CHECK(backwards <= kNormal);
    CHECK(lit_behind == 0);
}

TEST_CASE("case 43: there are hard shadows only: a point has all of the light or none") {
    HeadlessRenderer headless;
    Scene s;
    addObject(s, "plane", {0, 1, 0, 0});
    addObject(s, "sphere", {0.7}, {0, 1.1, 0});
    paint(s, diffuse());
    s.lights = {{"", {3, 6, 2}, {1, 1, 1}, 1}};
    std::size_t seen = 0, neither = 0, other = 0;
    eachHit(headless, s, cameraAt({0, 6, 5}, {0, 0, 0}), kSize, [](const DoubleRay& r) {
                const Span ball = sphereSpan(r, {0, 1.1, 0}, 0.7);
                return ball.empty() ? halfSpaceSpan(r, {0, 1, 0}, 0) : Span{};
            },
            [&](double value, const DoubleRay&, glm::dvec3 p) {
                const double full = glm::normalize(s.lights[0].pos - p).y, share = value / full;
                ++seen;
                neither += share > 1e-3 && std::fabs(share - 1) > 1e-3;
                other += (share > 0.5) == behind(p, s.lights[0].pos, {0, 1.1, 0}, 0.7);
            });
    MESSAGE(seen << " points: " << neither << " partly lit, " << other << " other than geometry says");
    CHECK(seen > 5000);
    CHECK(neither == 0);
    CHECK(static_cast<double>(other) <= 1e-3 * static_cast<double>(seen));
}

TEST_CASE("case 44: a highlight's exponent from 0 to 10,000, and none behind the surface") {
    for (const char* c : {"-1", "nan", "1e5"}) CHECK(firstFault(std::string("marchbox 1\nmaterial name:m C:") + c + "\n").starts_with("2:"));
    HeadlessRenderer headless;
    for (const double c : {0.0, 1.0, 1e4}) {
        Scene s;
        addObject(s, "sphere", {1});
        paint(s, {"m", {1, 1, 1}, {0, 0, 0}, Pattern::none, 0, 0, 1, 0, c});  // the highlight alone
        s.lights = {{"", {3, 4, 5}, {1, 1, 1}, 1}};
        std::size_t behind_it = 0, off = 0, compared = 0;
        eachHit(headless, s, cameraAt({-1, 0.5, 3.5}, {0, 0, 0}), kSize, [](const DoubleRay& r) { return sphereSpan(r, {}, 1); },
                [&](double value, const DoubleRay& r, glm::dvec3 p) {
                    const glm::dvec3 l = glm::normalize(s.lights[0].pos - p);
                    const double facing = glm::dot(p, l), mirrored = glm::dot(glm::reflect(-l, p), -r.direction);
                    behind_it += (facing < -1e-3 || mirrored < -1e-3) && value != 0;
                    if (facing < 1e-3 || mirrored < 1e-3) return;
                    ++compared;
                    // The normal is off by up to 1e-4: times the exponent, of the value.
                    off += std::fabs(value - std::pow(mirrored, c)) > 2e-3 + 2e-4 * c * std::pow(mirrored, c);
                });
        MESSAGE("exponent " << c << ": " << off << " of " << compared << " differ from the double's, " << behind_it << " highlights behind the surface");
        CHECK(compared > 1000);
        CHECK(behind_it == 0);
        CHECK(off == 0);
    }
}

TEST_CASE("case 45: colours lie below the sum of the lights, and brighten with each of them") {
    HeadlessRenderer headless;
    Scene s;
    addObject(s, "sphere", {1});
    paint(s, {"white", {1, 1, 1}, {0, 0, 0}, Pattern::none, 1, 1, 1, 0, 4});
    Draw draw(45);
    for (int i = 0; i < 8; ++i) s.lights.push_back({"", 5.0 * drawWay(draw) + glm::dvec3{0, 0, 5}, {1, 1, 1}, 1});
    const Camera camera = cameraAt({0, 0, 4}, {0, 0, 0});
    const auto before = headless.draw(s, camera, kSize);
    for (const glm::vec3& c : before) {
        REQUIRE(c.x >= 0);
        REQUIRE(c.x <= 1 + 8 * 2 + 1e-4f);  // ambient, and each light's diffuse and specular at most
    }
    const std::vector<std::uint8_t> shown = encodeSrgb(before);
    for (std::size_t i = 0; i < before.size(); ++i) CHECK((before[i].x < 1 || shown[3 * i] == 255));
    for (std::size_t k = 0; k < 8; ++k) {
        Scene brighter = s;
        brighter.lights[k].intensity = 1.5;
        const auto after = headless.draw(brighter, camera, kSize);
        std::size_t darker = 0, changed = 0;
        for (std::size_t i = 0; i < after.size(); ++i) darker += after[i].x < before[i].x, changed += after[i].x != before[i].x;
        CHECK(darker == 0);
        CHECK(changed > 0);
    }
}
