// The real window: open a file, add an object through the menus, save, close; and the file is what it should be. And what is
// said where there is no window to be had.
#include "real_window.h"
#include "core/scene/text.h"

using namespace mb;

TEST_CASE("in the real window: add an object through the menus, save, close, compare the file") {
    if (!canHaveWindow()) return;
    const fs::path folder = fs::temp_directory_path() / ("marchbox_window_" + std::to_string(::getpid()));
    fs::remove_all(folder), fs::create_directories(folder);
    const fs::path file = folder / "scene.txt";
    Editor expected;
    REQUIRE(expected.saveAs(file));
    const std::string before = contents(file);

    const Display display;
    REQUIRE_FALSE(display.display.empty());
    ::setenv("DISPLAY", display.display.c_str(), 1);
    ::unsetenv("WAYLAND_DISPLAY");
    Running running(folder, file.string());
    running.click("menu/Edit");
    running.click("menu/Add object");
    running.click("Add object/Create");
    REQUIRE(running.find("Objects/sphere"));
    Running::xdo("key ctrl+s");
    for (int i = 0; i < 200 && contents(file) == before; ++i) rest(50);
    Running::xdo("key Escape");  // closes the panel in front
    rest(500);
    Running::xdo("key Escape");
    CHECK(running.child.wait() == 0);

    Object sphere;
    sphere.type = findShapeType("sphere"), sphere.numbers = initialNumbers(*sphere.type);
    sphere.name = "sphere", sphere.pos = expected.standing(sphere);
    REQUIRE(expected.addObject(sphere));
    CHECK(contents(file) == writeScene(expected.scene()));

    // The program itself opens the file it wrote, and closes at once: nothing is unsaved.
    if (fs::exists(MARCHBOX_BINARY)) {
        Child program{::fork()};
        if (program.pid == 0) {
            // The driver unloads itself before the leak checker of a sanitizer build looks, so that its own leaks have no name
            // to be suppressed by; the editor's own are looked for by the tests with no window.
            ::setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
            ::execl(MARCHBOX_BINARY, "marchbox", "edit", file.c_str(), static_cast<char*>(nullptr));
            ::_exit(127);
        }
        Running::xdo("search --sync --onlyvisible --name marchbox windowfocus >/dev/null");
        rest(1500);
        Running::xdo("key Escape");
        CHECK(program.wait() == 0);
    } else {
        WARN_MESSAGE(false, MARCHBOX_BINARY << " is not built: it was NOT opened");
    }
    fs::remove_all(folder);
}

TEST_CASE("with no display the editor says so and ends with 3; a scene at fault with 1, a missing one with 4") {
    const auto run = [](const std::string& scene) {
        Child child{::fork()};
        if (child.pid == 0) {
            ::unsetenv("DISPLAY"), ::unsetenv("WAYLAND_DISPLAY");
            std::freopen("/dev/null", "w", stderr);
            ::_exit(runEditor({.scene = scene, .width = 640, .height = 480, .after_frame = {}}));
        }
        return child.wait();
    };
    const fs::path bad = fs::temp_directory_path() / ("marchbox_bad_" + std::to_string(::getpid()) + ".txt");
    std::ofstream(bad) << "marchbox 1\nball\n";
    CHECK(run("") == 3);
    CHECK(run(bad.string()) == 1);
    CHECK(run("/nowhere/at/all.txt") == 4);
    fs::remove(bad);
}
