#include "core/sdf/grid.h"

#include "core/sdf/grid_build.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace mb {
namespace {

constexpr double kMostCells = 32'768;      // coarse ones, chosen by itself
constexpr double kMostScaled = 65'536;     // whatever the scale: where all is in one place, every cell keeps all of it
constexpr double kCellsAPart = 3;
constexpr double kRoom = 0.05;             // of the box's size, that things may move before all is laid out anew

std::span<const Instruction> tapeOf(const Tree& tree, const Tree::Part& part) {
    return std::span(tree.program).subspan(part.begin, part.end - part.begin);
}
bool sameFrame(const auto& a, const auto& b) { return a.rotation == b.rotation && a.position == b.position && a.numbers == b.numbers; }

/// Whether the part says the same in both trees, whose topologies are equal.
bool samePart(const Tree& a, const Tree& b, const Tree::Part& part) {
    for (const Instruction& step : tapeOf(a, part)) {
        if (step.kind == Instruction::Kind::leaf) {
            if (!sameFrame(a.leaves[step.index], b.leaves[step.index])) return false;
        } else if (step.kind != Instruction::Kind::join) {
            const Branch &x = a.branches[step.index], &y = b.branches[step.index];
            if (x.blend != y.blend || !sameFrame(x, y)) return false;
        }
    }
    return true;
}

bool holds(const Box& outer, const Box& inner) {
    for (std::size_t i = 0; i < 3; ++i)
        if (inner.lo[i] < outer.lo[i] || inner.hi[i] > outer.hi[i]) return false;
    return true;
}
double milliseconds(std::chrono::steady_clock::time_point from) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count();
}

}  // namespace

bool Grid::sameTopology(const Tree& tree) const {
    if (generation_ == 0 || tree.program.size() != tree_.program.size() || tree.leaves.size() != tree_.leaves.size() ||
        tree.branches.size() != tree_.branches.size() || tree.parts.size() != tree_.parts.size())
        return false;
    for (std::size_t i = 0; i < tree.program.size(); ++i)
        if (tree.program[i].kind != tree_.program[i].kind || tree.program[i].index != tree_.program[i].index) return false;
    for (std::size_t i = 0; i < tree.leaves.size(); ++i)
        if (tree.leaves[i].primitive != tree_.leaves[i].primitive) return false;
    for (std::size_t i = 0; i < tree.branches.size(); ++i)
        if (tree.branches[i].op != tree_.branches[i].op) return false;
    return true;
}

bool Grid::follows(const Tree& tree) const {
    return sameTopology(tree) && std::ranges::all_of(tree.parts, [&](const Tree::Part& part) { return samePart(tree_, tree, part); });
}

GridWork Grid::follow(const Tree& tree, double scale) {
    const auto from = std::chrono::steady_clock::now();
    GridWork work;
    const bool same = sameTopology(tree);
    std::vector<std::uint32_t> moved;
    bool whole = !same || scale != scale_;
    for (std::size_t i = 0; same && !whole && i < tree.parts.size(); ++i) {
        if (samePart(tree_, tree, tree.parts[i])) continue;
        moved.push_back(static_cast<std::uint32_t>(i));
        const Box was = bounds(tree_, tapeOf(tree_, tree.parts[i])), is = bounds(tree, tapeOf(tree, tree.parts[i]));
        whole = moved.size() > tree.parts.size() / 16 + 1 || !isFinite(was) || !isFinite(is) || !holds(box_, is);
    }
    whole = whole || stale_ > items_.size() / 2 + 100'000;
    if (whole) {
        tree_ = tree, scale_ = scale;
        layOut();
        work = rebuild();
    } else {
        const Tree before = std::exchange(tree_, tree);
        if (!moved.empty()) work = update(moved, before);
    }
    work.ms = milliseconds(from);
    return work;
}

/// Chooses the box and its cells: some a part, as cubic as they can be.
void Grid::layOut() {
    box_ = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    boxes_.clear();
    double bounded = 0;
    for (const Tree::Part& part : tree_.parts) {
        const Box box = boxes_.emplace_back(bounds(tree_, tapeOf(tree_, part)));
        if (!isFinite(box) || box.lo[0] > box.hi[0]) continue;
        bounded += std::sqrt(static_cast<double>(part.end - part.begin));  // a part of many primitives is cut finer
        for (std::size_t i = 0; i < 3; ++i) box_.lo[i] = std::min(box_.lo[i], box.lo[i]), box_.hi[i] = std::max(box_.hi[i], box.hi[i]);
    }
    dims_ = {0, 0, 0};
    if (bounded == 0) return;

    glm::dvec3 extent{0};
    for (int i = 0; i < 3; ++i) extent[i] = box_.hi[static_cast<std::size_t>(i)] - box_.lo[static_cast<std::size_t>(i)];
    const double longest = std::max({extent.x, extent.y, extent.z, 1e-6});
    const double wanted = std::min(std::clamp(kCellsAPart * bounded, 64.0, kMostCells) * scale_ * scale_ * scale_, kMostScaled);
    extent = glm::max(extent, glm::dvec3(1e-3 * longest));
    for (int i = 0; i < 3; ++i)
        box_.lo[static_cast<std::size_t>(i)] -= kRoom * extent[i], box_.hi[static_cast<std::size_t>(i)] += kRoom * extent[i];
    extent *= 1 + 2 * kRoom;
    // The cube whose volume is the box's share; where that is thicker than the box, the other sides share what is left.
    size_ = std::cbrt(extent.x * extent.y * extent.z / wanted);
    for (int pass = 0; pass < 3; ++pass) {
        double cells = wanted, volume = 1;
        int sides = 0;
        for (int i = 0; i < 3; ++i)
            if (extent[i] > size_) volume *= extent[i], ++sides;
        if (sides > 0) size_ = std::pow(volume / cells, 1.0 / sides);
    }
    // One cell more on each side, so that whoever is outside is at least a cell's size away from everything.
    for (int i = 0; i < 3; ++i) {
        dims_[i] = std::clamp(static_cast<int>(std::ceil(extent[i] / size_)), 1, 1000) + 2;
        corner_[i] = box_.lo[static_cast<std::size_t>(i)] + 0.5 * (extent[i] - dims_[i] * size_);
    }
}

GridWork Grid::rebuild() {
    GridBuilder builder{tree_, corner_, size_, dims_, exact_};
    GridMade made = builder.build(nullptr, partsOf(tree_));
    cells_.assign(static_cast<std::size_t>(dims_.x) * static_cast<std::size_t>(dims_.y) * static_cast<std::size_t>(dims_.z), {});
    at_centre_.assign(cells_.size(), 0);
    items_.clear(), tape_.clear(), changed_.clear();
    ++generation_, stale_ = 0;

    // The parts without bounds are all there is outside.
    PartList all = partsOf(tree_), unbounded;
    for (const Tree::Part& part : all.parts) {
        const std::span<const Instruction> tape = std::span(all.tape).subspan(part.begin, part.end - part.begin);
        if (exact_ == Exact::near_surfaces && isFinite(bounds(tree_, tape))) continue;
        const auto begin = static_cast<std::uint32_t>(unbounded.tape.size());
        unbounded.tape.insert(unbounded.tape.end(), tape.begin(), tape.end());
        unbounded.parts.push_back({begin, static_cast<std::uint32_t>(unbounded.tape.size())});
    }
    tape_ = joined(unbounded);
    appendItems(tree_, tape_, items_);
    outer_ = {GridCell::Kind::list, 0, 0, static_cast<std::uint32_t>(items_.size()), 0, static_cast<std::uint32_t>(tape_.size()), tape_.empty()};

    place(made);
    changed_.clear();
    return {true, made.cells.size(), made.evaluations, 0};
}

/// Puts what was made into its coarse cells. A brick takes the place of the one before it.
void Grid::place(GridMade& made) {
    const auto first_item = static_cast<std::uint32_t>(items_.size()), first_tape = static_cast<std::uint32_t>(tape_.size());
    items_.insert(items_.end(), made.items.begin(), made.items.end());
    tape_.insert(tape_.end(), made.tape.begin(), made.tape.end());
    const auto moved = [&](GridCell cell) {
        if (cell.kind == GridCell::Kind::list) cell.first += first_item, cell.tape_first += first_tape;
        return cell;
    };
    constexpr std::size_t kCells = kBrick * kBrick * kBrick;
    for (const GridMade::Coarse& coarse : made.cells) {
        GridCell& cell = cells_[coarse.at];
        const GridCell old = cell;
        at_centre_[coarse.at] = coarse.at_centre;
        cell = moved(coarse.cell);
        changed_.push_back(coarse.at);
        if (old.kind == GridCell::Kind::list) stale_ += old.count;
        if (old.kind == GridCell::Kind::brick)
            for (std::size_t i = 0; i < kCells; ++i) stale_ += cells_[old.first + i].kind == GridCell::Kind::list ? cells_[old.first + i].count : 0;
        if (cell.kind != GridCell::Kind::brick) continue;
        cell.first = old.kind == GridCell::Kind::brick ? old.first : static_cast<std::uint32_t>(cells_.size());
        const std::uint32_t brick = cell.first;
        if (brick == cells_.size()) cells_.resize(cells_.size() + kCells);
        for (std::size_t i = 0; i < kCells; ++i) {
            cells_[brick + i] = moved(made.bricks[coarse.cell.first + i]);
            changed_.push_back(static_cast<std::uint32_t>(brick + i));
        }
    }
}

GridWork Grid::update(const std::vector<std::uint32_t>& parts, const Tree& before) {
    // A part matters in a cell if it is, or was, nearer than what is nearest there and twice the cell's radius.
    GridBuilder builder{tree_, corner_, size_, dims_, exact_};
    std::vector<char> dirty(at_centre_.size(), 0);
    GridWork work;
    for (const std::uint32_t part : parts)
        for (const Tree* tree : {&before, &std::as_const(tree_)}) {
            const std::span<const Instruction> tape = tapeOf(*tree, tree->parts[part]);
            const Box box = bounds(*tree, tape);
            for (std::size_t i = 0; i < at_centre_.size(); ++i) {
                const glm::dvec3 c = builder.centre(static_cast<std::uint32_t>(i));
                const double reach = static_cast<double>(at_centre_[i]) + 2 * builder.radius();
                if (dirty[i] || distanceTo(box, c) > reach) continue;
                dirty[i] = mb::distance<double>(*tree, tape, {c.x, c.y, c.z}) <= reach;
                ++work.evaluations;
            }
        }
    for (const std::uint32_t part : parts) boxes_[part] = bounds(tree_, tapeOf(tree_, tree_.parts[part]));
    GridMade made = builder.build(&dirty, near(dirty, builder, work));
    place(made);
    return {false, made.cells.size(), made.evaluations + work.evaluations, 0};
}

/// The parts that can matter in the cells marked: those no further from the middle of them all than the nearest one, and
/// twice the radius that holds the cells. A part whose value is its distance is at least as far as its box.
PartList Grid::near(const std::vector<char>& dirty, const GridBuilder& builder, GridWork& io_work) const {
    glm::dvec3 lo(INFINITY), hi(-INFINITY);
    for (std::size_t i = 0; i < dirty.size(); ++i)
        if (dirty[i]) lo = glm::min(lo, builder.centre(static_cast<std::uint32_t>(i))), hi = glm::max(hi, builder.centre(static_cast<std::uint32_t>(i)));
    const glm::dvec3 middle = 0.5 * (lo + hi);
    const double radius = 0.5 * glm::length(hi - lo) + 2 * builder.radius();
    const auto isDistance = [&](const Tree::Part& part) {
        const Instruction& step = tree_.program[part.begin];
        return part.end - part.begin == 1 && tree_.leaves[step.index].primitive->exact;
    };
    std::vector<std::uint32_t> kept;
    double least = kEmptyDistance;
    for (const bool second : {false, true})  // first the box nearest to the middle, for a bound on what is nearest there
        for (std::size_t i = 0; i < boxes_.size(); ++i) {
            const double away = isDistance(tree_.parts[i]) ? distanceTo(boxes_[i], middle) : 0;
            if (second && away <= least + 2 * radius) kept.push_back(static_cast<std::uint32_t>(i));
            if (second || away >= least) continue;
            least = std::min(least, mb::distance<double>(tree_, tapeOf(tree_, tree_.parts[i]), {middle.x, middle.y, middle.z}));
            ++io_work.evaluations;
        }

    PartList list;
    for (const std::uint32_t i : kept) {
        const auto begin = static_cast<std::uint32_t>(list.tape.size());
        const std::span<const Instruction> tape = tapeOf(tree_, tree_.parts[i]);
        list.tape.insert(list.tape.end(), tape.begin(), tape.end());
        list.parts.push_back({begin, static_cast<std::uint32_t>(list.tape.size())});
    }
    return list;
}

}  // namespace mb
