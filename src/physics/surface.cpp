#include "physics/surface.h"

#include "physics/planes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace mb {
namespace {

constexpr int kCells = 11;        // along the longest side of the box; odd, as the others: no symmetric shape's middle lies between two
constexpr int kFewest = 3;        // along the shortest
constexpr double kGrown = 0.37;   // of a cell, that the grid begins outside the box: no face lies between two cells
constexpr double kSharp = 0.99;   // of a cone's cosine: less is an edge or a corner
constexpr double kNearlyFlat = 0.99;  // the same, of a cell that may see no more than the beginning of a round
constexpr double kOpposite = -0.6;    // the same: two sides of a wall. (Not -0.5, that of a triangle's corner)
constexpr std::size_t kSure = 3;  // planes in a cell, that tell whether it is flat
constexpr double kAlike = 0.9;    // of two unit normals' product: one point's
// Of half a cell: how far from its middle its planes may lie. An edge between two cells needs more, a fine round less.
constexpr std::array kReaches{1.3, 2.0};
constexpr std::uint32_t kLeafPoints = 4;

void setCone(std::span<const Plane> planes, SurfacePoint& out) {
    const NormalCone cone = coneOf(planes);
    out.normal = cone.normal, out.cosine = cone.cosine;
}

/// The points of one cell.
class Cell {
public:
    Cell(const Tree& tree, glm::dvec3 centre, glm::dvec3 half, double size) : tree_(tree), centre_(centre), half_(half), on_(1e-10 * size) {}

    void addTo(std::vector<SurfacePoint>& out) const {
        for (const double reach : kReaches) addTo(out, planes(centre_, 1, reach));
    }

    /// The deepest place behind the surface here: of a wall thinner than a cell about its middle.
    void deepen(Depth& io_deepest) const {
        for (const Plane& plane : planes(centre_, 1))
            for (double in = 2 * glm::length(half_); in > 1e-6 * glm::length(half_); in *= 0.7) io_deepest.tryAt(tree_, plane.point - in * plane.normal);
    }

private:
    void addTo(std::vector<SurfacePoint>& out, const std::vector<Plane>& all) const {
        // Of a thin wall two sides; what lies across both, as its end does, is of either.
        std::vector<Plane> front, back;
        const auto opposite = [](const Plane& p, const Plane& q) { return glm::dot(p.normal, q.normal) < kOpposite; };
        for (const Plane& plane : all) (opposite(plane, all[0]) ? back : front).push_back(plane);
        if (!back.empty()) {
            addTip(all, out);
            const Plane behind = back[0];
            std::ranges::copy_if(front, std::back_inserter(back), [&](const Plane& p) { return !opposite(p, behind); });
        }
        addSide(front, out), addSide(back, out);
    }

    /// Adds a point that is not there yet, from another cell's or another reach's planes.
    void add(const SurfacePoint& point, std::vector<SurfacePoint>& out) const {
        const double same = 1e-3 * glm::length(half_);
        const auto is_it = [&](const SurfacePoint& p) {
            return glm::length(p.place - point.place) < same && std::fabs(p.round - point.round) < same && glm::dot(p.normal, point.normal) > kAlike &&
                   p.cosine <= point.cosine + 0.05;
        };
        if (std::ranges::any_of(out, is_it)) return;
        out.push_back(point);
        if (point.along != glm::dvec3{0})
            for (const double way : {1.0, -1.0}) addEnd(point, way * point.along, out);
    }

    /// Where a straight edge ends nearby there is a corner, of which its cell may see but two faces. (A bent edge leaves its tangent at once.)
    void addEnd(const SurfacePoint& edge, glm::dvec3 way, std::vector<SurfacePoint>& out) const {
        constexpr double kStraight = 0.01;  // of half a cell's diagonal
        const double length = 2 * glm::length(half_);
        if (isOn(edge.place + length * way)) return;
        double on = 0, off = length;
        while (off - on > 1e-9 * length) {
            const double middle = 0.5 * (on + off);
            (isOn(edge.place + middle * way) ? on : off) = middle;
        }
        if (on < kStraight * length) return;
        SurfacePoint end;
        end.place = edge.place + on * way, end.sharp = true;
        std::vector<Plane> around = planes(end.place, kStraight);
        std::erase_if(around, [&](const Plane& p) { return !(std::fabs(glm::dot(p.normal, end.place - p.point)) <= 1e-3 * kStraight * length); });
        if (around.size() < 3) return;
        if (const glm::dvec3 meet = meetingPoint(around); isMeeting(around, meet)) end.place = meet;  // to the last digits
        setCone(around, end);
        if (end.cosine < edge.cosine) add(end, out);
    }

    /// The surface's planes around a place, as far as `reach` times that many halves of the cell.
    std::vector<Plane> planes(glm::dvec3 around, double halves, double reach = kReaches[0]) const {
        std::vector<Plane> found;
        for (int k = 0; k < 9; ++k) {
            const glm::dvec3 corner{k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1};
            const glm::dvec3 from = k < 8 ? around + (1.1 * halves) * corner * half_ : around;
            if (const auto plane = planeNear(tree_, from, around, (reach * halves) * half_, on_)) found.push_back(*plane);
        }
        return found;
    }

    /// Whether every plane has the others' points in front of it.
    bool isHollow(std::span<const Plane> planes) const {
        double most = 0;
        for (const Plane& p : planes) {
            for (const Plane& q : planes) {
                const double above = glm::dot(p.normal, q.point - p.point);
                if (above < -10 * on_) return false;
                most = std::max(most, above);
            }
        }
        return most > 1000 * on_;
    }

    /// Whether a place is on the surface, and on each of the planes: those of a thin wall and of its end have no such place.
    bool isMeeting(std::span<const Plane> planes, glm::dvec3 place) const {
        const auto holds = [&](const Plane& p) { return std::fabs(glm::dot(p.normal, place - p.point)) <= 1000 * on_; };
        return isOn(place) && std::ranges::all_of(planes, holds);
    }

    /// Sets the point to where the planes meet, if the surface does: at once where they are flat; of a bent edge, as of a hole's
    /// rim, the planes ever nearer to it meet ever nearer to it.
    bool setMeeting(std::span<const Plane> planes, SurfacePoint& io_point) const {
        std::vector<Plane> near(planes.begin(), planes.end());
        glm::dvec3 meet = meetingPoint(near);
        if (!isMeeting(near, meet)) {
            if (io_point.cosine >= kSharp) return false;
            meet = meetingPoint(near, 0.1);
            for (double halves = 0.5; !isMeeting(near, meet); halves *= 0.5) {
                near = this->planes(meet, halves);
                if (halves < 1e-8 || near.size() < 2) return false;
                meet = meetingPoint(near, 0.1 * halves * halves);
            }
        }
        SurfacePoint found;
        setCone(near, found);
        if (io_point.cosine < kSharp && found.cosine >= kSharp) return false;
        found.place = meet, found.sharp = found.cosine < kSharp;
        if (found.sharp) found.along = edgeOf(near);
        io_point = found;
        return true;
    }

    /// A needle's tip or a blade's edge, where all the planes of both sides meet.
    void addTip(std::span<const Plane> planes, std::vector<SurfacePoint>& out) const {
        SurfacePoint tip;
        setCone(planes, tip);
        if (!isHollow(planes) && setMeeting(planes, tip) && isWithin(tip.place)) add(tip, out);
    }

    /// The direction of the edge where the planes meet; 0: they meet in a corner.
    static glm::dvec3 edgeOf(std::span<const Plane> planes) {
        glm::dvec3 along{0};
        for (const Plane& p : planes) {
            const glm::dvec3 cross = glm::cross(planes[0].normal, p.normal);
            if (glm::dot(cross, cross) > glm::dot(along, along)) along = cross;
        }
        if (!(glm::length(along) > 0.1)) return glm::dvec3{0};
        along = glm::normalize(along);
        for (const Plane& p : planes)
            if (std::fabs(glm::dot(p.normal, along)) > 0.1) return glm::dvec3{0};
        return along;
    }

    void addSide(std::vector<Plane> planes, std::vector<SurfacePoint>& out) const {
        if (planes.empty() || isHollow(planes)) return;
        SurfacePoint found;
        setCone(planes, found);
        if (isFlat(found)) return;
        const bool meet = setMeeting(planes, found);
        if (meet && isWithin(found.place)) return add(found, out);
        // What is bent may be another cell's; what lies in this one may be curved all the same.
        std::vector<Plane> own;
        std::ranges::copy_if(planes, std::back_inserter(own), [&](const Plane& p) { return isWithin(p.point); });
        if (own.empty()) return;
        SurfacePoint of_own;
        setCone(own, of_own);
        if (isFlat(of_own) && (meet || own.size() >= kSure)) return;
        if (meet) planes = own, found = of_own;
        // Of a curve, the point nearest to the middle of those found, if it is this cell's.
        glm::dvec3 middle{0};
        for (const Plane& p : planes) middle += p.point / static_cast<double>(planes.size());
        const auto plane = planeNear(tree_, middle, centre_, half_, on_);
        if (!plane) return;
        found.place = plane->point;
        std::vector<Plane> all(planes.begin(), planes.end());
        all.push_back(*plane);
        if (const auto round = roundOf(all, found.normal); round && isWithin(round->middle + round->radius * found.normal))
            found.place = round->middle, found.round = round->radius;
        else if (found.cosine > kNearlyFlat && (isMostlyFlat(planes) || belongsToNeighbour(planes))) return;
        add(found, out);
    }

    /// Whether kSure of the planes are parallel: a flat face, and the beginning of its rim.
    static bool isMostlyFlat(std::span<const Plane> planes) {
        return std::ranges::any_of(planes, [&](const Plane& p) {
            return std::ranges::count_if(planes, [&](const Plane& q) { return glm::dot(p.normal, q.normal) > 1 - 1e-9; }) >= static_cast<int>(kSure);
        });
    }
    static bool isFlat(const SurfacePoint& p) { return p.cosine > 1 - 1e-9; }
    bool isOn(glm::dvec3 p) const { return std::fabs(distance<double>(tree_, {p.x, p.y, p.z})) <= 10 * on_; }
    bool isWithin(glm::dvec3 p) const {
        const glm::dvec3 off = glm::abs(p - centre_), most = (1 + 1e-6) * half_;  // what lies between two cells is of both
        return off.x <= most.x && off.y <= most.y && off.z <= most.z;
    }

    /// Whether what is curved a little here is the beginning of a round whose middle another cell has.
    bool belongsToNeighbour(std::span<const Plane> own) const {
        std::vector<Plane> around = planes(centre_, 2);
        around.insert(around.end(), own.begin(), own.end());
        SurfacePoint wide;
        setCone(around, wide);
        const auto round = roundOf(around, wide.normal);
        return round && wide.cosine < kNearlyFlat && !isWithin(round->middle + round->radius * wide.normal);
    }

    /// The round that all the planes touch, if its surface is the shape's.
    std::optional<Round> roundOf(std::span<const Plane> planes, glm::dvec3 normal) const {
        const Round round = roundWithin(planes);
        if (round.radius > 2 * glm::length(half_)) return std::nullopt;  // no edge: points far from their surface are hard to find
        const double off = 100 * on_;
        const auto differs = [&](glm::dvec3 p, double f) { return !(std::fabs(distance<double>(tree_, {p.x, p.y, p.z}) - f) <= off); };
        if (!(round.radius > 0) || differs(round.middle, -round.radius) || differs(round.middle + round.radius * normal, 0)) return std::nullopt;
        for (const Plane& p : planes)
            if (!(std::fabs(glm::dot(p.normal, p.point - round.middle) - round.radius) <= off)) return std::nullopt;
        return round;
    }

    const Tree& tree_;
    glm::dvec3 centre_, half_;
    double on_;
};

}  // namespace

SurfacePoints::SurfacePoints(std::vector<SurfacePoint> points, double spacing, glm::dvec3 stretch)
    : points_(std::move(points)), spacing_(spacing), stretch_(stretch) {
    if (!points_.empty()) build(0, static_cast<std::uint32_t>(points_.size()));
}

/// Halves the points along their box's longest side until few are left.
void SurfacePoints::build(std::uint32_t first, std::uint32_t count) {
    const std::size_t n = nodes_.size();
    const auto begin = points_.begin() + first, end = begin + count;
    glm::dvec3 lo = begin->place, hi = lo;
    for (auto p = begin; p != end; ++p) lo = glm::min(lo, p->place), hi = glm::max(hi, p->place);
    Node node{0.5 * (lo + hi), 0, first, count, 0};
    for (auto p = begin; p != end; ++p) node.radius = std::max(node.radius, glm::length(p->place - node.centre) + p->round);
    nodes_.push_back(node);
    if (count > kLeafPoints) {
        const glm::dvec3 size = hi - lo;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        std::stable_sort(begin, end, [axis](const SurfacePoint& a, const SurfacePoint& b) { return a.place[axis] < b.place[axis]; });
        build(first, count / 2);
        build(first + count / 2, count - count / 2);
    }
    nodes_[n].skip = static_cast<std::uint32_t>(nodes_.size());
}

SurfacePoints surfacePoints(const Tree& tree, const Box& box, double& out_inner) {
    const glm::dvec3 lo{box.lo[0], box.lo[1], box.lo[2]}, size = glm::dvec3{box.hi[0], box.hi[1], box.hi[2]} - lo;
    const double longest = std::max({size.x, size.y, size.z});
    out_inner = 0;
    if (!(longest > 0)) return {};
    glm::ivec3 cells;
    glm::dvec3 cell;
    for (int i = 0; i < 3; ++i) {
        cells[i] = std::max(kFewest, static_cast<int>(std::ceil(kCells * size[i] / longest))) | 1;
        cell[i] = std::max(size[i], 1e-6 * longest) / (cells[i] - 2 * kGrown);
    }
    std::vector<SurfacePoint> points;
    const glm::dvec3 half = 0.5 * cell;
    const double reach = glm::length(half);
    Depth deepest;
    std::vector<Cell> crossed;
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x) {
                const glm::dvec3 centre = lo + (glm::dvec3{x, y, z} + 0.5 - kGrown) * cell;
                const double f = distance<double>(tree, {centre.x, centre.y, centre.z});
                if (-f > deepest.depth) deepest = {centre, -f};
                if (std::fabs(f) > reach) continue;
                crossed.emplace_back(tree, centre, half, longest).addTo(points);
            }
    if (deepest.depth < reach)  // all of it is thinner than a cell
        for (const Cell& c : crossed) c.deepen(deepest);
    deepest.climb(tree, half);
    out_inner = deepest.depth;
    return SurfacePoints(std::move(points), 2 * reach, stretchOf(cell));
}

}  // namespace mb
