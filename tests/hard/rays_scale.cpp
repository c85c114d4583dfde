// Cases 4, 5, 7, 13 and 16: near misses, silhouettes, far from the origin, thinner than a pixel, and bounds that are not
// distances.
#include "hard/oracle.h"

#include <tuple>

using namespace mb;
using namespace mb::hard;

namespace {

/// A ball, a box and a mirror over a checkered floor that is moved with them.
Scene stillLife(glm::dvec3 at) {
    Scene s;
    s.world.background = {0.2, 0.3, 0.5};
    s.materials.push_back({"m", {0.9, 0.8, 0.7}, {0.2, 0.1, 0.1}, Pattern::checker, 0.1, 0.6, 0.3, 0, 20});
    s.materials.push_back({"mirror", {0.5, 0.5, 0.6}, {0, 0, 0}, Pattern::none, 0.1, 0.3, 0.3, 0.5, 40});
    s.lights = {{"", at + glm::dvec3{3, 6, 4}, {1, 1, 1}, 1}};
    addObject(s, "plane", {0, 1, 0, 0}, at);
    addObject(s, "sphere", {1}, at + glm::dvec3{-1.2, 1, 0});
    addObject(s, "box", {1, 1, 1, 0.1}, at + glm::dvec3{1, 0.5, 0.5});
    for (Object& o : s.objects) o.material = 0;
    s.objects[1].material = 1;
    return s;
}

/// Mean of a picture of ones and noughts: the share that is covered.
double coverage(HeadlessRenderer& headless, const Scene& s, const Camera& camera, glm::ivec2 size) {
    double sum = 0;
    for (const glm::vec3& c : headless.draw(s, camera, size)) sum += static_cast<double>(c.x);
    return sum / (static_cast<double>(size.x) * size.y);
}

}  // namespace

TEST_CASE("case 4: a ray through a gap of 2 cm between two balls misses") {
    HeadlessRenderer headless;
    Scene s;
    for (const double x : {-1.01, 1.01}) addObject(s, "sphere", {1}, {x, 0, 0});
    Camera camera = cameraAt({0, 0, 5}, {0, 0, 0});
    camera.ortho = 2 * 0.009;
    for (const double eps : {1e-3, 5e-4, 1e-4, 1e-5}) {
        s.render.march_epsilon = eps;
        const Measured m = headless.measure(s, camera, {64, 64});
        MESSAGE("epsilon " << eps << " (close at " << 5 * eps << " m): " << m.counts.pixels.miss << " of 4096 miss, " << m.counts.pixels.undecided << " undecided");
        CHECK(m.counts.pixels.hit == 0);
        // At least 1 mm of room on either side: all miss where close is less than that.
        if (5 * eps < 1e-3) CHECK(m.counts.pixels.miss == 4096);
    }
}

TEST_CASE("case 5: a silhouette has no halo of hits, and what is painted of it is thinner than the tolerance") {
    HeadlessRenderer headless;
    Scene s;
    addObject(s, "sphere", {1});
    paint(s, plain({1, 1, 1}));
    const Camera camera = cameraAt({0.3, 0.4, 3}, {0, 0, 0});
    const glm::ivec2 size{320, 240};
    const double pixel = 2 * std::tan(glm::radians(camera.fov / 2)) / size.y, distance = glm::length(camera.eye);
    const double perimeter = 2 * kPi * (1 / std::sqrt(distance * distance - 1)) / pixel;  // of the outline, in pixels
    for (const double eps : {1e-2, 1e-3, 1e-4}) {
        s.render.march_epsilon = eps;
        const Measured m = headless.measure(s, camera, size);
        const auto picture = headless.draw(s, camera, size);
        const Truth truth = [](const DoubleRay& r) { return firstOf(sphereSpan(r, {}, 1), 200); };
        const Compared c = compare(m, camera, truth);
        std::size_t painted = 0;
        for (std::size_t i = 0; i < picture.size(); ++i)
            painted += picture[i].x > 0 && !truth(pixelRay(camera, size, static_cast<int>(i) % size.x, static_cast<int>(i) / size.x));
        const double allowed = perimeter * eps / pixel + 2;
        MESSAGE("epsilon " << eps << ": " << c.false_hits << " false hits, " << painted << " painted beside the ball, of " << allowed << " allowed; "
                           << c.undecided << " undecided");
        CHECK(c.false_hits == 0);
        CHECK(c.false_misses == 0);
        CHECK(static_cast<double>(painted) <= allowed);
        CHECK(c.worst_depth * distance <= distance * pixel);
    }
}

TEST_CASE("case 7: a scene far from the origin is the same picture") {
    HeadlessRenderer headless;
    const auto picture = [&](double x) {
        const glm::dvec3 at{x, 0, -x};
        return headless.draw(stillLife(at), cameraAt(at + glm::dvec3{0.3, 1.7, 6}, at + glm::dvec3{0, 0.8, 0}), {160, 120});
    };
    const auto near = picture(0);
    for (const double x : {1e2, 1e3, 1e4, 1e5, 1e6}) {
        const auto far = picture(x);
        double worst = 0;
        std::size_t other = 0;
        for (std::size_t i = 0; i < near.size(); ++i) {
            const glm::vec3 d = glm::abs(near[i] - far[i]);
            const double e = static_cast<double>(std::max({d.x, d.y, d.z}));
            worst = std::max(worst, e), other += e > 1.0 / 255;
        }
        MESSAGE(x << " m away: " << other << " pixels differ by more than 1/255, the worst by " << worst);
        CHECK(other == 0);
    }
}

TEST_CASE("case 7: a floor that stays at the origin is the same floor a thousand kilometres on") {
    HeadlessRenderer headless;
    Scene s;
    addObject(s, "plane", {0, 1, 0, 0});
    for (const double x : {0.0, 1e2, 1e3, 1e4, 1e5, 1e6}) {
        const Camera camera = cameraAt({x, 1.7, 6}, {x, 0.8, 0});
        const Compared c = compare(headless.measure(s, camera, {160, 120}), camera,
                                   [](const DoubleRay& r) { return firstOf(halfSpaceSpan(r, {0, 1, 0}, 0), 200); });
        MESSAGE(x << " m away: " << c.hits << " hits, " << c.lost << " lost, worst depth " << c.worst_depth);
        CHECK(c.false_hits + c.false_misses == 0);
        CHECK(c.lost <= c.pixels / 200);
        CHECK(c.worst_depth < 1e-3);
    }
}

TEST_CASE("case 13: what is thinner than a pixel covers, over 64 samples, what it covers") {
    HeadlessRenderer headless;
    constexpr double kTolerance = 0.2;  // of what it covers
    const glm::ivec2 size{64, 48};
    const double pixel = 2 * std::tan(glm::radians(30.0)) / 720 * 10;  // m, of a picture of 720 rows and 60 degrees, 10 m away
    Camera camera = cameraAt({0, 0, 10}, {0, 0, 0});
    camera.fov = 2 * glm::degrees(std::atan(pixel / 10 * size.y / 2));

    Scene wire;
    addObject(wire, "cylinder", {1e-3, 40, 0});
    wire.render.samples = 64;
    const double usual = wire.render.march_epsilon;  // close is 1 mm there, the wire's radius
    for (const auto& [tilt, epsilon, way] : {std::tuple{5.0, usual, Evaluation::straight}, {30.0, usual, Evaluation::straight}, {5.0, usual, Evaluation::grid},
                                             {30.0, usual, Evaluation::grid}, {30.0, 1e-5, Evaluation::straight}}) {
        headless.renderer->setEvaluation(way);
        wire.render.march_epsilon = epsilon;
        wire.objects[0].rot = {0, 0, tilt};
        paint(wire, plain({1, 1, 1}));
        const double seen = coverage(headless, wire, camera, size), wanted = 2e-3 / std::cos(glm::radians(tilt)) / (pixel * size.x);
        MESSAGE("a wire of 2 mm, tilted by " << tilt << ", epsilon " << epsilon << ": covers " << seen / wanted << " of what it should");
        CHECK(std::fabs(seen / wanted - 1) <= kTolerance);
        const auto picture = headless.draw(wire, camera, size);
        for (int y = 0; y < size.y; ++y) {
            float row = 0;
            for (int x = 0; x < size.x; ++x) row += picture[static_cast<std::size_t>(y * size.x + x)].x;
            CHECK(row > 0);  // no gap, of one row even
        }
    }

    Scene ring;
    addObject(ring, "torus", {1, 0.05});
    ring.objects[0].rot = {90, 0, 0};  // seen from its axis
    paint(ring, plain({1, 1, 1}));
    ring.render.samples = 16;
    const Camera wide = cameraAt({0, 0, 10}, {0, 0, 0}, 60);
    const double seen = coverage(headless, ring, wide, {160, 120});
    const double high = 2 * std::tan(glm::radians(30.0)) * 10, wanted = kPi * (1.05 * 1.05 - 0.95 * 0.95) / (high * high * 160 / 120);
    MESSAGE("a ring of 10 cm in pixels of " << high / 120 << " m: covers " << seen << ", wanted " << wanted);
    CHECK(std::fabs(seen / wanted - 1) <= kTolerance);
}

TEST_CASE("case 16: no shape is steeper than a distance, and a bound is drawn as what it bounds") {
    // A field steeper than 1 would be stepped through. None can be told to the program: every row of both tables is held to
    // a slope of 1 over pairs of points.
    Draw draw(161);
    double steepest = 0;
    int rows = 0;
    const auto hold = [&](const Scene& s) {
        const Tree tree = makeTree(s);
        ++rows;
        for (int i = 0; i < times(100'000 / 21); ++i) {
            const glm::dvec3 p{draw.uniform(-3, 3), draw.uniform(-3, 3), draw.uniform(-3, 3)};
            const glm::dvec3 q = p + draw.logUniform(1e-4, 1) * glm::normalize(glm::dvec3{draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)});
            steepest = std::max(steepest, std::fabs(distance<double>(tree, vec(p)) - distance<double>(tree, vec(q))) / glm::distance(p, q));
        }
    };
    for (const Primitive& row : primitives()) {
        Scene s;
        addObject(s, row.name, {});
        hold(s);
    }
    for (const Operator& op : operators()) {
        Scene s;
        const int o = addObject(s, op.name, {});
        for (int i = 0; i < std::min(op.max_children, 2); ++i) addObject(s, "box", {1, 1.6, 0.8, 0}, {0.3 * i, 0.2, 0}, o);
        hold(s);
    }
    MESSAGE("the steepest of " << rows << " rows rises by " << steepest << " a metre");
    CHECK(steepest <= 1 + 1e-6);

    HeadlessRenderer headless;
    const glm::dvec3 radii{1.2, 0.3, 0.6};
    Scene s;
    addObject(s, "ellipsoid", {radii.x, radii.y, radii.z});
    const Camera camera = cameraAt({2, 1, 3}, {0, 0, 0});
    const Compared c = compare(headless.measure(s, camera, {320, 240}), camera, [&](const DoubleRay& r) -> std::optional<Hit> {
        const double scale = glm::length(r.direction / radii);  // the unit ball's ray in the stretched space
        const auto hit = firstOf(sphereSpan({r.origin / radii, r.direction / radii / scale}, {}, 1), 1e9);
        return hit ? std::optional(Hit{hit->t / scale, {}}) : std::nullopt;
    });
    MESSAGE("ellipsoid: IoU " << c.iou() << ", worst depth " << c.worst_depth);
    CHECK(c.iou() >= 0.999);
    CHECK(c.false_hits + c.false_misses == 0);
}

TEST_CASE("case 16: a twisted box is drawn as the points that lie in the box once they are turned back") {
    HeadlessRenderer headless;
    constexpr double kTurns = 0.25, kStep = 2e-3;  // turns a metre; m along a ray
    const glm::dvec3 size{0.8, 1.6, 0.5};
    Scene s;
    const int twist = addObject(s, "twist", {kTurns});
    addObject(s, "box", {size.x, size.y, size.z, 0}, {}, twist);
    const auto inside = [&](glm::dvec3 p) {
        const double a = 2 * kPi * kTurns * p.y, c = std::cos(a), n = std::sin(a);
        const glm::dvec3 q = glm::abs(glm::dvec3{p.x * c - p.z * n, p.y, p.x * n + p.z * c});
        return q.x < size.x / 2 && q.y < size.y / 2 && q.z < size.z / 2;
    };
    // No distance: points along the ray, as far as a ball around the box goes, and halving where they change sides.
    const Truth truth = [&](const DoubleRay& r) -> std::optional<Hit> {
        const Span ball = sphereSpan(r, {}, glm::length(size) / 2);
        for (double t = ball.enter; !ball.empty() && t < ball.leave; t += kStep) {
            if (!inside(r.origin + t * r.direction)) continue;
            double lo = t - kStep, hi = t;
            for (int i = 0; i < 30; ++i) (inside(r.origin + (lo + hi) / 2 * r.direction) ? hi : lo) = (lo + hi) / 2;
            return Hit{hi, {}};
        }
        return std::nullopt;
    };
    const Camera camera = cameraAt({1.2, 0.9, 2}, {0, 0, 0});
    const Compared c = compare(headless.measure(s, camera, {160, 120}), camera, truth);
    MESSAGE("IoU " << c.iou() << " of " << c.hits << " hits, " << c.undecided << " undecided, worst depth " << c.worst_depth);
    CHECK(c.hits > 3000);
    CHECK(c.iou() >= 0.999);
}
