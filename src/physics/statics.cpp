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
    keepUnhidden(out, radius);
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

}  // namespace mb
