// Motions against their closed forms, and sweeps of motions.
#include "physics/motion_sweep.h"
#include "scenes.h"
#include "sdf/draw.h"

#include <fmt/format.h>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

using namespace mb;

namespace {

Scene onPlane(double height = 0) {
    Scene s;
    s.objects.clear();
    addObject(s, "plane", {0, 1, 0, height});
    return s;
}
Object& ball(Scene& s, double radius, glm::dvec3 pos, glm::dvec3 vel = {}, glm::dvec3 spin = {}) {
    Object& o = s.objects[static_cast<std::size_t>(addObject(s, "sphere", {radius}, pos))];
    o.mass = 1, o.vel = vel, o.spin = spin;
    return o;
}
Track tracked(const Scene& scene, double seconds, double every_s) {
    Tracker tracker(scene, seconds, every_s);
    while (tracker.step()) {}
    return tracker.track();
}
/// The greatest distance of any body at any moment from where another track has it.
double apart(const Track& a, const Track& b) {
    double worst = 0;
    REQUIRE(a.places.size() == b.places.size());
    REQUIRE(a.bodies == b.bodies);
    for (std::size_t m = 0; m < a.places.size(); ++m)
        for (std::size_t i = 0; i < a.places[m].size(); ++i) {
            const double d = glm::length(a.places[m][i] - b.places[m][i]);
            worst = std::isnan(d) ? d : std::max(worst, d);
        }
    return worst;
}
/// The scene with steps so short that what is left of their error is small.
Scene finely(Scene scene, double dt = 1e-5) {
    scene.physics.dt = dt, scene.physics.sleep_speed = 0;
    return scene;
}
Scene bowlWith(double offset) {
    Scene s;
    const int cut = addObject(s, "subtract", {0});
    addObject(s, "box", {4, 2, 4, 0}, {0, -1, 0}, cut);
    addObject(s, "sphere", {1}, {0, 0.3, 0}, cut);
    ball(s, 0.1, {offset, 0.3 - std::sqrt(0.9 * 0.9 - offset * offset), 0});  // touching: what falls the last bit first lands by a step too early or late
    s.world.restitution = 0;
    return s;
}

}  // namespace

TEST_CASE("closed motion: the world in very short steps follows it") {
    const double seconds = 1.6, every_s = 1.0 / 60;
    struct Case {
        std::string name;
        Scene scene;
    };
    std::vector<Case> cases;
    {
        Scene s = onPlane(0.2);
        s.world.restitution = 0.7;
        ball(s, 0.15, {0.3, 1.4, -0.2});
        cases.push_back({"dropped", s});
    }
    {
        Scene s = onPlane();
        s.world.restitution = 0.8, s.world.friction = 0.3;
        ball(s, 0.2, {-1, 1.2, 0}, {1.5, 0.5, -0.7}, {5, -3, 20});
        cases.push_back({"thrown with spin: it slides, then sticks", s});
    }
    {
        Scene s = onPlane();
        s.world.restitution = 0.85, s.world.friction = 0.9;
        ball(s, 0.1, {0, 0.8, 0}, {0.4, 0, 0.1}, {0, 7, -30});
        cases.push_back({"it sticks at once", s});
    }
    {
        Scene s = onPlane();
        s.world.restitution = 0.75;
        ball(s, 0.1, {-8, 1.0, 0});
        ball(s, 0.2, {0, 1.5, 8}, {0.2, 1, 0}, {1, 2, 3}).restitution = 0.9;
        ball(s, 0.15, {8, 0.7, 0}, {0, 0, -0.5}).friction = 0;
        cases.push_back({"three, apart", s});
    }
    {
        Scene s = onPlane();
        s.world.gravity = 0, s.world.restitution = 0.5;
        ball(s, 0.1, {0, 1, 0}, {0.3, -1.1, 0.2}, {0, 0, 9});
        cases.push_back({"no gravity", s});
    }
    {
        Scene s;
        ball(s, 0.1, {0, 1, 0}, {0.3, 2, 0.2});
        cases.push_back({"nothing there", s});
    }
    for (const Case& c : cases) {
        CAPTURE(c.name);
        const std::optional<Track> closed = closedTrack(c.scene, seconds, every_s);
        REQUIRE(closed);
        const double far = apart(tracked(finely(c.scene), seconds, every_s), *closed), near = apart(tracked(finely(c.scene, 1e-4), seconds, every_s), *closed);
        const Track fine = tracked(finely(c.scene), seconds, every_s);
        double energy = 0;
        for (std::size_t m = 0; m < fine.energy.size(); ++m) energy = std::max(energy, std::fabs(fine.energy[m] - closed->energy[m]));
        MESSAGE(c.name << ": " << near << " m off in steps of 1e-4 s, " << far << " in steps of 1e-5, energy " << energy << " J");
        // The world flies and bounces by the same closed forms, its impacts found to rounding; the places of a moment between two steps are
        // taken from the line between these, g·dt²/8 below the parabola.
        CHECK(near < 2e-8);
        CHECK(far < 1e-9);
        CHECK(energy < 1e-8);
        CHECK(closed->deepest == 0);
        CHECK(closed->places.size() == static_cast<std::size_t>(std::llround(seconds / every_s)) + 1);
        CHECK(glm::length(closed->places[0][0] - c.scene.objects[c.scene.objects.size() - closed->bodies.size()].pos) < 1e-12);
    }
}

TEST_CASE("closed motion: it refuses what it does not know") {
    const auto refuses = [](const Scene& s, double seconds = 1.5) { return !closedTrack(s, seconds, 1.0 / 60); };
    Scene plain = onPlane();
    plain.world.restitution = 0.8;
    ball(plain, 0.2, {0, 1, 0});
    CHECK(!refuses(plain));
    CHECK(refuses(onPlane()));  // no body
    Scene s = plain;
    ball(s, 0.2, {0, 2, 0});  // falls onto the first
    CHECK(refuses(s));
    s = plain;
    ball(s, 0.2, {3, 1, 0}, {-4, 0, 0});  // meets it from the side
    CHECK(refuses(s));
    s = plain, s.objects[0].numbers[0] = 0.1;  // a slope
    CHECK(refuses(s));
    s = plain, s.objects[0].rot.z = 10;
    CHECK(refuses(s));
    s = plain, s.world.restitution = 0.1;  // comes to rest
    CHECK(refuses(s));
    s = plain;
    addObject(s, "box", {1, 1, 1, 0}, {5, 0, 0});
    CHECK(refuses(s));
    s.objects.back().hidden = true;
    CHECK(!refuses(s));
    s = plain, s.objects[1].pos.y = 0.2;  // lies on it
    CHECK(refuses(s));
    s = plain, s.objects[1].pos.y = 0.05;  // in it
    CHECK(refuses(s));
    s = plain, s.world.gravity = -9.81;
    CHECK(refuses(s));
    s = plain, s.world.bounds = 2, s.objects[1].vel.x = 5;  // leaves the world
    CHECK(refuses(s));
    s = plain, s.objects[1].mass = 0, s.objects[1].density = 700;
    CHECK(!refuses(s));
}

TEST_CASE("motion errors: a run like the reference has none; a rolling ball's falls with the step") {
    const Scene scene = bowlWith(0.5);
    const double seconds = 0.8, every_s = 1.0 / 60;
    const Track truth = tracked(referenceScene(scene), seconds, every_s);
    const Values<Error> none = errorsOf(tracked(referenceScene(scene), seconds, every_s), truth);
    CHECK(none[Error::position] == 0);
    CHECK(none[Error::energy] == 0);
    CHECK(none[Error::penetration] == truth.deepest);
    CHECK(!none.has(Error::restitution));
    CHECK(!none.has(Error::color));
    std::vector<double> off;
    for (const double dt : {1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480}) {
        Scene coarse = scene;
        coarse.physics.dt = dt;
        off.push_back(errorsOf(tracked(coarse, seconds, every_s), truth)[Error::position]);
    }
    MESSAGE("a rolling ball: " << off[0] << ", " << off[1] << ", " << off[2] << ", " << off[3] << " m");
    // Of second order: half the step is a quarter of the error.
    for (std::size_t i = 1; i < off.size(); ++i) {
        CHECK(off[i] < off[i - 1] / 3);
        CHECK(off[i] > off[i - 1] / 5);
    }
}

TEST_CASE("motion errors: of tracks made by hand") {
    Track truth;
    truth.every_s = 0.5, truth.bodies = {{1}, {2}}, truth.places = {{{0, 0, 0}, {5, 0, 0}}, {{0, 1, 0}, {5, 1, 0}}};
    truth.energy = {10, 8}, truth.kinetic = {4, 2}, truth.deepest = 1e-4;
    Track track = truth;
    std::vector<Body> bodies(2);
    bodies[0].radius = 0.2, bodies[1].radius = 0.5;
    CHECK(failureOf(track, truth, bodies) == "");
    track.places[1] = {{0.3, 1, 0}, {5, 1, 0.4}}, track.energy[1] = 9, track.deepest = 0.01;
    const Values<Error> errors = errorsOf(track, truth);
    CHECK(errors[Error::position] == doctest::Approx(std::sqrt((0.09 + 0.16) / 4)));  // of two moments of two bodies
    CHECK(errors[Error::energy] == doctest::Approx(1.0 / 4));
    CHECK(errors[Error::penetration] == 0.01);
    CHECK(failureOf(track, truth, bodies) == "");
    // One lost: it is left out of the positions, and the motion is no point.
    track.places[1][1] = glm::dvec3(kNotMeasured), track.lost = 1;
    CHECK(errorsOf(track, truth)[Error::position] == doctest::Approx(std::sqrt(0.09 / 3)));
    CHECK(failureOf(track, truth, bodies).find("lost") != std::string::npos);
    Track lost_too = truth;
    lost_too.lost = 1;
    CHECK(failureOf(track, lost_too, bodies) == "");
    // Inside something by more than the smallest radius; but not where the truth is too.
    track = truth, track.deepest = 0.21;
    CHECK(failureOf(track, truth, bodies).find("went into") != std::string::npos);
    track.deepest = 0.19;
    CHECK(failureOf(track, truth, bodies) == "");
    Track deep = truth;
    deep.deepest = 0.2, track.deepest = 0.25;
    CHECK(failureOf(track, deep, bodies) == "");
    // Energy gained, by more than a hundredth of the greatest energy of motion; at any moment.
    track = truth, track.energy = {10, 10.05};
    CHECK(failureOf(track, truth, bodies).find("gained") != std::string::npos);
    track.energy = {10, 10.03};
    CHECK(failureOf(track, truth, bodies) == "");
    track.energy = {10, 11, 9};
    CHECK(failureOf(track, truth, bodies).find("gained") != std::string::npos);
}

TEST_CASE("motion errors: a ball leaves the floor as fast as it should, under the program's defaults and any step that counts") {
    for (const double e : {0.0, 0.3, 0.6, 0.9, 1.0}) {
        CAPTURE(e);
        World world;
        world.restitution = e;
        CHECK(restitutionError(world, {}) < 2e-3);
    }
    World still;
    still.gravity = 0;
    CHECK(std::isnan(restitutionError(still, {})));
    // A step in which it falls further than it bounces back hides the bounce.
    PhysicsKnobs coarse;
    coarse.dt = 0.6;
    CHECK(restitutionError({}, coarse) >= 0);
}

TEST_CASE("motion sweep: two ask for the same and count the same; own first, default next, then each knob's values") {
    Scene scene = bowlWith(0.5);
    ball(scene, 0.12, {-0.4, 0.5, 0.1});
    scene.world.restitution = 0.4;
    scene.physics.iterations = 7;
    MotionSweep::Plan plan;
    plan.seconds = 0.4, plan.together = 20, plan.timings = 1, plan.slice_ms = 3;
    MotionSweep a(scene, plan), b(scene, plan);
    double before = 0;
    int slices = 0;
    while (a.step()) {
        CHECK(a.progress() >= before);
        before = a.progress(), ++slices;
    }
    CHECK(slices > 3);
    while (b.step()) {}
    CHECK(!a.isClosed());
    CHECK(a.truthErrors()[Error::position] == b.truthErrors()[Error::position]);
    CHECK(a.truthErrors()[Error::position] < 0.02);
    REQUIRE(a.runs().size() == b.runs().size());
    for (std::size_t i = 0; i < a.runs().size(); ++i) {
        const Run &x = a.runs()[i], &y = b.runs()[i];
        CHECK(differences(x.setting, y.setting) == "");
        CHECK(x.knob == y.knob);
        CHECK(x.failure == y.failure);
        CHECK(x.costs[Cost::visits] == y.costs[Cost::visits]);
        CHECK(x.costs[Cost::visits] > 0);
        CHECK(x.costs[Cost::step_ms] > 0);
        for (const Error e : motionTerms().errors) CHECK(x.errors[e] == y.errors[e]);
    }
    CHECK(unbeaten(a.runs(), motionTerms()) == unbeaten(b.runs(), motionTerms()));
    const Setting own = settingOf(scene);
    CHECK(differences(a.runs()[kOwnRun].setting, own) == "");
    CHECK(differences(a.runs()[kDefaultRun].setting, own) == fmt::format("iterations={}", PhysicsKnobs{}.iterations));
    std::size_t at = 2;
    for (const Knob* knob : knobsOf(scene, true))
        for (const double value : valuesWith(*knob, {valueOf(own, *knob)})) {
            REQUIRE(at < a.runs().size());
            CHECK(a.runs()[at].knob == knob->key);
            CHECK(a.runs()[at].value == value);
            CHECK(differences(a.runs()[at].setting, turned(own, *knob, value)) == "");
            ++at;
        }
    CHECK(a.runs().size() <= at + 20);
    CHECK(a.runs().size() > at);
    // Shorter steps are dearer.
    const auto visitsAt = [&](double dt) { return std::ranges::find_if(a.runs(), [&](const Run& r) { return r.knob == "dt" && r.value == dt; })->costs[Cost::visits]; };
    CHECK(visitsAt(1.0 / 960) > visitsAt(1.0 / 120));
    CHECK(visitsAt(1.0 / 120) > visitsAt(1.0 / 30));
}

TEST_CASE("motion sweep: of a ball that bounces on a plane the truth is its closed form") {
    Scene scene = onPlane();
    scene.world.restitution = 0.8;
    ball(scene, 0.2, {0, 1, 0}, {1, 0, 0});
    MotionSweep::Plan plan;
    plan.seconds = 0.7, plan.together = 0, plan.timings = 1;
    MotionSweep sweep(scene, plan);
    while (sweep.step()) {}
    CHECK(sweep.isClosed());
    CHECK(sweep.truthErrors()[Error::position] == 0);
    const std::optional<Track> closed = closedTrack(scene, plan.seconds, plan.every_s);
    REQUIRE(closed);
    CHECK(sweep.truth().places == closed->places);
    for (const Run& r : sweep.runs())
        if (!r.failed()) CHECK(r.errors[Error::position] < 0.2);
    // The scene as a setting leaves it has its ball where the motion that is looked at ends.
    const Setting& own = sweep.runs()[kOwnRun].setting;
    Tracker tracker(withSetting(scene, own), plan.seconds, plan.every_s);
    while (tracker.step()) {}
    CHECK(glm::length(movedScene(scene, own, plan.seconds).objects[1].pos - tracker.track().places.back()[0]) < 1e-12);
}
