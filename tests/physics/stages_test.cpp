// A step composed of the stages its scene calls for does what the general one does, to the bit, with less.
#include "core/effects/effect.h"
#include "core/scene/text.h"
#include "physics/random.h"
#include "scenes.h"

#include <doctest/doctest.h>

#include <bit>
#include <filesystem>

using namespace mb;
using namespace mb::test;

namespace {

constexpr std::size_t kStages = static_cast<std::size_t>(Stage::count);

/// A world composed of what its scene calls for, beside the general one.
struct Twins {
    PhysicsWorld composed, general;
    explicit Twins(const Scene& scene, StageChoice choice = {}) : composed(scene, choice), general(scene, StageChoice::general()) {}
    void step() { composed.step(), general.step(); }
    /// The first step after which their states differ, of every tenth; −1: none.
    int firstDifference(int steps) {
        for (int i = 1; i <= steps; ++i) {
            step();
            if (i % 10 == 0 && composed.stateHash() != general.stateHash()) return i;
        }
        return -1;
    }
};
int firstDifference(const Scene& scene, int steps, StageChoice choice = {}) { return Twins(scene, choice).firstDifference(steps); }

/// A slope, a carved block, a lens, a blend, a bowl, or nothing.
void someSolid(Scene& s, Random& random) {
    const int kind = static_cast<int>(random.in(0, 10));
    const int parent = static_cast<int>(s.objects.size());
    if (kind == 0) floor(s);
    if (kind == 1) add(s, "box", {0, -0.3, 0}, {3, 0.5, 3, 0.05}).rot = {0, 20, random.in(-30, 30)};
    if (kind == 2) bowl(s, 1.5);
    if (kind == 3) lens(s);
    if (kind == 4) groove(s, random.in(60, 150));
    if (kind == 5) {
        add(s, "union", {}, {0.3});
        add(s, "box", {0, -0.4, 0}, {3, 0.8, 3, 0}, parent);
        add(s, "sphere", {0.4, 0.1, 0}, {0.4}, parent);
    }
}

double zeroOr(Random& random, double most) { return random.in(0, 1) < 0.4 ? 0.0 : random.in(0, most); }

/// One to six bodies near some solids, each number as likely 0 as not.
Scene smallScene(std::uint64_t seed) {
    Random random(seed);
    const double restitution = zeroOr(random, 1), friction = zeroOr(random, 1), falls = random.in(0, 1);
    Scene s = scene(random.in(0, 1) < 0.5 ? 1.0 / 120 : 1.0 / 30, restitution, friction, falls < 0.25 ? 0 : falls < 0.35 ? -2 : kG);
    s.physics.substeps = random.in(0, 1) < 0.3 ? 2 : 1;
    someSolid(s, random), someSolid(s, random);
    const int bodies = random.in(0, 1) < 0.2 ? 1 : static_cast<int>(random.in(2, 7));
    const bool spins = random.in(0, 1) < 0.5;
    const double speed = random.in(0, 1) < 0.2 ? 100 : zeroOr(random, 6), size = random.in(0, 1) < 0.2 ? 0.02 : 0.15;
    const auto any = [&](double most) {
        const double x = random.in(-most, most), y = random.in(-most, most), z = random.in(-most, most);
        return glm::dvec3{x, y, z};
    };
    for (int i = 0; i < bodies; ++i) {
        const glm::dvec3 at = glm::dvec3{0, 0.9 + 0.4 * i, 0} + any(0.6), vel = any(speed);
        const double r = size * random.in(0.5, 1.5), mass = random.in(0.1, 5);
        Object& o = random.in(0, 1) < 0.8 ? ball(s, at, r, vel, mass) : add(s, "box", at, {r, r, 2 * r, 0});
        o.vel = vel, o.mass = mass;
        if (spins) o.spin = any(20);
        if (random.in(0, 1) < 0.2) o.friction = zeroOr(random, 1);
        if (random.in(0, 1) < 0.2) o.restitution = zeroOr(random, 1);
        if (seed % 3 == 0) o.rolling = zeroOr(random, 0.05);
    }
    if (seed % 4 == 0) s.world.spinning = 0.01;
    return s;
}

/// A scene that calls for what is switched on.
struct Switches {
    bool friction = true, restitution = true, spin = true, statics = true, two = true, gravity = true, fast = false, rolling = true;
};
Scene switched(const Switches& on) {
    Scene s = scene(1.0 / 120, on.restitution ? 0.5 : 0, on.friction ? 0.4 : 0, on.gravity ? kG : 0);
    if (on.statics) {
        add(s, "box", {0, -0.5, 0}, {6, 1, 6, 0});
        add(s, "box", {1.5, 0.5, 0}, {0.05, 2, 4, 0});
    }
    s.world.rolling = on.rolling ? 0.01 : 0;
    const double speed = on.fast ? 60 : 1.5;
    ball(s, {0, 0.4, 0}, 0.1, {speed, 0, 0.1}).spin = on.spin ? glm::dvec3{3, 0, 8} : glm::dvec3{0};
    if (on.two) ball(s, {0.5, 0.4, 0.02}, 0.1);
    return s;
}

}  // namespace

TEST_CASE("a composed step does what the general one does: in every saved scene") {
    int with_bodies = 0;
    for (const auto& file : std::filesystem::directory_iterator(MARCHBOX_SOURCE "/saves")) {
        const LoadResult loaded = loadScene(file.path());
        REQUIRE(loaded.ok());
        CAPTURE(file.path());
        Twins twins(loaded.scene);
        with_bodies += !twins.composed.bodies().empty();
        CHECK(twins.firstDifference(240) == -1);
    }
    CHECK(with_bodies >= 4);
}

TEST_CASE("a composed step does what the general one does: in random small scenes") {
    Stages met, missed;
    std::uint64_t composed = 0, general = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Scene s = smallScene(seed);
        CAPTURE(seed);
        Twins twins(s);
        met = met | twins.composed.stages(), missed = missed | (Stages::all() - twins.composed.stages());
        CHECK(twins.firstDifference(240) == -1);
        composed += twins.composed.counts().searches, general += twins.general.counts().searches;
    }
    CHECK(met == Stages::all());
    for (const Effect& row : motionEffects()) {
        CAPTURE(row.name);
        CHECK(missed.has(row.stage) == (row.stage != Stage::flight));
    }
    CHECK(composed < general);
    MESSAGE("searches along a path: ", composed, " of ", general);
}

TEST_CASE("a composed step does what the general one does: among solids that are found through a grid") {
    Scene s = scene(1.0 / 120, 0.6, 0.3);
    Random random(5);
    for (int i = 0; i < 64; ++i) {
        const double high = random.in(0.2, 1), wide = random.in(0.3, 0.8);
        add(s, i % 3 ? "box" : "ellipsoid", {i % 8 - 3.5, 0, i / 8 - 3.5}, {wide, high, wide});
    }
    for (int i = 0; i < 30; ++i) {
        const glm::dvec3 at{random.in(-3, 3), random.in(1, 6), random.in(-3, 3)}, vel{random.in(-3, 3), 0, random.in(-3, 3)};
        ball(s, at, random.in(0.05, 0.2), vel);
    }
    Twins twins(s);
    CHECK(twins.firstDifference(240) == -1);
    CHECK(twins.composed.counts().evaluations < twins.general.counts().evaluations);
    MESSAGE("evaluations of the field: ", twins.composed.counts().evaluations, " of ", twins.general.counts().evaluations);
}

TEST_CASE("a composed step does what the general one does: each pair of switches in each way") {
    // Columns of the orthogonal array OA(8, 2⁷): the parities of the row's bits under each mask.
    const auto level = [](unsigned row, unsigned factor) { return std::popcount(row & (factor + 1)) % 2 == 1; };
    for (unsigned f = 0; f < 7; ++f)
        for (unsigned g = 0; g < f; ++g) {
            unsigned seen = 0;
            for (unsigned row = 0; row < 8; ++row) seen |= 1u << (2 * level(row, f) + level(row, g));
            REQUIRE(seen == 15);
        }
    for (unsigned row = 0; row < 8; ++row)
        for (const bool turn : {false, true}) {  // and the array's complement
            const auto on = [&](unsigned factor) { return level(row, factor) != turn; };
            CAPTURE(row); CAPTURE(turn);
            CHECK(firstDifference(switched({on(0), on(1), on(2), on(3), on(4), on(5), on(6)}), 240) == -1);
        }
}

TEST_CASE("a composed world follows what is done to it") {
    Scene s = scene(1.0 / 120, 0, 0);
    add(s, "box", {0, -0.5, 0}, {4, 1, 4, 0});
    ball(s, {0, 0.1, 0}, 0.1).friction = 0.5;
    ball(s, {0.25, 0.1, 0}, 0.1);
    ball(s, {0.1, 0.5, 0.1}, 0.1);
    const ObjectId first = s.objects[1].id, last = s.objects[3].id;
    Twins twins(s);
    PhysicsWorld &a = twins.composed, &b = twins.general;
    const auto both = [&](const auto& act) {
        act(a), act(b);
        for (int i = 0; i < 90; ++i) {
            twins.step();
            REQUIRE(a.stateHash() == b.stateHash());
        }
    };
    both([](PhysicsWorld&) {});
    both([](PhysicsWorld& w) { w.throwAbout(3, 2); });
    both([&](PhysicsWorld& w) { w.remove(first); });
    CHECK(!a.stages().has(Stage::friction));
    both([&](PhysicsWorld& w) { w.setMotion(0, {1, 0, 0}, {0, 0, -30}); });
    CHECK(a.stages().has(Stage::spin));
    both([&](PhysicsWorld& w) { s.world.friction = 1, w.changeStatics(s); });
    both([&](PhysicsWorld& w) { s.world.friction = 0, w.changeStatics(s); });
    both([&](PhysicsWorld& w) { w.remove(last); });
    CHECK(!a.stages().has(Stage::broad_phase));
    both([&](PhysicsWorld& w) { s.objects[0].hidden = true, w.changeStatics(s); });
    CHECK(a.stages() == Stages{Stage::flight, Stage::spin});
    both([&](PhysicsWorld& w) { w.setMotion(0, {}, {}); });
    CHECK(a.stages() == Stages{Stage::flight});
    both([&](PhysicsWorld& w) { s.world.gravity = 0, s.objects[0].hidden = false, w.changeStatics(s); });
    CHECK(a.stages().has(Stage::sleeping));
}

TEST_CASE("in a scene where nothing moves no stage is called for and nothing is counted") {
    Scene s = scene(1.0 / 120, 0.5, 0.5);
    floor(s), bowl(s, 1), lens(s);
    PhysicsWorld w(s);
    CHECK(w.stages() == Stages{});
    run(w, 1);
    CHECK(w.counts() == StepCounts{});
    CHECK(w.steps() == 120);
}

TEST_CASE("each stage counts exactly 0 in a scene that does not call for it, and more in one that does") {
    const auto lone = [](double gravity) {
        Scene s = scene(1.0 / 120, 0.5, 0.5, gravity);
        ball(s, {0, 10, 0}, 0.1);
        return s;
    };
    Scene still = scene(1.0 / 120, 0.5, 0.5);
    floor(still);
    const struct { Stage stage; Scene without; } cases[] = {
        {Stage::flight, still},
        {Stage::static_contacts, switched({.statics = false})},
        {Stage::broad_phase, switched({.two = false})},
        {Stage::body_contacts, switched({.two = false})},
        {Stage::spin, switched({.friction = false, .spin = false})},
        {Stage::friction, switched({.friction = false})},
        {Stage::restitution, switched({.restitution = false})},
        {Stage::continuous, lone(kG)},
        {Stage::sleeping, lone(kG)},
        {Stage::rolling, switched({.rolling = false})},
    };
    REQUIRE(std::size(cases) == kStages);
    PhysicsWorld with(switched({}));
    CHECK(with.stages() == Stages::all());
    run(with, 1);
    for (const auto& c : cases) {
        PhysicsWorld without(c.without);
        run(without, 1);
        CAPTURE(motionEffects()[static_cast<std::size_t>(c.stage)].name);
        CHECK(!without.stages().has(c.stage));
        CHECK(without.counts().used(c.stage) == 0);
        for (const Counter& counter : counters())
            if (counter.stage == c.stage) CHECK(without.counts().*counter.of == 0);
        CHECK(with.counts().used(c.stage) > 0);
    }
    CHECK(PhysicsWorld(lone(0)).stages() == Stages{Stage::flight, Stage::sleeping});
}

TEST_CASE("a needed stage that is left out is noticed, and a proof that proves nothing would be") {
    Scene s = switched({});
    ball(s, {-2, 0.1, 0}, 0.1);  // lies still
    for (std::size_t i = 0; i < kStages; ++i) {
        CAPTURE(motionEffects()[i].name);
        CHECK(firstDifference(s, 120, StageChoice::without(static_cast<Stage>(i))) > 0);
    }
    // Searches that are left out unproved, for fast balls, let them through the wall.
    PhysicsWorld open(switched({.fast = true}), StageChoice::without(Stage::continuous)), shut(switched({.fast = true}));
    run(open, 0.1), run(shut, 0.1);
    CHECK(open.bodies()[0].position.x > 1.6);
    CHECK(shut.bodies()[1].position.x < 1.5);
    // What is forced on does no harm.
    for (std::size_t i = 0; i < kStages; ++i)
        CHECK(firstDifference(switched({.friction = false, .spin = false, .two = false}), 120, StageChoice::with(static_cast<Stage>(i))) == -1);
}

TEST_CASE("a sleeping world steps nothing but the time") {
    Scene s = scene(1.0 / 120, 0.3, 0.4);
    bowl(s, 1);
    for (int i = 0; i < 4; ++i) ball(s, {0.1 * i, -0.5 + 0.25 * i, 0}, 0.1);
    Twins twins(s);
    PhysicsWorld &a = twins.composed, &b = twins.general;
    for (int i = 0; i < 2000 && a.awake() > 0; ++i) twins.step();
    REQUIRE(a.awake() == 0);
    const StepCounts before = a.counts();
    const double then = a.time_s();
    for (int i = 0; i < 1000; ++i) twins.step();
    CHECK(a.counts() == before);
    CHECK(a.time_s() == doctest::Approx(then + 1000.0 / 120));
    CHECK(a.stateHash() == b.stateHash());
    CHECK(b.counts().islands == a.counts().islands + 1000);
    a.setMotion(0, {1, 0, 0}, {});
    a.step();
    CHECK(a.counts() != before);
}
