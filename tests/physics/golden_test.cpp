// One state that every machine, compiler, level of optimisation and number of threads comes to. tools/golden.sh builds this test in
// several ways.
#include "physics/random.h"
#include "scenes.h"

#include <doctest/doctest.h>

using namespace mb;
using namespace mb::test;

namespace {

/// 80 bodies of all kinds fall on a carved floor and on one another: balls that bounce and balls that do not, boxes, capsules, and
/// carved shapes; with friction and resistance to rolling, and one fast enough to be searched for along its path.
Scene eighty() {
    Scene s = scene(1.0 / 120, 0.3, 0.4);
    s.physics.substeps = 2, s.physics.iterations = 8;
    add(s, "subtract", {}, {0});
    const int parent = static_cast<int>(s.objects.size()) - 1;
    add(s, "box", {0, -0.5, 0}, {6, 1, 6, 0.1}, parent);
    add(s, "sphere", {0.5, 0.4, 0.3}, {0.8}, parent);
    add(s, "box", {-1.5, 0.1, 0}, {1, 0.8, 1, 0.05}, parent);
    Random random(80);
    constexpr std::string_view kKinds[]{"ball", "box", "ball", "capsule", "ball", "carved"};
    for (int i = 0; i < 80; ++i) {
        const double x = random.in(-0.05, 0.05), z = random.in(-0.05, 0.05), size = 0.16 + 0.04 * (i % 3);
        const glm::dvec3 at{0.4 * (i % 5) - 0.8 + x, 0.2 + 0.3 * (i / 20), 0.4 * (i / 5 % 4) - 0.6 + z};
        Object& o = s.objects[bodyOf(s, kKinds[i % 6], at, size)];
        if (i % 6 == 0) o.restitution = 0;
        if (i % 6 == 2) o.rolling = 0.002;
        o.spin = {random.in(-5, 5), random.in(-5, 5), random.in(-5, 5)};
    }
    s.objects.back().vel = {3, -60, 1};
    return s;
}

}  // namespace

TEST_CASE("the golden state of 80 bodies is the same for any number of threads, and on every machine") {
    const Scene s = eighty();
    for (const unsigned threads : {1u, 2u, 4u}) {
        PhysicsWorld w(s);
        w.setThreads(threads);
        REQUIRE(w.bodies().size() == 80);
        run(w, 0.75);
        CAPTURE(threads);
        CHECK(w.counts().body_contacts > 1000);
        CHECK(w.counts().searches > 100);
        // A change of the physics changes it: then write the new one, once tools/golden.sh finds the same everywhere.
        CHECK(w.stateText() == "73d2b6b8408b7a6a");
    }
}
