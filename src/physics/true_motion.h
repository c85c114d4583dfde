#pragma once
// Where bodies truly are: by closed form where there is one, else by the same world in steps a sixty-fourth as long.
#include "physics/world.h"

#include <optional>

namespace mb {

/// Where a motion was at common moments.
struct Track {
    double every_s = 0;                              // between two moments; the first is the start
    std::vector<ObjectId> bodies;                    // of the start
    std::vector<std::vector<glm::dvec3>> places;     // [moment][body], of its centre; NaN once it is gone
    std::vector<double> energy, kinetic;             // J, at each moment
    double deepest = 0;                              // m: overlap after any step
    int lost = 0;                                    // bodies that are gone or frozen at the end
    std::uint64_t visits = 0;                        // see Cost::visits
};

/// Follows a world and notes where it is. Its steps are the parts of the scene's; between two of them the places are taken to lie on a
/// line.
class Tracker {
public:
    Tracker(const Scene& scene, double seconds, double every_s);
    /// One step; says whether there is more to do.
    bool step();
    const Track& track() const { return track_; }
    const PhysicsWorld& world() const { return world_; }

private:
    void note(double share);
    template <class F> void eachBody(F visit) const;

    PhysicsWorld world_;
    double seconds_;
    Track track_;
    Energy energy_;                                  // after the last step
    std::vector<glm::dvec3> last_;                   // the places before the step
};

/// The same by closed form, or nothing: where no body meets another, and none meets anything but one level plane, and `down` is -y. Each flight is a
/// parabola, each impact Newton's with Coulomb's friction (a solid ball's; Brogliato, "Nonsmooth Mechanics", 1999). Nothing
/// either where a ball comes to rest within the time.
std::optional<Track> closedTrack(const Scene& scene, double seconds, double every_s);

/// The scene as its reference steps it: dt/64, more turns of the solver, and no sleep.
Scene referenceScene(const Scene& scene, int finer = 64);

}  // namespace mb
