#include "physics/surface.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>

namespace mb {
namespace {

constexpr int kCells = 10;        // along the longest side of the box
constexpr int kFewest = 3;        // along the shortest
constexpr double kGrown = 0.37;   // of a cell, that the grid begins outside the box: no face lies between two cells
constexpr double kSharp = 0.99;   // of a cone's cosine: less is an edge or a corner
constexpr double kNearlyFlat = 0.99;  // the same, of a cell that may see no more than the beginning of a round
constexpr std::uint32_t kLeafPoints = 4;

/// A plane that touches the surface.
struct Plane {
    glm::dvec3 point{0}, normal{0};
};

/// The squares of a box's sides, as shares of its longest.
glm::dvec3 stretchOf(glm::dvec3 sides) {
    const glm::dvec3 share = sides / std::max({sides.x, sides.y, sides.z});
    return share * share;
}

/// The surface's plane next to p, if Newton's steps reach the surface within `reach`: steps along the gradient of a frame in which that
/// is a cube, so that of a needle the side is found from beside it and the tip from above.
std::optional<Plane> planeNear(const Tree& tree, glm::dvec3 p, glm::dvec3 centre, glm::dvec3 reach, double on) {
    const glm::dvec3 stretch = stretchOf(reach);
    for (int i = 0; i < 8; ++i) {
        const Slope s = slope(tree, p);
        const double l2 = glm::dot(s.gradient, s.gradient);
        if (!(l2 > 1e-6)) return std::nullopt;
        if (std::fabs(s.distance) <= on) return Plane{p, s.gradient / std::sqrt(l2)};
        const glm::dvec3 way = stretch * s.gradient;
        p -= (s.distance / glm::dot(way, s.gradient)) * way;
        const glm::dvec3 off = glm::abs(p - centre);
        if (off.x > reach.x || off.y > reach.y || off.z > reach.z) return std::nullopt;
    }
    return std::nullopt;
}

/// Where the planes meet, or of the points where they nearly do the one next to the mean of theirs: least squares, drawn to the
/// mean a little, the mean then moved there.
glm::dvec3 meetingPoint(std::span<const Plane> planes, double drawn = 1e-5) {
    glm::dvec3 at{0};
    glm::dmat3 normal{0};
    for (const Plane& p : planes) at += p.point / static_cast<double>(planes.size()), normal += glm::outerProduct(p.normal, p.normal);
    const double draw = drawn * static_cast<double>(planes.size());
    for (int i = 0; i < 3; ++i) normal[i][i] += draw;
    const glm::dmat3 inverse = glm::inverse(normal);
    for (int round = 0; round < 4; ++round) {
        glm::dvec3 off{0};
        for (const Plane& p : planes) off += glm::dot(p.normal, p.point - at) * p.normal;
        at += inverse * off;
    }
    return at;
}

/// A ball that touches planes from within.
struct Round {
    glm::dvec3 middle{0};
    double radius = 0;
};

/// The one that touches all of them as nearly as it can: n·(p − middle) = radius by least squares, as in meetingPoint(). Along a
/// rounded edge it is the one next to the mean of the points.
Round roundWithin(std::span<const Plane> planes) {
    glm::dvec3 mean{0};
    glm::dmat4 normal{0};
    for (const Plane& p : planes) {
        const glm::dvec4 row{p.normal, 1};
        mean += p.point / static_cast<double>(planes.size()), normal += glm::outerProduct(row, row);
    }
    const double draw = 1e-7 * static_cast<double>(planes.size());
    for (int i = 0; i < 4; ++i) normal[i][i] += draw;
    const glm::dmat4 inverse = glm::inverse(normal);
    glm::dvec4 found{0};
    for (int round = 0; round < 6; ++round) {
        glm::dvec4 off{0};
        for (const Plane& p : planes) {
            const glm::dvec4 row{p.normal, 1};
            off += (glm::dot(p.normal, p.point - mean) - glm::dot(row, found)) * row;
        }
        found += inverse * off;
    }
    return {mean + glm::dvec3{found}, found.w};
}

/// A narrow cone that holds the planes' normals: its middle goes ever less far towards the one that is farthest from it
/// (Bădoiu, Clarkson, "Smaller Core-Sets for Balls", 2003).
void setCone(std::span<const Plane> planes, SurfacePoint& out) {
    const auto farthest = [&] { return std::ranges::min_element(planes, {}, [&](const Plane& p) { return glm::dot(p.normal, out.normal); })->normal; };
    out.normal = planes[0].normal;
    for (int i = 1; i <= 40; ++i) {
        const glm::dvec3 middle = out.normal + (farthest() - out.normal) / (i + 1.0);
        if (glm::dot(middle, middle) > 1e-6) out.normal = glm::normalize(middle);
    }
    out.cosine = glm::dot(farthest(), out.normal);
}

/// The points of one cell.
class Cell {
public:
    Cell(const Tree& tree, glm::dvec3 centre, glm::dvec3 half, double size) : tree_(tree), centre_(centre), half_(half), on_(1e-10 * size) {}

    void addTo(std::vector<SurfacePoint>& out) const {
        const std::vector<Plane> all = planes(centre_, 1);
        std::vector<Plane> front, back;
        for (const Plane& plane : all) {
            const bool behind = !front.empty() && glm::dot(plane.normal, front[0].normal) < -0.5;
            (behind ? back : front).push_back(plane);
        }
        if (!back.empty() && addTip(all, out)) return;
        addSide(front, out), addSide(back, out);  // of a thin wall
    }

private:
    /// The surface's planes around a place, as far as that many halves of the cell.
    std::vector<Plane> planes(glm::dvec3 around, double halves) const {
        std::vector<Plane> found;
        for (int k = 0; k < 9; ++k) {
            const glm::dvec3 corner{k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1};
            const glm::dvec3 from = k < 8 ? around + (0.9 * halves) * corner * half_ : around;
            if (const auto plane = planeNear(tree_, from, around, (1.1 * halves) * half_, on_)) found.push_back(*plane);
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

    /// Sets the point to where the planes meet, if the surface does: at once where they are flat; of a bent edge, as of a hole's
    /// rim, the planes ever nearer to it meet ever nearer to it.
    bool setMeeting(std::span<const Plane> planes, SurfacePoint& io_point) const {
        std::vector<Plane> near(planes.begin(), planes.end());
        glm::dvec3 meet = meetingPoint(near);
        if (!isOn(meet) || !isWithin(meet)) {
            if (io_point.cosine >= kSharp) return false;
            meet = meetingPoint(near, 0.1);
            for (double halves = 0.5; !isOn(meet); halves *= 0.5) {
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

    /// A needle's tip or a blade's edge, where all the planes meet.
    bool addTip(std::span<const Plane> planes, std::vector<SurfacePoint>& out) const {
        SurfacePoint tip;
        tip.place = meetingPoint(planes), tip.sharp = true;
        if (!isOn(tip.place) || !isWithin(tip.place) || isHollow(planes)) return false;
        setCone(planes, tip);
        tip.along = edgeOf(planes);
        out.push_back(tip);
        return true;
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

    void addSide(std::span<const Plane> planes, std::vector<SurfacePoint>& out) const {
        if (planes.empty() || isHollow(planes)) return;
        SurfacePoint found;
        setCone(planes, found);
        if (found.cosine > 1 - 1e-9) return;  // flat
        if (setMeeting(planes, found) && isWithin(found.place)) return out.push_back(found);
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
        else if (found.cosine > kNearlyFlat && belongsToNeighbour(planes)) return;
        out.push_back(found);
    }

    bool isOn(glm::dvec3 p) const { return std::fabs(distance<double>(tree_, {p.x, p.y, p.z})) <= 10 * on_; }
    bool isWithin(glm::dvec3 p) const {
        const glm::dvec3 off = glm::abs(p - centre_);
        return off.x <= half_.x && off.y <= half_.y && off.z <= half_.z;
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
        cells[i] = std::max(kFewest, static_cast<int>(std::ceil(kCells * size[i] / longest)));
        cell[i] = std::max(size[i], 1e-6 * longest) / (cells[i] - 2 * kGrown);
    }
    std::vector<SurfacePoint> points;
    const glm::dvec3 half = 0.5 * cell;
    const double reach = glm::length(half);
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x) {
                const glm::dvec3 centre = lo + (glm::dvec3{x, y, z} + 0.5 - kGrown) * cell;
                const double f = distance<double>(tree, {centre.x, centre.y, centre.z});
                out_inner = std::max(out_inner, -f);
                if (std::fabs(f) <= reach) Cell(tree, centre, half, longest).addTo(points);
            }
    return SurfacePoints(std::move(points), 2 * reach, stretchOf(cell));
}

}  // namespace mb
