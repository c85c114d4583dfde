// Every panel, driven by a mouse and a keyboard over Dear ImGui with no window behind it.
#include "core/scene/text.h"
#include "hands.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <imgui_internal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

using namespace mb;
namespace fs = std::filesystem;

namespace {

/// Hands in a folder of their own, with a saves folder in it.
struct HandsInFolder {
    fs::path before = fs::current_path(), path = fs::temp_directory_path() / ("marchbox_panels_" + std::to_string(::getpid()));
    HandsInFolder() {
        fs::remove_all(path), fs::create_directories(path / "saves");
        fs::current_path(path);
        for (const char* name : {"saves/one.txt", "saves/two.txt"}) REQUIRE_FALSE(saveScene(name, hands.editor.scene()));
    }
    ~HandsInFolder() { fs::current_path(before), fs::remove_all(path); }
    Hands hands;
};

const Scene& sceneOf(const Hands& hands) { return hands.editor.scene(); }

}  // namespace

TEST_CASE("every row of the table can be reached through the menus; panels open and close") {
    Hands h;
    for (const Entry& entry : entries()) {
        if (!entry.draw) continue;
        CAPTURE(entry.name);
        const bool was_open = h.ui.isOpen(entry.name);
        h.menu(entry.menu, entry.name);
        CHECK(h.ui.isOpen(entry.name) != was_open);
        h.menu(entry.menu, entry.name);
        CHECK(h.ui.isOpen(entry.name) == was_open);
    }
}

TEST_CASE("Add object: a type from the list, sliders, Create") {
    Hands h;
    h.click("Objects", "Add...");
    h.click("Add object", "type");
    h.click("Add object", "torus");
    h.drag("Add object", "major", 0.3f, 0.6f);
    CHECK_FALSE(h.find("Add object", "pos.y"));
    h.click("Add object", "stands");
    h.drag("Add object", "pos.y", 0.5f, 0.7f);
    h.click("Add object", "Create");
    const Object& made = sceneOf(h).objects.back();
    CHECK(made.type->name == "torus");
    CHECK(made.name == "torus");
    CHECK(made.numbers[0] == doctest::Approx(3).epsilon(0.2));
    CHECK(made.pos.y > 1);
    CHECK(h.editor.selected() == made.id);
    CHECK(h.editor.unsaved());
    h.click("Add object", "Create");
    CHECK(sceneOf(h).objects.back().name == "torus2");
}

TEST_CASE("every operator is offered") {
    Hands h;
    h.ui.show("Add object"), h.frame(2);
    h.click("Add object", "type");
    for (const Operator& o : operators()) {
        CAPTURE(o.name);
        CHECK(h.find("Add object", std::string(o.name)) != nullptr);
    }
}

TEST_CASE("floating panels open side by side, and Esc closes the one in front") {
    Hands h;
    std::set<std::pair<float, float>> places;
    for (const Entry& entry : entries()) {
        if (!entry.draw || entry.place != Place::floating) continue;
        CAPTURE(entry.name);
        h.menu(entry.menu, entry.name), h.frame(2);
        const ImGuiWindow* window = ImGui::FindWindowByName(entry.name);
        REQUIRE(window);
        CHECK(places.insert({window->Pos.x, window->Pos.y}).second);
        CHECK(window->Pos.x + window->Size.x <= h.ui.picture_size.x);
        h.key(GLFW_KEY_ESCAPE);
        CHECK_FALSE(h.ui.isOpen(entry.name));
        CHECK_FALSE(h.ui.quit);
    }
    h.menu("Edit", "Camera"), h.menu("Edit", "Lights");
    h.key(GLFW_KEY_ESCAPE);
    CHECK_FALSE(h.ui.isOpen("Lights"));
    CHECK(h.ui.isOpen("Camera"));
    h.clickAt({700, 740});  // on the picture: no panel has the focus
    h.key(GLFW_KEY_ESCAPE);
    CHECK(h.ui.quit);
    CHECK(h.ui.isOpen("Camera"));
}

TEST_CASE("an operator takes a child through its attributes") {
    Hands h;
    h.editor.addObject(*findShapeType("union"));
    h.frame(2);
    const std::size_t before = sceneOf(h).objects.size();
    h.click("Attributes", "Add a child...");
    h.click("Add object", "Create");
    CHECK(sceneOf(h).objects.size() == before + 1);
    CHECK(sceneOf(h).objects.back().parent == 2);
    h.click("Objects", "union fold");
    CHECK_FALSE(h.find("Objects", "box 3"));
    h.click("Objects", "union fold");
    h.click("Objects", "box 3");
    CHECK(sceneOf(h).objects[3].id == h.editor.selected());
}

TEST_CASE("the tree and the attributes: select, slide, type, rename, give a material, delete") {
    Hands h;
    h.click("Objects", "ball");
    h.drag("Attributes", "radius", 0.1f, 0.5f);
    CHECK(sceneOf(h).objects[1].numbers[0] == doctest::Approx(2.5).epsilon(0.1));
    h.typeInto("Attributes", "radius", "0.25");
    CHECK(sceneOf(h).objects[1].numbers[0] == 0.25);
    h.typeInto("Attributes", "pos.x", "-1.5");
    CHECK(sceneOf(h).objects[1].pos.x == -1.5);
    h.fill("Attributes", "name", "marble");
    CHECK(sceneOf(h).objects[1].name == "marble");
    h.fill("Attributes", "name", "floor");
    CHECK(sceneOf(h).objects[1].name == "floor2");
    h.click("Attributes", "material");
    h.click("Attributes", "tile");
    CHECK(sceneOf(h).objects[1].material == 0);
    h.click("Attributes", "hidden");
    CHECK(sceneOf(h).objects[1].hidden);
    h.click("Attributes", "restitution");
    CHECK(sceneOf(h).objects[1].restitution.has_value());
    h.drag("Attributes", "own restitution", 0.5f, 1.0f);
    CHECK(*sceneOf(h).objects[1].restitution == 1);
    h.click("Objects", "Delete");
    CHECK(sceneOf(h).objects.size() == 1);
    h.click("Objects", "Remove last");
    CHECK(sceneOf(h).objects.empty());
}

TEST_CASE("a typed number is held to the key's range, and what is none changes nothing") {
    Hands h;
    h.click("Objects", "ball");
    const struct { const char *label, *text; double becomes; } kTyped[] = {
        {"radius", "-1", 1e-6}, {"radius", "nan", 1e-6}, {"radius", "", 1e-6}, {"radius", "99999999999", 1e6}, {"radius", "/0", 1e6},
        {"radius", "7", 7}, {"radius", "x", 7}, {"radius", "inf", 7}};
    for (const auto& typed : kTyped) {
        CAPTURE(typed.text);
        h.typeInto("Attributes", typed.label, typed.text);
        CHECK(sceneOf(h).objects[1].numbers[0] == typed.becomes);
    }
    CHECK(readScene(writeScene(sceneOf(h))).ok());
}

TEST_CASE("the selected object may go while its slider is held") {
    Hands h;
    h.click("Objects", "ball");
    h.moveTo(middle(h.get("Attributes", "radius")));
    h.press(0, true);
    h.editor.removeSelected();
    h.frame(3);
    h.moveTo({900, 700});
    h.press(0, false);
    CHECK(sceneOf(h).objects.size() == 1);
}

TEST_CASE("ten thousand objects, all of one name's stem, are listed") {
    Hands h;
    Object ball;
    ball.type = findShapeType("sphere"), ball.numbers = initialNumbers(*ball.type);
    for (int i = 0; i < 10'000; ++i) h.editor.addObject(ball);
    h.frame(3);
    const auto shows = [&](const std::string& label) {
        const ui::Seen* seen = h.find("Objects", label);
        return seen && seen->visible;
    };
    CHECK(shows("sphere 10001"));  // the one added last is selected
    CHECK_FALSE(shows("ball"));
    h.editor.select(sceneOf(h).objects[5000].id), h.frame(3);
    CHECK(shows("sphere 5000"));
    h.editor.select(sceneOf(h).objects[1].id), h.frame(3);
    CHECK(shows("ball"));
    h.click("Objects", "floor");
    CHECK(sceneOf(h).objects[0].id == h.editor.selected());
}

TEST_CASE("Materials: the list, its sliders, and another one") {
    Hands h;
    h.menu("Edit", "Materials");
    h.click("Materials", "clay");
    h.drag("Materials", "Kd", 0.2f, 0.9f);
    CHECK(sceneOf(h).materials[1].kd == doctest::Approx(0.9).epsilon(0.1));
    h.click("Materials", "pattern");
    h.click("Materials", "checker");
    CHECK(sceneOf(h).materials[1].pattern == Pattern::checker);
    h.click("Materials: new", "Another material");
    h.fill("Materials: new", "name", "glass");
    h.drag("Materials: new", "Kr", 0.1f, 1.0f);
    h.click("Materials: new", "Add");
    CHECK(sceneOf(h).materials.size() == 3);
    CHECK(sceneOf(h).materials[2].name == "glass");
    CHECK(sceneOf(h).materials[2].kr == doctest::Approx(1).epsilon(0.02));
}

TEST_CASE("Lights: the list, another one, and one less") {
    Hands h;
    h.menu("Edit", "Lights");
    h.drag("Lights", "intensity", 0.2f, 0.8f);
    CHECK(sceneOf(h).lights[0].intensity == doctest::Approx(4).epsilon(0.1));
    h.click("Lights: new", "Another light");
    h.drag("Lights: new", "pos.x", 0.5f, 0.2f);
    h.click("Lights: new", "Add");
    CHECK(sceneOf(h).lights.size() == 2);
    CHECK(sceneOf(h).lights[1].pos.x < -5);
    h.click("Lights", "Remove");
    CHECK(sceneOf(h).lights.size() == 1);
    h.click("Lights", "Remove");
    CHECK(sceneOf(h).lights.empty());
}

TEST_CASE("Constants: gravity, restitution and friction") {
    Hands h;
    h.menu("Settings", "Constants");
    h.typeInto("Constants", "gravity", "1.62");
    h.drag("Constants", "restitution", 0.6f, 0.0f);
    h.drag("Constants", "friction", 0.2f, 1.0f);
    h.drag("Constants", "substeps", 0.05f, 0.5f);
    CHECK(sceneOf(h).world.gravity == 1.62);
    CHECK(sceneOf(h).world.restitution == 0);
    CHECK(sceneOf(h).world.friction == 2);
    CHECK(sceneOf(h).physics.substeps > 4);
}

TEST_CASE("Constants: gravity may point anywhere, but must point somewhere") {
    Hands h;
    h.menu("Settings", "Constants");
    h.typeInto("Constants", "down.x", "2");
    CHECK(sceneOf(h).world.down == glm::dvec3{2, -1, 0});
    h.typeInto("Constants", "down.x", "0"), h.typeInto("Constants", "down.y", "0");
    CHECK(sceneOf(h).world.down == glm::dvec3{0, -1, 0});
    CHECK(h.editor.message().error);
    h.editor.play();
    h.editor.advance(0.1);
    const double fallen = sceneOf(h).objects[1].vel.y;
    h.typeInto("Constants", "down.y", "1");
    h.editor.advance(0.2);
    CHECK(fallen < 0);
    CHECK(sceneOf(h).objects[1].vel.y > fallen);
}

TEST_CASE("Picture: the knobs, and what the scene calls for") {
    Hands h;
    h.menu("Settings", "Picture");
    h.typeInto("Picture", "samples", "4");
    h.click("Picture", "show_undecided");
    h.drag("Picture", "march_epsilon", 0.5f, 1.0f);
    CHECK(sceneOf(h).render.samples == 4);
    CHECK(sceneOf(h).render.show_undecided);
    CHECK(sceneOf(h).render.march_epsilon == doctest::Approx(1e-2));
    CHECK_FALSE(h.ui.plan.called.empty());
}

TEST_CASE("Camera: sliders move the eye; the scene's camera follows only when told") {
    Hands h;
    h.menu("Edit", "Camera");
    h.drag("Camera", "fov", 0.3f, 0.9f);
    CHECK(h.editor.camera().fov > 90);
    CHECK_FALSE(h.editor.unsaved());
    h.click("Camera", "Use this view");
    CHECK(sceneOf(h).cameras[0].fov > 90);
    CHECK(h.editor.unsaved());
    h.drag("Camera", "eye.x", 0.5f, 0.9f);
    h.click("Camera", "Back to the scene's camera");
    CHECK(h.editor.camera().eye.x == doctest::Approx(sceneOf(h).cameras[0].eye.x));
}

TEST_CASE("play, pause, step, reset and throw, by buttons and by keys; Debug shows the bodies") {
    Hands h;
    h.menu("Settings", "Debug");
    const Scene before = sceneOf(h);
    h.click("Objects", "Step");
    CHECK(h.editor.simulation().steps() == 1);
    h.click("Objects", "Play");
    h.frame(10);
    CHECK(h.editor.playing());
    h.click("Objects", "Pause");
    CHECK_FALSE(h.editor.playing());
    CHECK(h.editor.simulation().steps() > 5);
    h.click("Objects", "Reset");
    CHECK(sameScene(sceneOf(h), before));
    h.key(GLFW_KEY_SPACE);
    CHECK(h.editor.playing());
    h.key(GLFW_KEY_SPACE);
    CHECK_FALSE(h.editor.playing());
    h.key(GLFW_KEY_PERIOD);
    h.key(GLFW_KEY_J);
    CHECK(h.editor.playing());
    CHECK(sceneOf(h).objects[1].vel != glm::dvec3{0});
    h.key(GLFW_KEY_R);
    CHECK(sameScene(sceneOf(h), before));
    CHECK_FALSE(h.editor.unsaved());
}

TEST_CASE("on the picture: left drag turns, the wheel zooms, right click selects, Delete removes; not through a panel") {
    Hands h;
    const Camera before = h.editor.camera();
    h.moveTo({300, 300});
    h.press(0, true);
    h.moveTo({400, 300}), h.moveTo({400, 5000});
    h.press(0, false);
    const Camera turned = h.editor.camera();
    CHECK(turned.eye != before.eye);
    CHECK(turned.eye.y > 5);
    h.moveTo({400, 300});
    h.wheel(3);
    CHECK(glm::distance(h.editor.camera().eye, h.editor.camera().target) < 0.8 * glm::distance(turned.eye, turned.target));
    h.editor.resetView();

    h.clickAt({470, 290}, 1);  // the ball hangs above the middle
    REQUIRE(h.editor.selection());
    CHECK(sceneOf(h).objects[*h.editor.selection()].name == "ball");
    h.key(GLFW_KEY_DELETE);
    CHECK(sceneOf(h).objects.size() == 1);
    h.clickAt({470, 40}, 1);
    CHECK_FALSE(h.editor.selection());

    const Camera still = h.editor.camera();
    h.moveTo({1100, 500});
    h.press(0, true), h.moveTo({1000, 400}), h.press(0, false);
    h.wheel(2);
    CHECK(h.editor.camera().eye == still.eye);
}

TEST_CASE("keys are not heard while a text is typed") {
    Hands h;
    h.click("Objects", "ball");
    h.click("Attributes", "name");
    h.key(GLFW_KEY_J), h.key(GLFW_KEY_DELETE), h.key(GLFW_KEY_SPACE);
    CHECK(sceneOf(h).objects.size() == 2);
    CHECK_FALSE(h.editor.playing());
}

TEST_CASE("Esc closes at once what is saved, and asks where it is not: Save, Discard, Cancel") {
    {
        Hands h;
        h.key(GLFW_KEY_ESCAPE);
        CHECK(h.ui.quit);
    }
    HandsInFolder in;
    Hands& h = in.hands;
    h.editor.addObject(*findShapeType("box"));
    h.key(GLFW_KEY_ESCAPE), h.frame(2);
    CHECK_FALSE(h.ui.quit);
    h.click("question", "Cancel");
    CHECK_FALSE(h.ui.after);
    h.key(GLFW_KEY_ESCAPE), h.frame(2);
    h.key(GLFW_KEY_ESCAPE), h.frame(2);
    CHECK_FALSE(h.ui.after);
    CHECK_FALSE(h.ui.quit);
    h.key(GLFW_KEY_ESCAPE), h.frame(2);
    h.fill("question", "file name", "three");
    h.click("question", "Save");
    CHECK(h.ui.quit);
    CHECK(loadScene("saves/three.txt").ok());
    CHECK(sameScene(loadScene("saves/three.txt").scene, sceneOf(h)));

    h.ui.quit = false;
    h.editor.removeLast();
    h.key(GLFW_KEY_ESCAPE), h.frame(2);
    h.click("question", "Discard");
    CHECK(h.ui.quit);
}

TEST_CASE("File: open from the list, save, save as; a bad file is told of") {
    HandsInFolder in;
    Hands& h = in.hands;
    std::ofstream("saves/bad.txt") << "marchbox 1\nlight\n";
    h.key(GLFW_KEY_O, true);
    h.click("Open", "bad.txt");
    h.click("Open", "Open");
    CHECK(h.editor.message().error);
    CHECK(h.find("message", "x"));
    h.click("message", "x");
    CHECK(h.editor.message().text.empty());
    h.click("Open", "two.txt");
    h.click("Open", "Open");
    CHECK(h.editor.path().filename() == "two.txt");
    CHECK_FALSE(h.ui.isOpen("Open"));

    h.editor.addObject(*findShapeType("cone"));
    h.key(GLFW_KEY_S, true);
    CHECK_FALSE(h.editor.unsaved());
    CHECK(sameScene(loadScene("saves/two.txt").scene, sceneOf(h)));
    h.menu("File", "Save as");
    h.fill("Save as", "file name", "four");
    h.click("Save as", "Save");
    CHECK(h.editor.path().filename() == "four.txt");
    CHECK(fs::exists("saves/four.txt"));

    // Opening drops unsaved work as closing does, so it asks too.
    h.editor.removeLast();
    h.menu("File", "Open");
    h.click("Open", "one.txt");
    h.click("Open", "Open");
    h.frame(2);
    CHECK(h.editor.path().filename() == "four.txt");
    h.click("question", "Discard");
    CHECK(h.editor.path().filename() == "one.txt");
}

TEST_CASE("every key of the controls' list is a row of the table, and no two rows share one") {
    std::set<std::pair<int, bool>> keys;
    for (const Entry& entry : entries())
        if (entry.shortcut.key) CHECK(keys.insert({entry.shortcut.key, entry.shortcut.ctrl}).second);
    for (const int needed : {GLFW_KEY_J, GLFW_KEY_DELETE, GLFW_KEY_ESCAPE, GLFW_KEY_SPACE}) CHECK(keys.contains({needed, false}));
}

TEST_CASE("a window of any size is laid out") {
    for (const ImVec2 screen : {ImVec2{0, 0}, ImVec2{1, 1}, ImVec2{50, 10}, ImVec2{200, 2000}, ImVec2{4000, 100}}) {
        Hands h(screen);
        for (const Entry& entry : entries())
            if (entry.draw) h.ui.show(entry.name);
        h.frame(3);
        CHECK(h.ui.picture_size.x >= 0);
        CHECK(h.ui.picture_size.y >= 0);
    }
}
