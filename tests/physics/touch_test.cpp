// Where balls touch what was carved, hollowed and deformed: against the surface that rays from their centres find.
#include "core/scene/text.h"
#include "physics/closest.h"
#include "physics/random.h"
#include "physics/statics.h"
#include "scenes.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

using namespace mb;
using namespace mb::test;

namespace {

Scene read(std::string_view objects) {
    const ReadResult r = readScene(fmt::format("marchbox 1\n{}", objects));
    REQUIRE(r.ok());
    return r.scene;
}

/// How near the surface is to a place at least, among the hits of so many rays; infinite beyond `most`.
double nearestHit(const Tree& tree, glm::dvec3 c, double most, int rays, Random& io_random) {
    const double free = slope(tree, c).distance;
    double nearest = INFINITY;
    for (int k = 0; k < rays; ++k) {
        const double x = io_random.in(-1, 1), y = io_random.in(-1, 1), z = io_random.in(-1, 1);
        const glm::dvec3 way = glm::normalize(glm::dvec3{x, y, z});
        double length = free;
        for (int i = 0; i < 100 && length < std::min(most, nearest); ++i) {
            const double f = slope(tree, c + length * way).distance;
            if (f < 1e-7) {
                if (slope(tree, c + (length + 1e-3) * way).distance < 0) nearest = length;
                break;
            }
            length += f;
        }
    }
    return nearest;
}

struct Carved {
    std::string_view name, objects;
};
constexpr Carved kCarved[] = {
    {"a tray", "object type:subtract\n  object type:box size:2,0.3,1\n  object type:box size:1.9,0.3,0.9 pos:0,0.05,0\n"},
    {"a recess less deep than its cutter is above it", "object type:subtract\n  object type:box size:2,0.4,1\n  object type:box size:1.8,0.12,0.8 pos:0,0.16,0\n"},
    {"a hole whose cutter is almost flush", "object type:subtract\n  object type:box size:1,0.1,1\n  object type:box size:0.4,0.11,0.4\n"},
    {"a round hole", "object type:subtract\n  object type:box size:1.5,0.1,1.5\n  object type:cylinder radius:0.16 height:0.12\n"},
    {"half a pipe", "object type:subtract\n  object type:cylinder rot:0,0,90 radius:0.5 height:2\n  object type:cylinder rot:0,0,90 radius:0.45 height:2.01\n"
                    "  object type:box size:3,1,2 pos:0,0.5,0\n"},
    {"a shell less a box", "object type:subtract\n  object type:shell thickness:0.05\n    object type:sphere radius:0.8\n  object type:box size:1,1,1 pos:0,0.9,0\n"},
    {"a pit like a cone", "object type:subtract\n  object type:box size:2,1,2\n  object type:cone radius:0.05 radius2:0.6 height:0.9 pos:0,0.1,0\n"},
    {"a twisted slab", "object type:twist turns:0.2\n  object type:box size:0.6,1.6,0.1\n"},
    {"a bent slab", "object type:bend angle:20\n  object type:box size:1.5,0.1,0.7\n"},
    {"a wavy box", "object type:displace amplitude:0.05 frequency:6\n  object type:box size:1.6,0.4,1.6\n"},
    {"a blend less a blend", "object type:subtract blend:0.05\n  object type:union blend:0.1\n    object type:box size:1.2,0.4,1.2\n    object type:sphere pos:0.5,0.3,0 "
                             "radius:0.3\n  object type:cylinder radius:0.3 height:2\n"},
};

}  // namespace

TEST_CASE("a ball that overlaps what was carved or deformed is known to, as deep as rays find") {
    for (const Carved& carved : kCarved) {
        const std::string_view name = carved.name;
        const Scene s = read(carved.objects);
        std::vector<std::string> notes;
        const StaticField field(s, [](std::size_t) { return true; }, notes);
        const Tree tree = makeTree(s);
        Random random(11);
        int overlaps = 0;
        double worst = 0;
        CAPTURE(name);
        for (int i = 0; i < 500; ++i) {
            const double radius = random.in(0.1, 0.3), x = random.in(-1.2, 1.2), y = random.in(-1, 1), z = random.in(-1.2, 1.2);
            const glm::dvec3 c{x, y, z};
            const double f = slope(tree, c).distance;
            if (f < 0.02 * radius || f > radius) continue;
            const double nearest = nearestHit(tree, c, radius, 500, random);
            if (nearest > 0.95 * radius) continue;
            ++overlaps;
            std::vector<Touch> touches;
            field.touches(c, radius, kNear * radius, touches);
            double gap = radius;
            for (const Touch& t : touches) gap = std::min(gap, t.gap);
            worst = std::max(worst, (gap + radius - nearest) / radius);
        }
        CHECK(overlaps > 10);
        CHECK(worst <= 0.01);
        MESSAGE(name, ": of ", overlaps, " overlaps the one most underrated by ", worst, " of the radius");
    }
}

TEST_CASE("a ball lies on the floor of a recess, in a hole, on waves and on the edge of what is twisted") {
    const auto rests = [](std::string_view objects, glm::dvec3 at, double radius) {
        Scene s = read(objects);
        s.world.gravity = kG, s.world.restitution = 0;
        ball(s, at, radius);
        PhysicsWorld w(s);
        run(w, 6);
        REQUIRE(w.bodies().size() == 1);
        CHECK(w.awake() == 0);
        return w.bodies()[0].position;
    };
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
        const glm::dvec3 on_floor = rests(kCarved[k].objects, {0, 0.5, 0}, 0.1);
        CHECK(std::fabs(on_floor.y - (k == 0 ? 0 : 0.2)) <= 1e-4);
    }
    // A ball of 0.2 in a round hole of 0.16 lies with its middle √(0.2² − 0.16²) above the rim.
    CHECK(std::fabs(rests(kCarved[3].objects, {0.02, 0.6, 0.01}, 0.2).y - (0.05 + 0.12)) <= 1e-4);
    rests(kCarved[9].objects, {0.1, 0.6, 0.1}, 0.1);
}
