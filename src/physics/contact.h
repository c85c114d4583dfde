#pragma once
// Contacts between balls, and between balls and static points, and the impulses that keep them apart.
//
// A ball's normal impulse passes through its centre and turns nothing; the tangential one acts at the lever r and meets
// the mass 1/(1/m + r²/I), which is 2/7·m for a solid ball.
#include "physics/body.h"
#include "physics/stages.h"

#include <span>

namespace mb {

inline constexpr int kStatic = -1;

struct Contact {
    int a = 0, b = kStatic;        // numbers of bodies; b may be static
    glm::dvec3 normal{0};          // unit, from b towards a
    double gap = 0;                // m
    Pairing pairing;
    double target = 0;             // the least normal velocity of a against b afterwards, m/s
    glm::dvec3 slip{0};            // the tangential velocity at the contact to reach if friction can, m/s
    double push = 0;               // the normal impulse so far, N·s
    glm::dvec3 drag{0};            // the tangential one
};

/// What impulses change.
struct Motion {
    glm::dvec3 velocity{0}, spin{0};
};

/// The unit vector from b's centre to a's. Centres that coincide are parted in a direction that follows from their ids.
glm::dvec3 directionApart(const Body& a, const Body& b);

/// The velocity of a's surface against b's at the contact, or of the centres, where no surface turns.
glm::dvec3 relativeVelocity(std::span<const Body> bodies, const Motion& a, const Motion* b, const Contact& c, bool spins);

/// Solves for impulses by turns (sequential impulses; Catto, "Iterative Dynamics with Temporal Coherence", 2005) until
/// the last round changed no velocity by more than 1e-12 m/s, or `rounds` is reached. `motion` is indexed by the body's
/// number. Impulses already in the contacts are applied first. Its rounds are composed of the stages: without friction there
/// is no tangential part, without spin nothing turns.
void solve(std::span<const Body> bodies, std::span<Contact> contacts, std::span<Motion> motion, int rounds, Stages stages,
           StepCounts& io_counts);

}  // namespace mb
