#include "gui/orbit.h"

#include "core/scene/camera.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace mb {

Orbit Orbit::around(const Camera& camera) {
    Orbit orbit;
    orbit.target = camera.target, orbit.fov = camera.fov, orbit.ortho = camera.ortho;
    const glm::dvec3 back = -viewOf(camera).forward;
    orbit.distance = std::clamp(glm::length(camera.eye - camera.target), kNearest, kFurthest);
    orbit.yaw = std::hypot(back.x, back.z) > 1e-12 ? std::atan2(back.x, back.z) : 0;
    orbit.pitch = std::clamp(std::asin(std::clamp(back.y, -1.0, 1.0)), -kPitchLimit, kPitchLimit);
    return orbit;
}

Camera Orbit::camera() const {
    Camera camera;
    const glm::dvec3 back{std::cos(pitch) * std::sin(yaw), std::sin(pitch), std::cos(pitch) * std::cos(yaw)};
    camera.target = target, camera.eye = target + distance * back;
    camera.fov = fov, camera.ortho = ortho;
    return camera;
}

void Orbit::turn(double yaw_by, double pitch_by) {
    if (!std::isfinite(yaw_by) || !std::isfinite(pitch_by)) return;
    yaw = std::remainder(yaw + yaw_by, 2 * 3.14159265358979323846);
    pitch = std::clamp(pitch + pitch_by, -kPitchLimit, kPitchLimit);
}

void Orbit::zoom(double notches) {
    if (!std::isfinite(notches)) return;
    const double before = distance;
    distance = std::clamp(distance * std::pow(0.9, notches), kNearest, kFurthest);
    ortho *= distance / before;
}

void Orbit::pan(double right, double up) {
    if (!std::isfinite(right) || !std::isfinite(up)) return;
    const View view = viewOf(camera());
    const double height = 2 * view.half * (view.parallel ? 1 : distance);
    target = glm::clamp(target + height * (right * view.right + up * view.up), glm::dvec3{-1e9}, glm::dvec3{1e9});
}

}  // namespace mb
