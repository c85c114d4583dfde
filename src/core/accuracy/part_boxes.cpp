#include "core/accuracy/part_boxes.h"

#include <algorithm>
#include <numeric>

namespace mb::accuracy {
namespace {

constexpr std::uint32_t kFew = 2;

double middle(const Box& box, std::size_t axis) { return box.lo[axis] / 2 + box.hi[axis] / 2; }

}  // namespace

PartBoxes::PartBoxes(const std::vector<Box>& boxes) : order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!boxes.empty()) build(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
}

// Halves the boxes by their middles along the axis on which those lie furthest apart: at most 32 levels.
void PartBoxes::build(const std::vector<Box>& boxes, std::uint32_t begin, std::uint32_t end) {
    Node node{glm::dvec3(kInfinity), glm::dvec3(-kInfinity), begin, end - begin};
    glm::dvec3 least(kInfinity), most(-kInfinity);
    for (std::uint32_t i = begin; i < end; ++i) {
        const Box& box = boxes[order_[i]];
        node.lo = glm::min(node.lo, glm::dvec3(box.lo[0], box.lo[1], box.lo[2]));
        node.hi = glm::max(node.hi, glm::dvec3(box.hi[0], box.hi[1], box.hi[2]));
        const glm::dvec3 centre(middle(box, 0), middle(box, 1), middle(box, 2));
        least = glm::min(least, centre), most = glm::max(most, centre);
    }
    const std::size_t at = nodes_.size();
    nodes_.push_back(node);
    if (end - begin <= kFew) return;

    const glm::dvec3 wide = most - least;
    const std::size_t axis = wide.x >= wide.y && wide.x >= wide.z ? 0 : wide.y >= wide.z ? 1 : 2;
    const std::uint32_t half = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return middle(boxes[a], axis) < middle(boxes[b], axis); });
    build(boxes, begin, half);
    nodes_[at].first = static_cast<std::uint32_t>(nodes_.size()), nodes_[at].count = 0;
    build(boxes, half, end);
}

// No 0: infinity times 0 is not a number.
glm::dvec3 PartBoxes::inverseOf(glm::dvec3 direction) {
    glm::dvec3 inverse;
    for (int axis = 0; axis < 3; ++axis) inverse[axis] = std::fabs(direction[axis]) > 1e-300 ? 1 / direction[axis] : 1e300;
    return inverse;
}

}  // namespace mb::accuracy
