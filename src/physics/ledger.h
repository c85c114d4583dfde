#pragma once
// What each stage of the physics costs and does, in a scene: the world with it against the same world without it. The bodies
// then go other ways, and what that costs or saves is in the price too: prices do not add up to a step, and may be negative.
#include "core/effects/effect.h"
#include "physics/world.h"

namespace mb {

/// A row for each stage of the table of effects.
struct StagePrice {
    const Effect* effect = nullptr;
    bool called = false;             // by the world as it was made from the scene
    std::vector<Because> because;    // the scene's records that call for it
    double uses_per_step = 0;        // of a called stage: its counter
    double ms_per_step = 0;          // of wall time: the median, over the rounds, of with less without
    double ms_least = 0, ms_most = 0;  // the same, of the least and the most round
    double moved_m = 0;              // without it: the greatest distance of a body from where it would be
    std::size_t lost = 0;            // bodies that only one of the two worlds still has
    bool changes = false;            // the state, to the bit
};

/// Made a slice at a time, so that an editor may go on between two. In each round two worlds take turns, a step each, the
/// first one second the next time: only differences within a round are figures.
class MotionLedger {
public:
    struct Plan {
        int steps = 120;             // of each world in each round
        int rounds = 5;              // an odd number
        std::size_t records = 8;     // the most that a row names
        double slice_ms = 4;         // after which a call returns
    };
    explicit MotionLedger(const Scene& scene) : MotionLedger(scene, Plan{}) {}
    MotionLedger(const Scene& scene, Plan plan);

    /// Does a slice; says whether there is more to do.
    bool step();
    double progress() const;         // 0 to 1
    /// In the order of Stage; a row's prices count once its rounds are made.
    std::span<const StagePrice> rows() const { return rows_; }
    double ms_per_step() const { return ms_per_step_; }  // of the world as it is composed: the median of all rounds

private:
    /// The stage being priced: the worlds as they begin and as they are, and this round's times.
    struct Trial {
        PhysicsWorld with_start, without_start, with, without;
        double with_ms = 0, without_ms = 0;
        int step = 0;
        std::vector<double> differences;
    };

    void begin();
    void stepBoth();
    void endRound();
    void compareStates();

    Scene scene_;
    Plan plan_;
    std::vector<StagePrice> rows_;
    std::size_t row_ = 0;            // being priced
    std::optional<Trial> trial_;
    std::vector<double> composed_ms_;
    double ms_per_step_ = 0;
};

}  // namespace mb
