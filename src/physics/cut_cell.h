#pragma once
// A cell cut by a plane.
#include <glm/vec3.hpp>

namespace mb {

/// What is left of a cell whose points have places from −1 to 1 along each axis.
struct Cut {
    double part = 0;       // of the cell's volume, 0 to 1
    glm::dvec3 first{0};   // the mean over the cell of the place where it is left, of 0 elsewhere: part times the centroid

    Cut& operator+=(const Cut& b) { return part += b.part, first += b.first, *this; }
    Cut& operator-=(const Cut& b) { return part -= b.part, first -= b.first, *this; }
};

/// The part where slope·place < level. The slope is not 0. Exact but where a slope along one axis is less than a thousandth of
/// the steepest: there within 1e-6 of the cell.
Cut behindPlane(const glm::dvec3& slope, double level);

}  // namespace mb
