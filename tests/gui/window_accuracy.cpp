// What accuracy costs, in a real window: the viewport measures behind frames that go on, and shows where the picture is wrong.
#include "real_window.h"
#include "core/accuracy/knobs.h"
#include "core/render/picture.h"
#include "gui/viewport.h"
#include "gui/window_context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

using namespace mb;

namespace {

constexpr glm::ivec2 kWindow{400, 300}, kCorner{37, 21}, kPicture{330, 240};

/// A viewport on a window of its own, in a process of its own.
struct Shown {
    WindowContext context;
    Editor editor;
    std::optional<Viewport> viewport;
    PictureState state;

    Shown() : context(window(), true) {
        if (context.makeCurrent().empty()) viewport.emplace(nullptr);
    }
    static GLFWwindow* window() {
        if (glfwInit() != GLFW_TRUE) return nullptr;
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3), glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE), glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
        return glfwCreateWindow(kWindow.x, kWindow.y, "test", nullptr, nullptr);
    }
    void frame(glm::ivec2 size = kPicture) { viewport->show(editor, kWindow, kCorner, size, state); }
    template <class F> bool until(F done) {
        for (const auto end = Clock::now() + kPatience; Clock::now() < end;)
            if (frame(), done()) return true;
        return false;
    }
    /// Of the picture's bytes on the window, how many are not the map's, enlarged; but for the last row and column of each of its pixels,
    /// which rounding may give to the next.
    int wrongBytes(const std::vector<glm::vec3>& map, glm::ivec2 pixels) const {
        const std::vector<std::uint8_t> wanted = encodeSrgb(map);
        std::vector<std::uint8_t> shown(3 * static_cast<std::size_t>(kPicture.x) * static_cast<std::size_t>(kPicture.y));
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
        gl.ReadPixels(kCorner.x, kCorner.y, kPicture.x, kPicture.y, GL_RGB, GL_UNSIGNED_BYTE, shown.data());
        int wrong = 0;
        for (int y = 0; y < pixels.y; ++y)
            for (int x = 0; x < pixels.x; ++x)
                for (int c = 0; c < 3; ++c) {
                    const int at_x = static_cast<int>((x + 0.5) * kPicture.x / pixels.x), at_y = kPicture.y - 1 - static_cast<int>((y + 0.5) * kPicture.y / pixels.y);
                    wrong += std::abs(wanted[static_cast<std::size_t>(3 * (y * pixels.x + x) + c)] - shown[static_cast<std::size_t>(3 * (at_y * kPicture.x + at_x) + c)]) > 1;
                }
        return wrong;
    }
};

/// 0, or the number of what did not hold.
int errorView(bool with_sweep) {
    Shown s;
    if (!s.viewport) return 1;
    if (with_sweep) s.state.sweep.emplace(s.editor.scene(), Frame{s.editor.camera(), kPicture / 6, 6}, PictureSweep::Plan{false, 0, 1}), s.state.sweeping = true;
    s.state.errors_wanted = true;
    if (!s.until([&] { return s.state.errors_shown; })) return 2;
    const Frame frame{s.editor.camera(), with_sweep ? kPicture / 6 : kPicture / 3, with_sweep ? 6 : 3};
    const auto mapOf = [&] {
        TruePictureWork truth(s.editor.scene(), frame);
        truth.finish();
        Renderer renderer;
        DrawnPicture picture;
        Values<Cost> costs;
        drawn(renderer, s.editor.scene(), frame, picture, costs);
        return errorMap(picture, truth.picture());
    };
    const std::vector<glm::vec3> before = mapOf();
    s.frame();
    if (s.wrongBytes(before, frame.size) > 0) return 3;
    if (with_sweep && !s.until([&] { return !s.state.sweeping; })) return 4;

    // Knobs make another map, of the same truth.
    RenderKnobs knobs = s.editor.scene().render;
    knobs.samples = 4;
    s.editor.setRender(knobs);
    s.frame();
    if (s.state.errors_shown || !s.until([&] { return s.state.errors_shown; })) return 5;
    const std::vector<glm::vec3> after = mapOf();
    s.frame();
    if (s.wrongBytes(after, frame.size) > 0 || s.wrongBytes(before, frame.size) == 0) return 6;

    // At rest it stays; another view is none of it.
    if (!s.until([&] { return !s.viewport->busy(); })) return 7;
    if (s.wrongBytes(after, frame.size) > 0) return 8;
    s.editor.turn(0.05, 0);
    s.frame();
    if (s.state.errors_wanted || s.state.errors_note.empty() || s.wrongBytes(after, frame.size) == 0) return 9;
    return gl.GetError() == GL_NO_ERROR ? 0 : 10;
}

/// A sweep that is asked for is made and goes on, frame by frame.
int sweepWanted() {
    Shown s;
    if (!s.viewport) return 1;
    s.state.sweep_wanted = true;
    if (!s.until([&] { return s.state.sweep && s.state.sweep->runs().size() > 4; })) return 2;
    if (s.state.sweep_wanted || !s.state.sweeping || !s.viewport->busy()) return 3;
    const Frame& frame = s.state.sweep->frame();
    if (frame.size != kPicture / frame.stride) return 4;
    s.state.sweeping = false;
    return s.until([&] { return !s.viewport->busy(); }) ? 0 : 5;
}

int inChild(const std::function<int()>& what) {
    const Display display;
    REQUIRE_FALSE(display.display.empty());
    ::setenv("DISPLAY", display.display.c_str(), 1);
    ::unsetenv("WAYLAND_DISPLAY");
    Child child{::fork()};
    if (child.pid == 0) ::_exit(what());
    return child.wait().value_or(-1);
}

}  // namespace

TEST_CASE("in a real window: the error view is the map of errors, follows the knobs, and goes where the view does") {
    if (!canHaveWindow()) return;
    CHECK(inChild([] { return errorView(false); }) == 0);
    CHECK(inChild([] { return errorView(true); }) == 0);
}

TEST_CASE("in a real window: a sweep is made of what is shown, a part each frame") {
    if (!canHaveWindow()) return;
    CHECK(inChild(sweepWanted) == 0);
}

TEST_CASE("in a real window: Measure draws curves behind frames that go on") {
    if (!canHaveWindow()) return;
    const Display display;
    REQUIRE_FALSE(display.display.empty());
    ::setenv("DISPLAY", display.display.c_str(), 1);
    ::unsetenv("WAYLAND_DISPLAY");
    const fs::path folder = fs::temp_directory_path() / ("marchbox_accuracy_" + std::to_string(::getpid()));
    fs::remove_all(folder), fs::create_directories(folder);
    {
        const Running running(folder, "");
        running.click("menu/Settings");
        running.click("menu/Accuracy");
        running.click("Accuracy/Measure");
        std::pair<int, int> sweep{0, 0};
        for (int i = 0; i < 600 && sweep.first < 20; ++i) rest(50), sweep = running.find("sweep").value_or(sweep);
        CHECK(sweep.first >= 20);
        const int frames = running.find("frames")->first;
        running.click("Accuracy/Show errors");
        CHECK(running.find("frames")->first > frames);
        running.click("Accuracy/Stop");
        CHECK(running.atRest("sweep"));
        MESSAGE(fmt::format("{} settings measured; the longest frame meanwhile took {} ms", sweep.first, running.find("sweep")->second));
    }
    fs::remove_all(folder);
}
