// What the rows of the physics say of a scene, and the ledger of each stage.
#include "physics/ledger.h"
#include "scenes.h"

#include <doctest/doctest.h>

using namespace mb;
using namespace mb::test;

namespace {
/// Two balls that meet over a floor, and one that lies on it; `friction` of the world.
Scene meeting(double friction) {
    Scene s = scene(1.0 / 120, 0.5, friction);
    add(s, "box", {0, -0.5, 0}, {8, 1, 8, 0});
    ball(s, {-0.5, 0.3, 0}, 0.1, {2, 0, 0});
    ball(s, {0.5, 0.3, 0.05}, 0.1, {-2, 0, 0});
    ball(s, {2, 0.1, 0}, 0.1);
    return s;
}
const StagePrice& priceOf(const MotionLedger& ledger, Stage stage) { return ledger.rows()[static_cast<std::size_t>(stage)]; }
}  // namespace

TEST_CASE("the ledger: each stage called for is used, and changes something; the others neither") {
    MotionLedger ledger(meeting(0), {.steps = 60, .rounds = 3, .records = 2, .slice_ms = 1});
    double last = ledger.progress();
    CHECK(last == 0);
    int slices = 0;
    for (bool more = true; more; ++slices) {
        more = ledger.step();
        CHECK(ledger.progress() >= last);
        last = ledger.progress();
    }
    CHECK(last == 1);
    CHECK(slices > 1);
    CHECK(!ledger.step());
    CHECK(ledger.ms_per_step() > 0);
    REQUIRE(ledger.rows().size() == static_cast<std::size_t>(Stage::count));
    for (const StagePrice& row : ledger.rows()) {
        CAPTURE(row.effect->name);
        const bool idle = row.effect->stage == Stage::friction || row.effect->stage == Stage::spin || row.effect->stage == Stage::rolling;
        CHECK(row.called != idle);
        CHECK(row.because.empty() == idle);
        CHECK(row.because.size() <= 2);
        CHECK((row.uses_per_step > 0) != idle);
        CHECK(row.changes != idle);
        CHECK(row.ms_least <= row.ms_per_step);
        CHECK(row.ms_per_step <= row.ms_most);
        if (idle) CHECK(row.moved_m == 0);
    }
    // Without it the balls fall for the half second: g t²/2, less what the bounces with it took of that.
    CHECK(priceOf(ledger, Stage::static_contacts).moved_m > 0.5 * kG * 0.25 - 0.3);
    CHECK(priceOf(ledger, Stage::broad_phase).moved_m > 0.1);
    CHECK(priceOf(ledger, Stage::sleeping).moved_m == 0);  // it changes what is stepped, not yet where
    CHECK(priceOf(ledger, Stage::flight).lost == 0);
}

TEST_CASE("the ledger of a scene without bodies: nothing is called for, nothing is lost") {
    Scene s = scene(1.0 / 120, 0.5, 0.5);
    floor(s);
    MotionLedger ledger(s, {.steps = 5, .rounds = 1});
    while (ledger.step()) {}
    for (const StagePrice& row : ledger.rows()) {
        CHECK(!row.called);
        CHECK(!row.changes);
        CHECK(row.lost == 0);
    }
}

TEST_CASE("the ledger names what the physics made of the records: a body without end is a solid") {
    Scene s = scene(1.0 / 120, 0.5, 0.5);
    floor(s).mass = 1;
    ball(s, {0, 1, 0}, 0.1);
    MotionLedger ledger(s, {.steps = 1, .rounds = 1, .slice_ms = 0});
    while (ledger.step()) {}
    const StagePrice& statics = priceOf(ledger, Stage::static_contacts);
    CHECK(statics.called);
    REQUIRE(statics.because.size() == 1);
    CHECK(statics.because[0].what == "type:plane");
    CHECK(!priceOf(ledger, Stage::broad_phase).called);
}

TEST_CASE("the ledger counts the bodies that fall out of the world without a stage") {
    Scene s = meeting(0.4);
    s.world.bounds = 3;
    MotionLedger ledger(s, {.steps = 120, .rounds = 1});
    while (ledger.step()) {}
    CHECK(priceOf(ledger, Stage::static_contacts).lost == 3);
}

TEST_CASE("the rows of the physics stand in the order of the stages, and name the records that call") {
    REQUIRE(motionEffects().size() == static_cast<std::size_t>(Stage::count));
    Scene s = meeting(0.4);
    s.objects[1].friction = 0.25, s.objects[1].spin = {0, 1, 0};
    s.objects[2].friction = s.objects[3].friction = 0;
    s.objects[2].rolling = 0.01;
    const Tree none;
    for (std::size_t i = 0; i < motionEffects().size(); ++i) {
        const Effect& row = motionEffects()[i];
        CHECK(row.stage == static_cast<Stage>(i));
        CHECK(row.ofMotion());
        CHECK(!row.tip.empty());
        CHECK(!row.counts.empty());
        Calls calls(10);
        row.calls(row, s, none, calls);
        REQUIRE(calls.any());
        if (row.stage == Stage::friction) {
            REQUIRE(calls.found().size() == 1);  // neither the world's, which all bodies overrule, nor a 0
            CHECK(calls.found()[0].index == 1);
            CHECK(calls.found()[0].what == "friction:0.25");
        }
        if (row.stage == Stage::rolling) CHECK(calls.found()[0].what == "rolling:0.01");
        if (row.stage == Stage::restitution) CHECK(calls.found()[0].record == Because::Record::world);
        if (row.stage == Stage::static_contacts) CHECK(calls.found()[0].what == "type:box");
        if (row.stage == Stage::spin) CHECK(calls.found()[0].what == "spin:0,1,0");
    }
    // Of two bodies alone a product needs both.
    s.objects.erase(s.objects.begin());
    CHECK(!calledFor(s).has(Stage::friction));
    s.objects[1].friction.reset();
    CHECK(calledFor(s).has(Stage::friction));
}
