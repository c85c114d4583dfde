#include "gui/window_context.h"

#include "core/render/loader.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace mb {

WindowContext::~WindowContext() { glfwDestroyWindow(window_); }

std::string WindowContext::makeCurrent() {
    glfwMakeContextCurrent(window_);
    return first_ ? loadOpenGl(glfwGetProcAddress) : std::string{};
}

void WindowContext::release() { glfwMakeContextCurrent(nullptr); }

std::unique_ptr<Context> WindowContext::makeShared(std::string& why) {
    // All other hints are still those of the first window.
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    GLFWwindow* hidden = glfwCreateWindow(16, 16, "", nullptr, window_);
    glfwWindowHint(GLFW_VISIBLE, GLFW_TRUE);
    if (hidden) return std::make_unique<WindowContext>(hidden, false);
    const char* text = nullptr;
    glfwGetError(&text);
    why = text ? text : "no second context can be had";
    return nullptr;
}

}  // namespace mb
