// The editor's time: play, pause, step, reset.
#include "gui/editor.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {

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
    return makeTree(scene_).fault.empty() ? &simulation_.ready(scene_) : nullptr;
}

void Editor::step() {
    if (!readyToMove()) return;
    simulation_.playing = false;
    simulation_.step(scene_);
    ++revision_;
}

void Editor::throwAbout() {
    if (!readyToMove()) return;
    simulation_.throwAbout(scene_);
    simulation_.playing = true;
    ++revision_;
}

void Editor::advance(double seconds) {
    if (!simulation_.playing) return;
    // An operator nobody can evaluate may have been added meanwhile.
    if (!readyToMove()) return pause();
    if (simulation_.advance(scene_, seconds)) ++revision_;
    if (!selection()) selected_ = {};
}

void Editor::reset() {
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
        // It left the world: it comes back with its children, at the end.
        const int shift = static_cast<int>(scene_.objects.size()) - static_cast<int>(i);
        for (std::size_t k = i; k < end; ++k) {
            Object o = before[k];
            if (o.parent != kNoParent) o.parent += shift;
            scene_.objects.push_back(std::move(o));
        }
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
