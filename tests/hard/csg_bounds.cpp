// Cases 19 to 23: what cut and joined distances are and are not: slopes, lower bounds, wedges, insides and rims.
#include "hard/oracle.h"

#include "core/sdf/raycast.h"
#include "physics/world.h"
#include "sdf/random_scene.h"

using namespace mb;
using namespace mb::hard;

namespace {

glm::dvec3 drawPoint(Draw& draw, double reach) { return {draw.uniform(-reach, reach), draw.uniform(-reach, reach), draw.uniform(-reach, reach)}; }
glm::dvec3 drawWay(Draw& draw) {
    for (;;)
        if (const glm::dvec3 v = drawPoint(draw, 1); glm::length(v) > 0.1 && glm::length(v) < 1) return glm::normalize(v);
}
double at(const Tree& tree, glm::dvec3 p) { return distance<double>(tree, vec(p)); }

/// Two unit balls at ±0.9 along x, intersected: a lens whose rim is the circle of radius kRim in the plane x = 0.
constexpr double kHalf = 0.9;
const double kRim = std::sqrt(1 - kHalf * kHalf);
Scene lens() {
    Scene s;
    const int o = addObject(s, "intersect", {});
    for (const double x : {-kHalf, kHalf}) addObject(s, "sphere", {1}, {x, 0, 0}, o);
    return s;
}
/// The lens's true distance outside: to the nearer cap, or to the rim where the foot on the cap is not on the lens.
double lensDistance(glm::dvec3 p) {
    const glm::dvec3 centre{p.x > 0 ? -kHalf : kHalf, 0, 0};
    const glm::dvec3 foot = centre + glm::normalize(p - centre);
    if (p.x > 0 ? foot.x >= 0 : foot.x <= 0) return glm::distance(p, centre) - 1;
    return std::hypot(std::hypot(p.y, p.z) - kRim, p.x);
}

}  // namespace

TEST_CASE("case 19: random trees are no steeper than 1") {
    Draw draw(19);
    double steepest = 0, steepest_float = 0;
    for (int i = 0; i < times(1000); ++i) {
        Scene s;
        addRandom(s, draw, {.levels = 2 + draw.below(7), .children = 3});
        const Tree tree = makeTree(s);
        for (int j = 0; j < 100; ++j) {
            const glm::dvec3 p = drawPoint(draw, 3), q = p + draw.logUniform(1e-6, 3) * drawWay(draw);
            steepest = std::max(steepest, std::fabs(at(tree, p) - at(tree, q)) / glm::distance(p, q));
            // In floats over at least 10 cm, or the rounding of some 10 m alone would count: 32 ulps, of 1e-6.
            const glm::dvec3 far = p + draw.uniform(0.1, 3) * drawWay(draw);
            const auto in_float = [&](glm::dvec3 r) {
                return distance<float>(tree, {static_cast<float>(r.x), static_cast<float>(r.y), static_cast<float>(r.z)});
            };
            steepest_float = std::max(steepest_float, std::fabs(static_cast<double>(in_float(p)) - static_cast<double>(in_float(far))) / glm::distance(p, far));
        }
    }
    MESSAGE("the steepest of " << times(1000) << " trees rises by " << steepest << " a metre, in floats by " << steepest_float);
    CHECK(steepest <= 1 + 1e-4);
    CHECK(steepest_float <= 1 + 2e-3);
    CHECK(steepest > 0.99);
}

TEST_CASE("case 20: the lens's value is a lower bound, by the stated ratios") {
    const Tree tree = makeTree(lens());
    for (const auto& [y, ratio] : {std::pair{0.5, 0.46}, std::pair{1.0, 0.61}, std::pair{5.0, 0.89}}) {
        const double f = at(tree, {0, y, 0}), d = lensDistance({0, y, 0});
        MESSAGE("y = " << y << ": value " << f << ", distance " << d << ", ratio " << f / d);
        CHECK(std::fabs(f / d - ratio) < 6e-3);
    }
    Draw draw(20);
    for (int i = 0; i < times(100'000); ++i) {
        const glm::dvec3 p = drawPoint(draw, 3);
        const double f = at(tree, p);
        if (f <= 0) continue;
        REQUIRE(f <= lensDistance(p) + 1e-6);
    }
}

TEST_CASE("case 20: random trees never say more than the distance to their surface") {
    Draw draw(201);
    double excess = -1e9, nearest_share = 0;
    for (int i = 0; i < times(60); ++i) {
        Scene s;
        addRandom(s, draw, {.levels = 4});
        const Tree tree = makeTree(s);
        std::vector<glm::dvec3> surface;
        for (int ray = 0; ray < 400; ++ray) {
            const glm::dvec3 from = 8.0 * drawWay(draw), to = drawPoint(draw, 1.5);
            const RayEnd end = raycast(tree, from, to - from, 100);
            if (end.state == RayState::hit) surface.push_back(from + end.t * glm::normalize(to - from));
        }
        for (int j = 0; j < 200 && !surface.empty(); ++j) {
            const glm::dvec3 p = drawPoint(draw, 3);
            double nearest = 1e9;
            for (const glm::dvec3& q : surface) nearest = std::min(nearest, glm::distance(p, q));
            const double f = at(tree, p);
            excess = std::max(excess, f - nearest), nearest_share = std::max(nearest_share, f / nearest);
        }
    }
    MESSAGE("at most " << excess << " m more than the distance to a point of the surface; at most " << nearest_share << " of it");
    CHECK(excess <= 1e-6);
    CHECK(nearest_share > 0.9);  // the points of the surface are near enough to tell
}

TEST_CASE("case 21: on a wedge's bisector the value is sin(A/2) of the distance, and a ray along it arrives or is flagged") {
    HeadlessRenderer headless;
    for (const double degrees : {90.0, 30.0, 10.0, 1.0}) {
        CAPTURE(degrees);
        const double half = glm::radians(degrees / 2), sine = std::sin(half);
        Scene s;  // the solid lies where x < 0, its edge along z, its faces at ±half of the −x axis
        const int o = addObject(s, "intersect", {});
        for (const double side : {1.0, -1.0}) addObject(s, "plane", {sine, side * std::cos(half), 0, 0}, {}, o);
        const Tree tree = makeTree(s);
        for (const double x : {0.1, 1.0, 7.0}) CHECK(std::fabs(at(tree, {x, 0, 0}) / x - sine) <= 1e-6);

        s.render.march_steps = 4096;
        const OneRay ray = shoot(headless, s, {1, 0, 0}, {-1, 0, 0});
        const double plain = std::log(1e-4) / std::log(1 - sine);
        MESSAGE(degrees << " degrees: " << ray.steps << " evaluations, plain sphere tracing " << std::lround(plain) << "; state " << ray.state << ", t " << ray.t);
        CHECK(ray.steps <= plain + 6);  // the bracket's few
        CHECK(ray.state != 0);
        if (ray.state == 1) CHECK(std::fabs(ray.t - 1) <= 1e-3);
        s.render.march_steps = 5;
        CHECK(shoot(headless, s, {1, 0, 0}, {-1, 0, 0}).state != 0);
    }
}

TEST_CASE("case 22: inside a union the value is no depth, but the way out is found") {
    Scene s;
    for (const double x : {-0.5, 0.5}) addObject(s, "sphere", {1}, {x, 0, 0});
    CHECK(at(makeTree(s), {0, 0, 0}) == -0.5);  // the surface is 0.866 away
    std::vector<std::string> notes;
    const StaticField field(s, [](std::size_t) { return true; }, notes);
    constexpr double kRadius = 0.1;
    Draw draw(22);
    int most = 0;
    for (int i = 0; i < times(200); ++i) {
        glm::dvec3 centre = i == 0 ? glm::dvec3{0, 0, 0} : drawPoint(draw, 0.8);
        int pushes = 0;
        std::vector<Touch> touches;
        for (; pushes < 20; ++pushes) {
            touches.clear();
            field.touches(centre, kRadius, 0.05, touches);
            if (touches.empty() || touches[0].gap >= -1e-6) break;
            centre = touches[0].point + kRadius * touches[0].normal;
        }
        most = std::max(most, pushes);
        CHECK(at(makeTree(s), centre) >= kRadius - 1e-4);
    }
    MESSAGE("out of the union in at most " << most << " pushes");
    CHECK(most <= 8);
}

TEST_CASE("case 23: a ball on the rim of a lens rests on it, not above it") {
    for (const double radius : {0.01, 0.05, 0.1, 0.2, 0.5}) {
        CAPTURE(radius);
        Scene s = lens();
        s.world.restitution = 0, s.world.friction = 0.5;
        addObject(s, "sphere", {radius}, {0, kRim + radius + 0.02, 0});
        s.objects.back().mass = 1;
        PhysicsWorld world(s);
        while (world.time_s() < 1) world.step();
        REQUIRE(world.bodies().size() == 1);
        world.writeTo(s);
        const double gap = s.objects.back().pos.y - kRim - radius;
        MESSAGE("radius " << radius << ": rests " << gap << " m above the rim; where the value is the radius it would be "
                          << std::sqrt((1 + radius) * (1 + radius) - kHalf * kHalf) - kRim - radius);
        CHECK(std::fabs(s.objects.back().pos.x) < 1e-6);  // balanced on it
        CHECK(std::fabs(gap) <= std::max(1e-3, 0.02 * radius));
    }
}
