// The real window's frames: none where nothing changes or every body sleeps, and some all the time a program is compiled.
#include "real_window.h"

#include "core/scene/camera.h"

using namespace mb;

namespace {

/// The editor with the scene it begins with, on a display of its own, and a cache of shaders that is empty.
struct Session {
    fs::path folder = fs::temp_directory_path() / ("marchbox_rest_" + std::to_string(::getpid()));
    Display display;
    std::optional<Running> running;

    Session() {
        REQUIRE_FALSE(display.display.empty());
        fs::remove_all(folder), fs::create_directories(folder);
        ::setenv("DISPLAY", display.display.c_str(), 1);
        ::setenv("MESA_SHADER_CACHE_DIR", folder.c_str(), 1);
        ::unsetenv("WAYLAND_DISPLAY");
        running.emplace(folder, "");
        ::unsetenv("MESA_SHADER_CACHE_DIR");
    }
    ~Session() {
        running.reset();
        fs::remove_all(folder);
    }
    std::pair<int, int> atRest(const std::string& numbers) const {
        const auto found = running->atRest(numbers);
        REQUIRE_MESSAGE(found, "the editor does not come to rest");
        return *found;
    }
};

}  // namespace

TEST_CASE("in the real window: at rest no frame is drawn, an event draws some, and so it is while every body sleeps") {
    if (!canHaveWindow()) return;
    const Session session;
    const int still = session.atRest("frames").first;
    Running::xdo("mousemove 300 300");
    const int moved = session.atRest("frames").first;
    CHECK(moved > still);

    Running::xdo("key space");
    CHECK(session.atRest("motion") == std::pair(1, 1));
    const int asleep = session.atRest("frames").first;
    CHECK(asleep > moved + 10);  // the ball has fallen
    Running::xdo("key j");
    for (int i = 0; i < 200 && session.running->find("motion") != std::pair(1, 0); ++i) rest(50);
    CHECK(session.running->find("motion") == std::pair(1, 0));  // thrown, it rolls on
    CHECK(session.running->find("frames")->first > asleep);
}

TEST_CASE("in the real window: a material that begins to reflect is compiled behind frames that go on") {
    if (!canHaveWindow()) return;
    const Session session;
    const int first = session.atRest("frames").second;
    CHECK(first >= 1);  // the first picture is waited for, too
    session.running->click("menu/Edit");
    session.running->click("menu/Materials");
    const int before = session.atRest("frames").second;
    CHECK(before == first);
    session.running->click("Materials/Kr");  // the middle of its slider
    const int compiling = session.atRest("frames").second;
    CHECK(compiling > before);
    const auto [longest, all] = session.atRest("compiling");
    MESSAGE(fmt::format("{} frames in {} ms while the reflection was compiled; the longest took {} ms", compiling - before, all, longest));

    // The same slider once more moves a value, which compiles nothing.
    session.running->click("Materials/Kr");
    session.running->click("Materials/Ka");
    CHECK(session.atRest("frames").second == compiling);
}

TEST_CASE("in the real window: Shift and drag holds a body, which follows the mouse and never rests, and letting go throws it") {
    if (!canHaveWindow()) return;
    const Session session;
    session.atRest("frames");
    // The picture is what the column and the bars of a window of 1280x800 leave; the ball is half a metre wide in it.
    const Editor as_opened;
    const auto ball = pictureOf(as_opened.camera(), {940, 758}, as_opened.scene().objects[1].pos);
    REQUIRE(ball);
    const int x = static_cast<int>(ball->x), y = static_cast<int>(ball->y) + 21;
    Running::xdo(fmt::format("mousemove {} {}", x, y));
    rest(250);
    Running::xdo("keydown shift"), rest(100);
    Running::xdo("mousedown 1"), rest(250);
    Running::xdo("keyup shift");
    Running::xdo(fmt::format("mousemove {} {}", x + 100, y - 80));
    // The line from the body to the mouse is drawn; it gets short.
    const auto held = session.running->find("picture/held");
    CHECK(held);
    rest(2000);
    const auto later = session.running->find("picture/held");
    REQUIRE(later);
    CHECK(std::abs(later->first - (x + 100)) <= 12);
    CHECK(std::abs(later->second - (y - 80)) <= 12);
    CHECK(session.running->find("motion") == std::pair(1, 0));
    Running::xdo(fmt::format("mousemove {} {}", x + 200, y - 80));
    Running::xdo("mouseup 1");
    rest(700);
    CHECK(contents(session.folder / "seen").find("picture/held") == std::string::npos);
    CHECK(session.running->find("motion") == std::pair(1, 0));  // thrown, it rolls on
}
