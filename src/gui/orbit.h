#pragma once
// The eye that circles the scene: angles and a distance around a point, and the camera they make.
#include "core/scene/scene.h"

namespace mb {

struct Orbit {
    static constexpr double kPitchLimit = 1.5;  // rad, short of the pole, where left and right would change sides
    static constexpr double kNearest = 1e-3, kFurthest = 1e6;  // m

    double yaw = 0, pitch = 0;  // rad; yaw 0 looks along −z, a positive pitch looks down
    double distance = 6;        // m from the target; of a parallel view its height changes with it
    glm::dvec3 target{0, 1, 0};
    double fov = 60, ortho = 0; // the camera's own

    static Orbit around(const Camera& camera);
    Camera camera() const;

    /// Turns by angles in radians; the pitch stays within its limit.
    void turn(double yaw_by, double pitch_by);
    /// Comes nearer by a positive number of notches, 10 % each.
    void zoom(double notches);
    /// Moves the target across the view, by parts of the picture's height.
    void pan(double right, double up);
};

}  // namespace mb
