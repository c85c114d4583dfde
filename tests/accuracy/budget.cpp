// A picture for a budget, on scenes drawn at random.
#include "core/render/budget.h"

#include "render/headless.h"
#include "sdf/random_scene.h"

#include <algorithm>

using namespace mb;

namespace {

/// A random thing on a floor, a lamp, and a camera that sees them; in half of them the floor mirrors a little.
Scene drawScene(Draw& draw) {
    SceneKind kind;
    kind.levels = 2, kind.children = 3, kind.bounded = true, kind.extent = 2;
    for (;;) {
        Scene scene;
        scene.world.background = {draw.uniform(0.2, 0.6), draw.uniform(0.3, 0.6), draw.uniform(0.4, 0.8)};
        scene.cameras = {cameraAt({draw.uniform(-2, 2), draw.uniform(1.5, 3), draw.uniform(4, 6)}, {0, 0, 0}, 40)};
        Light light;
        light.pos = {draw.uniform(-4, 4), draw.uniform(4, 7), draw.uniform(2, 5)};
        scene.lights = {light};
        Material floor, thing;
        floor.name = "floor", floor.pattern = draw.oneIn(2) ? Pattern::checker : Pattern::none, floor.kr = draw.oneIn(2) ? 0.2 : 0;
        thing.name = "thing", thing.color = {draw.uniform(0.2, 1), draw.uniform(0.2, 1), draw.uniform(0.2, 1)};
        scene.materials = {floor, thing};
        addObject(scene, "plane", {0, 1, 0, draw.uniform(-1, -0.3)});
        scene.objects.back().material = 0;
        for (int i = 1 + draw.below(3); i > 0; --i) {
            const std::size_t at = scene.objects.size();
            addRandom(scene, draw, kind);
            scene.objects[at].material = 1;
        }
        if (const Tree tree = makeTree(scene); tree.fault.empty() && tree.leaves.size() <= 12 && tree.warps == 0) return scene;
    }
}

/// A sweep to its end.
void finish(PictureSweep& io_sweep, Renderer& renderer) {
    io_sweep.finishTruth();
    while (io_sweep.step(renderer)) {}
}

}  // namespace

TEST_CASE("budget: an asked error is met on 18 of 20 scenes, for at most a tenth more than the best setting that is known to meet it") {
    HeadlessRenderer headless;
    const glm::ivec2 size{64, 36};
    int met = 0, cheap = 0;
    double worst = 1;
    Draw draw(streamOf("budget"));
    for (int round = 0; round < 20; ++round) {
        CAPTURE(round);
        const Scene scene = drawScene(draw);
        const Camera camera = defaultCamera(scene);
        // As --max-error does: every other pixel of every other row.
        const Frame frame = frameOf(camera, size, size / 2);
        CHECK(frame.stride == 2);
        PictureSweep larger(scene, frame, {true, 150, 1});
        finish(larger, *headless.renderer);
        const std::vector<std::size_t> line = frontOf(larger.runs(), Error::color, Cost::evaluations);
        REQUIRE(!line.empty());
        const double most = larger.runs()[line.front()].errors[Error::color], least = larger.runs()[line.back()].errors[Error::color];
        const double asked = least * std::pow(most / least, draw.uniform(0.2, 0.95));
        const Budget budget{Error::color, asked, {}, true};
        PictureSweep sweep(scene, frame, {false, 60, 1, Search::Aim{Error::color, asked, true}});
        finish(sweep, *headless.renderer);
        const std::optional<Picked> picked = pick(sweep.runs(), budget);
        REQUIRE(picked);
        const Run& run = sweep.runs()[picked->run];
        // The picture itself, all of its pixels, against the truth of all.
        DrawnPicture picture;
        Values<Cost> costs;
        const Frame whole{camera, size, 1};
        REQUIRE(drawn(*headless.renderer, withSetting(scene, run.setting), whole, picture, costs) == "");
        TruePictureWork truth(scene, whole);
        truth.finish();
        const double reached = errorsOf(picture, truth.picture())[Error::color];
        met += reached <= asked;
        // The best of all settings that either sweep tried, by the same care.
        double best = run.costs[Cost::evaluations];
        Setting with = run.setting;
        for (const Run& r : larger.runs())
            if (!r.failed() && surely(r, Error::color, true) <= asked && r.costs[Cost::evaluations] < best) best = r.costs[Cost::evaluations], with = r.setting;
        const double dearer = run.costs[Cost::evaluations] / best;
        cheap += dearer <= 1.1, worst = std::max(worst, dearer);
        if (reached > asked || dearer > 1.1)
            MESSAGE("scene " << round << ": asked " << asked << ", reached " << reached << " (said " << run.errors[Error::color] << std::string(picked->met ? "" : ", not met") << "), " << dearer << " times the best's cost: " << differences(run.setting, settingOf(scene)) << "; the best: " << differences(with, settingOf(scene)));
        CHECK(says(sweep.runs(), *picked, budget).find(picked->met ? "allowed" : "cannot be met") != std::string::npos);
    }
    MESSAGE("met on " << met << " of 20, within a tenth of the best on " << cheap << ", at worst " << worst << " times it");
    CHECK(met >= 18);
    CHECK(cheap >= 18);
}
