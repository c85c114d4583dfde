// The hand in the picture: what the mouse holds, throws and blows up; and what the meters read.
#include "core/scene/camera.h"
#include "hands.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace mb;

namespace {

/// Where the ball of the editor's first scene is on the screen.
ImVec2 ballOnScreen(const Hands& h) {
    const auto at = pictureOf(h.editor.camera(), pictureSize(h.ui), h.editor.scene().objects[1].pos);
    REQUIRE(at);
    return {h.ui.picture_corner.x + static_cast<float>(at->x), h.ui.picture_corner.y + static_cast<float>(at->y)};
}
glm::dvec3 ball(const Hands& h) { return h.editor.scene().objects[1].pos; }
void shift(bool down) { ImGui::GetIO().KeyShift = down; }

}  // namespace

TEST_CASE("Shift and drag: a body is held by the point under the mouse, follows it, and is thrown when it is let go") {
    Hands h;
    const ImVec2 at = ballOnScreen(h);
    const Camera eye = h.editor.camera();
    shift(true);
    h.moveTo(at), h.press(0, true);
    REQUIRE(h.ui.holding);
    CHECK(h.editor.playing());
    const Editor::Held start = *h.editor.held();
    CHECK(glm::length(start.place - ball(h)) == doctest::Approx(0.5).epsilon(0.02));  // on its surface
    shift(false);  // only the press asks for it
    const ImVec2 to{at.x + 120, at.y - 150};
    h.moveTo(to), h.frame(150);
    const Editor::Held held = *h.editor.held();
    CHECK(glm::length(held.hand - start.hand) > 0.5);
    // In the plane that faces the eye, and under the mouse.
    CHECK(glm::dot(held.hand - start.hand, viewOf(eye).forward) == doctest::Approx(0).epsilon(1e-9));
    const auto shown = pictureOf(eye, pictureSize(h.ui), held.hand);
    REQUIRE(shown);
    CHECK(std::fabs(shown->x + static_cast<double>(h.ui.picture_corner.x - to.x)) <= 1);  // of a pixel's corner or its middle
    CHECK(std::fabs(shown->y + static_cast<double>(h.ui.picture_corner.y - to.y)) <= 1);
    CHECK(glm::length(held.place - held.hand) < 0.03);  // it hangs there: the spring gives way by a centimetre
    CHECK(glm::length(h.editor.camera().eye - eye.eye) == 0);  // and the view did not turn
    const ui::Seen* line = h.find("picture", "held");
    REQUIRE(line);
    CHECK(line->max.x == doctest::Approx(to.x).epsilon(5e-3));
    // A quick movement, and it flies on.
    for (int i = 1; i <= 10; ++i) h.moveTo({to.x + 15.0f * static_cast<float>(i), to.y});
    h.press(0, false);
    CHECK_FALSE(h.ui.holding);
    CHECK_FALSE(h.editor.held());
    h.frame();
    CHECK(h.editor.simulation().timeline()->world().grabs().empty());
    CHECK(glm::length(h.editor.scene().objects[1].vel) > 1.5);
    // All of it is in the recording, which makes the same again.
    RecordingResult again = readRecording(writeRecording(h.editor.timeline()->recording()));
    REQUIRE(again.ok());
    CHECK_FALSE(replay(std::move(again.recording)));
}

TEST_CASE("without a body under it, or without Shift, a left drag turns the view as ever") {
    Hands h;
    shift(true);
    h.moveTo({300, 700}), h.press(0, true);  // the floor
    CHECK_FALSE(h.ui.holding);
    CHECK_FALSE(h.editor.playing());
    const glm::dvec3 eye = h.editor.camera().eye;
    h.moveTo({400, 700});
    CHECK(glm::length(h.editor.camera().eye - eye) > 0.1);
    h.press(0, false), shift(false);
    h.moveTo(ballOnScreen(h)), h.press(0, true);
    CHECK_FALSE(h.ui.holding);
    h.press(0, false);
}

TEST_CASE("whatever happens to what is held, nothing stays held when the mouse lets go") {
    const auto hold = [](Hands& h) {
        shift(true);
        h.moveTo(ballOnScreen(h)), h.press(0, true);
        shift(false);
        REQUIRE(h.ui.holding);
        h.moveTo({h.ui.picture_corner.x + 500, 200}), h.frame(30);
        REQUIRE(h.editor.held());
    };
    SUBCASE("it goes back in time, and on from where it was held") {
        Hands h;
        hold(h);
        h.key(GLFW_KEY_COMMA);
        CHECK_FALSE(h.editor.held());
        h.press(0, false);
        CHECK(h.editor.timeline()->world().grabs().size() == 1);  // it was held then
        h.editor.throwAbout();
        h.frame(10);
        CHECK(h.editor.timeline()->world().grabs().empty());
        CHECK_FALSE(h.editor.message().error);
    }
    SUBCASE("it is deleted") {
        Hands h;
        hold(h);
        h.editor.remove(h.editor.scene().objects[1].id);
        h.frame(5);
        CHECK_FALSE(h.editor.held());
        h.press(0, false), h.frame(5);
    }
    SUBCASE("the scene is reset") {
        Hands h;
        hold(h);
        h.key(GLFW_KEY_R);
        CHECK_FALSE(h.editor.held());
        h.press(0, false), h.frame(5);
        CHECK(ball(h).y == 1.5);
    }
    SUBCASE("time stands still") {
        Hands h;
        hold(h);
        h.editor.pause();
        const glm::dvec3 before = ball(h);
        h.moveTo({h.ui.picture_corner.x + 300, 300}), h.frame(5);
        CHECK(ball(h) == before);
        REQUIRE(h.editor.held());
        h.press(0, false);
        h.editor.play();
        h.frame(3);
        CHECK(h.editor.timeline()->world().grabs().empty());
    }
}

TEST_CASE("X blows the bodies away from what is under the mouse") {
    Hands h;
    const ImVec2 at = ballOnScreen(h);
    h.moveTo({at.x, at.y + 60});  // its lower half
    h.key(GLFW_KEY_X);
    CHECK(h.editor.playing());
    CHECK(h.editor.scene().objects[1].vel.y > 2);
    CHECK(h.editor.timeline()->recording().actions.back().kind->name == "explode");
}

TEST_CASE("X says so where nothing is seen; over a panel, the middle of the picture counts") {
    Hands h;
    h.moveTo({h.ui.picture_corner.x + 30, h.ui.picture_corner.y + 10});
    h.key(GLFW_KEY_X);
    CHECK(h.editor.message().error);
    CHECK_FALSE(h.editor.playing());
    h.moveTo({1270, 400});
    h.key(GLFW_KEY_X);
    CHECK(h.editor.playing());
}

TEST_CASE("Meters: what a falling ball has, and the history that goes back with the time") {
    Hands h;
    h.menu("Motion", "Meters");
    h.frame(2);
    CHECK(h.find("Meters", "angular momentum"));
    CHECK(h.find("Meters", "energy history"));
    REQUIRE(h.ui.meters.moments.size() == 1);
    CHECK(h.ui.meters.moments.front().energy == doctest::Approx(9.81 * 1.5));
    h.editor.play();
    h.frame(20);  // it is in the air
    const Meters::Moment last = h.ui.meters.moments.back();
    CHECK(h.ui.meters.moments.size() > 10);
    CHECK(last.step == h.editor.simulation().steps());
    CHECK(last.kinetic > 1);
    CHECK(last.energy == doctest::Approx(9.81 * 1.5).epsilon(1e-3));
    h.frame(600);
    CHECK(h.ui.meters.moments.size() <= Meters::kMost);
    h.editor.seek(last.step), h.frame();
    CHECK(h.ui.meters.moments.back().step == last.step);
    CHECK(h.ui.meters.moments.back().energy == last.energy);
    h.menu("Motion", "Meters");
    const std::size_t seen = h.ui.meters.moments.size();
    h.editor.play(), h.frame(10);
    CHECK(h.ui.meters.moments.size() == seen);  // closed, it asks nothing
}
