#pragma once
// Balls that lie on one another: a crowd. Its contacts are worked on four at a time.
#include "physics/rows.h"

namespace mb {

/// What impulses change of a ball, and how far it is pushed out of others, m. With each vector goes a number, of what never moves 0:
/// the inverse mass, the radius over the moment of inertia, and the radius.
struct alignas(32) LaneMotion {
    Lanes velocity{}, spin{}, apart{};
    /// `spins`: what does not has no lever.
    void set(const Body& ball, const Motion& m, bool spins) {
        velocity = Lanes{m.velocity.x, m.velocity.y, m.velocity.z, ball.inverse_mass};
        spin = Lanes{m.spin.x, m.spin.y, m.spin.z, spins ? BallNumbers::turnOf(ball) : 0};
        apart = Lanes{0, 0, 0, spins ? ball.radius : 0};
    }
    /// −0 becomes 0, as it does where nothing is added to it.
    Motion get() const { return {glm::dvec3{velocity[0], velocity[1], velocity[2]} + 0.0, glm::dvec3{spin[0], spin[1], spin[2]} + 0.0}; }
    glm::dvec3 getApart() const { return glm::dvec3{apart[0], apart[1], apart[2]} + 0.0; }
};

/// The contacts of one island of balls, sorted so that the four of a batch have no ball in common: by colours of the graph whose
/// edges they are (greedily, in their order), as parallel solvers do (Fratarcangeli, Tibaldo, Pellacini, "Vivace: a Practical
/// Gauss-Seidel Method for Stable Soft Body Dynamics", 2016).
class Crowd {
public:
    struct Batch {
        LaneVec normal, drag, drag_step, drag_way;
        Lanes normal_mass, tangent_mass, friction, target, push, step, way;
        Lanes apart_target, apart, apart_step, apart_way;  // of the displacements, m
        std::array<int, kLanes> a{}, b{};                  // bodies' numbers; of what never moves, and where there is no contact, one more than all
        std::array<std::uint32_t, kLanes> contact{};       // its number; kNone: there is no contact
    };
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};

    /// Of each body, by its number, and behind them of what never moves. `now` is given, of the crowd's balls, and changed.
    struct Motions {
        std::vector<LaneMotion> now, way, last;            // way and last: how the rounds go
        void resize(std::size_t bodies) {
            now.resize(bodies + 1), way.resize(bodies), last.resize(bodies);
            now.back() = {};
        }
    };
    /// `numbers`: of the island's contacts among all; `apart`: how far each of all is to part, in metres. `used` is of as many elements as
    /// there are bodies, all 0 of the balls'.
    void set(const Motions& motions, std::span<const Contact> contacts, std::span<const std::uint32_t> numbers,
             std::span<const double> apart, std::vector<std::uint64_t>& io_used);
    /// Makes rounds, until the last changed no velocity by more than 1e-12 m/s, and nothing is moved by more than as many metres.
    /// `balls`: all that the contacts have. `drags`: with friction; `parts`: what overlaps is moved apart too. Returns how many were made.
    int solve(std::span<const int> balls, Motions& io_motions, int rounds, bool drags, bool parts);
    /// Gives the impulses back to the contacts, and marks the bodies that are pushed.
    void finish(std::span<Contact> contacts, std::vector<std::uint64_t>& out_marks) const;

private:
    static void fill(Batch& io_batch, const Motions& motions, std::span<const Contact> contacts, std::span<const double> apart);

    std::span<Batch> batches() { return std::span(batches_).first(count_); }

    std::vector<Batch> batches_;                           // of the island, and behind them what larger ones needed
    std::size_t count_ = 0;                                // of the island's
    std::vector<std::uint8_t> colours_;                    // of the contacts
};

}  // namespace mb
