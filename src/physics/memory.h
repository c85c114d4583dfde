#pragma once
// What two shapes' contacts were, to be followed as long as the two hardly move against one another: the same points from part
// to part, without a question to the field.
#include "physics/hash.h"
#include "physics/manifold.h"

namespace mb {

/// A contact point, fixed to both.
struct FollowedPoint {
    glm::dvec3 on_a{0}, on_b{0};   // the point of each that faces the other's, in its frame
    glm::dvec3 normal{0};          // towards a, in b's frame
    std::uint64_t feature = 0;
};

class ManifoldMemory {
public:
    /// A pair's points and where a was in b's frame when they were found.
    struct Entry {
        std::uint32_t a = 0, b = 0;        // ids of objects; 0: what does not move
        Pose found;
        double slack = 0;                  // m: what no point of a may have moved by against b, for them to hold
        double reach = 0;                  // m: how far apart the shapes were looked at
        bool taken = false;                // it, or what was found instead, is of the next part
        std::vector<FollowedPoint> points = {};
    };

    /// What is found of some pairs in a part, to be added to the memory. Several may be filled at once, each by a thread of its own, as
    /// long as no two have a pair in common.
    class Share {
    public:
        explicit Share(ManifoldMemory& memory) : memory_(&memory) {}
        /// The pair's points, if they still are all there are within the margin; null: they must be looked for anew. `radius`: of a
        /// about its frame's origin.
        const Entry* follow(std::uint32_t a, std::uint32_t b, const Pose& pose_a, const Pose& pose_b, double radius, double margin);
        /// Keeps what was found; points hold for as long as nothing has moved by the slack.
        const Entry& remember(std::uint32_t a, std::uint32_t b, const Pose& pose_a, const Pose& pose_b, double slack, const Manifold& found);

    private:
        friend class ManifoldMemory;
        ManifoldMemory* memory_;
        std::vector<Entry> found_;
    };

    /// Begins a part: what is not added until its end will be forgotten.
    void begin();
    void add(Share&& share);
    /// Keeps what was not asked for of those that sleep, too. `asleep`: their ids, sorted.
    void end(std::span<const std::uint32_t> asleep);
    void addTo(StateHash& io_hash) const;
    void forget(std::uint32_t object);
    void clear() { last_.clear(), now_.clear(); }
    /// That a copy takes, but for its own size.
    std::size_t bytes() const;

private:
    Entry* lastOf(std::uint32_t a, std::uint32_t b);

    std::vector<Entry> last_, now_;        // sorted; now_: from the end of a part on
};

/// Where the point of an entry is now: on a, in the world; the normal, and the gap along it.
ManifoldPoint pointOf(const FollowedPoint& followed, const Pose& pose_a, const Pose& pose_b);

}  // namespace mb
