#include "physics/touch.h"

#include "physics/closest.h"
#include "physics/near_statics.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <optional>

namespace mb {
namespace {

constexpr std::size_t kNearLeaves = 8;  // of one solid, looked at around one ball: their faces, edges and corners
constexpr double kTooNear = 1e-9;       // of the radius: a point so near to the centre has no direction
constexpr double kOnSurface = 1e-8;     // of the radius: so near is on it
constexpr double kFinest = 1e-7;        // a turn that makes no difference

/// The search of one solid's points around one ball.
struct Search {
    const Solid& solid;
    glm::dvec3 c;
    double radius, margin;
    std::vector<Touch>& found;
    std::uint64_t& evaluations;

    double field(glm::dvec3 p) const { return ++evaluations, solid.at(p); }

    /// A shape less itself has a surface of no thickness. Behind a face there is solid; behind a sharp corner, where the
    /// line from the ball may pass it by, there is some towards the leaf's middle.
    bool solidBehind(glm::dvec3 point, glm::dvec3 normal, std::span<const std::size_t> leaves) const {
        const double reach = 1e-4 * radius;
        if (field(point - reach * normal) < 0) return true;
        if (leaves.empty()) return false;
        const glm::dvec3 inwards = solid.tree.leaves[leaves[0]].position - point;
        const double l = glm::length(inwards);
        return l > 0 && field(point + (reach / l) * inwards) < 0;
    }

    /// Adds the local minimum of the distance on these leaves (or on the whole tree, where there are none) if it lies on
    /// the solid's surface and faces the ball.
    bool add(std::span<const std::size_t> leaves, glm::dvec3 start, bool* parallel = nullptr, bool anywhere = false) const {
        std::array<Surface, 3> surfaces{};
        for (std::size_t i = 0; i < leaves.size(); ++i) surfaces[i].leaf = &solid.tree.leaves[leaves[i]];
        if (leaves.empty()) surfaces[0].tree = &solid.tree;
        const std::span<const Surface> all(surfaces.data(), std::max<std::size_t>(leaves.size(), 1));
        const auto closest = anywhere ? pointOn(all, c, start, radius, evaluations) : closestPoint(all, c, start, radius, evaluations, parallel);
        if (!closest) return false;

        const glm::dvec3 away = c - closest->point;
        const double d = glm::length(away);
        if (!(d > kTooNear * radius) || d > radius + margin) return false;
        const double on = 1e-8 * (1 + radius + glm::length(c));
        if (std::fabs(field(closest->point)) > on) return false;
        // On an edge each surface must push outwards; on a face there must be a solid behind the point.
        if (leaves.size() > 1) {
            for (std::size_t i = 0; i < leaves.size(); ++i)
                if (closest->shares[i] * solid.side[leaves[i]] < -1e-9 * d) return false;
        } else if (!solidBehind(closest->point, away / d, leaves)) {
            return false;
        }
        found.push_back({closest->point, away / d, d - radius});
        return true;
    }

    /// The leaves whose surface may be within reach, nearest first.
    std::vector<std::size_t> nearLeaves() const {
        std::vector<std::pair<double, std::size_t>> near;
        const auto look = [&](std::size_t i) {
            if (solid.side[i] == 0) return;
            const Leaf& leaf = solid.tree.leaves[i];
            const glm::dvec3 q = (c - leaf.position) * leaf.rotation;
            const double f = std::fabs(leaf.primitive->distance<double>({q.x, q.y, q.z}, leaf.numbers));
            if (f <= radius + margin) near.push_back({f, i});
        };
        if (solid.grid)
            for (const std::uint32_t i : solid.grid->leavesNear(c, radius + margin)) look(i);
        else
            for (std::size_t i = 0; i < solid.tree.leaves.size(); ++i) look(i);
        ++evaluations;
        std::sort(near.begin(), near.end());  // no two are equal: the indices differ
        if (near.size() > kNearLeaves) near.resize(kNearLeaves);
        std::vector<std::size_t> leaves;
        for (const auto& [f, i] : near) leaves.push_back(i);
        return leaves;
    }

    /// The nearest point of two surfaces' common curve, and three more around the ball: over a round hole it rests on the
    /// rim on all sides, though one is nearest. (Elsewhere these lie below the first one's tangent plane and are dropped.)
    void addEdge(std::size_t a, std::size_t b) const {
        const std::array edge{a, b};
        const Slope first = slope(solid.tree.leaves[a], c);
        const glm::dvec3 axis = first.gradient;
        bool parallel = false;
        if (add(edge, c, &parallel)) {
            const glm::dvec3 to = found.back().point - c, drop = glm::dot(to, axis) * axis, side = to - drop, across = glm::cross(axis, side);
            if (!(glm::dot(side, side) > 1e-12 * radius * radius)) return;
            for (const glm::dvec3& way : {across, -side, -across}) add(edge, c + drop + way, nullptr, true);
        } else if (parallel) {
            // Above the middle of a hole the surfaces' gradients are parallel, and no side is the nearest: from beside the ball they are not.
            const glm::dvec3 side = radius * glm::cross(axis, std::fabs(axis.x) < 0.6 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 1, 0});
            const glm::dvec3 foot = c - first.distance * axis, across = glm::cross(axis, side);
            for (const glm::dvec3& way : {side, across, -side, -across}) add(edge, foot + way), add(edge, foot + way, nullptr, true);
        }
    }

    /// Says whether each leaf's nearest point told.
    bool facesEdgesCorners() const {
        const std::vector<std::size_t> near = nearLeaves();
        bool all = !solid.blended;
        for (std::size_t a = 0; a < near.size(); ++a) {
            all = add(std::array{near[a]}, c) && all;
            for (std::size_t b = a + 1; b < near.size(); ++b) {
                addEdge(near[a], near[b]);
                for (std::size_t d = b + 1; d < near.size(); ++d) add(std::array{near[a], near[b], near[d]}, c);
            }
        }
        if (solid.blended) add({}, c);
        return all && !near.empty();
    }

    /// From a point pushed off the ones found: the leaf that is nearest there, and its own nearest point to the ball.
    bool probe(glm::dvec3 direction) const {
        const glm::dvec3 from = c + (0.5 * radius) * direction;
        const Slope s = slope(solid.tree, from);
        const int leaf = nearest<double>(solid.tree, {from.x, from.y, from.z}).leaf;
        evaluations += 2;
        if (s.distance <= 0 || leaf < 0) return false;
        const glm::dvec3 start = from - s.distance * s.gradient;
        const bool smooth = solid.blended && add({}, start);
        return add(std::array{static_cast<std::size_t>(leaf)}, start) || smooth;
    }

    /// How far the solid's surface is in a direction, m, from `from` on, where it is not yet; infinite beyond `most`.
    double along(glm::dvec3 way, double from, double most) const {
        constexpr int kStrides = 64;
        double length = from;
        for (int i = 0; i < kStrides && length <= most; ++i) {
            const double f = field(c + length * way);
            if (f <= kOnSurface * radius) return length;
            length += f;
        }
        return INFINITY;
    }

    /// From a point of the surface: the nearest one of the leaf it is on, or else on one of its edges, or its corners.
    void addFrom(glm::dvec3 start, std::span<const std::size_t> near) const {
        if (solid.blended && add({}, start)) return;
        ++evaluations;
        const int nearest_leaf = nearest<double>(solid.tree, {start.x, start.y, start.z}).leaf;
        if (nearest_leaf < 0) return;
        const auto leaf = static_cast<std::size_t>(nearest_leaf);
        if (solid.side[leaf] == 0 || add(std::array{leaf}, start)) return;
        bool any = false;
        for (const std::size_t a : near)
            if (a != leaf) any = add(std::array{leaf, a}, start) || any;
        for (std::size_t a = 0; a < near.size() && !any; ++a)
            for (std::size_t b = a + 1; b < near.size() && !any; ++b)
                if (near[a] != leaf && near[b] != leaf) any = add(std::array{leaf, near[a], near[b]}, start);
    }

    /// From a direction in which the surface is so far, by ever smaller turns to one in which it is least: of any surface, with edges or
    /// without.
    void addNearestAlong(glm::dvec3 way, double length) const {
        constexpr int kRounds = 60;
        if (field(c + (length + 1e-4 * radius) * way) >= 0) return;  // it has no thickness
        double turn = 0.3;
        for (int round = 0; round < kRounds && turn > kFinest; ++round) {
            const glm::dvec3 u = glm::normalize(glm::cross(way, std::fabs(way.x) < 0.6 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 1, 0})), v = glm::cross(way, u);
            glm::dvec3 best = way;
            double least = length;
            for (const auto& [x, y] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}, {0.7, 0.7}, {-0.7, 0.7}, {-0.7, -0.7}, {0.7, -0.7}}) {
                const glm::dvec3 other = glm::normalize(way + turn * (x * u + y * v));
                if (const double l = along(other, 0, least); l < least) best = other, least = l;
            }
            if (least > length * (1 - 0.03 * turn * turn)) turn *= 0.3;  // on a smooth surface a turn that is worth it brings more
            way = best, length = least;
        }
        if (length > radius + margin) return;
        found.push_back({c + length * way, -way, length - radius});
    }

    /// The place of the surface that slopes lead to from a place; nothing if it is farther than half a radius.
    std::optional<glm::dvec3> down(glm::dvec3 p) const {
        constexpr int kSteps = 6;
        for (int i = 0; i < kSteps; ++i) {
            ++evaluations;
            const Slope s = solid.slopeAt(p);
            const double square = glm::dot(s.gradient, s.gradient);
            if (std::fabs(s.distance) > 0.5 * radius || !(square > 1e-6)) return std::nullopt;
            p -= (s.distance / square) * s.gradient;
            if (std::fabs(s.distance) < 1e-4 * radius) return p;
        }
        return std::nullopt;
    }

    /// How far to look in a direction, m: what lies behind the tangent plane of one found is hidden.
    double mostAlong(glm::dvec3 way) const {
        double most = radius + std::max(margin, kNear * radius);
        for (const Touch& t : found)
            if (const double towards = -glm::dot(way, t.normal); towards > 0) most = std::min(most, (t.gap + radius) / towards * (1 - 1e-6));
        return most;
    }

    /// What the leaves' nearest points do not tell, where those were cut away, or lie elsewhere: looks for the surface in 26 directions, and
    /// down from where these leave the ball, which finds what is thin; and from each place found for the nearest one around. `f`: the
    /// field at the centre.
    void feel(double f) const {
        const std::vector<std::size_t> near = nearLeaves();
        for (int k = 0; k < 27; ++k) {
            const glm::dvec3 cell{k / 3 % 3 - 1, k / 9 - 1, k % 3 - 1};
            if (cell == glm::dvec3{0}) continue;
            glm::dvec3 way = glm::normalize(cell);
            double length = along(way, f, mostAlong(way));
            if (length == INFINITY) {
                const auto place = down(c + radius * way);
                if (!place || !(glm::length(*place - c) > f)) continue;
                way = glm::normalize(*place - c), length = along(way, f, mostAlong(way));
                if (length == INFINITY) continue;
            }
            const std::size_t before = found.size();
            addFrom(c + length * way, near);
            const auto is_nearer = [&](const Touch& t) { return t.gap + radius <= length * (1 + 1e-6); };
            if (std::none_of(found.begin() + static_cast<std::ptrdiff_t>(before), found.end(), is_nearer)) addNearestAlong(way, length);
        }
    }

    /// The other walls of a corner that one leaf makes alone, as a box taken away does. Where nothing else is near, half
    /// a radius away from the first point is half a radius further from the solid, and there is nothing to look for: says so.
    bool otherWalls(double f) const {
        if (found.empty()) return false;
        const glm::dvec3 n = found.front().normal;
        if (field(c + (0.5 * radius) * n) >= f + 0.5 * radius * (1 - 1e-9)) return true;
        const std::size_t before = found.size();
        probe(n);
        if (found.size() == before) return false;
        const glm::dvec3 m = found.back().normal, sum = n + m, cross = glm::cross(n, m);
        if (const double l = glm::length(sum); l > 1e-3) probe(sum / l);
        if (const double l = glm::length(cross); l > 1e-3) probe(cross / l), probe(-cross / l);
        return false;
    }
};

}  // namespace

FreeGap addTouches(const Solid& solid, const Ball& ball, double margin, std::vector<Touch>& io_touches, std::uint64_t& io_evaluations) {
    const double outside = distanceTo(solid.box, ball.centre) - ball.radius;
    if (outside > margin) return {outside, outside};
    static thread_local std::vector<Touch> found;  // its memory is used again
    found.clear();
    const Search search{solid, ball.centre, ball.radius, margin, found, io_evaluations};
    const Leaf* lone = solid.lone();
    const Slope of_lone = lone ? slope(*lone, ball.centre) : Slope{};
    if (lone) ++io_evaluations;
    const double f = lone ? of_lone.distance : search.field(ball.centre);
    FreeGap gap{INFINITY, f - ball.radius};
    if (f - ball.radius > margin) return {f - ball.radius, f - ball.radius};
    if (f <= 2 * kTooNear * ball.radius) {
        // The centre is inside, or on the surface.
        const glm::dvec3 n = wayOutAlong(solid.slopeAt(ball.centre));
        found.push_back({ball.centre - f * n, n, f - ball.radius});
    } else if (lone) {
        const glm::dvec3 n = glm::normalize(of_lone.gradient);
        found.push_back({ball.centre - f * n, n, f - ball.radius});
    } else {
        const bool told = search.facesEdgesCorners(), alone = search.otherWalls(f);
        if (!told || !alone) search.feel(f);
        if (found.empty()) gap.free = std::max(f - ball.radius, margin);
    }
    io_touches.insert(io_touches.end(), found.begin(), found.end());
    return gap;
}

void keepUnhidden(std::vector<Touch>& io_touches, double radius) {
    if (io_touches.size() < 2) return;
    std::stable_sort(io_touches.begin(), io_touches.end(), [](const Touch& a, const Touch& b) { return a.gap < b.gap; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < io_touches.size(); ++i) {
        bool hidden = false;
        for (std::size_t k = 0; k < kept && !hidden; ++k)
            hidden = glm::dot(io_touches[i].point - io_touches[k].point, io_touches[k].normal) <= 1e-7 * radius;
        if (!hidden) io_touches[kept++] = io_touches[i];
    }
    io_touches.resize(kept);
}

}  // namespace mb
