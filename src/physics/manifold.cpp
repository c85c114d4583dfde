#include "physics/candidate.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace mb {
namespace {

constexpr double kSame = 0.02;              // of the spacing: places nearer than this are one
constexpr double kAlone = 1.5;              // of the spacing: the lowest point within it is looked at
constexpr double kOneEdge = 0.9;            // of two surface normals' product: one edge's, or one curve's
constexpr double kDeeper = 1e-5;            // of the spacing: a lower place is worth a point of its own
constexpr std::uint64_t kOfOther = std::uint64_t{1} << 63;

class Search {
public:
    Search(const Placed& a, std::span<const Placed> others, double margin, std::uint64_t& io_evaluations)
        : a_(a), others_(others), margin_(margin), settler_(margin, io_evaluations) {}

    Manifold run() {
        collectOfA();
        for (std::size_t o = 0; o < others_.size(); ++o) collectOfOther(o);
        Manifold found{{}, margin_};
        if (candidates_.empty()) return found.room = std::max(margin_, room_), found;
        for (const std::vector<Candidate>& group : outermost(touching())) addGroup(group, found.points);
        for (Candidate& c : lowest())
            if (settler_.settleLower(c)) addApart(c, found.points);
        return found;
    }

private:
    /// Whether some point within `radius` of a place may be nearer to the solid than `reach`; if not, how far all are.
    bool near(const Placed& p, glm::dvec3 at, double radius, double between, double reach) const {
        double bound = distanceTo(p.solid->box, p.pose.fromWorld(at)) - radius;
        if (bound <= reach) bound = settler_.fieldOf(p, at) - radius;
        if (bound <= reach) return true;
        room_ = std::min(room_, bound - between);
        return false;
    }

    void collectOfA() {
        const double between = 0.5 * a_.solid->points.spacing(), reach = margin_ + between;
        const auto may = [&](glm::dvec3 centre, double radius) {
            const glm::dvec3 at = a_.pose.toWorld(centre);
            bool any = false;
            for (const Placed& o : others_) any = near(o, at, radius, between, reach) || any;
            return any;
        };
        a_.solid->points.search(may, [&](std::uint32_t i, const SurfacePoint& point) {
            const glm::dvec3 at = a_.pose.toWorld(point.place);
            Candidate best{at, reach, i, 0, true, &a_, &a_, &point};
            bool found = false;
            for (std::size_t o = 0; o < others_.size(); ++o) {
                if (distanceTo(others_[o].solid->box, others_[o].pose.fromWorld(at)) - point.round > best.gap) continue;
                const double f = settler_.fieldOf(others_[o], at) - point.round;
                if (f < best.gap || (!found && f <= best.gap)) best.gap = f, best.other = o, found = true;
            }
            best.asked = &others_[best.other];
            if (found) candidates_.push_back(best);
            else room_ = margin_;  // it is not known how much more
        });
    }

    void collectOfOther(std::size_t o) {
        const Placed& other = others_[o];
        const double between = 0.5 * other.solid->points.spacing(), reach = margin_ + between;
        const auto may = [&](glm::dvec3 centre, double radius) { return near(a_, other.pose.toWorld(centre), radius, between, reach); };
        other.solid->points.search(may, [&](std::uint32_t i, const SurfacePoint& point) {
            const glm::dvec3 at = other.pose.toWorld(point.place);
            const double f = settler_.fieldOf(a_, at) - point.round;
            if (f > reach) room_ = std::min(room_, f - between);
            else candidates_.push_back({at, f, kOfOther | (std::uint64_t{other.number} << 32) | i, o, false, &other, &a_, &point});
        });
    }

    std::vector<Candidate> touching() const {
        std::vector<Candidate> found;
        for (Candidate c : candidates_)
            if (settler_.settle(c)) found.push_back(c);
        return found;
    }

    /// The points of one face, brought to where the other is nearest; and if none of them is the lowest, as where two rims cross
    /// between points, that place too.
    void addGroup(const std::vector<Candidate>& group, std::vector<ManifoldPoint>& io_points) const {
        const Candidate* deepest = nullptr;
        std::vector<Candidate> settled = group;
        for (std::size_t i = 0; i < group.size(); ++i) {
            Candidate& c = settled[i];
            if (!c.lowest) settler_.refine(c, Settler::Until::rim);
            if (!settler_.isContact(c)) c = group[i];
            if (!settler_.isContact(c)) continue;
            addApart(c, io_points);
            if (!deepest || c.gap < deepest->gap) deepest = &c;
        }
        if (!deepest) return;
        Candidate lower = *deepest;
        settler_.refine(lower, Settler::Until::lowest);
        if (lower.gap < deepest->gap - kDeeper * lower.fineness() && settler_.isContact(lower)) addApart(lower, io_points);
    }

    /// Of a curve, or where two edges cross, the points on either side may be beyond the margin though the curve is within it: of
    /// those the lowest around, of each edge and face of its own.
    std::vector<Candidate> lowest() const {
        std::vector<Candidate> found;
        for (const Candidate& c : candidates_) {
            if (c.gap <= margin_) continue;
            const double around = kAlone * c.spacing();
            const bool beaten = std::ranges::any_of(candidates_, [&](const Candidate& d) {
                return d.of_a == c.of_a && d.other == c.other && (d.gap < c.gap || (d.gap == c.gap && d.feature < c.feature)) &&
                       glm::length(d.at - c.at) < around && glm::dot(d.from->normal, c.from->normal) > kOneEdge;
            });
            if (!beaten) found.push_back(c);
        }
        return found;
    }

    /// Of each group of like normals the outermost in eight directions, and the deepest if it is deeper than all of those.
    /// The directions lie in a's frame, off its axes: they choose the same points while a rests.
    std::vector<std::vector<Candidate>> outermost(const std::vector<Candidate>& all) const {
        std::vector<std::vector<Candidate>> chosen;
        std::vector<char> grouped(all.size(), 0);
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (grouped[i]) continue;
            std::vector<std::size_t> group;
            for (std::size_t k = i; k < all.size(); ++k)
                if (!grouped[k] && glm::dot(all[i].normal, all[k].normal) > kAlike) grouped[k] = 1, group.push_back(k);
            chooseOf(all, group, chosen.emplace_back());
        }
        return chosen;
    }

    void chooseOf(const std::vector<Candidate>& all, const std::vector<std::size_t>& group, std::vector<Candidate>& out) const {
        const std::size_t deepest = *std::ranges::min_element(group, {}, [&](std::size_t k) { return all[k].gap; });
        const glm::dvec3 n = all[group[0]].normal;
        const glm::dvec3 in_a = n * a_.pose.rotation, size = glm::abs(in_a);
        const int axis = size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2;
        const glm::dvec3 u = glm::normalize(glm::cross(n, a_.pose.rotation[axis])), v = glm::cross(n, u);
        constexpr std::array<std::array<double, 2>, 8> kWays{{{0.92, 0.39}, {0.37, 0.93}, {-0.41, 0.91}, {-0.94, 0.35},
                                                              {-0.91, -0.42}, {-0.36, -0.93}, {0.4, -0.92}, {0.93, -0.38}}};
        std::vector<std::size_t> picked;
        for (const auto& [x, y] : kWays) {
            const glm::dvec3 way = x * u + y * v;
            const std::size_t far = *std::ranges::max_element(group, {}, [&](std::size_t k) { return glm::dot(way, all[k].at - a_.pose.position); });
            if (std::ranges::find(picked, far) == picked.end()) picked.push_back(far);
        }
        const bool beneath = std::ranges::all_of(picked, [&](std::size_t k) { return all[deepest].gap < all[k].gap - 0.1 * std::fabs(margin_); });
        if (beneath) picked.push_back(deepest);
        for (const std::size_t k : picked) out.push_back(all[k]);
    }

    /// Adds it unless there is one at its place already; of two the deeper stays.
    void addApart(const Candidate& c, std::vector<ManifoldPoint>& io_points) const {
        const ManifoldPoint point{c.at, c.normal, c.gap, c.feature, c.other};
        const double same = kSame * c.fineness();
        for (ManifoldPoint& p : io_points) {
            if (p.other != c.other || glm::length(p.point - c.at) > same || glm::dot(p.normal, c.normal) < kAlike) continue;
            if (c.gap < p.gap - 1e-9) p = point;
            return;
        }
        io_points.push_back(point);
    }

    const Placed& a_;
    std::span<const Placed> others_;
    double margin_;
    Settler settler_;
    std::vector<Candidate> candidates_;
    mutable double room_ = INFINITY;        // of what was not looked at closely
};

}  // namespace

Manifold manifold(const Placed& a, std::span<const Placed> others, double margin, std::uint64_t& io_evaluations) {
    return Search(a, others, margin, io_evaluations).run();
}

}  // namespace mb
