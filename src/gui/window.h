#pragma once
// The editor in a window of its own: GLFW, OpenGL 3.3, Dear ImGui's back ends, and the loop.
#include <cstdint>
#include <functional>
#include <string>

namespace mb {

struct Ui;

struct EditorOptions {
    std::string scene;                            // opened at the start; empty: a new scene
    int width = 1280, height = 800;               // of the window, if the screen is as large
    std::uint64_t seed = 1;                       // where the throws begin
    std::function<void(const Ui&)> after_frame;   // called when each frame is on the screen
};

/// Runs the editor until it is closed. Returns the exit code: 0; 1 or 4 if the scene cannot be read, 3 if no window or no
/// OpenGL 3.3 can be had, with the reason on standard error.
int runEditor(const EditorOptions& options);

}  // namespace mb
