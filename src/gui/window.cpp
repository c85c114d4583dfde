#include "gui/window.h"

#include "core/scene/text.h"
#include "gui/look.h"
#include "gui/panels.h"
#include "gui/viewport.h"
#include "gui/window_context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

namespace mb {
namespace {

constexpr double kFrameSeconds = 1.0 / 60;   // where the screen sets no pace
constexpr double kBlinkSeconds = 0.4;        // between frames while a text cursor blinks
constexpr int kFramesAfterEvent = 12;        // as long as Dear ImGui's slowest control takes to settle, which is a question's fading in

std::string g_glfw_error;

int fail(int code, const std::string& why) {
    std::fputs(fmt::format("marchbox: {}\n", why).c_str(), stderr);
    return code;
}

/// GLFW, for as long as this lives.
struct Glfw {
    bool ready;
    Glfw() {
        glfwSetErrorCallback([](int, const char* text) { g_glfw_error = text; });
        ready = glfwInit() == GLFW_TRUE;
    }
    ~Glfw() { glfwTerminate(); }
    Glfw(const Glfw&) = delete;
    Glfw& operator=(const Glfw&) = delete;
};

GLFWwindow* makeWindow(const EditorOptions& options) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SAMPLES, 0);
    glfwWindowHint(GLFW_ALPHA_BITS, 0);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    int x = 0, y = 0, width = options.width, height = options.height;
    if (GLFWmonitor* screen = glfwGetPrimaryMonitor()) glfwGetMonitorWorkarea(screen, &x, &y, &width, &height);
    width = width > 0 ? std::min(width, options.width) : options.width;
    height = height > 0 ? std::min(height, options.height) : options.height;
    return glfwCreateWindow(width, height, "marchbox", nullptr, nullptr);
}

/// Dear ImGui with its two back ends, for as long as this lives.
struct Panels {
    explicit Panels(GLFWwindow* window) {
        // Dear ImGui's back end, installed after this, calls it first.
        glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int mods) {
            auto* ui = static_cast<Ui*>(glfwGetWindowUserPointer(w));
            if (ui && action != GLFW_RELEASE && !(mods & (GLFW_MOD_ALT | GLFW_MOD_SUPER)))
                ui->pressed.push_back({key, (mods & GLFW_MOD_CONTROL) != 0, action == GLFW_REPEAT});
        });
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;
        float scale = 1, ignored = 1;
        glfwGetWindowContentScale(window, &scale, &ignored);
        setLook(std::clamp(scale, 1.0f, 4.0f));
        ImGui_ImplGlfw_InitForOpenGL(window, true);
        ImGui_ImplOpenGL3_Init("#version 330 core");
    }
    ~Panels() {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    Panels(const Panels&) = delete;
    Panels& operator=(const Panels&) = delete;
};

/// Waits for something to happen if nothing moves, and keeps a pace where the screen keeps none.
class Pace {
public:
    /// Lets events in, and waits for one, `most` seconds at most, while nothing moves. Returns the wall time since the last call.
    double next(bool moving, double most) {
        if (moving || awake_ > 0) {
            --awake_;
            const double rest = last_ + kFrameSeconds - glfwGetTime();
            if (rest > 0) std::this_thread::sleep_for(std::chrono::duration<double>(rest));
            glfwPollEvents();
        } else {
            const double until = glfwGetTime() + most;
            std::isfinite(most) ? glfwWaitEventsTimeout(most) : glfwWaitEvents();
            if (glfwGetTime() < until) awake_ = kFramesAfterEvent;
        }
        if (moving) awake_ = std::max(awake_, 1);
        const double now = glfwGetTime(), passed = now - last_;
        last_ = now;
        average_ = awake_ > 0 ? (average_ > 0 ? average_ + 0.1 * (passed - average_) : passed) : 0;
        return passed;
    }
    double framesPerSecond() const { return average_ > 0 ? 1 / average_ : 0; }

private:
    double last_ = glfwGetTime(), average_ = 0;
    int awake_ = kFramesAfterEvent;
};

/// How long a picture of the panels that nothing has changed stays as it is.
double staysFor(const Ui& ui) {
    const double message = std::max(ui.message_until - ImGui::GetTime(), 0.0);
    return ImGui::GetIO().WantTextInput ? std::min(message, kBlinkSeconds) : message;
}

void setTitle(GLFWwindow* window, const Editor& editor, std::string& shown) {
    const std::string name = editor.path().empty() ? "new scene" : editor.path().filename().string();
    std::string title = fmt::format("{}{} - marchbox", editor.unsaved() ? "*" : "", name);
    if (title == shown) return;
    glfwSetWindowTitle(window, title.c_str());
    shown = std::move(title);
}

void drawFrame(GLFWwindow* window, Ui& ui, Viewport& viewport) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    // A key that is up again already counts as down for this frame.
    std::vector<int> tapped;
    for (const KeyPress& press : ui.pressed)
        if (press.key >= 0 && !ImGui::GetIO().KeysDown[press.key]) ImGui::GetIO().KeysDown[press.key] = true, tapped.push_back(press.key);
    ImGui::NewFrame();
    for (const int key : tapped) ImGui::GetIO().KeysDown[key] = false;
    handleInput(ui);
    drawInterface(ui);
    ImGui::Render();

    glm::ivec2 pixels{0};
    glfwGetFramebufferSize(window, &pixels.x, &pixels.y);
    const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
    const glm::ivec2 size{static_cast<int>(ui.picture_size.x * scale.x), static_cast<int>(ui.picture_size.y * scale.y)};
    const int top = static_cast<int>(ui.picture_corner.y * scale.y);
    viewport.show(ui.editor, pixels, {static_cast<int>(ui.picture_corner.x * scale.x), pixels.y - top - size.y}, size, ui.picture);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(window);
}

void loop(WindowContext& context, Editor& editor, const EditorOptions& options) {
    GLFWwindow* window = context.window();
    Panels panels(window);
    std::string why;
    auto compiler = Compiler::start(context, why);
    if (!compiler) std::fputs(fmt::format("marchbox: new programs will be waited for: {}\n", why).c_str(), stderr);
    Viewport viewport(std::move(compiler));
    Ui ui(editor);
    glfwSetWindowUserPointer(window, &ui);
    Pace pace;
    std::string title;
    while (!ui.quit) {
        // A button held down may repeat what it does.
        const double passed = pace.next(viewport.busy() || ui.pricing_motion || ui.accuracy.sweeping_motion || editor.moving() || ImGui::IsAnyMouseDown(), staysFor(ui));
        ui.frames_per_second = pace.framesPerSecond();
        editor.advance(passed);
        if (glfwWindowShouldClose(window)) {
            glfwSetWindowShouldClose(window, GLFW_FALSE);
            ui.unlessUnsaved([&ui] { ui.quit = true; });
        }
        setTitle(window, editor, title);
        drawFrame(window, ui, viewport);
        if (options.after_frame) options.after_frame(ui);
    }
    glfwSetWindowUserPointer(window, nullptr);
}

}  // namespace

int runEditor(const EditorOptions& options) {
    Editor editor;
    editor.seedThrows(options.seed);
    if (!options.scene.empty()) {
        const LoadResult loaded = loadScene(options.scene);
        for (const Fault& fault : loaded.faults) std::fputs((describe(fault, options.scene) + "\n").c_str(), stderr);
        if (!loaded.disk_fault.empty()) return fail(4, loaded.disk_fault);
        if (!loaded.ok()) return 1;
        editor.open(options.scene);
    }
    const Glfw glfw;
    if (!glfw.ready) return fail(3, fmt::format("no window can be opened: {}", g_glfw_error));
    GLFWwindow* window = makeWindow(options);
    if (!window) return fail(3, fmt::format("no window with OpenGL 3.3 can be had: {}", g_glfw_error));
    WindowContext context(window, true);
    const std::string why = context.makeCurrent();
    if (why.empty()) glfwSwapInterval(1), loop(context, editor, options);
    return why.empty() ? 0 : fail(3, why);
}

}  // namespace mb
