// What happens in the saves that are about motion.
#include "core/scene/text.h"
#include "scenes.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>

using namespace mb;
using namespace mb::test;

namespace {
PhysicsWorld save(const char* name) {
    const LoadResult loaded = loadScene(std::string(MARCHBOX_SOURCE "/saves/") + name + ".txt");
    REQUIRE(loaded.ok());
    return PhysicsWorld(loaded.scene);
}
}  // namespace

TEST_CASE("marble_run: every marble rolls down the carved channels and ends in the tray") {
    PhysicsWorld w = save("marble_run");
    REQUIRE(w.bodies().size() == 4);
    std::array<bool, 3> passed{};  // by the first one, from one channel into the next
    while (w.time_s() < 20 && w.awake() > 0) {
        w.step();
        const glm::dvec3 p = w.bodies()[0].position;
        if (p.x > 1 && p.y > 2 && p.y < 2.8) passed[0] = true;
        if (passed[0] && p.x < -1 && p.y > 1.2 && p.y < 2) passed[1] = true;
        if (passed[1] && p.x > 0.5 && p.y < 1.2) passed[2] = true;
    }
    CHECK(passed == std::array{true, true, true});
    for (const Body& b : w.bodies()) {
        CAPTURE(b.name);
        CHECK(std::fabs(b.position.x - 1.75) < 0.75);  // between the tray's walls, on its bottom
        CHECK(std::fabs(b.position.z) < 0.5);
        CHECK(b.position.y == doctest::Approx(0.15 + b.radius).epsilon(1e-3));
    }
    MESSAGE("asleep after ", w.time_s(), " s");
}

TEST_CASE("heavy_on_light: a tonne stands on three kilograms") {
    PhysicsWorld w = save("heavy_on_light");
    const std::vector<Body> before(w.bodies().begin(), w.bodies().end());
    REQUIRE(before.size() == 4);
    CHECK(before[3].mass() == 1000 * before[0].mass());
    run(w, 6);
    CHECK(w.awake() == 0);
    double moved = 0;
    for (std::size_t i = 0; i < 4; ++i) moved = std::max(moved, glm::length(w.bodies()[i].position - before[i].position));
    CHECK(moved <= 2e-3);
    MESSAGE("moved by ", moved, " m");
}

TEST_CASE("nuts: they fall into the bowl, stay in it, and lie still") {
    PhysicsWorld w = save("nuts");
    REQUIRE(w.bodies().size() == 9);
    const double start = w.energy().total();
    double highest = start;
    for (int i = 0; i < 360; ++i) w.step(), highest = std::max(highest, w.energy().total());
    CHECK(highest <= start * (1 + 1e-3));
    CHECK(w.energy().kinetic <= 1e-3 * start);
    CHECK(w.maxPenetration() <= 5e-3);
    MESSAGE("after 3 s kinetic ", w.energy().kinetic, " J of ", start, ", deepest ", w.maxPenetration(), " m");
    while (w.awake() > 0 && w.time_s() < 20) w.step();
    CHECK(w.awake() == 0);
    CHECK(w.maxPenetration() <= 1e-4);
    for (const Body& b : w.bodies()) {
        CAPTURE(b.name);
        CHECK(glm::length(b.position - glm::dvec3{0, 1.2, 0}) < 1.16);  // within the hollow
        CHECK(b.position.y < 0.8);
    }
    MESSAGE("asleep after ", w.time_s(), " s, ", w.maxPenetration(), " m deep");
}
