#pragma once
// A run through which one can go back and forth: what was done, the hashes of every state, and snapshots to begin from.
//
// A moment is a number of steps made; what was done at that moment comes behind it, except at the end, which is the present:
// what was done there is done. Going on from an earlier moment makes the recorded steps again, with all that was done, and
// compares each with its hash. Doing something new there discards what was recorded behind it.
#include "physics/recording.h"

#include <chrono>
#include <map>

namespace mb {

struct TimelineOptions {
    /// Of the snapshots and the recording together, by an estimate. Beyond it snapshots get fewer, evenly; where the
    /// recording takes half of it, the oldest steps lose the hashes of their bodies: their divergences then have no name.
    std::size_t most_bytes = std::size_t{256} << 20;
    std::uint64_t spacing = 16;  // steps from one snapshot to the next, at first; 0: there are none but the start
    double copying = 0.02;       // of the time the steps take: what copying worlds may take at most
};

class Timeline {
public:
    /// Begins with the world of that scene.
    explicit Timeline(Scene start, TimelineOptions options = {});
    /// Stands at the start of a recorded run, all of it ahead. The recording has a start.
    explicit Timeline(Recording recording, TimelineOptions options = {});

    const PhysicsWorld& world() const { return world_; }
    /// The scene whose shapes, world and knobs hold at this moment: the start, or that of the last change of statics.
    const std::shared_ptr<const Scene>& scene() const;
    std::uint64_t step() const { return world_.steps(); }
    std::uint64_t last() const { return recording_.steps.size(); }
    bool atEnd() const { return step() == last(); }

    /// Makes one step: the recorded one, or at the end a new one.
    void advance();
    /// Does it now. Says how many steps were recorded from here on, which are discarded. Changes of the statics with no step
    /// between them count as the last of them alone.
    std::uint64_t act(Action action);
    /// Forgets what was recorded behind this moment, which is the end then.
    void discardFuture();
    /// Goes to a moment, at most the end: exactly the state that was there.
    void seek(std::uint64_t step) { aim(step), arrive(); }
    /// The same in slices: whether it is reached. aim() may reach it at once; advance() and act() give the rest up.
    void aim(std::uint64_t step);
    bool arrive(double seconds = 1e300);
    std::optional<std::uint64_t> target() const { return target_; }

    /// The first step found that is not as recorded: the world is no longer deterministic, or the recording is of another.
    const std::optional<Divergence>& divergence() const { return divergence_; }
    const Recording& recording() const { return recording_; }
    /// Whether the end can be had at once.
    bool keepsEnd() const { return atEnd() || end_; }

    std::size_t bytes() const { return snapshot_bytes_ + recording_bytes_; }
    std::size_t snapshots() const { return snapshots_.size(); }
    std::uint64_t spacing() const { return spacing_; }

private:
    struct Snapshot {
        PhysicsWorld world;
        std::size_t done = 0;   // actions
        std::size_t bytes = 0;
    };

    Snapshot snapshot();
    void restore(const Snapshot& from);
    const Snapshot& nearest(std::uint64_t step) const;
    void forward();
    void doActions();
    void record();
    void keepSnapshot();
    void thin();

    Recording recording_;
    PhysicsWorld world_;
    TimelineOptions options_;
    std::size_t done_ = 0;                             // of the recording's actions
    std::optional<std::uint64_t> target_;
    std::optional<Divergence> divergence_;
    std::map<std::uint64_t, Snapshot> snapshots_;      // by their step; the first is the start
    std::optional<Snapshot> end_;                      // kept while one looks at an earlier moment
    std::optional<Snapshot> near_;                     // a little before where one went last: the next step back is short
    std::optional<PhysicsWorld> before_statics_;       // the world before the last change, if no step was made since
    std::uint64_t spacing_;
    std::size_t snapshot_bytes_ = 0, recording_bytes_ = 0;
    std::size_t named_from_ = 0;                       // the first step that has the hashes of its bodies
    std::shared_ptr<const Scene> counted_;             // the scene of which static_bytes_ is
    std::size_t static_bytes_ = 0;                     // of its shapes, which each snapshot has
    double stepping_s_ = 0, copying_s_ = 0;            // of steps since the last snapshot; of copying that
};

/// Makes a recorded run again, up to the first step that is not as recorded, and says which. `watch` sees each step.
std::optional<Divergence> replay(Recording recording, const std::function<void(const Timeline&)>& watch = {});

}  // namespace mb
