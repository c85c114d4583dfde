#pragma once
// One place where two shapes may touch: a surface point of the one in the field of the other, brought to where the other is nearest.
#include "physics/manifold.h"

#include <optional>

namespace mb {

inline constexpr double kAlike = 0.97;  // of two unit normals' product: the same face

/// A surface point of one solid near the other.
struct Candidate {
    glm::dvec3 at{0};                       // on its owner's surface or, of a round, in its middle until it is settled; in the world
    double gap = 0;
    std::uint64_t feature = 0;
    std::size_t other = 0;
    bool of_a = true;
    const Placed *owner = nullptr, *asked = nullptr;  // whose point it is, and whose field is read
    const SurfacePoint* from = nullptr;
    double inwards = 0;                     // where the other's field is read, m behind the point
    glm::dvec3 normal{0};                   // towards a
    bool lowest = false;                    // the surface falls no further there
    glm::dvec3 own{0};                      // out of its owner, unit, once it moved along a curve; 0: not asked

    double spacing() const { return owner->solid->points.spacing(); }
    /// The finer of the two spacings, which small lengths are shares of: a die is small at a tray's rim.
    double fineness() const { return asked->solid->points.empty() ? spacing() : std::min(spacing(), asked->solid->points.spacing()); }
    /// Whether it stays where it is: a corner.
    bool isCorner() const { return from->sharp && from->along == glm::dvec3{0}; }
};

/// Settles candidates: looks for their gaps, normals and places. Questions to a field are counted.
class Settler {
public:
    Settler(double margin, std::uint64_t& io_evaluations) : margin_(margin), evaluations_(io_evaluations) {}

    /// Sets the candidate's gap, normal and place where it is; says whether it may be a contact within the margin.
    bool settle(Candidate& io_c) const;
    /// Of a candidate beyond the margin: moves it to where the other is nearest, if that may be within.
    bool settleLower(Candidate& io_c) const;
    enum class Until { rim, lowest };
    /// Moves the point along its own solid's surface, or edge, to where the other's field is least. With `rim` a point on the rim of a
    /// flat place that hardly slopes stays: what it stands on is that rim, not the far side.
    void refine(Candidate& io_c, Until until, double most = INFINITY) const;
    /// Whether it is a contact: within the margin, and the two surfaces face one another there.
    bool isContact(const Candidate& c) const;

    double fieldOf(const Placed& p, glm::dvec3 at) const { return ++evaluations_, p.solid->at(p.pose.fromWorld(at)); }

private:
    /// What the own surface is like at a place.
    struct Footing {
        Slope own;
        glm::dvec3 along{0}, first{0}, second{0};  // of an edge: its direction, and the normals of the faces on either side
        glm::dmat3 stretch{1}, shrink{1};          // of a curve: the metric in which the owner's cells are cubes, and its inverse
    };
    /// The way down along a surface or an edge.
    struct Way {
        glm::dvec3 way{0};                         // steepest in the metric
        double steep = 0;                          // its length there: how far the other's field falls for each metre of it
        double slope = 0;                          // the sine of the angle between the surface and the other's level
    };

    Slope slopeOf(const Placed& p, glm::dvec3 at) const;
    Slope otherAt(const Candidate& c, glm::dvec3 at) const;
    static void setTo(Candidate& io_c, const Slope& s);
    static bool faces(const Candidate& c, double but);
    std::optional<bool> settleRound(Candidate& io_c) const;
    bool hasFoot(Candidate& io_c) const;
    Footing footingOf(const Candidate& c) const;
    static Way downhill(const Footing& footing, const Slope& there);
    bool stand(Candidate& io_c, Footing& io_footing) const;
    bool standOnEdge(Candidate& io_c, Footing& io_footing) const;

    double margin_;
    std::uint64_t& evaluations_;
};

}  // namespace mb
