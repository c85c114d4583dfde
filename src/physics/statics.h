#pragma once
// What does not move, as the bodies meet it. One way for every shape; a floor is a shape like any other. Many shapes, and shapes
// of many leaves, are found through grids.
#include "physics/touch.h"

#include <atomic>
#include <functional>
#include <optional>

namespace mb {

/// A count that several threads may add to.
class Tally {
public:
    Tally() = default;
    Tally(const Tally& other) : count_(other.value()) {}
    Tally& operator=(const Tally& other) { return count_ = other.value(), *this; }
    void add(std::uint64_t more) { count_.fetch_add(more, std::memory_order_relaxed); }
    std::uint64_t value() const { return count_.load(std::memory_order_relaxed); }

private:
    std::atomic<std::uint64_t> count_{0};
};

/// A straight way out of the solids a place lies in.
struct WayOut {
    glm::dvec3 direction{0};  // unit
    double length = 0;        // m
};

/// Several threads may ask it at once.
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
    /// Whether a place is in a solid.
    bool contains(glm::dvec3 place) const { return deepestAt(place) < 0; }
    /// Whether what goes out of one solid at `exit`, along its normal, and is `thick` (m), goes into another that would send it back: a
    /// floor below a box that stands on it.
    bool isBlocked(glm::dvec3 exit, glm::dvec3 normal, double thick) const;
    /// The shortest of 26 straight ways to where something so thick is in no solid; nothing, if it is there, or none is known.
    std::optional<WayOut> wayOut(glm::dvec3 from, double thick) const;
    /// visit(number), of the solids that may have a surface within reach of the centre, in order.
    template <class Visit> void eachNear(glm::dvec3 centre, double reach, Visit visit) const {
        if (grid_) return eachInGrid(centre, reach, visit);
        for (std::size_t i = 0; i < solids_.size(); ++i) visit(i);
    }
    const Solid& solid(std::size_t number) const { return solids_[number]; }

    void countEvaluations(std::uint64_t more) const { evaluations_.add(more); }
    std::uint64_t evaluations() const { return evaluations_.value(); }
    bool empty() const { return solids_.empty(); }

private:
    void eachInGrid(glm::dvec3 centre, double reach, const std::function<void(std::size_t)>& visit) const;
    double deepestAt(glm::dvec3 place) const;
    double lengthOut(glm::dvec3 from, glm::dvec3 direction, double thick, double most) const;

    std::vector<Solid> solids_;
    std::shared_ptr<const Grid> grid_;       // of them all together, where they are many
    std::vector<std::size_t> solid_of_;      // by a leaf's number in that grid
    mutable Tally evaluations_;              // of a solid's whole tree, or as much work
};

}  // namespace mb
