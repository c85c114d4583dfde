// A monkey at the mouse and the keys, the same one every time: whatever it does, the scene can be saved and read again.
#include "core/scene/text.h"
#include "hands.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <unistd.h>

#include <filesystem>
#include <random>

using namespace mb;

namespace {

constexpr int kEvents = 6000;
constexpr std::size_t kMostObjects = 60;

struct Monkey {
    Hands& hands;
    std::mt19937_64 random;

    std::size_t below(std::size_t n) { return static_cast<std::size_t>(random() % n); }
    float part() { return static_cast<float>(below(1001)) / 1000; }
    bool avoids(const ui::Seen& s) const { return s.label == "Save" || s.label == "Replace" || s.label == "Save as"; }

    void act() {
        const ImVec2 screen = ImGui::GetIO().DisplaySize;
        const ui::Seen* target = hands.seen.empty() ? nullptr : &hands.seen[below(hands.seen.size())];
        if (target && (!target->visible || avoids(*target))) target = nullptr;
        const ImVec2 at = target ? middle(*target, part()) : ImVec2{part() * screen.x, part() * screen.y};
        switch (below(12)) {
        case 0: hands.clickAt(at, 1); break;
        case 1: hands.moveTo(at), hands.wheel(part() * 4 - 2); break;
        case 2: case 3: {
            hands.moveTo(at);
            ImGui::GetIO().KeyShift = below(2) == 0;
            hands.press(0, true);
            hands.moveTo({at.x + 200 * (part() - 0.5f), at.y + 60 * (part() - 0.5f)});
            hands.press(0, false);
            ImGui::GetIO().KeyShift = false;
            break;
        }
        case 4: {
            constexpr int kKeys[] = {GLFW_KEY_SPACE, GLFW_KEY_J, GLFW_KEY_R, GLFW_KEY_PERIOD, GLFW_KEY_COMMA, GLFW_KEY_ESCAPE, GLFW_KEY_DELETE, GLFW_KEY_ENTER,
                                     GLFW_KEY_TAB, GLFW_KEY_BACKSPACE, GLFW_KEY_INSERT, GLFW_KEY_F1, GLFW_KEY_X};
            hands.key(kKeys[below(std::size(kKeys))]);
            break;
        }
        case 5: {
            constexpr const char* kTexts[] = {"1", "-7.5", "1e30", "nan", "99999999", "\"a b\\", "\xc3\xa9\n\t#", "union", "/0", "0"};
            ImGui::GetIO().KeyCtrl = true;
            hands.clickAt(at);
            ImGui::GetIO().KeyCtrl = false;
            hands.type(kTexts[below(std::size(kTexts))]);
            hands.key(GLFW_KEY_ENTER);
            break;
        }
        default: hands.clickAt(at); break;
        }
    }
};

void checkSavable(const Scene& scene) {
    const ReadResult read = readScene(writeScene(scene));
    REQUIRE_MESSAGE(read.ok(), describe(read.faults.front(), "the scene"));
    REQUIRE(sameScene(read.scene, scene));
}

}  // namespace

TEST_CASE("some thousand random events leave a scene that saves and reads back equal") {
    const auto before = std::filesystem::current_path();
    const auto folder = std::filesystem::temp_directory_path() / ("marchbox_monkey_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder / "saves");
    std::filesystem::current_path(folder);
    {
        Hands hands;
        for (const char* panel : {"Add object", "Materials", "Lights", "Constants", "Picture", "Debug", "Timeline", "Meters"}) hands.ui.show(panel);
        Monkey monkey{hands, std::mt19937_64{20}};
        for (int i = 0; i < kEvents; ++i) {
            monkey.act();
            hands.ui.quit = false;
            if (hands.editor.scene().objects.size() > kMostObjects) hands.editor.clear();
            if (hands.editor.playing() && i % 8 == 0) hands.editor.pause();
            if (i % 100 == 0) checkSavable(hands.editor.scene());
        }
        checkSavable(hands.editor.scene());
        const Camera eye = hands.editor.camera();
        CHECK(glm::length(eye.eye - eye.target) < 1e12);
        REQUIRE_FALSE(saveScene(folder / "monkey.txt", hands.editor.scene()));
        CHECK(sameScene(loadScene(folder / "monkey.txt").scene, hands.editor.scene()));
    }
    std::filesystem::current_path(before);
    std::filesystem::remove_all(folder);
}
