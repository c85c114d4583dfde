#pragma once
// The resistance of contacts to rolling and to spinning on the spot.
#include "physics/contact.h"

namespace mb {

/// Does what solve() does of contacts that last through a part; then, for those that resist, gives each an angular impulse against
/// the bodies' relative spin, along the surface of at most pairing.rolling times its push and along the normal of at most
/// pairing.spinning times it, and solves the contacts anew with these, in turns, `rounds` at most: so what would roll by less
/// stands still. (Resistance as a lever, in metres: Johnson, "Contact Mechanics", 1985, section 9.3; the cone as Coulomb's.)
/// Where no contact resists it is solve().
void solveResisting(std::span<const Body> bodies, std::span<Contact> io_contacts, std::span<Motion> io_motion, int rounds, Stages stages,
                    StepCounts& io_counts);

}  // namespace mb
