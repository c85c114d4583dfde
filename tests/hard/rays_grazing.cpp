// Cases 1 to 3 and 6: flat rays, the driver's loop limit, thin walls, and tolerances near the grid of floats.
#include "hard/oracle.h"

#include "core/effects/plan.h"
#include "core/sdf/tree.h"

using namespace mb;
using namespace mb::hard;

namespace {

Scene floorScene() {
    Scene s;
    addObject(s, "plane", {0, 1, 0, 0});
    return s;
}

/// The same surface, of which no span tells where it is met.
Scene swollenFloor() {
    Scene s;
    const int round = addObject(s, "round", {0.25});
    addObject(s, "plane", {0, 1, 0, -0.25}, {}, round);
    return s;
}

/// Evaluations that unrelaxed sphere tracing needs from height h down to eps, at an angle with this sine.
double plainSteps(double eps, double h, double sine) { return std::log(eps / h) / std::log(1 - sine); }

/// Sphere tracing with no relaxation, in double: steps of the distance, of `close` of the way where that is more, to the
/// first change of sign.
std::optional<Hit> plainMarch(const Tree& tree, const DoubleRay& ray, double close, double far) {
    const auto at = [&](double t) { return distance<double>(tree, vec(ray.origin + t * ray.direction)); };
    for (double t = 0; t < far;) {
        const double step = std::max(at(t), close * t);
        if (at(t + step) < 0) return Hit{t + step, {}};
        t += step;
    }
    return std::nullopt;
}

}  // namespace

TEST_CASE("case 1: a grazing plane is met, and what runs out of steps is flagged") {
    HeadlessRenderer headless;
    // The march steps up to twice as far as the sphere (its slope is known), so it needs about half of N down to where it
    // is close, and then 1/sin a steps of that length; never more than N and a bracket's few.
    constexpr int kBracket = 6;
    for (const bool swollen : {false, true})
        for (const double degrees : {10.0, 5.0, 2.0, 1.0, 0.5, 0.1}) {
            CAPTURE(swollen);
            CAPTURE(degrees);
            Scene s = swollen ? swollenFloor() : floorScene();
            s.render.march_steps = 8192, s.render.max_distance = 1000;
            const double a = glm::radians(degrees), n = plainSteps(1e-4, 1, std::sin(a));
            const OneRay ray = shoot(headless, s, {0, 1, 0}, {std::cos(a), -std::sin(a), 0});
            MESSAGE(std::string(swollen ? "without a span, " : "") << degrees << " degrees: " << ray.steps << " evaluations, plain sphere tracing " << std::lround(n) << "; t off by "
                            << std::fabs(ray.t * std::sin(a) - 1) << " of it");
            CHECK(ray.state == 1);
            CHECK(ray.t * std::sin(a) == doctest::Approx(1).epsilon(1e-3));
            CHECK(ray.steps <= n + kBracket);

            // A second try has twice the budget.
            s.render.march_steps = std::max(static_cast<int>(ray.steps / 4), 1);
            if (swollen) CHECK(shoot(headless, s, {0, 1, 0}, {std::cos(a), -std::sin(a), 0}).state == 2);
        }
}

TEST_CASE("case 1: no pixel of a floor within reach is sky, whatever the budget") {
    HeadlessRenderer headless;
    const Camera camera = cameraAt({0, 1, 0}, {0, 0.9, -1}, 60);
    for (const bool swollen : {false, true})
        for (const int budget : {16, 64, 512}) {
            Scene s = swollen ? swollenFloor() : floorScene();
            s.render.march_steps = budget;
            const Compared c = compare(headless.measure(s, camera, {160, 120}), camera,
                                       [](const DoubleRay& r) { return firstOf(halfSpaceSpan(r, {0, 1, 0}, 0), 200); });
            MESSAGE(std::string(swollen ? "without a span, " : "") << budget << " steps: " << c.hits << " hits, " << c.undecided << " undecided, worst depth " << c.worst_depth);
            CHECK(c.false_misses == 0);
            CHECK(c.false_hits == 0);
            if (budget == 512) CHECK(c.undecided <= c.pixels / 200);
            if (budget == 16) CHECK((c.undecided > 0) == swollen);
        }
}

TEST_CASE("case 2: the driver's loop limit is above what any pass is planned to take") {
    HeadlessRenderer headless;
    // A canary: how far a loop of 70,000 gets on this driver.
    const Texts texts{{"canary", "#version 330 core\nlayout(location = 0) out vec4 count;\nvoid main() {\n    float n = 0.0;\n"
                                 "    for (int i = 0; i < 70000; ++i) n += 1.0;\n    count = vec4(n * (gl_FragCoord.x > 0.0 ? 1.0 : 2.0));\n}\n"}};
    const Program program = makeProgram(resolve(texts, "canary"));
    REQUIRE_MESSAGE(program.usable(), program.log);
    const Targets target({1, 1}, 1);
    target.clear();
    glUseProgram(program.name);
    Quad().draw();
    const float reached = target.read(0)[0];
    MESSAGE("a loop of 70000 makes " << reached << " turns; a pass is planned to make at most " << kLoopBudget);
    CHECK(reached > static_cast<float>(kLoopBudget));
}

TEST_CASE("case 2: many primitives leave a flat ray where it is") {
    HeadlessRenderer headless;
    const double a = glm::radians(2.0);
    std::vector<int> counts{16, 128, 256, 1024, 4096};
    if (times(1) > 1) counts.push_back(512);  // its shader takes some ten seconds to compile
    for (const int n : counts) {
        CAPTURE(n);
        Scene s = floorScene();
        for (int i = 0; i < n; ++i) addObject(s, "sphere", {0.1}, {-5.0 - i % 64, 0.5 + i / 64, 3.0 * (i % 5)});
        Measured m;
        REQUIRE(headless.renderer->measure(s, cameraAt({0, 1, 0}, {std::cos(a), 1 - std::sin(a), 0}), {1, 1}, m) == "");
        MESSAGE(n << " primitives: t " << m.channels.depth[0] << ", at most " << headless.renderer->plan().loop_iterations << " loop turns");
        CHECK(m.channels.state[0] == 1);
        CHECK(static_cast<double>(m.channels.depth[0]) == doctest::Approx(28.6537).epsilon(1e-3 / 28.6537));
        CHECK(headless.renderer->plan().loop_iterations < kLoopLimit);
    }
}

TEST_CASE("case 3: relaxed steps do not pass through a thin wall") {
    HeadlessRenderer headless;
    // There is no omega to set: the march's own steps, up to twice the sphere, against plain ones with the same tolerance.
    // The ball is hollow and cut open, so that rays meet the wall from without, from within, and at its rim.
    constexpr double kWall = 0.02, kCut = 0.3;
    Scene s;
    const int open = addObject(s, "subtract", {});
    addObject(s, "sphere", {1}, {}, open);
    addObject(s, "sphere", {1 - kWall}, {}, open);
    addObject(s, "plane", {0, 0, -1, -kCut}, {}, open);
    const Tree tree = makeTree(s);
    const Truth closed_form = [](const DoubleRay& r) {
        const Inside shell = less(insideOf(sphereSpan(r, {}, 1)), insideOf(sphereSpan(r, {}, 1 - kWall)));
        return firstAhead(less(shell, insideOf(halfSpaceSpan(r, {0, 0, -1}, -kCut))), 200);
    };
    const Truth plain_steps = [&](const DoubleRay& r) { return plainMarch(tree, r, 1e-6, 200); };
    for (const glm::dvec3 eye : {glm::dvec3{0.3, 0.4, 4}, glm::dvec3{1.5, 1, 2}, glm::dvec3{0.5, -0.2, -3}, glm::dvec3{0.1, 0.2, 0.1}}) {
        const Camera camera = cameraAt(eye, {0, 0, -0.2});
        const Measured m = headless.measure(s, camera, {320, 240});
        const Compared c = compare(m, camera, plain_steps), exact = compare(m, camera, closed_form);
        MESSAGE("IoU of the first surface " << c.iou() << " with plain steps, " << exact.iou() << " with the closed form: " << c.hits << " hits, "
                                            << c.undecided << " undecided, " << c.deep << " of a surface behind");
        CHECK(c.hits > 5000);
        CHECK(c.iou() >= 0.9999);
        CHECK(exact.false_misses + exact.false_hits == 0);
        CHECK(exact.iou() >= 0.9998);  // a ray through less of the rim than the tolerance is undecided, or meets what is behind
    }
}

TEST_CASE("case 3: no ray through a sheet, however thin, is said to miss it") {
    HeadlessRenderer headless;
    for (const double thick : {1e-6, 1e-5, 1e-4, 1e-3}) {
        Scene s;
        addObject(s, "box", {4, thick, 4, 0});
        const Measured m = headless.measure(s, cameraAt({0, 3, 0.1}, {0, 0, 0}, 20), {64, 48});
        MESSAGE("a sheet of " << thick << " m, 3 m away: " << m.counts.pixels.miss << " of 3072 rays miss, " << m.counts.pixels.undecided << " are undecided");
        CHECK(m.counts.pixels.miss == 0);
    }
}

TEST_CASE("case 6: an epsilon near the grid of floats still converges, and none below it can be set") {
    HeadlessRenderer headless;
    Scene s = floorScene();
    addObject(s, "sphere", {1}, {-1.2, 1, 0});
    addObject(s, "sphere", {0.7}, {1.1, 0.7, 0.5});
    s.render.max_distance = 60, s.render.march_steps = 1024;
    const Camera camera = cameraAt({0, 1.5, 6}, {0, 0.8, 0}, 60);
    const Truth truth = [](const DoubleRay& r) {
        return firstAhead(joined(insideOf(halfSpaceSpan(r, {0, 1, 0}, 0)),
                                 joined(insideOf(sphereSpan(r, {-1.2, 1, 0}, 1)), insideOf(sphereSpan(r, {1.1, 0.7, 0.5}, 0.7)))), 60);
    };
    for (const double eps : {1e-5, 1e-6}) {
        s.render.march_epsilon = eps;
        const Measured m = headless.measure(s, camera, {320, 240});
        const Compared c = compare(m, camera, truth);
        std::size_t exhausted = 0;
        for (std::size_t i = 0; i < c.pixels; ++i) exhausted += m.channels.state[i] == 2 && m.channels.steps[i] >= 1024;
        MESSAGE("epsilon " << eps << ": " << exhausted << " pixels ran out of 1024 steps, " << c.undecided << " undecided, IoU " << c.iou());
        CHECK(exhausted == 0);
        CHECK(c.false_hits + c.false_misses == 0);
        CHECK(c.iou() >= 0.9995);
    }
    CHECK(setKnob(s, "march_epsilon=1e-7").has_value());
    CHECK(!setKnob(s, "march_epsilon=1e-6").has_value());
}
