#pragma once
// A hierarchy of bounding volumes over boxes: which of thousands a ray may meet, the nearest first.
#include "core/accuracy/implicit.h"

#include <glm/common.hpp>

#include <cstdint>
#include <vector>

namespace mb::accuracy {

class PartBoxes {
public:
    PartBoxes() = default;
    explicit PartBoxes(const std::vector<Box>& boxes);  // all finite

    /// Calls visit(i) for each box i that the ray crosses nearer than visit's last answer, which begins as `far`.
    template <class Visit> void cross(const Ray& ray, double far, Visit visit) const {
        if (nodes_.empty()) return;
        const glm::dvec3 inverse = inverseOf(ray.direction);
        const auto entry = [&](std::uint32_t i) { return nodes_[i].entry(ray.origin, inverse); };
        struct Waiting {
            std::uint32_t node;
            double t;
        };
        Waiting stack[64];
        std::size_t top = 0;
        if (const double t = entry(0); t <= far) stack[top++] = {0, t};
        while (top > 0) {
            const Waiting next = stack[--top];
            if (next.t > far) continue;
            const Node& node = nodes_[next.node];
            if (node.count > 0) {
                for (std::uint32_t i = 0; i < node.count; ++i) far = visit(order_[node.first + i]);
                continue;
            }
            Waiting near{next.node + 1, entry(next.node + 1)}, further{node.first, entry(node.first)};
            if (further.t < near.t) std::swap(near, further);
            if (further.t <= far) stack[top++] = further;
            if (near.t <= far) stack[top++] = near;
        }
    }

private:
    struct Node {
        glm::dvec3 lo, hi;
        std::uint32_t first = 0, count = 0;  // of a leaf: in order_; else its second child's number, the first being the next
        /// Infinite where the ray passes by.
        double entry(glm::dvec3 origin, glm::dvec3 inverse) const {
            const glm::dvec3 a = (lo - origin) * inverse, b = (hi - origin) * inverse, in = glm::min(a, b), out = glm::max(a, b);
            const double enter = std::max(std::max(in.x, in.y), std::max(in.z, 0.0)), leave = std::min(std::min(out.x, out.y), out.z);
            return enter <= leave ? enter : kInfinity;
        }
    };
    static glm::dvec3 inverseOf(glm::dvec3 direction);
    void build(const std::vector<Box>& boxes, std::uint32_t begin, std::uint32_t end);

    std::vector<Node> nodes_;  // a node's first child follows it
    std::vector<std::uint32_t> order_;
};

}  // namespace mb::accuracy
