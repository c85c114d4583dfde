#pragma once
// What does not move, as the bodies meet it. One way for every shape; a floor is a shape like any other. Many shapes, and shapes
// of many leaves, are found through grids.
#include "physics/touch.h"

namespace mb {

class StaticField {
public:
    StaticField() = default;
    /// The top-level objects `wanted` says yes to. Those that cannot be evaluated are left out, and named in notes. `with_points`:
    /// bodies that are no balls may meet them. What was there before saves work where little has changed.
    StaticField(const Scene& scene, const std::function<bool(std::size_t)>& wanted, std::vector<std::string>& io_notes,
                const StaticField* before = nullptr, bool with_points = false);

    /// The touches of all solids (addTouches, keepUnhidden). Returns a gap that is certain to be free: at most that of the
    /// nearest point. `out_room`, if asked for, is what the distances alone prove to be free: negative in an overlap.
    double touches(glm::dvec3 centre, double radius, double margin, std::vector<Touch>& out, double* out_room = nullptr) const;

    /// What the distances prove to be free around a ball, m from its surface on.
    double room(glm::dvec3 centre, double radius) const;
    /// The numbers of the solids that may have a surface within reach of the centre, in order.
    std::vector<std::size_t> solidsNear(glm::dvec3 centre, double reach) const;
    const Solid& solid(std::size_t number) const { return solids_[number]; }

    void countEvaluations(std::uint64_t more) const { evaluations_ += more; }
    std::uint64_t evaluations() const { return evaluations_; }
    bool empty() const { return solids_.empty(); }

private:
    std::vector<Solid> solids_;
    std::shared_ptr<const Grid> grid_;       // of them all together, where they are many
    std::vector<std::size_t> solid_of_;      // by a leaf's number in that grid
    mutable std::uint64_t evaluations_ = 0;  // of a solid's whole tree, or as much work
};

}  // namespace mb
