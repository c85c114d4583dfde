#pragma once
// Finds contacts: of a body with what does not move, and of two bodies, wherever they are.
#include "physics/contact.h"
#include "physics/memory.h"
#include "physics/near_statics.h"

namespace mb {

class Collider {
public:
    /// `memory`: what is found is followed from call to call; none: it is looked for each time.
    Collider(const World& world, const StaticField& field, StepCounts& io_counts, ManifoldMemory::Share* memory = nullptr)
        : world_(world), field_(field), counts_(io_counts), memory_(memory) {}

    /// Appends the contacts that are nearer than the margin. `near`: what is known of the statics around the body. A ball's
    /// margin is at most kNear of its radius.
    void withStatics(int i, const Body& body, const Pose& pose, double margin, NearStatics& io_near, std::vector<Contact>& io_contacts) const;
    /// Of two balls.
    void betweenBalls(int i, const Body& a, int j, const Body& b, const Pairing& pairing, double margin, std::vector<Contact>& io_contacts) const;
    /// Of two bodies; where just one is a ball, that is the contact's a.
    void between(int i, const Body& a, const Pose& pose_a, int j, const Body& b, const Pose& pose_b, double margin,
                 std::vector<Contact>& io_contacts) const;

private:
    void ballWithShape(int i, const Body& ball, const Pose& at, int j, const Body& shape, const Pose& pose, double margin,
                       std::vector<Contact>& io_contacts) const;
    bool part(int i, const Body& a, const Pose& pose_a, int j, const Body& b, const Pose& pose_b, std::vector<Contact>& io_contacts) const;
    void leaveBuried(int i, const Body& body, const Pose& pose, std::vector<Contact>& io_contacts) const;
    void addWayOut(int i, const Body& body, glm::dvec3 arm, const WayOut& way, std::vector<Contact>& io_contacts) const;
    void leaveBlocked(int i, const Body& body, const Pose& pose, std::size_t first, std::vector<Contact>& io_contacts) const;
    bool holds(const Body& body, const Pose& pose, glm::dvec3 place) const;
    template <class Find>
    void addPoints(int i, const Body& a, const Pose& pose_a, int j, const Body* b, const Pose& pose_b, double margin, Find find,
                   std::vector<Contact>& io_contacts) const;

    const World& world_;
    const StaticField& field_;
    StepCounts& counts_;
    ManifoldMemory::Share* memory_;
};

}  // namespace mb
