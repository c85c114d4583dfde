#pragma once
// What a camera sees where: the one place that turns a camera into directions, for the shader's frame and for picking.
#include "core/scene/scene.h"

#include <glm/vec2.hpp>

#include <optional>

namespace mb {

/// The directions of a camera; unit vectors, right-handed.
struct View {
    glm::dvec3 right, up, forward;
    double half = 1;        // half the picture's height: of a perspective at distance 1, of a parallel view in metres
    bool parallel = false;
};
/// A camera that looks straight up or down has x for its right; one whose eye is its target looks along −z.
View viewOf(const Camera& camera);

struct Ray {
    glm::dvec3 origin, direction;  // the direction has unit length
};
/// The ray through a point of a picture of that size, in pixels from its top left corner: the centre of pixel (x, y) is
/// (x + ½, y + ½).
Ray cameraRay(const Camera& camera, glm::ivec2 size, glm::dvec2 point);
/// The point of that picture whose ray goes through a place; nothing, where it is not in front of the eye.
std::optional<glm::dvec2> pictureOf(const Camera& camera, glm::ivec2 size, glm::dvec3 place);

}  // namespace mb
