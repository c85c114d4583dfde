// The editor without any panel: its commands, and what they keep true.
#include "core/scene/keys.h"
#include "core/scene/text.h"
#include "core/sdf/tree.h"
#include "gui/editor.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace mb;
namespace fs = std::filesystem;

namespace {

/// A folder of its own, gone with the test.
struct Folder {
    fs::path path = fs::temp_directory_path() / ("marchbox_gui_" + std::to_string(::getpid()));
    Folder() { fs::remove_all(path), fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
};

const ShapeType& type(const char* name) { return *findShapeType(name); }

void checkSavable(const Editor& editor) {
    const ReadResult read = readScene(writeScene(editor.scene()));
    REQUIRE(read.ok());
    CHECK(sameScene(read.scene, editor.scene()));
}

}  // namespace

TEST_CASE("every type can be added, alone and under an operator, and the scene can always be saved") {
    Editor editor;
    const auto add = [&](const ShapeType& t) {
        REQUIRE(editor.addObject(t));
        CHECK(editor.scene().objects[*editor.selection()].type == &t);
        checkSavable(editor);
    };
    for (const Primitive& p : primitives()) add(p);
    for (const Operator& o : operators()) {
        add(o);
        const ObjectId parent = editor.selected();
        const bool takes_more = o.max_children > 2;
        CHECK(static_cast<bool>(editor.addObject(type("cone"), parent)) == takes_more);
        CHECK(editor.message().error == !takes_more);
        checkSavable(editor);
    }
    CHECK(editor.unsaved());
}

TEST_CASE("objects nest no deeper than a file may") {
    Editor editor;
    ObjectId parent;
    int made = 0;
    while (const ObjectId id = editor.addObject(type("union"), parent)) parent = id, ++made;
    CHECK(made == static_cast<int>(Limits::levels) - 1);
    checkSavable(editor);
}

TEST_CASE("names in use get a number behind them") {
    Editor editor;
    for (const char* name : {"sphere", "sphere2", "sphere3"}) {
        editor.addObject(type("sphere"));
        CHECK(editor.scene().objects.back().name == name);
    }
    Object o = editor.scene().objects.back();
    o.name = "ball";
    editor.setObject(editor.scene().objects.size() - 1, o);
    CHECK(editor.scene().objects.back().name == "ball2");
    Material m = editor.scene().materials[1];
    m.name = "tile";
    editor.setMaterial(1, m);
    CHECK(editor.scene().materials[1].name == "tile2");
    m.name = "";
    editor.setMaterial(1, m);
    CHECK(editor.scene().materials[1].name == "tile2");
    editor.addMaterial({.name = ""});
    editor.addLight({.name = "sun"});
    CHECK(editor.scene().lights.back().name == "sun2");
    checkSavable(editor);
}

TEST_CASE("what a file would refuse is refused, and changes nothing") {
    Editor editor;
    editor.addObject(type("plane"));
    const std::size_t last = editor.scene().objects.size() - 1;
    const Object before = editor.scene().objects[last];
    for (const double bad : {0.0, std::nan(""), static_cast<double>(INFINITY)}) {
        Object o = before;
        o.numbers[0] = bad, o.numbers[1] = 0, o.numbers[2] = 0;
        CHECK_FALSE(editor.setObject(last, o));
        CHECK(editor.message().error);
        CHECK(editor.scene().objects[last].numbers == before.numbers);
    }
    Object o = before;
    o.mass = 3;
    CHECK(editor.setObject(last, o));
    o.density = 700;  // the one set last holds
    CHECK(editor.setObject(last, o));
    CHECK(editor.scene().objects[last].mass == 0);
    CHECK(editor.scene().objects[last].density == 700);
    checkSavable(editor);
}

TEST_CASE("removing: the selected, the last, all; an operator keeps the children it needs") {
    Editor editor;
    const std::size_t at_start = editor.scene().objects.size();
    CHECK_FALSE(editor.removeSelected());
    const ObjectId whole = editor.addObject(type("subtract"));
    editor.addObject(type("cone"));
    CHECK(editor.removeLast());
    CHECK(editor.scene().objects.size() == at_start + 3);
    const std::size_t index = *findObject(editor.scene(), whole);
    CHECK(editor.remove(editor.scene().objects[index + 1].id));
    CHECK_FALSE(editor.remove(editor.scene().objects[index + 1].id));
    CHECK(editor.message().error);
    CHECK(editor.remove(whole));
    CHECK_FALSE(editor.selection());
    editor.clear();
    CHECK(editor.scene().objects.empty());
    CHECK_FALSE(editor.removeLast());
    checkSavable(editor);
}

TEST_CASE("saving and opening; a file that is at fault changes nothing") {
    const Folder folder;
    Editor editor;
    CHECK_FALSE(editor.unsaved());
    CHECK_FALSE(editor.save());
    editor.addObject(type("torus"));
    CHECK(editor.unsaved());
    CHECK(editor.saveAs(folder.path / "one"));
    CHECK(editor.path().filename() == "one.txt");
    CHECK_FALSE(editor.unsaved());
    std::ofstream(folder.path / "bad.txt") << "marchbox 1\nobject type:ball\n";
    std::ofstream(folder.path / "other.png") << "no scene";
    CHECK(editor.saves() == std::vector<std::string>{"bad.txt", "one.txt"});

    const Scene before = editor.scene();
    CHECK_FALSE(editor.open(folder.path / "bad.txt"));
    CHECK(editor.message().text.find("bad.txt:2:") != std::string::npos);
    CHECK_FALSE(editor.open(folder.path / "none.txt"));
    CHECK(sameScene(editor.scene(), before));
    CHECK(editor.path().filename() == "one.txt");

    Editor other;
    CHECK(other.open(folder.path / "one.txt"));
    CHECK(sameScene(other.scene(), before));
    CHECK_FALSE(other.unsaved());
    CHECK_FALSE(other.saveAs(folder.path / "no such folder" / "x.txt"));
    CHECK(other.message().error);
}

TEST_CASE("the eye turns within its limits and looking around is no edit") {
    Editor editor;
    const Camera first = editor.camera();
    CHECK(glm::length(first.eye - editor.scene().cameras[0].eye) < 1e-12);
    for (int i = 0; i < 1000; ++i) editor.turn(0.1, 0.1);
    CHECK(editor.camera().eye.y > editor.camera().target.y);
    editor.turn(0, -1e9);
    CHECK(editor.camera().eye.y < editor.camera().target.y);
    editor.zoom(1e9), editor.zoom(-1e9), editor.turn(std::nan(""), INFINITY), editor.pan(std::nan(""), 0);
    CHECK(std::isfinite(glm::length(editor.camera().eye)));
    CHECK_FALSE(editor.unsaved());
    editor.resetView();
    CHECK(glm::length(first.eye - editor.camera().eye) < 1e-12);
    editor.turn(1, 0);
    editor.keepView();
    CHECK(editor.unsaved());
    CHECK(editor.scene().cameras[0].eye == editor.camera().eye);
    checkSavable(editor);
}

TEST_CASE("a click takes the whole object, a second one the part under it") {
    Editor editor;
    editor.clear();
    const ObjectId whole = editor.addObject(type("union"));
    editor.lookThrough({.name = "", .eye = {0, 1, 6}, .target = {0, 1, 0}});
    editor.select({});
    CHECK(editor.pick({200, 100}, {100, 50}) == whole);
    const ObjectId part = editor.pick({200, 100}, {100, 50});
    CHECK(part != whole);
    CHECK(editor.scene().objects[*findObject(editor.scene(), part)].parent == 0);
    CHECK_FALSE(editor.pick({200, 100}, {1, 1}));
    CHECK_FALSE(editor.pick({0, 0}, {0, 0}));

    // The same through the picture's grid, and through one of another scene, which is not asked.
    Grid grid;
    grid.follow(makeTree(editor.scene()));
    for (const Grid* drawn : {static_cast<const Grid*>(&grid), static_cast<const Grid*>(nullptr)}) {
        editor.select({});
        CHECK(editor.pick({200, 100}, {100, 50}, drawn) == whole);
        CHECK_FALSE(editor.pick({200, 100}, {1, 1}, drawn));
    }
    grid.follow(Tree{});
    editor.select({});
    CHECK(editor.pick({200, 100}, {100, 50}, &grid) == whole);
}

TEST_CASE("time: play, pause, step, and a reset that gives the bits back") {
    Editor editor;
    const Scene before = editor.scene();
    editor.advance(1);
    CHECK(sameScene(editor.scene(), before));
    editor.step();
    CHECK(editor.simulation().steps() == 1);
    CHECK_FALSE(sameScene(editor.scene(), before));
    editor.play();
    for (int i = 0; i < 60; ++i) editor.advance(1.0 / 60);
    CHECK(editor.simulation().steps() >= 100);
    CHECK(editor.scene().objects[1].pos.y < 1.5);
    CHECK_FALSE(editor.unsaved());
    editor.pause();
    const Scene paused = editor.scene();
    editor.advance(1);
    CHECK(sameScene(editor.scene(), paused));
    checkSavable(editor);
    editor.reset();
    CHECK(sameScene(editor.scene(), before));
    CHECK_FALSE(editor.canReset());
}

TEST_CASE("an edit while bodies move stays, and a reset keeps it") {
    Editor editor;
    editor.play();
    editor.advance(0.1);
    Object ball = editor.scene().objects[1];
    ball.numbers[0] = 0.25, ball.pos.x = 1;
    CHECK(editor.setObject(1, ball));
    editor.addObject(type("box"));
    editor.advance(0.1);
    editor.reset();
    CHECK(editor.scene().objects[1].numbers[0] == 0.25);
    CHECK(editor.scene().objects[1].pos == glm::dvec3{1, 1.5, 0});
    CHECK(editor.scene().objects.size() == 3);
}

TEST_CASE("a body that leaves the world comes back with a reset, one that was removed does not") {
    Editor editor;
    World world = editor.scene().world;
    world.bounds = 3;
    editor.setWorld(world);
    Object ball = editor.scene().objects[1];
    ball.name = "away", ball.pos = {1.5, 1.5, 0}, ball.vel = {30, 0, 0};
    editor.addObject(ball);
    const ObjectId away = editor.selected();
    editor.play();
    for (int i = 0; i < 60; ++i) editor.advance(1.0 / 60);
    CHECK_FALSE(findObject(editor.scene(), away));
    REQUIRE(editor.scene().objects.size() == 2);
    editor.remove(editor.scene().objects[1].id);
    editor.reset();
    CHECK(editor.scene().objects.size() == 2);
    CHECK(findObject(editor.scene(), away));
    checkSavable(editor);
}

TEST_CASE("a reset away from what was saved is an edit, one back to it is none") {
    const Folder folder;
    Editor editor;
    REQUIRE(editor.saveAs(folder.path / "ball"));
    const auto move = [&] {
        editor.throwAbout();
        for (int i = 0; i < 10; ++i) editor.advance(1.0 / 60);
        editor.pause();
    };
    move(), editor.reset();
    CHECK_FALSE(editor.unsaved());
    move();
    REQUIRE(editor.save());
    CHECK_FALSE(editor.unsaved());
    editor.reset();
    CHECK(editor.unsaved());
    REQUIRE(editor.save());
    CHECK_FALSE(editor.unsaved());
    CHECK(sameScene(loadScene(editor.path()).scene, editor.scene()));
}

TEST_CASE("what is added stands on what is below the point looked at") {
    Editor editor;
    const auto draft = [&](const char* name) {
        Object o;
        o.type = &type(name), o.numbers = initialNumbers(type(name));
        return o;
    };
    const auto lowest = [&](ObjectId id) {
        const std::size_t index = *findObject(editor.scene(), id);
        return bounds(makeTree(editor.scene(), [&](std::size_t i) { return i == index; })).lo[1];
    };
    editor.lookThrough({.name = "", .eye = {4, 3, 6}, .target = {2, 1, -1}});
    const ObjectId ball = editor.addObject(type("sphere"));
    CHECK(editor.scene().objects.back().pos.x == 2);
    CHECK(editor.scene().objects.back().pos.z == -1);
    CHECK(std::abs(lowest(ball)) < 1e-5);  // on the floor
    const double top = 2 * editor.scene().objects.back().numbers[0];
    for (const char* name : {"box", "torus", "union"}) {
        const glm::dvec3 pos = editor.standing(draft(name));
        const ObjectId id = editor.addObject(type(name));
        CHECK(editor.scene().objects[*findObject(editor.scene(), id)].pos == pos);
        CHECK(lowest(id) == doctest::Approx(top).epsilon(1e-5));
        editor.remove(id);
    }
    editor.clear();
    CHECK(std::abs(lowest(editor.addObject(type("box")))) < 1e-5);  // on nothing
    CHECK(editor.standing(draft("plane")) == glm::dvec3{0});
}

TEST_CASE("the throws begin with the seed") {
    Editor a, b, c;
    a.seedThrows(7), b.seedThrows(7), c.seedThrows(8);
    for (Editor* e : {&a, &b, &c}) e->throwAbout();
    CHECK(sameScene(a.scene(), b.scene()));
    CHECK_FALSE(sameScene(a.scene(), c.scene()));
    a.throwAbout();
    CHECK(a.scene().objects[1].vel == c.scene().objects[1].vel);
}

TEST_CASE("throwing is the same in every session, and a slow machine drops time instead of freezing") {
    Editor a, b;
    for (Editor* e : {&a, &b}) e->throwAbout(), e->advance(0.05), e->advance(0.05);
    CHECK(a.playing());
    CHECK(sameScene(a.scene(), b.scene()));
    a.advance(1e9);
    CHECK(a.simulation().ratio() < 1);
    CHECK(a.simulation().steps() < 100);
}

TEST_CASE("a scene that cannot be evaluated is shown as it is: nothing is picked, nothing moves, and it says why") {
    const Folder folder;
    std::ofstream(folder.path / "spiral.txt") << "marchbox 1\nobject name:spiral type:twist turns:1\n  object type:plane\n"
                                                 "object type:sphere pos:0,1,0 radius:0.5 mass:1\n";
    Editor editor;
    REQUIRE(editor.open(folder.path / "spiral.txt"));
    CHECK_FALSE(editor.pick({200, 100}, {100, 50}));
    CHECK(editor.bodies() == nullptr);
    editor.play();
    CHECK_FALSE(editor.playing());
    CHECK(editor.message().error);
    CHECK(editor.message().text.find("'spiral'") != std::string::npos);
}
