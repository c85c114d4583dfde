#include "core/sdf/grid_build.h"

#include "core/measure/parallel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace mb {
namespace {

constexpr double kFar = 2;              // radii: a cell further than this from everything keeps a number, no list
constexpr std::size_t kLongTape = 3;    // instructions: a longer one, near a surface, is cut into a brick
constexpr std::size_t kVeryLongTape = 64;
constexpr std::size_t kTasks = 64;

/// What float may lose of a distance.
float safely(double distance) { return static_cast<float>(std::min(distance, kEmptyDistance) * (1 - 1e-6)); }

}  // namespace

/// One thread's share.
struct GridBuilder::Work {
    const GridBuilder& grid;
    const std::vector<char>* dirty;
    Pruner pruner{grid.tree_};
    GridMade made{};
    std::array<PartList, 24> kept{};   // by depth of the recursion
    PartList inner{};

    glm::dvec3 middle(const Range& r) const { return grid.corner_ + 0.5 * grid.size_ * glm::dvec3(r.lo + r.hi); }
    double radius(const Range& r) const { return 0.5 * grid.size_ * glm::length(glm::dvec3(r.hi - r.lo)) + grid.radius() * 1e-3; }

    void split(const Range& range, const PartList& parts, std::size_t depth) {
        if (!grid.touches(range, dirty)) return;
        if (range.single()) return coarse(range.lo, parts);
        PartList& less = kept[depth];
        pruner.prune(parts, middle(range), radius(range), less);
        for (const Range& half : grid.halves(range)) split(half, less, depth + 1);
    }

    void coarse(glm::ivec3 at, const PartList& parts) {
        const auto index = static_cast<std::uint32_t>((at.z * grid.dims_.y + at.y) * grid.dims_.x + at.x);
        const glm::dvec3 c = grid.centre(index);
        PartList& less = kept.back();
        const double d = pruner.prune(parts, c, grid.radius(), less);
        GridMade::Coarse& cell = made.cells.emplace_back(GridMade::Coarse{index, {}, static_cast<float>(d)});
        if (less.tape.size() <= kLongTape || std::fabs(d) > grid.radius() || !shortens(c, less)) {
            cell.cell = cellOf(less, d, grid.radius());
            return;
        }
        cell.cell = {GridCell::Kind::brick, 0, static_cast<std::uint32_t>(made.bricks.size()), 0, 0, 0, false};
        const double size = grid.size_ / kBrick;
        for (int z = 0; z < kBrick; ++z)
            for (int y = 0; y < kBrick; ++y)
                for (int x = 0; x < kBrick; ++x) {
                    const glm::dvec3 k = c + size * (glm::dvec3{x, y, z} - 0.5 * (kBrick - 1));
                    const double radius = grid.radius(1.0 / kBrick);
                    const double at_k = pruner.prune(less, k, radius, inner);
                    made.bricks.push_back(cellOf(inner, at_k, radius));
                }
    }

    /// Whether a brick's cells would have shorter tapes, asked for a very long one only: what lies in one place stays together.
    bool shortens(glm::dvec3 c, const PartList& list) {
        if (list.tape.size() < kVeryLongTape) return true;
        pruner.prune(list, c + 0.5 * grid.size_ / kBrick, grid.radius(1.0 / kBrick), inner);
        return 4 * inner.tape.size() < 3 * list.tape.size();
    }

    GridCell cellOf(const PartList& list, double d, double radius) {
        if ((d > kFar * radius && !grid.exact_) || list.parts.empty()) return {GridCell::Kind::far, safely(d), 0, 0, 0, 0, true};
        const Tape tape = joined(list);
        GridCell cell{GridCell::Kind::list, safely(d), static_cast<std::uint32_t>(made.items.size()), 0, static_cast<std::uint32_t>(made.tape.size()),
                      static_cast<std::uint32_t>(tape.size()), d > radius};
        appendItems(grid.tree_, tape, made.items);
        made.tape.insert(made.tape.end(), tape.begin(), tape.end());
        cell.count = static_cast<std::uint32_t>(made.items.size()) - cell.first;
        return cell;
    }
};

void GridMade::append(GridMade&& other) {
    const auto item = static_cast<std::uint32_t>(items.size()), step = static_cast<std::uint32_t>(tape.size()), brick = static_cast<std::uint32_t>(bricks.size());
    const auto moved = [&](GridCell cell) {
        if (cell.kind == GridCell::Kind::list) cell.first += item, cell.tape_first += step;
        if (cell.kind == GridCell::Kind::brick) cell.first += brick;
        return cell;
    };
    for (Coarse c : other.cells) c.cell = moved(c.cell), cells.push_back(c);
    for (const GridCell& c : other.bricks) bricks.push_back(moved(c));
    items.insert(items.end(), other.items.begin(), other.items.end());
    tape.insert(tape.end(), other.tape.begin(), other.tape.end());
    evaluations += other.evaluations;
}

glm::dvec3 GridBuilder::centre(std::uint32_t coarse) const {
    const int i = static_cast<int>(coarse);
    const glm::ivec3 at{i % dims_.x, i / dims_.x % dims_.y, i / dims_.x / dims_.y};
    return corner_ + size_ * (glm::dvec3(at) + 0.5);
}
double GridBuilder::radius(double share) const { return 0.5 * std::sqrt(3.0) * size_ * (share + 1e-3); }

bool GridBuilder::touches(const Range& r, const std::vector<char>* dirty) const {
    if (!dirty) return true;
    for (int z = r.lo.z; z < r.hi.z; ++z)
        for (int y = r.lo.y; y < r.hi.y; ++y)
            for (int x = r.lo.x; x < r.hi.x; ++x)
                if ((*dirty)[static_cast<std::size_t>((z * dims_.y + y) * dims_.x + x)]) return true;
    return false;
}

std::vector<GridBuilder::Range> GridBuilder::halves(const Range& range) const {
    std::vector<Range> all{range};
    for (int axis = 0; axis < 3; ++axis) {
        if (range.hi[axis] - range.lo[axis] == 1) continue;
        const int middle = (range.lo[axis] + range.hi[axis]) / 2;
        for (std::size_t i = 0, n = all.size(); i < n; ++i) {
            Range upper = all[i];
            all[i].hi[axis] = middle, upper.lo[axis] = middle;
            all.push_back(upper);
        }
    }
    return all;
}

GridMade GridBuilder::build(const std::vector<char>* dirty, PartList parts) const {
    GridMade all;
    if (dims_.x == 0) return all;
    // The largest ranges first, until there are enough for every thread.
    std::vector<Task> tasks{{{{0, 0, 0}, dims_}, std::move(parts)}};
    Work first{*this, dirty};
    for (std::size_t next = 0; next < tasks.size() && tasks.size() < kTasks;) {
        if (tasks[next].range.single() || !touches(tasks[next].range, dirty)) {
            ++next;
            continue;
        }
        const Task task = std::move(tasks[next]);
        tasks.erase(tasks.begin() + static_cast<std::ptrdiff_t>(next));
        for (const Range& half : halves(task.range)) {
            if (!touches(half, dirty)) continue;
            Task less{half, {}};
            first.pruner.prune(task.parts, first.middle(half), first.radius(half), less.parts);
            tasks.push_back(std::move(less));
        }
    }
    all.evaluations = first.pruner.evaluations();

    std::vector<GridMade> made(tasks.size());
    inParallel(tasks.size() > 8 ? coresOf() : 1, tasks.size(), [&](std::size_t i, bool) {
        Work share{*this, dirty};
        share.split(tasks[i].range, tasks[i].parts, 0);
        share.made.evaluations = share.pruner.evaluations();
        made[i] = std::move(share.made);
    });
    for (GridMade& m : made) all.append(std::move(m));
    return all;
}

}  // namespace mb
