#pragma once
// What is true of a scene along a ray, in double, to hold pictures against. None of the GLSL that draws them takes part: a
// solid is the list of a ray's intervals that lie inside it, found as the roots of its own equation, and union,
// intersection and difference act on the lists (Roth, "Ray Casting for Modeling Solids", 1982). What has no such list
// (blends, morphs, shells, swellings, twists, bends, waves) is marched densely over formulas of its own, and each change of
// sign is halved down to the last bit.
#include "core/scene/camera.h"
#include "core/sdf/tree.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mb {

/// The first surface on a ray.
struct TrueHit {
    double t = 0;             // m, along a direction of unit length
    glm::dvec3 normal{0};     // of unit length, towards the side that the ray came from
    int leaf = -1;            // of Oracle::tree().leaves: whose surface it is; of blended ones the one that shows most
    int object = -1;          // the top-level object's number, counting top-level objects from 0
};

/// A leaf that shows at a point of a surface.
struct LeafShare {
    int leaf = -1;
    double share = 1;         // of all that shows there
    glm::dvec3 at{0};         // the point in the leaf's own frame, behind the warps above it
};

/// Made of a scene once; then any number of threads may ask it at a time.
class Oracle {
public:
    explicit Oracle(const Scene& scene);
    ~Oracle();
    Oracle(Oracle&&) noexcept;
    Oracle& operator=(Oracle&&) noexcept;

    const Tree& tree() const;
    /// The first surface beyond the start and no further than `far`. A ray that starts inside a solid meets its inside, where it
    /// leaves all solids. A surface that the ray starts on is not met again.
    std::optional<TrueHit> firstHit(const Ray& ray, double far) const;
    /// Whether the ray starts inside a solid or meets one before `far`.
    bool isBlocked(const Ray& ray, double far) const;
    /// The leaves that show at a hit, `at` being the point itself; their shares add up to 1.
    std::vector<LeafShare> sharesAt(const TrueHit& hit, glm::dvec3 at) const;

    /// Whether every part of the scene has lists of intervals; else roots were marched for.
    bool isExact() const;
    /// m: what is thinner than this along a ray may be missed where roots are marched for; of what has no bounds, in proportion to the
    /// way where that is longer than the shape's largest part with bounds. 0 where all is exact.
    double resolution() const;
    /// m: how far a marched root may be from where its value changes its sign, if that rises by 1 a metre along the ray there; where it
    /// rises by a tenth of that, ten times as far. 0 where all is exact.
    double rootError() const;
    /// What a reader must know: primitives and operators without a form of their own here, whose values are then the program's own;
    /// or why the scene has no tree.
    const std::vector<std::string>& notes() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace mb
