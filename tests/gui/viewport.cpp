// What the viewport puts on a window, pixel by pixel, against the renderer's own picture.
#include "real_window.h"
#include "core/render/picture.h"
#include "gui/viewport.h"
#include "gui/window_context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

using namespace mb;

namespace {

constexpr glm::ivec2 kWindow{400, 300}, kCorner{37, 21}, kPicture{331, 243};

/// How many of the picture's bytes on the window differ by more than a step from the picture that the renderer reads; a negative
/// number where there is nothing to compare. Needs the window's context current.
int wrongBytes(double scale, int samples) {
    Editor editor;
    RenderKnobs knobs = editor.scene().render;
    knobs.scale = scale, knobs.samples = samples;
    editor.setRender(knobs);
    Viewport viewport(nullptr);
    PictureState state;
    const glm::ivec2 drawn = rasterOf(kPicture, scale).drawn;
    auto last = Clock::now();  // that it was not refined, which begins after kStillMs
    for (const auto end = last + kPatience; Clock::now() < end && Clock::now() < last + std::chrono::milliseconds(700);) {
        viewport.show(editor, kWindow, kCorner, kPicture, state);
        if (state.refining || state.drawn != drawn) last = Clock::now();
    }
    if (state.refining || state.drawn != drawn || state.full != kPicture) return -1;

    std::vector<std::uint8_t> shown(3 * static_cast<std::size_t>(kPicture.x) * static_cast<std::size_t>(kPicture.y));
    viewport.show(editor, kWindow, kCorner, kPicture, state);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(kCorner.x, kCorner.y, kPicture.x, kPicture.y, GL_RGB, GL_UNSIGNED_BYTE, shown.data());

    Renderer renderer;
    if (!renderer.draw(editor.scene(), editor.camera(), kPicture).empty()) return -2;
    const std::vector<std::uint8_t> wanted = encodeSrgb(renderer.readShown());
    int wrong = 0;
    const std::size_t row = 3 * static_cast<std::size_t>(kPicture.x);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const std::size_t from_bottom = (static_cast<std::size_t>(kPicture.y) - 1 - i / row) * row + i % row;
        wrong += std::abs(wanted[i] - shown[from_bottom]) > 1;
    }
    return wrong;
}

/// All of them in one window, since a display that its last window leaves begins anew. Returns how many were wrong.
int wrongPictures() {
    if (glfwInit() != GLFW_TRUE) return -1;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3), glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE), glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    WindowContext context(glfwCreateWindow(kWindow.x, kWindow.y, "test", nullptr, nullptr), true);
    if (!context.window() || !context.makeCurrent().empty()) return -1;
    int wrong = 0;
    for (const double scale : {1.0, 0.5, 0.37, 0.05})
        for (const int samples : {1, 4})
            if (const int bytes = wrongBytes(scale, samples); bytes != 0) {
                ++wrong;
                std::fputs(fmt::format("scale {}, samples {}: {} bytes are wrong\n", scale, samples, bytes).c_str(), stderr);
            }
    return wrong;
}

}  // namespace

TEST_CASE("in a real window: once refined, what is shown is the picture, drawn whole or with a share of its pixels") {
    if (!canHaveWindow()) return;
    const Display display;
    REQUIRE_FALSE(display.display.empty());
    ::setenv("DISPLAY", display.display.c_str(), 1);
    ::unsetenv("WAYLAND_DISPLAY");
    Child child{::fork()};
    if (child.pid == 0) ::_exit(wrongPictures());
    CHECK(child.wait() == 0);
}
