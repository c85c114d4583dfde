// Cases 17 and 18: watertight rooms, and surfaces that coincide.
#include "hard/oracle.h"

#include "core/sdf/raycast.h"

#include <ranges>

using namespace mb;
using namespace mb::hard;

TEST_CASE("case 17: no ray leaves a closed room or a heap of balls") {
    HeadlessRenderer headless;
    Scene room, heap;
    const int walls = addObject(room, "subtract", {});
    addObject(room, "box", {6, 4, 5, 0}, {}, walls);
    addObject(room, "box", {5.8, 3.8, 4.8, 0}, {}, walls);
    Draw draw(171);
    for (int i = 0; i < 50; ++i) addObject(heap, "sphere", {1.2}, {draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)});
    std::uint64_t rays = 0, escaped = 0, undecided = 0;
    for (const Scene* s : {&room, &heap})
        for (const glm::dvec3 way : {glm::dvec3{1, 0, 0}, glm::dvec3{-1, 0.001, 0}, glm::dvec3{0, 1, 0.2}, glm::dvec3{0, -1, -0.2}, glm::dvec3{0, 0, 1}, glm::dvec3{2.9, 1.9, 2.4}}) {
            const Measured m = headless.measure(*s, cameraAt({0, 0, 0}, way, 100), {256, 192});
            rays += 256 * 192, escaped += m.counts.pixels.miss, undecided += m.counts.pixels.undecided;
        }
    MESSAGE(rays << " rays: " << escaped << " escaped, " << undecided << " undecided");
    CHECK(escaped == 0);
    CHECK(static_cast<double>(undecided) <= 2e-5 * static_cast<double>(rays));

    // Aimed at the edges and the corners of the room, in double.
    const Tree tree = makeTree(room);
    int open = 0;
    for (int i = 0; i < times(20'000); ++i) {
        glm::dvec3 at{draw.member(-2.9, 2.9), draw.member(-1.9, 1.9), draw.member(-2.4, 2.4)};
        const RayEnd end = raycast(tree, {draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)}, at, 100);
        open += end.state != RayState::hit;
    }
    CHECK(open == 0);
}

TEST_CASE("case 18: of surfaces that coincide the first is seen, from everywhere") {
    HeadlessRenderer headless;
    Scene twins, tiles;
    for (int i = 0; i < 2; ++i) addObject(twins, "sphere", {1}, {0.3, 0.1, 0});
    for (const double x : {-0.5, 0.5}) addObject(tiles, "box", {1, 1, 1, 0}, {x, 0, 0});
    std::size_t wrong_twin = 0, wrong_tile = 0, seen = 0;
    for (int frame = 0; frame < 100; ++frame) {
        const Camera camera = cameraAt({0.2 + 0.013 * frame, 0.4, 3 + 0.031 * frame}, {0, 0, 0.5});
        const glm::ivec2 size{32, 24};
        for (const Scene* s : {&twins, &tiles}) {
            const Channels c = headless.measure(*s, camera, size).channels;
            for (std::size_t i = 0; i < c.state.size(); ++i) {
                if (c.state[i] != 1) continue;
                ++seen;
                const DoubleRay r = pixelRay(camera, size, static_cast<int>(i) % size.x, static_cast<int>(i) / size.x);
                const glm::dvec3 p = r.origin + static_cast<double>(c.depth[i]) * r.direction;
                wrong_twin += s == &twins && c.object[i] != 0;
                if (s == &tiles && std::fabs(p.x) > 1e-3) wrong_tile += c.object[i] != (p.x < 0 ? 0 : 1);
            }
        }
    }
    MESSAGE(seen << " pixels of 100 frames: " << wrong_twin << " show the second ball, " << wrong_tile << " the other tile");
    CHECK(wrong_twin == 0);
    CHECK(wrong_tile == 0);
}
TEST_CASE("case 18: of faces that lie in one plane the first is seen, wherever the boxes' centres are and however they are turned") {
    HeadlessRenderer headless;
    const glm::ivec2 size{32, 24};
    // Two boxes with a face in the plane z = 0.5, which they share around the axis; what is subtracted lies before it.
    const auto pair = [](std::string_view op, double turn, bool large_first) {
        Scene s;
        const int parent = op.empty() ? kNoParent : addObject(s, op, {});
        s.materials = {plain({1, 0, 0}), plain({0, 1, 0})};
        for (const int i : {0, 1}) {
            const bool large = large_first == (i == 0);
            const glm::dvec3 sides = large ? glm::dvec3{2, 1.2, 1.6} : glm::dvec3{1.3, 1.4, 0.8};
            const double way = op == "subtract" && i == 1 ? -1 : 1;
            addObject(s, "box", {sides.x, sides.y, sides.z, 0}, {large ? 0 : 0.1, large ? 0 : 0.03, 0.5 - way * sides.z / 2}, parent);
            s.objects.back().rot = {0, 0, large ? 0 : turn};
            s.objects.back().material = i;
        }
        return s;
    };
    for (const Evaluation way : {Evaluation::straight, Evaluation::grid}) {
        headless.renderer->setEvaluation(way);
        std::size_t seen = 0, second = 0, picked = 0;
        for (const std::string_view op : {"", "union", "intersect", "subtract"})
            for (const double turn : {0.0, 31.7})
                for (const int frame : std::views::iota(0, 50)) {
                    const Scene s = pair(op, turn, frame % 2 == 0);
                    const Tree tree = makeTree(s);
                    const Camera camera = cameraAt({0.2 + 0.026 * frame, 0.4, 3 + 0.062 * frame}, {0, 0, 0.5});
                    const auto picture = headless.draw(s, camera, size);
                    for (std::size_t i = 0; i < picture.size(); ++i) {
                        const DoubleRay r = pixelRay(camera, size, static_cast<int>(i) % size.x, static_cast<int>(i) / size.x);
                        const glm::dvec3 p = r.origin + (0.5 - r.origin.z) / r.direction.z * r.direction;
                        if (std::max(std::fabs(p.x), std::fabs(p.y)) > 0.4) continue;
                        ++seen, second += picture[i] != glm::vec3{1, 0, 0};
                        picked += raycast(tree, r.origin, r.direction, 100).leaf != 0;
                    }
                }
        MESSAGE(std::string(way == Evaluation::grid ? "through the grid: " : "straight: ") << second << " of " << seen << " pixels of the shared face show the second box, "
                << picked << " picks find it");
        CHECK(seen > 8000);
        CHECK(second == 0);
        CHECK(picked == 0);
    }
}
