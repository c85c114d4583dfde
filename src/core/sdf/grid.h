#pragma once
// A scene's bounds cut into cells, each with the part of the tree that can matter inside it. Whoever asks for a distance
// looks up the point's cell and evaluates a handful of primitives instead of all.
//
// A cell far from everything keeps one number instead: the distance at its centre. A cell with a long tape is cut into a
// brick of 4³ smaller ones. Beyond the grid only the parts without bounds are asked; the others are as near as their box.
// Sources: Barbier et al., "Lipschitz Pruning" (2025); Keeter, "Massively Parallel Rendering of Complex Closed-Form Implicit
// Surfaces" (2020). Every value of a tree is 1-Lipschitz (tree.h), which both assume of theirs.
#include "core/sdf/tree.h"

#include <glm/vec3.hpp>

#include <utility>

namespace mb {

/// A step of a cell's tape as the GPU runs it, over an accumulator and a stack under it: it computes a value (a leaf's, or the
/// one popped), then pushes it or joins it with the top.
struct GridItem {
    std::uint32_t word = 0;      // code | how << 6 | 1 << 11 if it is its tape's last | record << 12
    std::uint32_t joined = 0;    // the record of the fold that joins it
};
inline constexpr std::uint32_t kItemLast = 1u << 11;
inline constexpr std::uint32_t kItemPop = 61, kItemPush = 0, kItemJoin = 1, kItemFolds = 2;
/// A leaf's code is its row in primitives(); that of `enter` and `wrap`, these plus the row in operators(). A fold's `how` is
/// kItemFolds plus its row.
inline constexpr std::uint32_t kItemEnter = 20, kItemWrap = 40;
/// Writes a tape as items; appends to `out`.
void appendItems(const Tree& tree, std::span<const Instruction> tape, std::vector<GridItem>& out);
/// How many values the items of this tape hold at once, the accumulator included.
int itemStack(const Tree& tree, std::span<const Instruction> tape);

struct GridCell {
    enum class Kind : std::uint32_t { far, list, brick } kind = Kind::far;
    float safe = 0;              // of an empty one: no surface is nearer to the cell's centre
    std::uint32_t first = 0, count = 0;            // list: its items; brick: its first cell
    std::uint32_t tape_first = 0, tape_count = 0;  // list: the same as instructions
    bool empty = true;           // no surface crosses it: a ray may pass without asking
};

/// What a rebuild took.
struct GridWork {
    bool whole = false;          // all of it
    std::size_t cells = 0;       // coarse cells made
    std::uint64_t evaluations = 0;  // of primitives
    double ms = 0;
};

inline constexpr int kBrick = 4; // cells along a brick's side

/// How far p lies outside the box; 0 inside.
double distanceTo(const Box& box, glm::dvec3 p);

struct GridMade;
struct PartList;
class GridBuilder;
class Grid {
public:
    /// For marching, the exact distance is kept where a surface is near, and a bound elsewhere; or it is kept everywhere.
    enum class Exact { near_surfaces, everywhere };
    explicit Grid(Exact exact = Exact::near_surfaces) : exact_(exact) {}

    /// Makes this the grid of `tree`: all of it where the topology, the bounds or the scale changed, else the cells that what
    /// moved can have changed. On as many threads as the machine has; the same cells, whatever their number. `scale`: of the
    /// cells along a side, a multiple of what is chosen by itself; the values stay.
    GridWork follow(const Tree& tree, double scale = 1);

    /// Whether this is the grid of just that tree.
    bool follows(const Tree& tree) const;

    /// The tree's distance, or where its cell is far, a lower bound of it that is positive.
    double distance(glm::dvec3 p) const;
    /// The tape of the cell that p lies in; of a far cell, nothing.
    std::span<const Instruction> tapeAt(glm::dvec3 p) const;
    /// The leaves, in order, that the cells within `reach` of p along each axis ask: each whose surface the whole has there is among them.
    std::vector<std::uint32_t> leavesNear(glm::dvec3 p, double reach) const;
    const Tree& tree() const { return tree_; }
    Exact exact() const { return exact_; }

    glm::dvec3 corner() const { return corner_; }
    double cellSize() const { return size_; }
    glm::ivec3 dims() const { return dims_; }             // coarse cells; 0 where nothing has bounds
    const Box& box() const { return box_; }               // holds all that has bounds
    std::span<const GridCell> cells() const { return cells_; }  // the coarse ones, x fastest, then bricks
    std::span<const GridItem> items() const { return items_; }
    const GridCell& outer() const { return outer_; }      // the list of the parts without bounds
    /// Counts rebuilds of all; and, since the last one, the cells changed and how many items there were then.
    std::uint64_t generation() const { return generation_; }
    std::vector<std::uint32_t> takeChangedCells() { return std::exchange(changed_, {}); }

private:
    struct Place {
        const GridCell* cell;
        glm::dvec3 centre;
    };
    bool sameTopology(const Tree& tree) const;
    void layOut();
    GridWork rebuild();
    void place(GridMade& made);
    PartList near(const std::vector<char>& dirty, const GridBuilder& builder, GridWork& io_work) const;
    GridWork update(const std::vector<std::uint32_t>& parts, const Tree& before);
    Place find(glm::dvec3 p) const;
    std::span<const Instruction> listOf(const GridCell& cell) const;

    Exact exact_;
    double scale_ = 1;
    Tree tree_;
    Box box_{};
    glm::dvec3 corner_{0};
    double size_ = 1;
    glm::ivec3 dims_{0};
    std::vector<GridCell> cells_;
    std::vector<Box> boxes_;                              // of each part
    std::vector<float> at_centre_;                        // the distance there, of each coarse cell
    std::vector<GridItem> items_;
    Tape tape_;
    GridCell outer_;
    std::uint64_t generation_ = 0;
    std::size_t stale_ = 0;                               // items no cell uses any more
    std::vector<std::uint32_t> changed_;
};

}  // namespace mb
