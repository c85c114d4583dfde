#pragma once
// The real window, on a display of its own (Xvfb), with a real mouse and keyboard (xdotool), for tests.
#include "core/render/gl.h"
#include "gui/panels.h"
#include "gui/widgets.h"
#include "gui/window.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

namespace mb {
namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;
inline constexpr auto kPatience = std::chrono::seconds(25);

inline bool installed(const char* program) { return std::system(fmt::format("command -v {} >/dev/null 2>&1", program).c_str()) == 0; }
inline void rest(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

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

/// Whether the programs that make a window and a hand are there; says so where one is missing.
inline bool canHaveWindow() {
    for (const char* program : {"Xvfb", "xdotool"})
        if (!installed(program)) {
            WARN_MESSAGE(false, program << " is not installed: the real window was NOT tested");
            return false;
        }
    return true;
}

/// The frames of an editor.
struct Frames {
    int drawn = 0, compiling = 0;  // all, and those that said "compiling"
    double longest = 0, all = 0;   // ms, of the last of those in a row
    bool went_on = false;
    double longest_measuring = 0;  // ms, of those in which a sweep went on
    bool measured = false;
    Clock::time_point last = Clock::now();

    void add(const PictureState& picture) {
        const double ms = std::chrono::duration<double, std::milli>(Clock::now() - last).count();
        if (std::exchange(measured, picture.sweeping)) longest_measuring = std::max(longest_measuring, ms);
        last = Clock::now();
        ++drawn;
        // The first in a row may have come after a rest; the one after the last has drawn the new picture, too.
        if (picture.compiling && !went_on) longest = all = 0;
        if (went_on) longest = std::max(longest, ms), all += ms;
        went_on = picture.compiling;
        compiling += went_on;
    }
};

/// The editor in a process of its own, which writes down after each frame where its controls are and how it fares.
struct Running {
    fs::path folder;
    Child child;

    Running(const fs::path& in, const std::string& scene) : folder(in) {
        child.pid = ::fork();
        if (child.pid != 0) return;
        std::vector<ui::Seen> seen;
        ui::seen = &seen;
        Frames frames;
        const int code = runEditor({.scene = scene, .width = 1280, .height = 800, .after_frame = [&](const Ui& ui) {
            frames.add(ui.picture);
            std::ofstream out(folder / "seen.new");
            if (const GLenum error = gl.GetError()) out << "gl error " << error << '\n';
            for (const ui::Seen& s : seen)
                if (s.visible) out << s.panel << '/' << s.label << '\t' << (s.min.x + s.max.x) / 2 << ' ' << (s.min.y + s.max.y) / 2 << '\n';
            out << "frames\t" << frames.drawn << ' ' << frames.compiling << "\ncompiling\t" << frames.longest << ' ' << frames.all << '\n';
            out << "sweep\t" << (ui.picture.sweep ? ui.picture.sweep->runs().size() : 0) << ' ' << frames.longest_measuring << '\n';
            out << "motion\t" << ui.editor.playing() << ' ' << ui.editor.simulation().asleep() << "\nend\n";
            out.close();
            fs::rename(folder / "seen.new", folder / "seen");
            seen.clear();
        }});
        ::_exit(code);
    }

    /// Where that control is, once it is drawn; or two numbers of that name.
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
    /// The two numbers of that name as they are when no frame was drawn for a second; nothing if that does not come.
    std::optional<std::pair<int, int>> atRest(const std::string& numbers) const {
        for (const auto end = Clock::now() + kPatience; Clock::now() < end;) {
            const auto before = find("frames");
            rest(1000);
            if (before && find("frames") == before) return find(numbers);
        }
        return std::nullopt;
    }
    static void xdo(const std::string& what) { REQUIRE(std::system(("xdotool " + what).c_str()) == 0); }
};

inline std::string contents(const fs::path& path) {
    std::ostringstream out;
    out << std::ifstream(path).rdbuf();
    return out.str();
}

}  // namespace mb
