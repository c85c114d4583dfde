#pragma once
// Contacts of bodies, with one another and with what does not move, and the impulses that keep them apart.
#include "physics/body.h"
#include "physics/stages.h"

#include <span>

namespace mb {

inline constexpr int kStatic = -1;
/// Where things of bodies hold that of the body with this number.
inline std::size_t slot(int body) { return static_cast<std::size_t>(body); }

struct Contact {
    int a = 0, b = kStatic;        // numbers of bodies; b may be static
    int island = 0;                // which it belongs to; those of one stand together
    bool flown = false;            // it is met in flight (flight.h), if it is fast
    bool way_out = false;          // of two too deep in one another for their surfaces to tell how to part
    glm::dvec3 normal{0};          // unit, from b towards a
    double gap = 0;                // m
    double depth = 0;              // m: how deep the two may rest in one another
    double target = 0;             // the least normal velocity of a against b afterwards, m/s
    double push = 0;               // the normal impulse so far, N·s
    glm::dvec3 drag{0};            // the tangential one
    Pairing pairing;
    std::uint64_t feature = 0;     // what it was found from (manifold.h); 0 for a ball's
    glm::dvec3 arm_a{0}, arm_b{0}; // from the centres of mass to the contact, m
    glm::dvec3 slip{0};            // the tangential velocity at the contact to reach if friction can, m/s
    double patch = 0;              // m: radius of what touches, in truth; friction about the normal has it for a lever
    double twist = 0;              // the angular impulse about the normal, N·m·s
};

/// The unit vector from b's centre to a's. Centres that coincide are parted in a direction that follows from their ids.
glm::dvec3 directionApart(const Body& a, const Body& b);

/// Adds one of a ball a with what does not move, or with another ball.
Contact& addBallContact(int a, const Body& body, const glm::dvec3& normal, double gap, const Pairing& pairing, std::vector<Contact>& io_contacts);
Contact& addBallContact(int a, const Body& body_a, int b, const Body& body_b, const Pairing& pairing, std::vector<Contact>& io_contacts);

/// Whether no lever is needed: a ball with what does not move, or with another ball.
bool betweenBalls(std::span<const Body> bodies, const Contact& c);

/// The velocity of a's surface against b's at the contact, or of the centres, where no surface turns. b: null for a static one.
glm::dvec3 relativeVelocity(const Motion& a, const Motion* b, const Contact& c, bool spins);
/// The same of bodies as they move.
glm::dvec3 relativeVelocity(std::span<const Body> bodies, const Contact& c, bool spins);

/// How many rounds an island of so many contacts gets, where `rounds` are asked for: a small one, whose errors are seen, up to four
/// times as many.
int roundsFor(std::size_t contacts, int rounds);

/// Solves for impulses by turns (sequential impulses; Catto, "Iterative Dynamics with Temporal Coherence", 2005), island by
/// island, until the last round changed no velocity of the island by more than 1e-12 m/s, or roundsFor() are made; between rounds it goes on
/// in the way they went (rows.h). `motion` is indexed by the body's number. Impulses already in the contacts are applied
/// first. Its rounds are composed of the stages: without friction there is no tangential part, without spin nothing turns.
void solve(std::span<const Body> bodies, std::span<Contact> contacts, std::span<Motion> motion, int rounds, Stages stages,
           StepCounts& io_counts);

/// Newton's restitution with Coulomb's friction can make energy, of one contact too (Brogliato, "Nonsmooth Mechanics", 1999). Brings the
/// motions that `members` have after such impacts back to an energy of no more than `most`, J: as far as needed towards those without
/// restitution, which make none. The impulses between are within friction's cone too.
void temper(std::span<const Body> bodies, std::span<const Contact> contacts, std::span<const int> members, double most, std::span<Motion> io_motion,
            int rounds, Stages stages, StepCounts& io_counts);

}  // namespace mb
