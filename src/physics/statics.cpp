#include "physics/statics.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>

namespace mb {

StaticField::StaticField(const Scene& scene, const std::function<bool(std::size_t)>& wanted, std::vector<std::string>& io_notes,
                         const StaticField* before, bool with_points) {
    std::vector<std::size_t> objects;  // that the solids are
    for (std::size_t i = 0; i < scene.objects.size(); i = subtreeEnd(scene, i)) {
        if (scene.objects[i].hidden || !wanted(i)) continue;
        Tree tree = makeTreeOf(scene, i);
        if (!tree.fault.empty()) io_notes.push_back(fmt::format("no body meets it: {}", tree.fault));
        if (tree.program.empty()) continue;
        objects.push_back(i);
        solids_.push_back(makeSolid(std::move(tree), with_points, before && solids_.size() < before->solids_.size() ? &before->solids_[solids_.size()] : nullptr));
    }
    if (solids_.size() <= kMany) return;
    const Tree all = makeTree(scene, [&](std::size_t i) { return std::ranges::binary_search(objects, i); });
    if (all.program.empty()) return;  // too many leaves in all: each solid is asked
    grid_ = gridOf(all, Grid::Exact::near_surfaces, before ? before->grid_.get() : nullptr);
    for (const Leaf& leaf : all.leaves)
        solid_of_.push_back(static_cast<std::size_t>(std::ranges::upper_bound(objects, leaf.index) - objects.begin() - 1));
}

void StaticField::eachInGrid(glm::dvec3 centre, double reach, const std::function<void(std::size_t)>& visit) const {
    std::size_t last = solids_.size();
    for (const std::uint32_t leaf : grid_->leavesNear(centre, reach))
        if (solid_of_[leaf] != last) visit(last = solid_of_[leaf]);
}

double StaticField::touches(glm::dvec3 centre, double radius, double margin, std::vector<Touch>& out, double* out_room) const {
    out.clear();
    // What the grid does not name has no surface within reach.
    std::uint64_t evaluations = 0;
    double free = grid_ ? std::max(grid_->distance(centre) - radius, margin) : INFINITY, room = free;
    eachNear(centre, radius + margin, [&](std::size_t i) {
        const FreeGap gap = addTouches(solids_[i], {centre, radius}, margin, out, evaluations);
        free = std::min(free, gap.free), room = std::min(room, gap.room);
    });
    evaluations_.add(evaluations);
    if (out_room) *out_room = room;
    // In a solid it goes out at the nearest face, unless that stands on another.
    std::optional<WayOut> way;
    if (room < -radius && std::erase_if(out, [&](const Touch& t) { return t.gap < -radius && isBlocked(t.point, t.normal, radius); }))
        way = wayOut(centre, radius);
    keepUnhidden(out, radius);
    if (way) out.insert(out.begin(), {centre + way->length * way->direction, way->direction, -way->length - radius});
    return out.empty() ? free : std::min(free, out.front().gap);
}

double StaticField::room(glm::dvec3 centre, double radius) const {
    double room = grid_ ? grid_->distance(centre) - radius : INFINITY;
    eachNear(centre, radius, [&](std::size_t i) {
        const double outside = distanceTo(solids_[i].box, centre) - radius;
        if (outside > 0) room = std::min(room, outside);
        else evaluations_.add(1), room = std::min(room, solids_[i].at(centre) - radius);
    });
    return room;
}

bool StaticField::isBlocked(glm::dvec3 exit, glm::dvec3 normal, double thick) const {
    bool blocked = false;
    const glm::dvec3 beyond = exit + thick * normal;
    eachNear(beyond, thick, [&](std::size_t i) {
        if (blocked || distanceTo(solids_[i].box, beyond) > 0) return;
        const Slope s = solids_[i].slopeAt(beyond);
        evaluations_.add(1);
        blocked = s.distance < 0 && glm::dot(s.gradient, normal) < -0.5 * glm::length(s.gradient);
    });
    return blocked;
}

/// The least of the solids' fields, m, where it is negative; else 0.
double StaticField::deepestAt(glm::dvec3 place) const {
    if (grid_) return std::min(grid_->distance(place), 0.0);
    double deepest = 0;
    for (const Solid& solid : solids_)
        if (distanceTo(solid.box, place) <= 0) evaluations_.add(1), deepest = std::min(deepest, solid.at(place));
    return deepest;
}

/// By strides that are certain to stay in the deepest solid; infinite, if it is more than `most`, or takes too many strides.
double StaticField::lengthOut(glm::dvec3 from, glm::dvec3 direction, double thick, double most) const {
    constexpr int kStrides = 100;
    constexpr double kShortest = 0.01;  // of the thickness
    double length = 0;
    for (int i = 0; i < kStrides && length < most; ++i) {
        const double deep = deepestAt(from + length * direction);
        if (deep == 0 && deepestAt(from + (length + thick) * direction) == 0) return length;
        length += deep < 0 ? std::max(-deep, kShortest * thick) : thick;
    }
    return INFINITY;
}

std::optional<WayOut> StaticField::wayOut(glm::dvec3 from, double thick) const {
    WayOut best{{}, INFINITY};
    for (int k = 0; k < 27; ++k) {
        const glm::dvec3 way{k / 3 % 3 - 1, 1 - k / 9, k % 3 - 1};  // upwards first
        if (way == glm::dvec3{0}) continue;
        const glm::dvec3 direction = glm::normalize(way);
        if (const double length = lengthOut(from, direction, thick, best.length); length < best.length) best = {direction, length};
    }
    if (best.length == 0 || best.length == INFINITY) return std::nullopt;
    return best;
}

}  // namespace mb
