// The editor's knobs, as the Accuracy panel turns them.
#include "core/accuracy/knobs.h"
#include "gui/editor.h"

#include <fmt/format.h>

namespace mb {

bool Editor::stillShows(const Scene& scene, const Camera& from) const {
    const Camera eye = camera();
    return eye.eye == from.eye && eye.target == from.target && eye.fov == from.fov && eye.ortho == from.ortho && sameButKnobs(scene, scene_);
}

void Editor::setKnobs(const Setting& setting, bool motion) {
    const Setting now = settingOf(scene_), to = withKnobs(now, setting, motion);
    const std::string set = differences(to, now);
    if (set.empty()) return say(false, "The knobs are set so already.");
    motion ? setPhysics(to.physics) : setRender(to.render);
    say(false, fmt::format("Set {}", set));
}

}  // namespace mb
