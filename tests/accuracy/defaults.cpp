// The program's defaults are settings that nothing beats: of the saves that are quick to draw, as the report says of all.
#include "core/render/picture_sweep.h"
#include "physics/motion_sweep.h"

#include "core/scene/text.h"
#include "render/headless.h"

#include <algorithm>

using namespace mb;

namespace {

/// Whether nothing beats the defaults; else what does is said.
bool isUnbeaten(std::span<const Run> runs, const Terms& terms) {
    const Run& usual = runs[kDefaultRun];
    if (usual.failed()) MESSAGE("failed: " << usual.failure);
    for (const Run& run : runs)
        if (beats(run, usual, terms)) MESSAGE("beaten by " << differences(run.setting, usual.setting));
    const std::vector<std::size_t> front = unbeaten(runs, terms);
    return std::ranges::find(front, kDefaultRun) != front.end();
}

}  // namespace

TEST_CASE("defaults: nothing beats them in a picture of a save") {
    HeadlessRenderer headless;
    for (const char* name : {"die", "grazing_plain", "marble_run"}) {
        CAPTURE(name);
        const LoadResult loaded = loadScene(std::string(MARCHBOX_SOURCE) + "/saves/" + name + ".txt");
        REQUIRE(loaded.ok());
        Scene scene = loaded.scene;
        scene.render.samples = 1;  // what the save itself asks for is no default
        PictureSweep sweep(scene, {defaultCamera(scene), {96, 54}, 1}, {true, 60, 1});
        sweep.finishTruth();
        while (sweep.step(*headless.renderer)) {}
        CHECK(isUnbeaten(sweep.runs(), pictureTerms(sweep.truth().picture().noise)));
    }
}

TEST_CASE("defaults: nothing beats them in a motion of a save") {
    for (const char* name : {"welcome", "balls"}) {
        CAPTURE(name);
        const LoadResult loaded = loadScene(std::string(MARCHBOX_SOURCE) + "/saves/" + name + ".txt");
        REQUIRE(loaded.ok());
        MotionSweep sweep(loaded.scene);
        while (sweep.step()) {}
        CHECK(isUnbeaten(sweep.runs(), sweep.terms()));
    }
}
