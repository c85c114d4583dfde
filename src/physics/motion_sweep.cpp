#include "physics/motion_sweep.h"

#include "core/measure/timing.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace mb {
namespace {

using Clock = std::chrono::steady_clock;
double msSince(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

/// The root mean square, over all moments, of the distances of the bodies that both have then.
double apart(const Track& a, const Track& b) {
    double sum = 0;
    std::size_t n = 0;
    for (std::size_t m = 0; m < std::min(a.places.size(), b.places.size()); ++m)
        for (std::size_t i = 0; i < a.places[m].size(); ++i) {
            const glm::dvec3 d = a.places[m][i] - b.places[m][i];
            if (!std::isnan(d.x)) sum += glm::dot(d, d), ++n;
        }
    return n > 0 ? std::sqrt(sum / static_cast<double>(n)) : 0;
}

/// What energies are compared with: the greatest there was of motion.
double turnedOver(const Track& truth) { return std::max(1e-12, *std::ranges::max_element(truth.kinetic)); }

std::uint64_t stepsOf(const Scene& scene, double seconds) { return static_cast<std::uint64_t>(std::llround(seconds / scene.physics.dt)); }

}  // namespace

Values<Error> errorsOf(const Track& track, const Track& truth) {
    Values<Error> errors;
    errors[Error::position] = apart(track, truth);
    errors[Error::energy] = std::fabs(track.energy.back() - truth.energy.back()) / turnedOver(truth);
    errors[Error::penetration] = track.deepest;
    return errors;
}

double restitutionError(const World& world, const PhysicsKnobs& knobs) {
    if (!(world.gravity > 0)) return kNotMeasured;
    constexpr double kDrop = 1, kRadius = 0.1;  // m
    Scene probe;
    probe.world = world, probe.physics = knobs;
    probe.world.bounds = 1e6, probe.world.down = World{}.down;
    Object floor, ball;
    floor.type = findShapeType("plane"), floor.numbers = initialNumbers(*floor.type), floor.id = probe.newId();
    ball.type = findShapeType("sphere"), ball.numbers = initialNumbers(*ball.type), ball.id = probe.newId();
    ball.numbers[0] = kRadius, ball.pos.y = kDrop + kRadius, ball.mass = 1;
    probe.objects = {floor, ball};
    PhysicsWorld dropped(probe);
    // It falls for √(2/g); the energy above the floor is then e² of what it was.
    const double contact = world.gravity * kRadius, before = dropped.energy().total() - contact, until = 1.2 * std::sqrt(2 * kDrop / world.gravity);
    while (dropped.time_s() < until) dropped.step();
    const double left = std::max(dropped.energy().total() - contact, 0.0);
    return std::fabs(std::sqrt(left / before) - world.restitution);
}

std::string failureOf(const Track& track, const Track& truth, std::span<const Body> bodies) {
    if (track.lost > truth.lost) return fmt::format("{} bodies were lost: their state was no number, or they left the world", track.lost - truth.lost);
    double smallest = INFINITY;
    for (const Body& b : bodies) smallest = std::min(smallest, b.radius);
    if (track.deepest > smallest && track.deepest > 2 * truth.deepest) return fmt::format("a body went into something by {:.3g} m, more than its radius", track.deepest);
    constexpr double kGain = 0.01;
    const double gained = *std::ranges::max_element(track.energy) - track.energy.front();
    if (gained > kGain * turnedOver(truth)) return fmt::format("energy was gained: {:.3g} J, {:.2g} of the greatest energy of motion", gained, gained / turnedOver(truth));
    return {};
}

Scene movedByAHair(Scene scene, int number) {
    constexpr double kHair = 1e-6;  // m
    int turn = number;
    for (Object& o : scene.objects)
        if (o.isBody()) o.pos[turn % 3] += (turn / 3 + number) % 2 == 0 ? kHair : -kHair, ++turn;
    return scene;
}

Scene movedScene(const Scene& scene, const Setting& setting, double seconds) {
    Scene moved = withSetting(scene, setting);
    PhysicsWorld world(moved);
    for (std::uint64_t i = stepsOf(moved, seconds); i > 0; --i) world.step();
    world.writeTo(moved);
    return moved;
}

MotionSweep::MotionSweep(const Scene& scene, Plan plan)
    : scene_(scene), plan_(plan), search_(settingOf(scene), defaultsOf(settingOf(scene), true), {knobsOf(scene, true), motionTerms(), plan.together}) {
    const PhysicsWorld world(scene);
    bodies_.assign(world.bodies().begin(), world.bodies().end());
    const Setting own = settingOf(scene);
    wanted_ = {runOf(own), runOf(defaultsOf(own, true))};
    for (const Knob* knob : knobsOf(scene, true))
        for (const double value : valuesWith(*knob, {valueOf(own, *knob)})) wanted_.push_back(runOf(turned(own, *knob, value), knob->key, value));
}

double MotionSweep::progress() const {
    const double all = static_cast<double>(wanted_.size() + search_.most());
    return known_ ? 0.1 + 0.9 * static_cast<double>(runs_.size()) / all : 0;
}

bool MotionSweep::step() {
    const Clock::time_point start = Clock::now();
    while (msSince(start) < plan_.slice_ms)
        if (!work()) return false;
    return true;
}

/// The closed form, or both references; says whether it goes on.
bool MotionSweep::findTruth() {
    if (!coarse_) {
        if (std::optional<Track> closed = closedTrack(scene_, plan_.seconds, plan_.every_s)) {
            truth_ = std::move(*closed), closed_ = known_ = true;
            truth_errors_[Error::position] = truth_errors_[Error::energy] = 0;
            return true;
        }
        coarse_.emplace(referenceScene(scene_, 32), plan_.seconds, plan_.every_s);
        fine_.emplace(referenceScene(scene_), plan_.seconds, plan_.every_s);
    }
    if (coarse_->step() || fine_->step()) return true;
    truth_ = fine_->track(), truth_errors_ = errorsOf(coarse_->track(), truth_);
    coarse_.reset(), fine_.reset();
    return known_ = true;
}

bool MotionSweep::begin() {
    if (runs_.size() < wanted_.size()) run_ = wanted_[runs_.size()];
    else if (const std::optional<Setting> next = search_.next(runs_)) run_ = runOf(*next);
    else return false;
    tracked_.emplace(withSetting(scene_, run_->setting), plan_.seconds, plan_.every_s);
    timing_ = 0, timed_.reset();
    return true;
}

/// A step of the motion that is looked at, then of those that are timed; says whether there is more to do.
bool MotionSweep::work() {
    if (!known_) return findTruth();
    constexpr int kSways = 4;
    if (!run_ && runs_.size() == 1 && sways_ < kSways) return sway(), true;
    if (!run_) return begin();
    if (timing_ == 0 && !timed_ && tracked_->step()) return true;
    if (!timed_) timed_.emplace(withSetting(scene_, run_->setting)), ms_ = 0;
    ms_ += timeOf([&] { timed_->step(); });
    if (static_cast<double>(timed_->steps()) * timed_->dt_s() < plan_.seconds - 0.5 * timed_->dt_s()) return true;
    const double a_second = ms_ / plan_.seconds;
    double& best = run_->costs[Cost::step_ms];
    best = timing_ == 0 ? a_second : std::min(best, a_second);
    timed_.reset();
    // One timing is enough of what takes long.
    constexpr double kLong = 4;
    const bool is_long = !runs_.empty() && static_cast<double>(tracked_->track().visits) > kLong * plan_.seconds * runs_[kOwnRun].costs[Cost::visits];
    if (++timing_ >= (is_long ? 1 : plan_.timings)) conclude();
    return true;
}

void MotionSweep::conclude() {
    const Track& track = tracked_->track();
    run_->errors = errorsOf(track, truth_);
    run_->errors[Error::restitution] = restitutionError(scene_.world, run_->setting.physics);
    run_->costs[Cost::visits] = static_cast<double>(track.visits) / plan_.seconds;
    run_->failure = failureOf(track, truth_, bodies_);
    run_->off = off_;
    runs_.push_back(std::move(*run_));
    run_.reset(), tracked_.reset();
}

/// A step of the own motion from a hair's breadth beside; at its end, how much more or less wrong it was.
void MotionSweep::sway() {
    if (!swayed_) swayed_.emplace(movedByAHair(scene_, sways_), plan_.seconds, plan_.every_s);
    if (swayed_->step()) return;
    const Values<Error> errors = errorsOf(swayed_->track(), truth_);
    for (const Error e : motionTerms().errors)
        if (errors.has(e)) off_[e] = std::max(off_.has(e) ? off_[e] : 0, std::fabs(errors[e] - runs_[kOwnRun].errors[e]));
    runs_[kOwnRun].off = off_;
    swayed_.reset(), ++sways_;
}

}  // namespace mb
