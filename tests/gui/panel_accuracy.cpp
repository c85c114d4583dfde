// The Accuracy panel, driven by a mouse over a sweep of a small picture.
#include "core/accuracy/front.h"
#include "core/render/budget.h"
#include "hands.h"
#include "render/headless.h"

#include <fmt/format.h>

using namespace mb;

namespace {

/// Hands with the panel open, and a sweep of what the editor shows in progress.
struct Measuring {
    HeadlessRenderer gpu;
    Hands hands;

    Measuring() {
        hands.menu("Settings", "Accuracy");
        hands.ui.picture.sweep.emplace(hands.editor.scene(), Frame{hands.editor.camera(), {20, 12}, 4}, PictureSweep::Plan{true, 10, 1});
        hands.ui.picture.sweeping = true;
        hands.frame(2);
    }
    PictureSweep& sweep() { return *hands.ui.picture.sweep; }
    const std::vector<Run>& runs() { return sweep().runs(); }
    bool step() { return hands.ui.picture.sweeping = sweep().step(*gpu.renderer); }
    void finish() {
        while (step()) {}
        hands.frame(2);
        hands.ui.stopMeasuring();
        hands.frame(2);
    }
    Setting setting() { return settingOf(hands.editor.scene()); }
    /// Whether the knobs are as that run had them, or as one had them that lies at its very place.
    bool isAt(std::size_t run) {
        return std::ranges::any_of(runs(), [&](const Run& r) {
            return r.errors[Error::color] == runs()[run].errors[Error::color] && r.costs[Cost::evaluations] == runs()[run].costs[Cost::evaluations] && sameKnobs(r.setting, setting(), false);
        });
    }
    /// The cheapest of the line, which is not the scene's own.
    std::size_t cheap() { return frontOf(runs(), Error::color, Cost::evaluations).front(); }
};

std::string colorPoint(std::size_t run) { return fmt::format("All settings: color {}", run); }

}  // namespace

TEST_CASE("Accuracy: before anything is measured it asks for a sweep, and stops it") {
    Hands h;
    h.key(GLFW_KEY_F3);
    REQUIRE(h.ui.isOpen("Accuracy"));
    h.click("Accuracy", "Measure");
    CHECK(h.ui.picture.sweep_wanted);
    h.click("Accuracy", "Stop");
    CHECK_FALSE(h.ui.picture.sweep_wanted);
    h.click("Accuracy", "Measure");
    h.key(GLFW_KEY_F3);  // nobody waits for it
    CHECK_FALSE(h.ui.picture.sweep_wanted);
}

TEST_CASE("Accuracy: the curves grow while the sweep does; each knob has its own") {
    Measuring m;
    CHECK(m.hands.find("Accuracy", "All settings: color"));
    CHECK_FALSE(m.hands.find("Accuracy", colorPoint(0)));
    while (m.runs().size() < 3) m.step();
    m.hands.frame();
    CHECK(m.hands.find("Accuracy", colorPoint(0)));
    CHECK_FALSE(m.hands.find("Accuracy", colorPoint(5)));
    while (m.runs().size() < 6) m.step();
    m.hands.frame();
    CHECK(m.hands.find("Accuracy", colorPoint(5)));

    m.hands.click("Accuracy", "Stop");
    CHECK_FALSE(m.hands.ui.picture.sweeping);
    m.hands.click("Accuracy", "Go on");
    CHECK(m.hands.ui.picture.sweeping);
    m.finish();
    for (const Knob* knob : m.sweep().knobs()) {
        CAPTURE(knob->key);
        m.hands.click("Accuracy", "curves");
        m.hands.click("Accuracy", fmt::format("{} ({})", knob->title, knob->key));
        CHECK(m.hands.find("Accuracy", fmt::format("{}: {}", knob->key, rowOf(knob->moves.front()).name)));
    }
}

TEST_CASE("Accuracy: a click on a point sets the knobs, and the ring follows; the curves stay what they are") {
    Measuring m;
    m.finish();
    const std::size_t run = m.cheap();
    REQUIRE_FALSE(m.isAt(run));
    m.hands.click("Accuracy", colorPoint(run));
    CHECK(m.isAt(run));
    CHECK(m.hands.editor.unsaved());
    CHECK(m.hands.editor.message().text.starts_with("Set "));
    CHECK(m.hands.ui.accuracy.current);
    const ChartSeries& own = m.hands.ui.accuracy.charts[0].series[3];
    REQUIRE(own.look == ChartSeries::Look::own);
    REQUIRE(own.points.size() == 1);
    CHECK(sameKnobs(m.runs()[static_cast<std::size_t>(own.points[0].run)].setting, m.setting(), false));

    // A setting that was not tried has no place.
    RenderKnobs knobs = m.hands.editor.scene().render;
    knobs.march_steps = 333;
    m.hands.editor.setRender(knobs);
    m.hands.frame(2);
    CHECK(m.hands.ui.accuracy.current);
    CHECK(m.hands.ui.accuracy.charts[0].series[3].points.empty());
}

TEST_CASE("Accuracy: the budget's slider picks and sets, and says where it cannot be met") {
    Measuring m;
    m.finish();
    AccuracyMemory& memory = m.hands.ui.accuracy;
    m.hands.drag("Accuracy", "largest color error", 0.3f, 0.999f);
    const auto picked = pick(m.runs(), {Error::color, memory.most_error, {}});
    REQUIRE(picked);
    CHECK(picked->met);
    CHECK(sameKnobs(m.runs()[picked->run].setting, m.setting(), false));
    CHECK(memory.picked.starts_with("picked "));
    CHECK(memory.picked.find("cannot be met") == std::string::npos);
    CHECK(m.runs()[picked->run].costs[Cost::evaluations] < m.runs()[kOwnRun].costs[Cost::evaluations]);

    m.hands.drag("Accuracy", "largest color error", 0.9f, -0.1f);
    CHECK(memory.picked.find("cannot be met") != std::string::npos);
    CHECK(sameKnobs(m.runs()[*leastWrong(m.runs(), Error::color, Cost::evaluations)].setting, m.setting(), false));
}

TEST_CASE("Accuracy: what moves makes the curves those of what was, and their points set nothing") {
    for (const bool eye : {false, true}) {
        CAPTURE(eye);
        Measuring m;
        while (m.runs().size() < 4) m.step();
        m.hands.frame();
        CHECK(m.hands.ui.accuracy.current);
        const Object was = m.hands.editor.scene().objects.back();
        Object moved = was;
        moved.pos.x += 0.5;
        if (eye) m.hands.editor.turn(0.1, 0);
        else m.hands.editor.setObject(m.hands.editor.scene().objects.size() - 1, moved);
        m.hands.frame(2);
        CHECK_FALSE(m.hands.ui.accuracy.current);
        CHECK_FALSE(m.hands.ui.picture.sweeping);
        const Setting before = m.setting();
        m.hands.click("Accuracy", colorPoint(2));
        CHECK(differences(m.setting(), before).empty());
        CHECK_FALSE(m.hands.find("Accuracy", "largest color error"));
        if (eye) continue;
        m.hands.editor.setObject(m.hands.editor.scene().objects.size() - 1, was);
        m.hands.frame(2);
        CHECK(m.hands.ui.accuracy.current);
        CHECK(m.hands.find("Accuracy", "Go on"));
    }
}

TEST_CASE("Accuracy: the motion follows the picture, in slices") {
    Measuring m;
    while (m.step()) {}
    for (int i = 0; i < 3000 && !(m.hands.ui.accuracy.motions && m.hands.ui.accuracy.motions->runs().size() > 3); ++i) m.hands.frame();
    AccuracyMemory& memory = m.hands.ui.accuracy;
    REQUIRE(memory.motions);
    m.hands.click("Accuracy", "Stop");
    m.hands.click("Accuracy", "curves");
    m.hands.click("Accuracy", "All together: the motion");
    REQUIRE(memory.charts.size() == motionTerms().errors.size());
    const auto run = static_cast<std::size_t>(memory.charts[0].series[0].points.back().run);
    const Setting before = m.setting();
    m.hands.click("Accuracy", fmt::format("{} {}", memory.charts[0].title, run));
    CHECK(differences({before.render, {}}, {m.setting().render, {}}).empty());
    CHECK(memory.current);
    m.hands.click("Accuracy", "Go on");
    CHECK(memory.sweeping_motion);
}

TEST_CASE("the editor's knobs are set and nothing beside them, and it still shows the same") {
    Editor editor;
    RenderKnobs render = editor.scene().render;
    render.max_distance = 77;
    editor.setRender(render);
    const Scene before = editor.scene();
    Setting other;
    other.render.samples = 4, other.render.max_distance = 50, other.physics.dt = 1.0 / 60;
    editor.setKnobs(other, false);
    CHECK(editor.scene().render.samples == 4);
    CHECK(editor.scene().render.max_distance == 77);
    CHECK(editor.scene().physics.dt == before.physics.dt);
    CHECK(editor.message().text == "Set samples=4");
    editor.setKnobs(other, true);
    CHECK(editor.scene().physics.dt == other.physics.dt);
    CHECK(editor.stillShows(before, editor.camera()));

    render.max_distance = 78;
    editor.setRender(render);
    CHECK_FALSE(editor.stillShows(before, editor.camera()));
}
