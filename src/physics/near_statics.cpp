#include "physics/near_statics.h"

#include <glm/geometric.hpp>

namespace mb {

void NearStatics::moveTo(const StaticField& field, glm::dvec3 position, double radius, StepCounts& io_counts) {
    if (at_ == position) return;
    at_ = position;
    free_ = field.touches(position, radius, kNear * radius, touches_, &room_);
    ++io_counts.static_queries;
}

/// Distances are 1-Lipschitz: a ball that moved by m has at least the room it had, less m.
double NearStatics::roomAt(glm::dvec3 position, double radius) const {
    if (!(room_ > 0)) return -1;
    return room_ - glm::length(position - at_) - gapError(position, radius, room_);
}

}  // namespace mb
