// The real window, on a display of its own (Xvfb), with a real mouse and keyboard (xdotool): open a file, add an object
// through the menus, save, close; and the file is what it should be.
#include "gui/window.h"
#include "core/render/gl.h"
#include "core/scene/text.h"
#include "gui/panels.h"
#include "gui/widgets.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

using namespace mb;
namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kPatience = std::chrono::seconds(25);

bool installed(const char* program) { return std::system(fmt::format("command -v {} >/dev/null 2>&1", program).c_str()) == 0; }
void rest(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

/// A child process, ended with its owner.
struct Child {
    pid_t pid = -1;
    ~Child() {
        if (pid > 0) ::kill(pid, SIGKILL), ::waitpid(pid, nullptr, 0);
    }
    /// The exit code, or nothing if it does not end in time.
    std::optional<int> wait() {
        for (const auto end = Clock::now() + kPatience; Clock::now() < end; rest(20)) {
            int status = 0;
            if (::waitpid(pid, &status, WNOHANG) != pid) continue;
            pid = -1;
            return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        }
        return std::nullopt;
    }
};

/// An X server with no screen to look at; `display` is empty if none comes up.
struct Display {
    Child server;
    std::string display;
    Display() {
        int ends[2];
        if (::pipe(ends) != 0) return;
        server.pid = ::fork();
        if (server.pid == 0) {
            ::close(ends[0]);
            std::freopen("/dev/null", "w", stderr);
            const std::string fd = std::to_string(ends[1]);
            ::execlp("Xvfb", "Xvfb", "-displayfd", fd.c_str(), "-screen", "0", "1280x800x24", "-nolisten", "tcp", static_cast<char*>(nullptr));
            ::_exit(127);
        }
        ::close(ends[1]);
        std::string number;
        for (char c = 0; ::read(ends[0], &c, 1) == 1 && c != '\n';) number += c;
        ::close(ends[0]);
        if (!number.empty()) display = ":" + number;
    }
};

/// The editor in a process of its own, which writes down after each frame where its controls are.
struct Running {
    fs::path folder;
    Child child;

    Running(const fs::path& in, const std::string& scene) : folder(in) {
        child.pid = ::fork();
        if (child.pid != 0) return;
        std::vector<ui::Seen> seen;
        ui::seen = &seen;
        const int code = runEditor({.scene = scene, .width = 1280, .height = 800, .after_frame = [&](const Ui&) {
            std::ofstream out(folder / "seen.new");
            if (const GLenum error = gl.GetError()) out << "gl error " << error << '\n';
            for (const ui::Seen& s : seen)
                if (s.visible) out << s.panel << '/' << s.label << '\t' << (s.min.x + s.max.x) / 2 << ' ' << (s.min.y + s.max.y) / 2 << '\n';
            out << "end\n";
            out.close();
            fs::rename(folder / "seen.new", folder / "seen");
            seen.clear();
        }});
        ::_exit(code);
    }

    /// Where that control is, once it is drawn.
    std::optional<std::pair<int, int>> find(const std::string& control) const {
        for (const auto end = Clock::now() + kPatience; Clock::now() < end; rest(30)) {
            std::ifstream in(folder / "seen");
            for (std::string line; std::getline(in, line);) {
                REQUIRE_FALSE(line.starts_with("gl error"));
                double x = 0, y = 0;
                if (!line.starts_with(control + '\t')) continue;
                std::istringstream(line.substr(control.size())) >> x >> y;
                return std::pair{static_cast<int>(x), static_cast<int>(y)};
            }
        }
        return std::nullopt;
    }
    void click(const std::string& control) const {
        const auto at = find(control);
        REQUIRE_MESSAGE(at, "not drawn: " << control);
        xdo(fmt::format("mousemove {} {}", at->first, at->second));
        rest(250);
        xdo("mousedown 1"), rest(250), xdo("mouseup 1"), rest(250);
    }
    static void xdo(const std::string& what) { REQUIRE(std::system(("xdotool " + what).c_str()) == 0); }
};

std::string contents(const fs::path& path) {
    std::ostringstream out;
    out << std::ifstream(path).rdbuf();
    return out.str();
}

}  // namespace

TEST_CASE("in the real window: add an object through the menus, save, close, compare the file") {
    for (const char* program : {"Xvfb", "xdotool"})
        if (!installed(program)) {
            WARN_MESSAGE(false, program << " is not installed: the real window was NOT tested");
            return;
        }
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
