#include "core/scene/camera.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>

namespace mb {

View viewOf(const Camera& camera) {
    const glm::dvec3 ahead = camera.target - camera.eye;
    View view;
    view.forward = glm::length(ahead) > 0 ? glm::normalize(ahead) : glm::dvec3{0, 0, -1};
    const glm::dvec3 sideways = glm::cross(view.forward, glm::dvec3{0, 1, 0});
    view.right = glm::length(sideways) > 1e-12 ? glm::normalize(sideways) : glm::dvec3{1, 0, 0};
    view.up = glm::cross(view.right, view.forward);
    view.parallel = camera.ortho > 0;
    view.half = view.parallel ? camera.ortho / 2 : std::tan(glm::radians(camera.fov) / 2);
    return view;
}

Ray cameraRay(const Camera& camera, glm::ivec2 size, glm::dvec2 point) {
    const View view = viewOf(camera);
    const double aspect = static_cast<double>(size.x) / size.y;
    const double u = (point.x / size.x * 2 - 1) * aspect * view.half, v = (1 - point.y / size.y * 2) * view.half;
    const glm::dvec3 across = u * view.right + v * view.up;
    if (view.parallel) return {camera.eye + across, view.forward};
    return {camera.eye, glm::normalize(view.forward + across)};
}

std::optional<glm::dvec2> pictureOf(const Camera& camera, glm::ivec2 size, glm::dvec3 place) {
    const View view = viewOf(camera);
    const glm::dvec3 from_eye = place - camera.eye;
    const double ahead = glm::dot(from_eye, view.forward);
    if (!(ahead > 0)) return std::nullopt;
    const double half = view.half * (view.parallel ? 1 : ahead), aspect = static_cast<double>(size.x) / size.y;
    const double u = glm::dot(from_eye, view.right) / (aspect * half), v = glm::dot(from_eye, view.up) / half;
    return glm::dvec2{0.5 * (u + 1) * size.x, 0.5 * (1 - v) * size.y};
}

}  // namespace mb
