// Every example scene: it reads, saves to the same bytes, and renders with every ray accounted for.
#include "headless.h"

#include "core/scene/text.h"

#include <filesystem>
#include <fstream>
#include <iterator>

using namespace mb;

TEST_CASE("every save renders at the default size with nothing undecided to speak of") {
    HeadlessRenderer headless;
    int scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(MARCHBOX_SOURCE "/saves")) {
        if (entry.path().extension() != ".txt") continue;
        ++scenes;
        const std::string name = entry.path().filename();
        CAPTURE(name);
        LoadResult loaded = loadScene(entry.path());
        REQUIRE(loaded.ok());
        CHECK(loaded.warnings.empty());
        const std::string text = writeScene(loaded.scene);
        const ReadResult again = readScene(text);
        REQUIRE(again.ok());
        CHECK(sameScene(loaded.scene, again.scene));
        CHECK(writeScene(again.scene) == text);

        loaded.scene.render.samples = 1;
        const Measured m = headless.measure(loaded.scene, defaultCamera(loaded.scene), {640, 360});
        const double pixels = 640 * 360;
        MESSAGE(name << ": undecided " << 100 * static_cast<double>(m.counts.pixels.undecided) / pixels << " %, evaluations a pixel "
                     << static_cast<double>(m.counts.evaluations.primary) / pixels << " primary, "
                     << static_cast<double>(m.counts.evaluations.shadow) / pixels << " shadow, "
                     << static_cast<double>(m.counts.evaluations.reflection) / pixels << " reflection");
        CHECK(static_cast<double>(m.counts.pixels.undecided) <= 0.005 * pixels);
        CHECK(m.counts.pixels.hit > 10'000);
        for (std::size_t i = 0; i < m.channels.state.size(); ++i) {
            if (m.channels.state[i] != 1) continue;
            const glm::vec3 n = m.channels.normal[i];
            REQUIRE(std::isfinite(m.channels.depth[i]));
            REQUIRE(std::fabs(glm::length(n) - 1) <= 1e-5f);
            REQUIRE(m.channels.object[i] >= 0);
        }
        for (const glm::vec3& c : headless.draw(loaded.scene, defaultCamera(loaded.scene), {160, 90}))
            REQUIRE((std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z)));
    }
    CHECK(scenes >= 8);
}
