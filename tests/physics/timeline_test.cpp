// Runs that are made again: from a recording, and from any moment of a timeline.
#include "physics/timeline.h"
#include "physics/random.h"
#include "scenes.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <malloc.h>
#include <sstream>

using namespace mb;
using namespace mb::test;

namespace {

/// Balls that meet, fall onto a floor and a box, and one that leaves the world.
Scene busy() {
    Scene s = scene(1.0 / 120, 0.5, 0.4);
    s.world.bounds = 6;
    floor(s).name = "floor";
    add(s, "box", {0, 0.5, 0}, {1, 1, 1, 0.1}).name = "block";
    for (int i = 0; i < 6; ++i) ball(s, {0.3 * i - 0.8, 1.5 + 0.35 * i, 0.05 * i}, 0.15).name = fmt::format("ball{}", i);
    ball(s, {0, 3, 2}, 0.2, {0, 0, 30}).name = "away";
    return s;
}

Scene moved(Scene s) {
    s.objects[1].pos = {0.4, 0.5, 0.1}, s.world.gravity = 6, s.physics.substeps = 2;
    return s;
}

/// 200 steps with every kind of action among them.
void live(Timeline& t, const Scene& s, std::uint64_t steps = 200) {
    while (t.step() < steps) {
        if (t.step() == 0) t.act(settingMotion(s.objects[2].id, {1, 0, 0}, {0, 5, 0}));
        if (t.step() == 40) t.act(throwing(0xfedcba9876543210u, 6));
        if (t.step() == 70) t.act(changingStatics(moved(s)));
        if (t.step() == 70) t.act(settingMotion(s.objects[4].id, {0, 0.1, 0.3}, {}));
        if (t.step() >= 80 && t.step() < 95) t.act(grabbing(s.objects[5].id, {0.05, 0, 0.1}, {0.1, 0.02 * static_cast<double>(t.step()), 0}));
        if (t.step() == 95) t.act(lettingGo(s.objects[5].id));
        if (t.step() == 110) t.act(exploding({0.1, 0, 0}, 4, 1.5));
        if (t.step() == 100) t.act(removing(s.objects[3].id));
        if (t.step() == 150) t.act(changingStatics(s)), t.act(throwing(3, 2));
        t.advance();
    }
}

std::vector<std::uint64_t> statesOf(const Timeline& t) {
    std::vector<std::uint64_t> states;
    for (const StepHash& step : t.recording().steps) states.push_back(step.state);
    return states;
}

/// The text with one piece of it replaced.
std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE_MESSAGE(at != std::string::npos, from);
    return text.replace(at, from.size(), to);
}

Recording readWhole(const std::string& text) {
    RecordingResult read = readRecording(text);
    for (const Fault& f : read.faults) FAIL_CHECK(describe(f, "recording"));
    REQUIRE(read.ok());
    return std::move(read.recording);
}

}  // namespace

TEST_CASE("the timeline runs as the world does") {
    const Scene s = busy();
    PhysicsWorld w(s);
    Timeline t(s);
    for (int i = 0; i < 120; ++i) {
        w.step(), t.advance();
        REQUIRE(t.world().stateHash() == w.stateHash());
        REQUIRE(t.recording().steps.back().state == w.stateHash());
    }
    CHECK(t.recording().steps.back().bodies.size() == w.bodies().size());
}

TEST_CASE("any moment that is gone to has the state it had, whatever was done, and the run goes on from it as it did") {
    const Scene s = busy();
    for (const std::uint64_t spacing : {1u, 16u, 64u}) {
        Timeline t(s, {.spacing = spacing});
        live(t, s);
        REQUIRE(t.world().bodies().size() == 5);  // one was removed by hand, one left the world
        const std::vector<std::uint64_t> states = statesOf(t);
        const std::uint64_t end = t.world().stateHash();
        Random random(spacing);
        for (int i = 0; i < 60; ++i) {
            const auto to = static_cast<std::uint64_t>(random.in(0, 201));
            t.seek(to);
            REQUIRE(t.step() == to);
            REQUIRE(t.world().stateHash() == (to == 200 ? end : to == 0 ? PhysicsWorld(s).stateHash() : states[to - 1]));
            CHECK(t.scene()->world.gravity == (to > 70 && to <= 150 ? 6 : kG));
            for (int k = 0; k < 5 && !t.atEnd(); ++k) t.advance();
        }
        t.seek(1'000'000);
        CHECK(t.step() == 200);
        CHECK(t.world().stateHash() == end);
        CHECK_FALSE(t.divergence());
        CHECK(statesOf(t) == states);
    }
}

TEST_CASE("what is done at the end stays done there; what is done earlier discards what came behind") {
    const Scene s = busy();
    Timeline t(s);
    for (int i = 0; i < 50; ++i) t.advance();
    CHECK(t.act(throwing(1, 5)) == 0);
    const std::uint64_t thrown = t.world().stateHash();
    CHECK(thrown != t.recording().steps.back().state);
    t.seek(20), t.seek(50);
    CHECK(t.world().stateHash() == thrown);
    t.seek(20);
    for (int i = 0; i < 40; ++i) t.advance();
    CHECK(t.step() == 60);
    const std::vector<std::uint64_t> states = statesOf(t);

    t.seek(50);
    CHECK(t.world().stateHash() == states[49]);  // not yet thrown
    CHECK(t.act(throwing(2, 5)) == 10);
    CHECK(t.last() == 50);
    CHECK(t.recording().actions.size() == 1);
    CHECK(t.atEnd());
    t.advance();
    CHECK(t.recording().steps[50].state != states[50]);
    t.seek(30), t.seek(51);
    CHECK_FALSE(t.divergence());
    CHECK_FALSE(replay(t.recording()));
}

TEST_CASE("a sleeping world is gone through as any other, and shapes dragged about count once") {
    Scene s = scene(1.0 / 120, 0.2, 0.5);
    add(s, "box", {0, -0.5, 0}, {4, 1, 4, 0});
    ball(s, {0, 0.1, 0}, 0.1), ball(s, {0.3, 0.1, 0}, 0.1);
    Timeline t(s);
    for (int i = 0; i < 300; ++i) t.advance();
    REQUIRE(t.world().awake() == 0);
    Scene lower = s;
    for (int i = 0; i < 20; ++i) lower.objects[0].pos.y -= 0.01, t.act(changingStatics(lower));
    CHECK(t.recording().actions.size() == 1);
    CHECK(t.world().awake() == 2);
    for (int i = 0; i < 300; ++i) t.advance();
    const std::uint64_t end = t.world().stateHash();
    for (const std::uint64_t to : {299u, 301u, 10u, 450u, 600u}) t.seek(to);
    CHECK(t.world().stateHash() == end);
    t.seek(250);
    while (!t.atEnd()) t.advance();
    CHECK(t.world().stateHash() == end);
    CHECK_FALSE(t.divergence());
    CHECK_FALSE(replay(t.recording()));
}

TEST_CASE("a seek in slices arrives at the same state, and can be given up") {
    const Scene s = busy();
    Timeline t(s, {.spacing = 64});
    live(t, s);
    const std::vector<std::uint64_t> states = statesOf(t);
    t.aim(190);
    CHECK(t.target() == 190);
    int slices = 0;
    while (!t.arrive(1e-9)) ++slices;
    CHECK(slices > 10);
    CHECK(t.world().stateHash() == states[189]);
    CHECK_FALSE(t.target());
    t.aim(50);
    t.arrive(1e-9);
    const std::uint64_t at = t.step();
    REQUIRE(at < 50);
    t.advance();
    CHECK_FALSE(t.target());
    CHECK(t.world().stateHash() == states[at]);
}

TEST_CASE("the budget holds: snapshots get fewer, then the oldest hashes of bodies go, and every moment can still be had") {
    Scene s = scene(1.0 / 120, 0.5, 0.4);
    floor(s);
    for (int i = 0; i < 100; ++i) ball(s, {0.5 * (i % 10), 1 + 0.02 * i, 0.5 * (i / 10)}, 0.2);
    constexpr std::size_t kBudget = 1 << 20;
    Timeline t(s, {.most_bytes = kBudget, .spacing = 4, .copying = 1e9});
    std::size_t most = 0;
    while (t.step() < 2000) t.advance(), most = std::max(most, t.bytes());
    CHECK(most <= kBudget);
    CHECK(t.spacing() > 4);
    CHECK(t.snapshots() > 2);
    CHECK(t.recording().steps.front().bodies.empty());
    CHECK(t.recording().steps.back().bodies.size() == 100);
    for (const std::uint64_t to : {1999u, 3u, 1000u}) {
        t.seek(to);
        CHECK(t.world().stateHash() == t.recording().steps[to - 1].state);
    }
    CHECK(t.bytes() <= kBudget);
    CHECK_FALSE(t.divergence());
    MESSAGE("1 MiB, 100 balls, 2000 steps: ", t.snapshots(), " snapshots, ", t.spacing(), " steps apart or more");
}

TEST_CASE("a timeline takes the memory it says") {
#ifndef __SANITIZE_ADDRESS__
    Scene s = scene(1.0 / 120, 0.5, 0.4);
    floor(s);
    for (int i = 0; i < 300; ++i) ball(s, {0.5 * (i % 20), 0.1 + 0.01 * i, 0.5 * (i / 20)}, 0.2);
    const std::size_t before = mallinfo2().uordblks;
    Timeline t(s, {.spacing = 4});
    while (t.step() < 400) t.advance();
    const std::size_t now = mallinfo2().uordblks;
    REQUIRE(now > before);
    const double share = static_cast<double>(t.bytes()) / static_cast<double>(now - before);
    CHECK(share > 0.6);
    CHECK(share < 1.6);
    MESSAGE("a timeline says ", t.bytes() >> 10, " KiB and has ", (now - before) >> 10);
#endif
}

TEST_CASE("a recording is read as it was written, byte by byte, and its run is made again") {
    const Scene s = busy();
    Timeline t(s);
    live(t, s);
    const std::string text = writeRecording(t.recording());
    const Recording read = readWhole(text);
    CHECK(writeRecording(read) == text);
    CHECK(sameScene(*read.start, s));
    CHECK(read.steps == t.recording().steps);
    REQUIRE(read.actions.size() == t.recording().actions.size());
    CHECK(read.actions[1].seed == 0xfedcba9876543210u);
    int steps = 0;
    CHECK_FALSE(replay(read, [&](const Timeline&) { ++steps; }));
    CHECK(steps == 200);
}

TEST_CASE("objects keep their numbers, whatever was removed before the start") {
    Scene s = busy();
    removeSubtree(s, 4);
    std::swap(s.objects[3].id, s.objects[5].id);
    Timeline t(s);
    for (int i = 0; i < 30; ++i) t.advance();
    t.act(settingMotion(s.objects[3].id, {0, 2, 0}, {}));
    t.act(changingStatics(moved(s)));
    for (int i = 0; i < 30; ++i) t.advance();
    const Recording read = readWhole(writeRecording(t.recording()));
    for (std::size_t i = 0; i < s.objects.size(); ++i) CHECK(read.start->objects[i].id == s.objects[i].id);
    CHECK_FALSE(replay(read));
}

TEST_CASE("a run that is another is told by step and body") {
    const Scene s = busy();
    Timeline t(s);
    live(t, s);
    const std::string text = writeRecording(t.recording());
    const auto diverges = [](const std::string& changed) {
        const auto found = replay(readWhole(changed));
        REQUIRE(found);
        return *found;
    };

    // The start is another: one body's velocity, the gravity.
    const Divergence away = diverges(with(text, "vel:0,0,30", "vel:0,0,30.5"));
    CHECK(away.step == 1);
    CHECK(away.body == "away");
    CHECK(describe(away).find("at step 1: body 'away' is another") == 0);
    CHECK(diverges(with(text, "  world ", "  world gravity:9 ")).step == 1);
    // What was done is another, or is missing.
    const Divergence push = diverges(with(text, "vel:0,0.1,0.3", "vel:0,0.1,0.30000000000000004"));
    CHECK(push.step == 71);
    CHECK(push.body == "ball2");
    const Divergence kept = diverges(with(text, "remove body:4\n", ""));
    CHECK(kept.step == 101);
    CHECK(kept.body == "ball1");
    const Divergence gone = diverges(with(text, "remove body:4\n", "remove body:4\nremove body:7\n"));
    CHECK(gone.step == 101);
    CHECK(gone.body == "ball4");
    // A digit of a hash is another.
    const StepHash& step = t.recording().steps[120];
    const Divergence state = diverges(with(text, fmt::format("{:016x}", step.state), fmt::format("{:016x}", step.state ^ 1)));
    CHECK(state.step == 121);
    CHECK(state.body.empty());
    CHECK(state.recorded == (state.found ^ 1));
    const std::size_t which = 2;
    const Divergence body = diverges(with(text, fmt::format("{:08x}", step.bodies[which]), fmt::format("{:08x}", step.bodies[which] ^ 0x80000000u)));
    CHECK(body.step == 121);
    CHECK(body.body == "ball3");  // ball1 was removed
    // A timeline tells it too, and goes on.
    Timeline wrong(readWhole(with(text, "vel:0,0,30", "vel:0,0,30.5")));
    wrong.seek(90);
    CHECK(wrong.step() == 90);
    REQUIRE(wrong.divergence());
    CHECK(wrong.divergence()->body == "away");
}

TEST_CASE("a recording at fault is told by line and column") {
    const std::string text = "marchbox-recording 1\nscene\n  marchbox 1\n  object type:sphere pos:0,1,0 radius:0.5 mass:1\n"
                             "step n:1 state:0123456789abcdef bodies:01234567\nthrow seed:1 speed:2\nstep n:2 state:0123456789abcdef bodies:-\nend\n";
    CHECK(readRecording(text).ok());
    CHECK(readRecording("\xef\xbb\xbf# before\n" + text + "# behind\n\n").ok());
    const auto fault = [&](const std::string& changed) {
        const RecordingResult read = readRecording(changed);
        REQUIRE_FALSE(read.ok());
        CHECK_FALSE(read.recording.start);
        return describe(read.faults.front(), "r");
    };
    CHECK(fault("") == "r:1:1: error: there is no record, expected 'marchbox-recording 1'");
    CHECK(fault("marchbox 1\n").find("r:1:1: error: the first record") == 0);
    CHECK(fault("marchbox-recording 2\n").find("r:1:20: error: the version is not known") == 0);
    CHECK(fault(with(text, "mass:1", "mass:-1")).find("r:4:48: error: 'mass' is -1") == 0);
    CHECK(fault(with(text, "  object", "  objekt")).find("r:4:3: error: unknown keyword 'objekt', the nearest is 'object'") == 0);
    CHECK(fault(with(text, "n:2", "n:3")).find("r:7:8: error: 'n' is '3', expected 2") == 0);
    CHECK(fault(with(text, "abcdef bodies:0", "abcdeg bodies:0")).find("r:5:16: error: 'state' is") == 0);
    CHECK(fault(with(text, "bodies:-", "bodies:-,-")).find("r:7:42: error: a body's hash is '-'") == 0);
    CHECK(fault(with(text, "bodies:0", "bodies:")).find("r:5:40: error: a body's hash is '1234567'") == 0);
    CHECK(fault(with(text, "throw", "thrwo")).find("r:6:1: error: unknown keyword 'thrwo', the nearest is 'throw'") == 0);
    CHECK(fault(with(text, " speed:2", "")).find("r:6:1: error: no 'speed'") == 0);
    CHECK(fault(with(text, "seed:1", "seed:-1")).find("r:6:12: error: 'seed' is '-1'") == 0);
    CHECK(fault(with(text, "speed:2", "speed:nan")).find("r:6:20: error: 'speed' is 'nan'") == 0);
    CHECK(fault(with(text, "speed:2", "seed:2")).find("r:6:14: error: 'seed' stands twice") == 0);
    CHECK(fault(with(text, "throw", "scene")).find("r:6:1: error: a second 'scene'") == 0);
    CHECK(fault(with(text, "scene\n", "scene ids:1,2\n")).find("r:2:11: error: 'ids' has 2 numbers") == 0);
    CHECK(fault(with(text, "scene\n", "scene ids:0\n")).find("r:2:11: error: an id is '0'") == 0);
    CHECK(fault(with(text, "end\n", "")).find("r:8:1: error: the file ends without 'end'") == 0);
    CHECK(fault(with(text, "end\n", "end\nstep\n")).find("r:9:1: error: a record behind 'end'") == 0);
    CHECK(fault("marchbox-recording 1\nstep n:1\n").find("r:2:1: error: 'step' stands before the scene") == 0);
    CHECK(fault(with(text, "throw", std::string(1, '\0'))).find("r:6:1: error: a byte (0x00)") == 0);
}

TEST_CASE("whatever is cut off or changed in a recording, the reader ends, and what it reads can be played") {
    Scene s = busy();
    s.objects.resize(5);
    Timeline t(s);
    while (t.step() < 12) {
        if (t.step() == 3) t.act(throwing(1, 6));
        if (t.step() == 5) t.act(changingStatics(s));
        if (t.step() == 7) t.act(removing(s.objects[3].id));
        t.advance();
    }
    const std::string text = writeRecording(t.recording());
    for (std::size_t n = 0; n < text.size() - 1; ++n) REQUIRE_FALSE(readRecording(std::string_view(text).substr(0, n)).ok());

    Random random(5);
    const auto draw = [&](std::size_t n) { return static_cast<std::size_t>(random.in(0, static_cast<double>(n))); };
    int sound = 0, diverged = 0;
    for (int i = 0; i < 4000; ++i) {
        std::string changed = text;
        for (std::size_t k = draw(3) + 1; k-- > 0;) {
            const std::size_t at = draw(changed.size());
            const std::size_t what = draw(4);
            if (what == 0) changed[at] = static_cast<char>(draw(256));
            else if (what == 1) changed.erase(at, draw(40));
            else if (what == 2) changed.insert(at, changed, draw(changed.size()), draw(60));
            else changed[at] = "0123456789abcdef-,.: \n"[draw(22)];
        }
        RecordingResult read = readRecording(changed);
        REQUIRE(read.faults.size() <= kMaxFaults);
        if (!read.ok()) continue;
        ++sound;
        REQUIRE(writeRecording(readWhole(writeRecording(read.recording))) == writeRecording(read.recording));
        diverged += replay(std::move(read.recording)).has_value();
    }
    CHECK(sound > 50);
    MESSAGE(sound, " of 4000 changed recordings could be read; ", diverged, " of them diverged");
}
