#pragma once
// Balls that lie on one another: a crowd. Its contacts are worked on four at a time.
#include "physics/rows.h"

namespace mb {

/// What impulses change, as vectors of which the fourth number is not used.
struct alignas(64) LaneMotion {
    Lanes velocity{}, spin{};
    void set(const Motion& m) {
        velocity = Lanes{m.velocity.x, m.velocity.y, m.velocity.z, 0}, spin = Lanes{m.spin.x, m.spin.y, m.spin.z, 0};
    }
    /// −0 becomes 0, as it does where nothing is added to it.
    Motion get() const { return {glm::dvec3{velocity[0], velocity[1], velocity[2]} + 0.0, glm::dvec3{spin[0], spin[1], spin[2]} + 0.0}; }
};

/// The contacts of one island of balls, sorted so that the four of a batch have no ball in common: by colours of the graph whose
/// edges they are (greedily, in their order), as parallel solvers do (Fratarcangeli, Tibaldo, Pellacini, "Vivace: a Practical
/// Gauss-Seidel Method for Stable Soft Body Dynamics", 2016).
class Crowd {
public:
    struct Batch {
        alignas(32) BallRowOf<true, Lanes, LaneVec> row;  // said, as a template's argument is not aligned as its type is
        std::array<int, kLanes> a{}, b{};                  // bodies' numbers; of a static one, and where there is no contact, one more than all
        std::array<std::uint32_t, kLanes> contact{};       // its number; kNone: there is no contact
    };
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};

    /// `numbers`: of the island's contacts among all. `used` is of as many elements as there are bodies, all 0, and is so again.
    void set(std::span<const Body> bodies, std::span<const Contact> contacts, std::span<const std::uint32_t> numbers, Stages stages,
             std::vector<std::uint64_t>& io_used);
    /// Sets each row's target and the impulses it begins with.
    void aim(std::span<const Contact> contacts);
    /// Makes rounds, until the last changed no velocity by more than 1e-12 m/s; `motion` is of one element more than there are bodies.
    /// `drags`: with friction. Returns how many were made.
    int solve(std::span<LaneMotion> motion, int rounds, bool drags);
    /// Gives the impulses back to the contacts.
    void finish(std::span<Contact> contacts) const;

private:
    static void fill(Batch& io_batch, std::span<const Body> bodies, std::span<const Contact> contacts, bool spins);

    std::vector<Batch> batches_;
    std::vector<std::uint8_t> colours_;                    // of the contacts
};

}  // namespace mb
