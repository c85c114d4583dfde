#pragma once
// What accuracy costs in a motion: each knob of the physics turned alone, and all of them together, each setting's motion held
// against the true one, counted and timed.
#include "core/accuracy/search.h"
#include "physics/true_motion.h"

#include <optional>

namespace mb {

/// Made a slice at a time, so that an editor may go on between two. The same runs each time, but for the milliseconds.
class MotionSweep {
public:
    struct Plan {
        double seconds = 2;              // of motion
        double every_s = 1.0 / 960;      // between two moments at which it is looked at: finer than most steps, so that a path's corners show
        std::size_t together = 60;       // settings of the joint sweep
        int timings = 3;
        double slice_ms = 10;            // after which a call returns
    };
    explicit MotionSweep(const Scene& scene) : MotionSweep(scene, Plan{}) {}
    MotionSweep(const Scene& scene, Plan plan);

    /// Works for a slice; says whether there is more to do.
    bool step();
    double progress() const;             // 0 to 1
    /// The own setting first, then the default one, then each knob's values, then the joint ones.
    const std::vector<Run>& runs() const { return runs_; }
    const Track& truth() const { return truth_; }
    /// Whether the truth is a closed form; and how far off a reference that is stepped may be itself: its errors, if one of twice
    /// its step were the truth. 0 of a closed form.
    bool isClosed() const { return closed_; }
    const Values<Error>& truthErrors() const { return truth_errors_; }
    Terms terms() const { return motionTerms(truth_errors_[Error::position], truth_errors_[Error::energy]); }
    const Plan& plan() const { return plan_; }

private:
    bool work();
    bool findTruth();
    void sway();
    bool begin();
    void conclude();

    Scene scene_;
    Plan plan_;
    std::vector<Body> bodies_;           // as they begin
    Track truth_;
    bool closed_ = false, known_ = false;
    Values<Error> truth_errors_;
    std::optional<Tracker> coarse_, fine_;  // the reference, of twice its step and of its own
    std::vector<Run> wanted_;
    Search search_;
    std::vector<Run> runs_;
    std::optional<Run> run_;             // in work
    std::optional<Tracker> tracked_;     // its motion, looked at
    std::optional<Tracker> swayed_;      // the own setting's, from a hair's breadth beside
    int sways_ = 0;
    Values<Error> off_;                  // how much the errors then differed at most: what chance alone makes
    std::optional<PhysicsWorld> timed_;  // and timed
    int timing_ = 0;
    double ms_ = 0;                      // of this timing
};

/// What a motion is wrong by, restitution left out.
Values<Error> errorsOf(const Track& track, const Track& truth);
/// By how much the speed with which a ball leaves a level floor is off under these knobs, as a share of the speed with which it came:
/// dropped from a metre, against Newton's law of impact. Not measured where nothing falls.
double restitutionError(const World& world, const PhysicsKnobs& knobs);
/// The scene with each body moved by a micrometre, another way for each number.
Scene movedByAHair(Scene scene, int number);

/// Why a motion is no point of a curve, or nothing: a body is lost or went through something, or energy was gained.
std::string failureOf(const Track& track, const Track& truth, std::span<const Body> bodies);

/// The scene as a setting leaves it after that time.
Scene movedScene(const Scene& scene, const Setting& setting, double seconds);

}  // namespace mb
