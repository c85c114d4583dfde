#pragma once
// Time in the editor: what it takes to run the physics beside a picture, and to go back and forth in it. Wall time becomes
// whole steps; what a slow machine cannot make is dropped, and said.
#include "physics/timeline.h"

#include <optional>
#include <tuple>

namespace mb {

/// What of the world its bodies feel; the rest is looks.
inline constexpr std::tuple kFelt{&World::gravity, &World::down, &World::restitution, &World::friction, &World::rolling, &World::spinning, &World::bounds};
inline bool feelsAlike(const World& a, const World& b) {
    return std::apply([&](auto... felt) { return ((a.*felt == b.*felt) && ...); }, kFelt);
}

class Simulation {
public:
    static constexpr int kMostSteps = 24;         // at one call of advance()
    static constexpr double kMostSeconds = 0.04;  // of wall time at one call, after the first step

    static constexpr double kThrowSpeed = 6;       // m/s
    static constexpr double kExplodeSpeed = 8;     // m/s, at its middle

    bool playing = false;
    std::uint64_t throws = 1;                     // the next throw's seed: the same session throws the same way

    /// Goes on with a seek; else makes as many steps as `seconds` of wall time hold. Shows the bodies; says whether anything
    /// changed. Where every body sleeps at the end, time stands still.
    bool advance(Scene& scene, double seconds);
    /// Makes one step.
    void step(Scene& scene);
    void throwAbout(Scene& scene);
    void explode(Scene& scene, glm::dvec3 at, double radius);
    /// Takes hold of a body at a place on it. The hand may then be moved, which each step takes note of, until it lets go.
    void grab(Scene& scene, ObjectId body, glm::dvec3 at);
    void moveHand(glm::dvec3 to);
    void letGo();
    /// The hand, while the run has its body; its target is where the hand is now.
    std::optional<Grab> hand() const;
    /// Goes to a moment, or as near to it as there is time for: advance() does the rest.
    void seek(Scene& scene, std::uint64_t step);
    bool seeking() const { return timeline_ && timeline_->target(); }
    /// The run so far, begun with the scene if there is none yet.
    Timeline& ready(const Scene& scene);
    /// The scene's bodies were changed by hand: a new run begins with the scene as it then is.
    void rebuild() { timeline_.reset(), shown_.reset(), changed_ = false, loaded_ = 0; }
    /// What does not move was changed, or the knobs: the run goes on with the scene as it then is.
    void changeStatics() { changed_ = timeline_.has_value(); }
    /// Forgets the steps that were made behind the moment shown.
    void discardFuture();
    bool hasBody(ObjectId object) const;
    /// Takes the body out of the run, if it is in it.
    void remove(ObjectId body);
    /// Begins a recorded run again, which advance() compares with what was recorded.
    void load(Recording recording);
    void stop() { playing = false, owed_ = 0, ratio_ = 1, told_ = false, rebuild(); }

    std::uint64_t steps() const { return timeline_ ? timeline_->step() : 0; }
    /// Nothing moves until something wakes a body: a throw, an edit.
    bool asleep() const { return timeline_ && !changed_ && timeline_->atEnd() && timeline_->world().awake() == 0; }
    /// Simulated seconds a second of wall time: 1, or less where the machine is too slow.
    double ratio() const { return ratio_; }
    const Timeline* timeline() const { return timeline_ ? &*timeline_ : nullptr; }
    /// Whether the scene has had its shapes replaced, by those of another moment, since the last call.
    bool tookShapes() { return std::exchange(took_shapes_, false); }
    /// What a comparison with the recording has to tell that was not told yet: a step that is another, or that all are equal.
    std::optional<Divergence> divergenceToTell();
    std::uint64_t equalStepsToTell();

private:
    void show(Scene& scene);
    void makeStep();
    bool holds(ObjectId body) const;

    std::optional<Timeline> timeline_;
    std::shared_ptr<const Scene> shown_;          // the timeline's scene whose shapes are in the editor's, and when
    std::uint64_t shown_step_ = 0;
    std::uint64_t loaded_ = 0;                    // steps of a recording that are not all compared yet
    std::optional<Grab> hand_;
    bool changed_ = false, told_ = false, took_shapes_ = false;
    double owed_ = 0, ratio_ = 1;
};

}  // namespace mb
