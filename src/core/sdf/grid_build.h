#pragma once
// Makes the cells of a grid, all of them or those that changed, on all cores.
#include "core/sdf/grid.h"
#include "core/sdf/prune.h"

namespace mb {

/// Cells made, not yet in their places: lists count from the first item and instruction made, bricks from the first brick.
struct GridMade {
    struct Coarse {
        std::uint32_t at = 0;
        GridCell cell;
        float at_centre = 0;
    };
    std::vector<Coarse> cells;
    std::vector<GridCell> bricks;
    std::vector<GridItem> items;
    Tape tape;
    std::uint64_t evaluations = 0;
    void append(GridMade&& other);
};

class GridBuilder {
public:
    GridBuilder(const Tree& tree, glm::dvec3 corner, double size, glm::ivec3 dims, Grid::Exact exact)
        : tree_(tree), corner_(corner), size_(size), dims_(dims), exact_(exact == Grid::Exact::everywhere) {}
    /// The coarse cells marked in `dirty`, or all where there is none, in the order of the recursion.
    /// `parts` are all of the tree's, or at least those that can matter in these cells.
    GridMade build(const std::vector<char>* dirty, PartList parts) const;
    glm::dvec3 centre(std::uint32_t coarse) const;
    /// How far a cell's list holds around its centre: to its corners, and a little over, since the GPU rounds.
    double radius(double share = 1) const;

private:
    struct Range {
        glm::ivec3 lo, hi;
        bool single() const { return hi.x - lo.x == 1 && hi.y - lo.y == 1 && hi.z - lo.z == 1; }
    };
    struct Task {
        Range range;
        PartList parts;
    };
    struct Work;
    bool touches(const Range& range, const std::vector<char>* dirty) const;
    std::vector<Range> halves(const Range& range) const;

    const Tree& tree_;
    glm::dvec3 corner_;
    double size_;
    glm::ivec3 dims_;
    bool exact_;
};

}  // namespace mb
