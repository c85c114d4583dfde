// The editor's time: play, pause, step, back and forth, reset.
#include "gui/editor.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {
namespace {

/// Appends the objects [begin, end) of a list, a top-level one with its children.
void append(const std::vector<Object>& from, std::size_t begin, std::size_t end, std::vector<Object>& io_to) {
    const int shift = static_cast<int>(io_to.size()) - static_cast<int>(begin);
    for (std::size_t i = begin; i < end; ++i) {
        io_to.push_back(from[i]);
        if (from[i].parent != kNoParent) io_to.back().parent += shift;
    }
}

}  // namespace

/// Whether the scene can be stepped; remembers the objects before the first step.
bool Editor::readyToMove() {
    if (const std::string why = makeTree(scene_).fault; !why.empty()) return refuse(why);
    if (!before_) before_ = scene_.objects;
    return true;
}

void Editor::play() {
    if (readyToMove()) simulation_.playing = true;
}

const PhysicsWorld* Editor::bodies() {
    return makeTree(scene_).fault.empty() ? &simulation_.ready(scene_).world() : nullptr;
}

void Editor::step() {
    if (!readyToMove()) return;
    simulation_.playing = false;
    simulation_.step(scene_);
    moved();
}

void Editor::seek(std::uint64_t step) {
    if (!readyToMove()) return;
    simulation_.playing = false;
    simulation_.seek(scene_, step);
    moved();
}

void Editor::stepBack() {
    if (canStepBack()) seek(simulation_.steps() - 1);
}

void Editor::throwAbout() {
    if (!readyToMove()) return;
    leaveFuture();
    simulation_.throwAbout(scene_);
    simulation_.playing = true;
    moved();
}

void Editor::advance(double seconds) {
    if (!moving()) return;
    // An operator nobody can evaluate may have been added meanwhile.
    if (!readyToMove()) return pause();
    if (simulation_.advance(scene_, seconds)) moved();
}

/// The scene shows another moment.
void Editor::moved() {
    ++revision_;
    if (simulation_.tookShapes()) ++edits_;
    if (!selection()) selected_ = {};
    if (const auto divergence = simulation_.divergenceToTell()) {
        pause();
        say(true, fmt::format("The run is not as it was {}.", describe(*divergence)));
    } else if (const std::uint64_t steps = simulation_.equalStepsToTell()) {
        say(false, fmt::format("All {} recorded steps were made again, each to the same state.", steps));
    }
}

/// Something is done at this moment: the steps recorded behind it are void, and what was removed behind it is there to stay.
void Editor::leaveFuture() {
    if (!timeline() || timeline()->atEnd()) return simulation_.discardFuture();
    const std::uint64_t at = timeline()->step(), steps = timeline()->last() - at;
    simulation_.discardFuture();
    const char* gone = steps == 1 ? "step behind it is" : "steps behind it are";
    say(false, fmt::format("Something new was done at step {}: the {} {} gone.", at, steps, gone));
    const Scene& start = *timeline()->recording().start;
    for (std::size_t i = 0; before_ && i < start.objects.size(); i = subtreeEnd(start, i)) {
        const auto is = [&](const Object& o) { return o.id == start.objects[i].id; };
        if (std::ranges::any_of(scene_.objects, is) && std::ranges::none_of(*before_, is))
            append(start.objects, i, subtreeEnd(start, i), *before_);
    }
}

void Editor::reset() {
    // What was edited since is of the present.
    if (timeline() && !timeline()->atEnd() && timeline()->keepsEnd()) seek(timeline()->last());
    simulation_.stop();
    ++revision_;
    if (!before_) return;
    const std::vector<Object> before = std::move(*before_);
    before_.reset();
    for (std::size_t i = 0, end = 0; i < before.size(); i = end) {
        for (end = i + 1; end < before.size() && before[end].parent != kNoParent;) ++end;
        if (const auto index = findObject(scene_, before[i].id)) {
            Object& o = scene_.objects[*index];
            o.pos = before[i].pos, o.rot = before[i].rot, o.vel = before[i].vel, o.spin = before[i].spin;
            continue;
        }
        append(before, i, end, scene_.objects);  // it left the world
    }
    // What was saved meanwhile may be the bodies as they had moved.
    if (!unsaved() && !sameScene(scene_, saved_)) ++edits_;
}

/// What is removed by hand does not come back with a reset.
void Editor::forget(ObjectId id) {
    if (!before_) return;
    Scene before;
    before.objects = std::move(*before_);
    if (const auto index = findObject(before, id)) removeSubtree(before, *index);
    before_ = std::move(before.objects);
}

}  // namespace mb
