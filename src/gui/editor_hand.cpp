// The editor's hand in the picture: what it points at, holds and blows up.
#include "core/scene/camera.h"
#include "core/sdf/raycast.h"
#include "gui/editor.h"

#include <glm/geometric.hpp>

namespace mb {

std::optional<Editor::SeenAt> Editor::seenAt(glm::ivec2 picture, glm::dvec2 point, const Grid* drawn) const {
    if (picture.x < 1 || picture.y < 1) return {};
    const Camera eye = camera();
    const Ray ray = cameraRay(eye, picture, point);
    const Tree tree = makeTree(scene_);
    const double far = scene_.render.max_distance;
    const RayEnd end = drawn && drawn->follows(tree) ? raycast(*drawn, ray.origin, ray.direction, far) : raycast(tree, ray.origin, ray.direction, far);
    // A ray that is not decided may have passed within a pixel of a surface: near enough for a click.
    const double pixel = 2 * viewOf(eye).half / picture.y * (eye.ortho > 0 ? 1 : end.t);
    if (end.state == RayState::miss || end.leaf < 0 || (end.state == RayState::undecided && end.closest > pixel)) return {};
    return SeenAt{ray.origin + end.t * ray.direction, end.index};
}

bool Editor::grab(glm::ivec2 picture, glm::dvec2 point, const Grid* drawn) {
    const std::optional<SeenAt> seen = seenAt(picture, point, drawn);
    if (!seen || !readyToMove()) return false;
    const ObjectId object = scene_.objects[topLevel(scene_, seen->index)].id;
    const auto bodies = simulation_.ready(scene_).world().bodies();
    if (std::ranges::find(bodies, object, &Body::object) == bodies.end()) return false;
    leaveFuture();
    simulation_.grab(scene_, object, seen->place);
    simulation_.playing = true;
    const Camera eye = camera();
    hand_ahead_ = glm::dot(seen->place - eye.eye, viewOf(eye).forward);
    moved();
    return true;
}

void Editor::drag(glm::ivec2 picture, glm::dvec2 point) {
    if (!held() || picture.x < 1 || picture.y < 1) return;
    const Camera eye = camera();
    const Ray ray = cameraRay(eye, picture, point);
    const glm::dvec3 to = ray.origin + hand_ahead_ / glm::dot(ray.direction, viewOf(eye).forward) * ray.direction;
    if (std::isfinite(to.x + to.y + to.z)) simulation_.moveHand(to);
}

std::optional<Editor::Held> Editor::held() const {
    const std::optional<Grab> hand = simulation_.hand();
    if (!hand) return {};
    const Body& body = *std::ranges::find(timeline()->world().bodies(), hand->object, &Body::object);
    return Held{body.pose().toWorld(hand->arm), hand->target};
}

bool Editor::explode(glm::ivec2 picture, glm::dvec2 point, const Grid* drawn) {
    const std::optional<SeenAt> seen = seenAt(picture, point, drawn);
    if (!seen) return refuse("nothing is seen there that could blow up");
    if (!readyToMove()) return false;
    leaveFuture();
    simulation_.explode(scene_, seen->place, 0.5 * glm::length(seen->place - camera().eye));
    simulation_.playing = true;
    moved();
    return true;
}

}  // namespace mb
