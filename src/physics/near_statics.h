#pragma once
// What one body knows of the static shapes around it, so that it need not ask again: the points it was told of at the last
// place, and a room that is proved to hold none.
#include "physics/stages.h"
#include "physics/statics.h"

namespace mb {

inline constexpr double kNear = 0.25;  // of the radius: static points are looked for within it, and strides are that long

class NearStatics {
public:
    /// Asks the field what a ball touches, unless it was last asked for just this place.
    void moveTo(const StaticField& field, glm::dvec3 position, double radius, StepCounts& io_counts);
    /// The points nearer than kNear·radius at the place of the last moveTo().
    const std::vector<Touch>& touches() const { return touches_; }
    /// StaticField::touches' answer there.
    double free() const { return free_; }

    /// How far from the surface of the ball at this place it is proved that there is no static point, m; not known: below 0.
    double roomAt(glm::dvec3 position, double radius) const;

private:
    glm::dvec3 at_{NAN};
    std::vector<Touch> touches_;
    double free_ = 0;
    double room_ = -INFINITY;  // around at_, from the ball's surface on
};

/// How far a measured gap may err, m: a static point lies within 1e-8 of the size of the numbers on its surface (statics.cpp),
/// a far cell of a grid keeps its distance as a float, 6e-8 of it; the rest is to be safe.
inline double gapError(glm::dvec3 position, double radius, double distance = 0) {
    return 2e-7 * (1 + radius + std::fabs(position.x) + std::fabs(position.y) + std::fabs(position.z) + std::fabs(distance));
}

}  // namespace mb
