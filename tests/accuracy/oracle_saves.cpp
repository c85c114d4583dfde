// Every save as a small picture, against the program's double field.
#include "core/scene/text.h"
#include "rays.h"

#include <filesystem>

using namespace mb;

TEST_CASE("saves: the pixels' rays end as the field says") {
    int scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(MARCHBOX_SOURCE "/saves")) {
        if (entry.path().extension() != ".txt") continue;
        ++scenes;
        const std::string name = entry.path().filename();
        CAPTURE(name);
        const LoadResult loaded = loadScene(entry.path());
        REQUIRE(loaded.ok());
        const Oracle oracle(loaded.scene);
        Grid grid;
        grid.follow(makeTree(loaded.scene));
        const Camera camera = defaultCamera(loaded.scene);
        const glm::ivec2 size{64, 36};
        int wrong = 0, undecided = 0, far_off = 0, hits = 0, objects = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const Ray ray = cameraRay(camera, size, {x + 0.5, y + 0.5});
                const RayEnd march = raycast(grid, ray.origin, ray.direction, 1e4);
                const std::optional<TrueHit> truth = oracle.firstHit(ray, 1e4);
                if (march.state == RayState::undecided) ++undecided;
                else if ((march.state == RayState::hit) != truth.has_value()) ++wrong;
                else if (truth) {
                    ++hits, far_off += std::fabs(march.t - truth->t) > 1e-6 * truth->t;
                    objects += oracle.tree().leaves[static_cast<std::size_t>(march.leaf)].object != truth->object;
                }
            }
        MESSAGE(name << ": " << hits << " hits, undecided " << undecided << ", other state " << wrong << ", off " << far_off << ", other object " << objects);
        CHECK(wrong <= 3);
        CHECK(far_off <= 3);
        CHECK(objects <= 3);
        CHECK(undecided <= size.x);  // a row of pixels at the horizon of a plane, at most
    }
    CHECK(scenes >= 8);
}
