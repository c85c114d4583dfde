// Cases that this version does not meet, as they should be: in no test program until it does (the suite takes the files of
// tests/hard/ alone). docs/hard_cases.md has the figures and the causes.
#include "hard/oracle.h"

using namespace mb;
using namespace mb::hard;

TEST_CASE("case 13, open: with the default epsilon a wire of 2 mm, 10 m away, covers what it covers") {
    HeadlessRenderer headless;
    const glm::ivec2 size{64, 48};
    const double pixel = 2 * std::tan(glm::radians(30.0)) / 720 * 10;
    Camera camera = cameraAt({0, 0, 10}, {0, 0, 0});
    camera.fov = 2 * glm::degrees(std::atan(pixel / 10 * size.y / 2));
    Scene wire;
    addObject(wire, "cylinder", {1e-3, 40, 0});
    paint(wire, plain({1, 1, 1}));
    wire.render.samples = 64;
    for (const double tilt : {5.0, 30.0}) {
        wire.objects[0].rot = {0, 0, tilt};
        double seen = 0;
        for (const glm::vec3& c : headless.draw(wire, camera, size)) seen += static_cast<double>(c.x) / (size.x * size.y);
        const double wanted = 2e-3 / std::cos(glm::radians(tilt)) / (pixel * size.x);
        MESSAGE("tilted by " << tilt << ": covers " << seen / wanted << " of what it should");
        CHECK(std::fabs(seen / wanted - 1) <= 0.2);
    }
}

TEST_CASE("case 24, open: a ball less itself is not painted either") {
    HeadlessRenderer headless;
    Scene s;
    const int o = addObject(s, "subtract", {});
    addObject(s, "sphere", {1}, {}, o), addObject(s, "sphere", {1}, {}, o);
    paint(s, plain({1, 1, 1}));
    std::size_t painted = 0;
    for (const glm::vec3& c : headless.draw(s, cameraAt({0.3, 0.5, 3}, {0, 0, 0}, 60), {160, 120})) painted += c.x > 0;
    MESSAGE(painted << " pixels painted, " << headless.renderer->countUndecided() << " of them counted as undecided");
    CHECK(painted == 0);
}
