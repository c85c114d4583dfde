#pragma once
// Hands for the tests: a Dear ImGui context with no window, and a mouse and a keyboard that press what is drawn.
#include "gui/panels.h"
#include "gui/widgets.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <string>

namespace mb {

class Hands {
public:
    explicit Hands(ImVec2 screen = {1280, 800});
    ~Hands();
    Hands(const Hands&) = delete;
    Hands& operator=(const Hands&) = delete;

    Editor editor;
    Ui ui{editor};

    /// Draws frames as the window's loop does.
    void frame(int count = 1);
    /// The control of that label in that panel, or null.
    const ui::Seen* find(const std::string& panel, const std::string& label) const;
    /// The same; scrolls it into view, and fails the test if it is not there.
    ui::Seen get(const std::string& panel, const std::string& label);

    void moveTo(ImVec2 at) { ImGui::GetIO().MousePos = at, frame(); }
    void press(int button, bool down) { ImGui::GetIO().MouseDown[button] = down, frame(); }
    void clickAt(ImVec2 at, int button = 0) { moveTo(at), frame(), press(button, true), press(button, false), frame(2); }
    void click(const std::string& panel, const std::string& label);
    /// Opens a menu and clicks on one of its entries.
    void menu(const std::string& menu, const std::string& entry) { click("menu", menu), click("menu", entry); }
    /// Drags from a part (0 to 1) of a slider's width to another.
    void drag(const std::string& panel, const std::string& label, float from, float to);
    /// Ctrl+clicks a slider and types into it.
    void typeInto(const std::string& panel, const std::string& label, const std::string& text);
    /// Clicks into a text field, replaces what is there, and leaves it.
    void fill(const std::string& panel, const std::string& label, const std::string& text);
    void key(int key, bool ctrl = false);
    void type(const std::string& text);
    void wheel(float notches) { ImGui::GetIO().MouseWheel = notches, frame(); }

    std::vector<ui::Seen> seen;  // of the last frame
};

ImVec2 middle(const ui::Seen& seen, float part = 0.5f);

}  // namespace mb
