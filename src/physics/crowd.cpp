// Balls that lie on one another: a crowd. How exact the path of one of them is matters less than that all keep apart, for one
// pass over the contacts a part: the velocities at the end of the part are those the balls move with through it (the
// semi-implicit Euler rule), so that no contact comes nearer than its gap is.
#include "physics/world.h"

namespace mb {
namespace {
std::size_t at(int i) { return static_cast<std::size_t>(i); }
}  // namespace

/// A ball that nothing pushes keeps falling, which is exact; the others move at the velocities found, without acceleration.
void PhysicsWorld::settleCrowds(std::span<Contact> contacts, double h, std::span<Motion> io_accelerations) {
    if (contacts.empty()) return;
    takeKept(contacts);
    std::vector<Motion> motion(bodies_.size());
    for (Contact& c : contacts) {
        c.target = -std::max(c.gap, 0.0) / h;
        for (const int i : {c.a, c.b})
            if (i != kStatic) motion[at(i)] = {bodies_[at(i)].velocity + glm::dvec3{0, -world_.gravity * h, 0}, bodies_[at(i)].spin};
    }
    solve(bodies_, contacts, motion, knobs_.iterations, stages_, counts_);
    std::vector<char> pushed(bodies_.size(), 0);
    for (const Contact& c : contacts) {
        if (c.push == 0) continue;
        pushed[at(c.a)] = 1;
        if (c.b != kStatic) pushed[at(c.b)] = 1;
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (!pushed[i]) continue;
        bodies_[i].velocity = motion[i].velocity, bodies_[i].spin = motion[i].spin;
        io_accelerations[i] = {};
    }
}

}  // namespace mb
