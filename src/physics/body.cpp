#include "physics/body.h"

namespace mb {

glm::dquat turned(const glm::dquat& orientation, const glm::dvec3& spin, double time) {
    // A turn by an angle is (1, tan(angle/2)·axis), made a unit. tan x = x(15 − x²)/(15 − 6x²) errs by x⁷/1575
    // (Padé approximant [3/2]); the angle is halved until x ≤ 1/8, and the turn squared as often.
    glm::dvec3 half = 0.5 * time * spin;
    int halvings = 0;
    for (; glm::dot(half, half) > 0.125 * 0.125 && halvings < 40; ++halvings) half *= 0.5;
    const double x2 = glm::dot(half, half);
    if (x2 == 0) return orientation;
    const glm::dvec3 tangent = half * ((15 - x2) / (15 - 6 * x2));
    glm::dquat turn = glm::normalize(glm::dquat{1, tangent.x, tangent.y, tangent.z});
    for (; halvings > 0; --halvings) turn = glm::normalize(turn * turn);
    return glm::normalize(turn * orientation);
}

}  // namespace mb
