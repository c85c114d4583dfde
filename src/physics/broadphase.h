#pragma once
// Which bodies may meet: the pairs that are within reach of one another.
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <span>
#include <utility>
#include <vector>

namespace mb {

/// A body and how far around its centre it may reach, m; finite, and more than 0.
struct Reach {
    glm::dvec3 centre{0};
    double reach = 0;
};

/// Every pair (i < j) of those that overlap, sorted: the same set as comparing each with each. Bodies of about one size lie in
/// rows along x, as wide as the largest of them, and look along the rows around theirs, and along those within their reach of every
/// lesser size, so that the work grows with the bodies and the pairs (a hierarchical grid, swept along one axis; Ericson, "Real-Time
/// Collision Detection", 2005, sections 7.2 and 7.5).
std::vector<std::pair<int, int>> overlappingPairs(std::span<const Reach> bodies);

/// The pairs that may meet for some time: found once, and good for as long as every body stays within the reach it was given
/// around a place that drifts. (Of things that fall together the drift is most of what moves.)
class PairList {
public:
    /// From now on, of bodies that drift at `drift` m/s but for what their reach allows.
    void find(std::vector<Reach> bodies, glm::dvec3 drift) {
        reach_ = std::move(bodies), drift_ = drift, age_ = 0, pairs_ = overlappingPairs(reach_);
    }
    void forget() { reach_.clear(), pairs_.clear(); }
    void pass(double seconds) { age_ += seconds; }
    glm::dvec3 drift() const { return drift_; }
    /// Whether there are so many bodies and all stay within their reach, each given how far around its centre it will need.
    template <class ReachOf> bool holds(std::size_t bodies, ReachOf reach_of) const {
        if (bodies != reach_.size()) return false;
        const glm::dvec3 drifted = age_ * drift_;
        for (std::size_t i = 0; i < bodies; ++i) {
            const Reach needed = reach_of(i);
            const glm::dvec3 off = needed.centre - reach_[i].centre - drifted;
            const double room = reach_[i].reach - needed.reach;
            if (!(room >= 0 && glm::dot(off, off) <= room * room)) return false;
        }
        return true;
    }
    std::span<const std::pair<int, int>> pairs() const { return pairs_; }
    std::size_t bytes() const { return reach_.size() * sizeof(Reach) + pairs_.size() * sizeof pairs_[0]; }

private:
    std::vector<Reach> reach_;
    glm::dvec3 drift_{0};
    double age_ = 0;                       // s
    std::vector<std::pair<int, int>> pairs_;
};

/// Whether the balls do within which they reach; rounding included.
inline bool overlap(const Reach& a, const Reach& b) {
    const double r = (a.reach + b.reach) * (1 + 1e-12);
    const glm::dvec3 d = a.centre - b.centre;
    return glm::dot(d, d) <= r * r;
}

}  // namespace mb
