// What a grid says of points and places.
#include "core/sdf/grid.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace mb {

Grid::Place Grid::find(glm::dvec3 p) const {
    const glm::dvec3 at = (p - corner_) / size_;
    const glm::ivec3 i(glm::floor(at));
    if (!(at.x >= 0 && at.y >= 0 && at.z >= 0) || i.x >= dims_.x || i.y >= dims_.y || i.z >= dims_.z) return {nullptr, p};
    const GridCell& coarse = cells_[static_cast<std::size_t>((i.z * dims_.y + i.y) * dims_.x + i.x)];
    if (coarse.kind != GridCell::Kind::brick) return {&coarse, corner_ + size_ * (glm::dvec3(i) + 0.5)};
    const glm::ivec3 k = glm::clamp(glm::ivec3(glm::floor((at - glm::dvec3(i)) * double{kBrick})), 0, kBrick - 1);
    const std::uint32_t inner = static_cast<std::uint32_t>((k.z * kBrick + k.y) * kBrick + k.x);
    return {&cells_[coarse.first + inner], corner_ + size_ * (glm::dvec3(i) + (glm::dvec3(k) + 0.5) / double{kBrick})};
}

std::span<const Instruction> Grid::listOf(const GridCell& cell) const {
    if (cell.kind != GridCell::Kind::list) return {};
    return std::span(tape_).subspan(cell.tape_first, cell.tape_count);
}

std::span<const Instruction> Grid::tapeAt(glm::dvec3 p) const {
    const Place place = find(p);
    const GridCell& cell = place.cell ? *place.cell : outer_;
    return listOf(cell);
}

std::vector<std::uint32_t> Grid::leavesNear(glm::dvec3 p, double reach) const {
    std::vector<std::uint32_t> leaves;
    const auto add = [&](const GridCell& cell) {
        for (const Instruction& step : listOf(cell))
            if (step.kind == Instruction::Kind::leaf) leaves.push_back(step.index);
    };
    // In cells of bricks.
    const glm::dvec3 lo = glm::floor((p - reach - corner_) / size_ * double{kBrick}), hi = glm::floor((p + reach - corner_) / size_ * double{kBrick});
    const glm::dvec3 most(dims_ * kBrick - 1), first = glm::max(lo, glm::dvec3(0)), last = glm::min(hi, most);
    if (first != lo || last != hi) add(outer_);
    if (first.x <= last.x && first.y <= last.y && first.z <= last.z) {
        const glm::ivec3 from(first), to(last), coarse_from = from / kBrick, coarse_to = to / kBrick;
        for (int z = coarse_from.z; z <= coarse_to.z; ++z)
            for (int y = coarse_from.y; y <= coarse_to.y; ++y)
                for (int x = coarse_from.x; x <= coarse_to.x; ++x) {
                    const GridCell& cell = cells_[static_cast<std::size_t>((z * dims_.y + y) * dims_.x + x)];
                    add(cell);
                    if (cell.kind != GridCell::Kind::brick) continue;
                    const glm::ivec3 begin = glm::max(from - kBrick * glm::ivec3(x, y, z), 0), end = glm::min(to - kBrick * glm::ivec3(x, y, z), kBrick - 1);
                    for (int k = begin.z; k <= end.z; ++k)
                        for (int j = begin.y; j <= end.y; ++j)
                            for (int i = begin.x; i <= end.x; ++i) add(cells_[cell.first + static_cast<std::uint32_t>((k * kBrick + j) * kBrick + i)]);
                }
    }
    std::ranges::sort(leaves);
    leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
    return leaves;
}

double Grid::distance(glm::dvec3 p) const {
    const Place place = find(p);
    if (place.cell && place.cell->kind == GridCell::Kind::far) return static_cast<double>(place.cell->safe) - glm::length(p - place.centre);
    const double d = mb::distance<double>(tree_, tapeAt(p), {p.x, p.y, p.z});
    return place.cell || exact_ == Exact::everywhere ? d : std::min(d, dims_.x > 0 ? distanceTo(box_, p) : kEmptyDistance);
}

double distanceTo(const Box& box, glm::dvec3 p) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double d = std::max({box.lo[k] - p[i], p[i] - box.hi[k], 0.0});
        sum += d * d;
    }
    return std::sqrt(sum);
}

}  // namespace mb
