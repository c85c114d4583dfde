#pragma once
// Points on a shape's surface from which its contacts are looked for: every corner, every edge at intervals, and where
// the surface is curved, every cell of it. Flat places have none: a flat face meets another shape where the other has a
// corner, an edge or a curve, or at the face's own rim. Hollows have none either: what touches them from within is rounder there.
#include "core/sdf/tree.h"

#include <span>
#include <vector>

namespace mb {

/// A point of the surface and the normals it has there: all lie in a cone, of a corner a wide one. Where an edge or a corner is
/// rounded, `place` is the middle of the round instead: the surface is `round` from it along each of the cone's normals.
struct SurfacePoint {
    glm::dvec3 place{0};
    glm::dvec3 normal{0};              // unit, the middle of the cone, out of the shape
    double cosine = 1;                 // of the cone's half angle
    bool sharp = false;                // an edge or a corner: all of the cone's normals are this one point's
    glm::dvec3 along{0};               // unit, of an edge: its direction; 0: there is none
    double round = 0;                  // m: radius of the round, at most the spacing; 0: none is known

    glm::dvec3 onSurface() const { return place + round * normal; }
};

class SurfacePoints {
public:
    struct Node {
        glm::dvec3 centre{0};
        double radius = 0;             // m: holds the surface at the node's points
        std::uint32_t first = 0, count = 0;  // its points
        std::uint32_t skip = 0;        // the node after it and all below it
    };

    SurfacePoints() = default;
    SurfacePoints(std::vector<SurfacePoint> points, double spacing, glm::dvec3 stretch);

    std::span<const SurfacePoint> points() const { return points_; }
    /// How far apart neighbours are at most, m: the diagonal of a cell.
    double spacing() const { return spacing_; }
    bool empty() const { return points_.empty(); }
    /// The squares of a cell's sides, as shares of its longest: the metric in which the cells are cubes.
    glm::dvec3 stretch() const { return stretch_; }

    /// Visits the points of every node that `may(centre, radius)` holds open: visit(number, point).
    template <class May, class Visit> void search(May may, Visit visit) const {
        for (std::uint32_t n = 0; n < nodes_.size();) {
            const Node& node = nodes_[n];
            if (!may(node.centre, node.radius)) {
                n = node.skip;
                continue;
            }
            if (node.skip == n + 1)
                for (std::uint32_t i = node.first; i < node.first + node.count; ++i) visit(i, points_[i]);
            ++n;
        }
    }

private:
    void build(std::uint32_t first, std::uint32_t count);

    std::vector<SurfacePoint> points_;
    std::vector<Node> nodes_;          // each before those below it
    double spacing_ = 0;
    glm::dvec3 stretch_{1};
};

/// The points of a bounded shape, by a grid of cells over its box: in each cell that the surface crosses, the planes that touch
/// it nearby meet in a corner or on an edge if there is one (Ju, Losasso, Schaefer, Warren, "Dual Contouring of Hermite Data",
/// 2002). A wall thinner than a cell gets the points of both its sides. `out_inner`: how deep the deepest place lies
/// inside, m.
SurfacePoints surfacePoints(const Tree& tree, const Box& box, double& out_inner);

}  // namespace mb
