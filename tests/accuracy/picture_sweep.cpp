// Sweeps of pictures: the same twice, in order, and with failures named.
#include "core/render/picture_sweep.h"

#include "core/scene/text.h"
#include "render/headless.h"

#include <glm/geometric.hpp>

#include <algorithm>

using namespace mb;

namespace {

Scene smallScene() {
    const ReadResult read = readScene("marchbox 1\nworld background:0.3,0.4,0.5\ncamera eye:0,2,5 target:0,0.6,0 fov:45\nlight pos:3,5,4\nmaterial name:m Kr:0.3\n"
                                      "object type:plane\nobject type:sphere radius:0.7 pos:-0.6,0.7,0 material:m\nobject type:union pos:0.9,0.5,0.3 blend:0.3\n"
                                      "  object type:box size:0.8,0.8,0.8\n  object type:sphere radius:0.4 pos:0.2,0.5,0\n");
    REQUIRE_MESSAGE(read.ok(), (read.ok() ? "" : read.faults[0].message));
    return read.scene;
}
void finish(PictureSweep& io_sweep, Renderer& renderer) {
    double before = 0;
    while (io_sweep.step(renderer)) {
        CHECK(io_sweep.progress() >= before);
        CHECK(io_sweep.progress() <= 1);
        before = io_sweep.progress();
    }
}

}  // namespace

TEST_CASE("picture sweep: two ask for the same, count the same, and have the same front") {
    HeadlessRenderer headless;
    const Scene scene = smallScene();
    const Frame frame{defaultCamera(scene), {32, 18}, 1};
    std::optional<Renderer> other;
    other.emplace();
    PictureSweep a(scene, frame, {true, 60, 2}), b(scene, frame, {true, 60, 1});
    finish(a, *headless.renderer), b.finishTruth(), finish(b, *other);
    CHECK(a.truth().picture().color == b.truth().picture().color);
    REQUIRE(a.runs().size() == b.runs().size());
    for (std::size_t i = 0; i < a.runs().size(); ++i) {
        const Run &x = a.runs()[i], &y = b.runs()[i];
        CAPTURE(differences(x.setting, a.runs()[kOwnRun].setting));
        CHECK(x.knob == y.knob);
        CHECK((x.value == y.value || (std::isnan(x.value) && std::isnan(y.value))));
        CHECK(differences(x.setting, y.setting) == "");
        CHECK(x.failure == y.failure);
        CHECK((x.failed() || x.costs.has(Cost::ms)));
        for (const Cost c : {Cost::evaluations}) CHECK((x.costs[c] == y.costs[c] || (x.failed() && !x.costs.has(c) && !y.costs.has(c))));
        for (const auto& row : errorRows()) CHECK((x.errors[row.row] == y.errors[row.row] || (!x.errors.has(row.row) && !y.errors.has(row.row))));
        CHECK(x.undecided == y.undecided);
        CHECK(x.off[Error::color] == y.off[Error::color]);
    }
    // The issue asks for 95 % of the front's members; counts and errors being equal, it is all of them.
    const Terms terms = pictureTerms(a.truth().picture().noise);
    CHECK(unbeaten(a.runs(), terms) == unbeaten(b.runs(), terms));
    CHECK(unbeaten(a.runs(), terms).size() > 3);
    other.reset();
}

TEST_CASE("picture sweep: the own setting, the default, each knob's values, then those together; each knob's pictures are kept") {
    HeadlessRenderer headless;
    Scene scene = smallScene();
    scene.render.samples = 5, scene.render.march_epsilon = 2e-3;
    PictureSweep sweep(scene, {defaultCamera(scene), {20, 12}, 1}, {true, 12, 1});
    finish(sweep, *headless.renderer);
    const std::vector<Run>& runs = sweep.runs();
    CHECK(differences(runs[kOwnRun].setting, settingOf(scene)) == "");
    CHECK(differences(runs[kDefaultRun].setting, defaultsOf(settingOf(scene), false)) == "");
    std::size_t at = 2;
    for (const Knob* knob : knobsOf(scene, false))
        for (const double value : valuesWith(*knob, {valueOf(settingOf(scene), *knob)})) {
            REQUIRE(at < runs.size());
            CHECK(runs[at].knob == knob->key);
            CHECK(runs[at].value == value);
            CHECK(differences(runs[at].setting, turned(settingOf(scene), *knob, value)) == "");
            const auto shots = std::ranges::count(sweep.shots(), at, &PictureSweep::Shot::run);
            CHECK(shots == (runs[at].costs.has(Cost::evaluations) ? 1 : 0));  // one that could be drawn
            ++at;
        }
    CHECK(runs.size() == at + 12);
    for (std::size_t i = at; i < runs.size(); ++i) CHECK(runs[i].knob == "");
    for (const PictureSweep::Shot& shot : sweep.shots()) {
        CHECK(runs[shot.run].knob != "");
        CHECK(shot.shown.size() == 20 * 12);
        CHECK(shot.errors.size() == 20 * 12);
    }
    // A knob's run at the own value is the own run again.
    for (const Run& run : runs)
        if (!run.knob.empty() && run.value == valueOf(settingOf(scene), knobNamed(run.knob))) {
            CHECK(run.costs[Cost::evaluations] == runs[kOwnRun].costs[Cost::evaluations]);
            CHECK(run.errors[Error::color] == runs[kOwnRun].errors[Error::color]);
        }
    CHECK(sweep.own().shown.size() == 20 * 12);
}

TEST_CASE("picture sweep: a setting that cannot draw the scene, or not all of it, is failed with its reason") {
    HeadlessRenderer headless;
    const LoadResult loaded = loadScene(MARCHBOX_SOURCE "/saves/blends.txt");
    REQUIRE(loaded.ok());
    Scene scene = loaded.scene;
    scene.render.march_steps = 1;
    scene.render.samples = 1;
    PictureSweep sweep(scene, {defaultCamera(scene), {32, 18}, 1}, {false, 0, 1});
    finish(sweep, *headless.renderer);
    REQUIRE(sweep.runs().size() == 2);
    CHECK(sweep.runs()[kOwnRun].failure.find("undecided") != std::string::npos);
    CHECK(sweep.runs()[kOwnRun].undecided > 0.01);
    CHECK(!sweep.runs()[kDefaultRun].failed());
    CHECK(unbeaten(sweep.runs(), pictureTerms()) == std::vector<std::size_t>{kDefaultRun});
    // One that the renderer refuses.
    scene.render.march_steps = 8192, scene.render.reflections = 64;
    scene.materials[0].kr = 0.99;
    PictureSweep refused(scene, {defaultCamera(scene), {32, 18}, 1}, {false, 0, 1});
    finish(refused, *headless.renderer);
    CHECK(refused.runs()[kOwnRun].failure != "");
    CHECK(!refused.runs()[kOwnRun].costs.has(Cost::evaluations));
}

TEST_CASE("picture sweep: what is measured of a stride's pixels is what the large picture has there") {
    HeadlessRenderer headless;
    const Scene scene = smallScene();
    const Camera camera = defaultCamera(scene);
    DrawnPicture part, whole;
    Values<Cost> part_costs, whole_costs;
    REQUIRE(drawn(*headless.renderer, scene, {camera, {20, 12}, 3}, part, part_costs) == "");
    REQUIRE(drawn(*headless.renderer, scene, {camera, {60, 36}, 1}, whole, whole_costs) == "");
    int other = 0;
    for (std::size_t y = 0; y < 12; ++y)
        for (std::size_t x = 0; x < 20; ++x) {
            const std::size_t i = y * 20 + x, k = (3 * y + 1) * 60 + 3 * x + 1;
            other += part.channels.object[i] != whole.channels.object[k];
            if (part.channels.state[i] == 1 && whole.channels.state[k] == 1) CHECK(part.channels.depth[i] == doctest::Approx(whole.channels.depth[k]).epsilon(1e-5));
            CHECK(glm::length(part.shown[i] - whole.shown[k]) < 0.02f);
        }
    CHECK(other == 0);
    CHECK(part_costs[Cost::evaluations] == doctest::Approx(whole_costs[Cost::evaluations]).epsilon(0.1));  // of one pixel in nine
}
