#pragma once
// The context of a GLFW window, which goes with it. Windows are made and ended on the main thread.
#include "core/render/context.h"

struct GLFWwindow;

namespace mb {

class WindowContext final : public Context {
public:
    WindowContext(GLFWwindow* window, bool first) : window_(window), first_(first) {}
    ~WindowContext() override;
    WindowContext(const WindowContext&) = delete;
    WindowContext& operator=(const WindowContext&) = delete;

    std::string makeCurrent() override;
    void release() override;
    /// That of a window nobody sees.
    std::unique_ptr<Context> makeShared(std::string& why) override;
    std::string_view name() const override { return "window"; }
    GLFWwindow* window() const { return window_; }

private:
    GLFWwindow* window_;
    bool first_;  // of those that share: it loads the functions
};

}  // namespace mb
