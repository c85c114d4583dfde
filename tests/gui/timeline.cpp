// Time travel in the editor: its commands, then its panel.
#include "core/scene/text.h"
#include "hands.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

using namespace mb;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kFloor = 0, kBall = 1;  // of the scene the editor begins with

void stepTo(Editor& editor, std::uint64_t step) {
    while (editor.simulation().steps() < step) editor.step();
}
void finish(Editor& editor) {
    while (editor.seeking()) editor.advance(0);
}
void seek(Editor& editor, std::uint64_t step) { editor.seek(step), finish(editor); }
std::uint64_t state(Editor& editor) { return editor.bodies()->stateHash(); }

Object objectOf(const Editor& editor, std::size_t index) { return editor.scene().objects[index]; }
void moveFloor(Editor& editor, double y) {
    Object floor = objectOf(editor, kFloor);
    floor.pos.y = y;
    REQUIRE(editor.setObject(kFloor, floor));
}

/// Of the editor's first scene, with a second ball that leaves the world at about step 20.
struct Leaving {
    Editor editor;
    ObjectId away;
    Leaving() {
        World world = editor.scene().world;
        world.bounds = 5;
        editor.setWorld(world);
        Object ball = objectOf(editor, kBall);
        ball.name = "away", ball.pos = {1.5, 1.5, 0}, ball.vel = {20, 0, 0};
        away = editor.addObject(ball);
        editor.addObject(*findShapeType("box"));  // behind it
    }
};

}  // namespace

TEST_CASE("any step made can be gone to: the bodies are where they were, and playing goes on from there") {
    Editor editor;
    std::vector<Scene> scenes{editor.scene()};
    for (std::uint64_t i = 1; i <= 100; ++i) editor.step(), scenes.push_back(editor.scene());
    const std::uint64_t end = state(editor);
    for (const std::uint64_t to : {50u, 51u, 3u, 0u, 99u}) {
        seek(editor, to);
        CHECK(editor.simulation().steps() == to);
        CHECK(sameScene(editor.scene(), scenes[to]));
    }
    editor.stepBack();
    CHECK(sameScene(editor.scene(), scenes[98]));
    CHECK_FALSE(editor.unsaved());
    seek(editor, 40);
    editor.play();
    for (int i = 0; i < 20; ++i) editor.advance(1.0 / 60);
    CHECK(editor.simulation().steps() == 80);
    CHECK(sameScene(editor.scene(), scenes[80]));
    for (int i = 0; i < 20; ++i) editor.advance(1.0 / 60);
    CHECK(editor.simulation().steps() == 120);
    CHECK(editor.timeline()->last() == 120);
    seek(editor, 100);
    CHECK(state(editor) == end);
    CHECK_FALSE(editor.playing());
    seek(editor, 1'000'000);
    CHECK(editor.simulation().steps() == 120);
}

TEST_CASE("a body that left the world is there again at the moments before, and gone again behind") {
    Leaving l;
    const std::size_t objects = l.editor.scene().objects.size();
    stepTo(l.editor, 60);
    REQUIRE_FALSE(findObject(l.editor.scene(), l.away));
    seek(l.editor, 5);
    REQUIRE(findObject(l.editor.scene(), l.away) == 2);  // in its place
    CHECK(l.editor.scene().objects.size() == objects);
    CHECK(objectOf(l.editor, 2).pos.x == l.editor.bodies()->bodies()[1].position.x);
    seek(l.editor, 60);
    CHECK_FALSE(findObject(l.editor.scene(), l.away));
    seek(l.editor, 5);
    l.editor.reset();
    CHECK(findObject(l.editor.scene(), l.away));
    CHECK(l.editor.scene().objects.size() == objects);
}

TEST_CASE("a shape that is edited while time stands still is another from that moment on; looks are the same at all moments") {
    Editor editor;
    stepTo(editor, 30);
    const ObjectId ball = objectOf(editor, kBall).id;
    moveFloor(editor, -0.5), moveFloor(editor, -1);
    World world = editor.scene().world;
    world.gravity = 5, world.background = {1, 0, 0};
    editor.setWorld(world);
    stepTo(editor, 90);
    CHECK(editor.timeline()->recording().actions.size() == 1);
    const std::uint64_t end = state(editor);
    Object repainted = objectOf(editor, kFloor);
    repainted.material = 1;
    REQUIRE(editor.setObject(kFloor, repainted));
    CHECK(editor.timeline()->last() == 90);

    seek(editor, 20);
    CHECK(objectOf(editor, kFloor).pos.y == 0);
    CHECK(objectOf(editor, kFloor).material == 1);
    CHECK(editor.scene().world.gravity == doctest::Approx(9.81));
    CHECK(editor.scene().world.background == glm::dvec3{1, 0, 0});
    CHECK(editor.unsaved());
    seek(editor, 31);
    CHECK(objectOf(editor, kFloor).pos.y == -1);
    CHECK(editor.scene().world.gravity == 5);
    seek(editor, 90);
    CHECK(state(editor) == end);

    // A reset keeps the edits, from wherever it is pressed.
    seek(editor, 10);
    editor.reset();
    CHECK(objectOf(editor, kFloor).pos.y == -1);
    CHECK(objectOf(editor, kBall).pos.y == 1.5);
    CHECK(objectOf(editor, kBall).id == ball);
    CHECK(editor.scene().world.gravity == 5);
    CHECK_FALSE(editor.timeline());
}

TEST_CASE("doing something new at an earlier moment discards what came behind it, and says so") {
    Editor editor;
    stepTo(editor, 50);
    seek(editor, 20);
    SUBCASE("a throw") { editor.throwAbout(); }
    SUBCASE("a shape") { moveFloor(editor, -1); }
    SUBCASE("a constant") {
        PhysicsKnobs physics = editor.scene().physics;
        physics.substeps = 3;
        editor.setPhysics(physics);
    }
    CHECK(editor.timeline()->last() == 20);
    CHECK(editor.message().text == "Something new was done at step 20: the 30 steps behind it are gone.");
    editor.pause();
    stepTo(editor, 60);
    const std::uint64_t end = state(editor);
    seek(editor, 10), seek(editor, 60);
    CHECK(state(editor) == end);
    CHECK_FALSE(editor.timeline()->divergence());
}

TEST_CASE("a body that is edited begins a new run from there") {
    Editor editor;
    stepTo(editor, 50);
    Object ball = objectOf(editor, kBall);
    ball.pos = {1, 2, 0};
    REQUIRE(editor.setObject(kBall, ball));
    CHECK_FALSE(editor.timeline());
    editor.step();
    CHECK(editor.timeline()->last() == 1);
    CHECK(objectOf(editor, kBall).pos.x == 1);
    editor.addObject(ball);
    editor.step();
    CHECK(editor.timeline()->last() == 1);
}

TEST_CASE("a body removed by hand is there before that moment; a reset leaves it removed unless the removal is undone") {
    Leaving l;
    stepTo(l.editor, 10);
    REQUIRE(l.editor.remove(l.away));
    CHECK(l.editor.timeline()->last() == 10);
    stepTo(l.editor, 30);
    seek(l.editor, 8);
    CHECK(findObject(l.editor.scene(), l.away));
    SUBCASE("still removed") {
        l.editor.reset();
        CHECK_FALSE(findObject(l.editor.scene(), l.away));
        return;
    }
    SUBCASE("undone") {
        l.editor.throwAbout();
        l.editor.pause();
        l.editor.reset();
        const auto back = findObject(l.editor.scene(), l.away);
        REQUIRE(back);
        CHECK(objectOf(l.editor, *back).pos.x == 1.5);
    }
}

TEST_CASE("a sleeping world stands still at the end of its run, not before it") {
    Editor editor;
    editor.play();
    for (int i = 0; i < 1000 && !editor.simulation().asleep(); ++i) editor.advance(0.1);
    REQUIRE(editor.simulation().asleep());
    const std::uint64_t asleep = editor.simulation().steps();
    for (int i = 0; i < 60; ++i) editor.step();  // asleep
    editor.throwAbout();
    for (int i = 0; i < 20; ++i) editor.advance(1.0 / 60);
    editor.pause();
    const std::uint64_t last = editor.timeline()->last();
    const std::uint64_t end = state(editor);
    seek(editor, asleep + 1);
    CHECK(editor.bodies()->awake() == 0);
    editor.play();
    CHECK(editor.moving());
    for (int i = 0; i < 1000 && editor.simulation().steps() < last; ++i) editor.advance(1.0 / 120);
    CHECK(editor.simulation().steps() == last);
    CHECK(state(editor) == end);
}

TEST_CASE("a run is saved, and made again from its file; a changed one is told") {
    const fs::path folder = fs::temp_directory_path() / fmt::format("marchbox_timeline_{}", ::getpid());
    fs::remove_all(folder), fs::create_directories(folder);
    Editor editor;
    CHECK_FALSE(editor.saveRecording(folder / "none"));
    editor.addObject(*findShapeType("box")), editor.removeLast();
    stepTo(editor, 20);
    editor.throwAbout(), editor.pause();
    stepTo(editor, 40);
    moveFloor(editor, -1);
    stepTo(editor, 80);
    const Scene end = editor.scene();
    REQUIRE(editor.saveRecording(folder / "run"));
    CHECK(fs::exists(folder / "run.rec"));

    Editor other;
    REQUIRE(other.openRecording(folder / "run.rec"));
    CHECK(other.recordings() == std::vector<std::string>{"run.rec"});
    CHECK_FALSE(other.unsaved());
    CHECK(other.timeline()->last() == 80);
    CHECK(other.simulation().steps() == 0);
    CHECK(objectOf(other, kFloor).pos.y == 0);
    other.play();
    for (int i = 0; i < 40; ++i) other.advance(1.0 / 60);
    CHECK(other.message().text == "All 80 recorded steps were made again, each to the same state.");
    CHECK(sameScene(other.scene(), end));
    seek(other, 30);
    CHECK(objectOf(other, kFloor).pos.y == 0);
    other.reset();
    CHECK(objectOf(other, kBall).pos.y == 1.5);

    std::ifstream in(folder / "run.rec");
    std::string text{std::istreambuf_iterator<char>(in), {}};
    text.replace(text.find("mass:1"), 6, "mass:2");
    std::ofstream(folder / "changed.rec") << text;
    REQUIRE(other.openRecording(folder / "changed.rec"));
    seek(other, 50);
    CHECK(other.message().error);
    CHECK(other.message().text.find("The run is not as it was at step 1: body 'ball' is another") == 0);
    std::ofstream(folder / "bad.rec") << text.substr(0, 300);
    CHECK_FALSE(other.openRecording(folder / "bad.rec"));
    CHECK(other.message().text.find("bad.rec:") == 0);
    fs::remove_all(folder);
}

TEST_CASE("the Timeline panel: its slider, its buttons, the keys") {
    Hands h;
    const float before = h.ui.picture_size.y;
    h.key(GLFW_KEY_F4);
    REQUIRE(h.ui.isOpen("Timeline"));
    h.frame();
    CHECK(h.ui.picture_size.y < before);
    h.menu("Settings", "Debug"), h.menu("Settings", "Debug");
    for (int i = 0; i < 100; ++i) h.editor.step();
    const Scene end = h.editor.scene();
    const auto step = [&] { return h.editor.simulation().steps(); };
    h.frame();
    h.drag("Timeline", "step", 0.9f, 0.5f);
    CHECK(step() > 40);
    CHECK(step() < 60);
    const std::uint64_t at = step();
    h.key(GLFW_KEY_COMMA);
    CHECK(step() == at - 1);
    h.click("Timeline", "<");
    CHECK(step() == at - 2);
    h.click("Timeline", ">"), h.key(GLFW_KEY_PERIOD);
    CHECK(step() == at);
    h.click("Timeline", "|<");
    CHECK(step() == 0);
    h.click("Timeline", "<");
    CHECK(step() == 0);
    h.typeInto("Timeline", "step", "77");
    CHECK(step() == 77);
    h.click("Timeline", ">|");
    CHECK(step() == 100);
    CHECK(sameScene(h.editor.scene(), end));
    h.click("Timeline", "Play");
    h.frame(5);
    CHECK(step() > 100);
    h.drag("Timeline", "step", 1.0f, 0.3f);
    CHECK_FALSE(h.editor.playing());
    CHECK(step() < 60);
}

TEST_CASE("recordings are saved and opened through their panels") {
    const fs::path before = fs::current_path(), folder = fs::temp_directory_path() / fmt::format("marchbox_recordings_{}", ::getpid());
    fs::remove_all(folder), fs::create_directories(folder / "saves");
    fs::current_path(folder);
    {
        Hands h;
        for (int i = 0; i < 10; ++i) h.editor.step();
        h.menu("Motion", "Save recording");
        h.fill("Save recording", "file name", "fall");
        h.click("Save recording", "Save");
        CHECK_FALSE(h.ui.isOpen("Save recording"));
        REQUIRE(fs::exists("saves/fall.rec"));
        h.editor.reset();
        h.menu("Motion", "Open recording");
        h.click("Open recording", "fall.rec");
        h.click("Open recording", "Open");
        CHECK_FALSE(h.ui.isOpen("Open recording"));
        CHECK(h.ui.isOpen("Timeline"));
        REQUIRE(h.editor.timeline());
        CHECK(h.editor.timeline()->last() == 10);
    }
    fs::current_path(before);
    fs::remove_all(folder);
}
