#include "physics/timeline.h"

#include <algorithm>
#include <utility>

namespace mb {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSlow_s = 0.1;          // where fewer steps take so long, they need not be made again to go back

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::size_t bytesOf(const Scene& scene) {
    return sizeof(Scene) + scene.objects.size() * (sizeof(Object) + 32) + scene.materials.size() * sizeof(Material);
}
std::size_t bytesOf(const Tree& tree) {
    return tree.leaves.size() * (sizeof(Leaf) + 1) + tree.branches.size() * sizeof(Branch) + tree.program.size() * sizeof(Instruction);
}
std::size_t bytesOf(const StepHash& hash) { return sizeof hash + hash.bodies.capacity() * sizeof hash.bodies[0]; }
std::size_t bytesOf(const Action& action) { return sizeof action + (action.scene ? bytesOf(*action.scene) : 0); }

std::vector<ObjectId> objectsOf(const PhysicsWorld& world) {
    std::vector<ObjectId> objects;
    for (const Body& b : world.bodies()) objects.push_back(b.object);
    return objects;
}

Recording beginningWith(Scene start) { return {std::make_shared<const Scene>(std::move(start)), {}, {}}; }

}  // namespace

Timeline::Timeline(Scene start, TimelineOptions options) : Timeline(beginningWith(std::move(start)), options) {}

Timeline::Timeline(Recording recording, TimelineOptions options)
    : recording_(std::move(recording)), world_(*recording_.start), options_(options), spacing_(options.spacing) {
    recording_bytes_ = bytesOf(*recording_.start);
    for (const StepHash& step : recording_.steps) recording_bytes_ += bytesOf(step);
    for (const Action& action : recording_.actions) recording_bytes_ += bytesOf(action);
    snapshot_bytes_ = snapshots_.emplace(0, snapshot()).first->second.bytes;
    if (atEnd()) doActions();
}

const std::shared_ptr<const Scene>& Timeline::scene() const {
    for (std::size_t i = done_; i-- > 0;)
        if (recording_.actions[i].scene) return recording_.actions[i].scene;
    return recording_.start;
}

Timeline::Snapshot Timeline::snapshot() {
    if (counted_ != scene()) counted_ = scene(), static_bytes_ = world_.bodies().empty() ? 0 : bytesOf(makeTree(*counted_));
    return {world_, done_, world_.bytes() + static_bytes_};
}

void Timeline::restore(const Snapshot& from) {
    world_ = from.world, done_ = from.done;
    before_statics_.reset();
}

/// The latest snapshot that is not behind that moment.
const Timeline::Snapshot& Timeline::nearest(std::uint64_t step) const {
    const Snapshot& kept = std::prev(snapshots_.upper_bound(step))->second;
    return near_ && near_->world.steps() <= step && near_->world.steps() > kept.world.steps() ? *near_ : kept;
}

void Timeline::advance() {
    target_.reset();
    forward();
}

void Timeline::forward() {
    const bool recorded = !atEnd();
    const std::vector<ObjectId> before = recorded ? objectsOf(world_) : std::vector<ObjectId>{};
    doActions();
    const auto start = Clock::now();
    world_.step();
    stepping_s_ += secondsSince(start);
    before_statics_.reset();
    if (!recorded) record();
    else if (!divergence_) divergence_ = compare(recording_, world_, before);
    keepSnapshot();
    thin();
    if (atEnd()) doActions();
}

/// Does what was done at this moment and is not done yet.
void Timeline::doActions() {
    for (; done_ < recording_.actions.size() && recording_.actions[done_].step <= step(); ++done_)
        recording_.actions[done_].kind->apply(world_, recording_.actions[done_]);
}

void Timeline::record() {
    end_.reset();
    recording_.steps.push_back(hashOf(world_));
    recording_bytes_ += bytesOf(recording_.steps.back());
    for (; recording_bytes_ > options_.most_bytes / 2 && named_from_ + 1 < recording_.steps.size(); ++named_from_) {
        std::vector<std::uint32_t>& bodies = recording_.steps[named_from_].bodies;
        recording_bytes_ -= bodies.capacity() * sizeof bodies[0];
        bodies = {};
    }
}

/// Keeps this moment if the last one kept is far enough away, in steps or in the time they took.
void Timeline::keepSnapshot() {
    if (target_ && *target_ - step() == options_.spacing) near_ = snapshot();
    const std::uint64_t since = step() - std::prev(snapshots_.upper_bound(step()))->first;
    const bool slow = stepping_s_ > kSlow_s && spacing_ == options_.spacing;  // as long as there is memory for more
    if (spacing_ == 0 || since == 0 || (since < spacing_ && !slow) || stepping_s_ * options_.copying < copying_s_) return;
    const auto start = Clock::now();
    snapshot_bytes_ += snapshots_.emplace(step(), snapshot()).first->second.bytes;
    copying_s_ = secondsSince(start), stepping_s_ = 0;
}

/// Doubles the distance between snapshots until what is left is within the budget. The start stays.
void Timeline::thin() {
    while (bytes() > options_.most_bytes && snapshots_.size() > 1) {
        spacing_ *= 2;
        std::uint64_t kept = 0;
        for (auto it = std::next(snapshots_.begin()); it != snapshots_.end();) {
            const bool stays = it->first - kept >= spacing_;
            if (stays) kept = it->first, ++it;
            else snapshot_bytes_ -= it->second.bytes, it = snapshots_.erase(it);
        }
    }
}

std::uint64_t Timeline::act(Action action) {
    const std::uint64_t discarded = last() - step();
    discardFuture();
    action.step = step();
    if (!action.kind->has_scene) {
        before_statics_.reset();
    } else if (before_statics_) {
        world_ = *before_statics_;
        recording_bytes_ -= bytesOf(recording_.actions.back());
        recording_.actions.pop_back();
    } else {
        before_statics_ = world_;
    }
    action.kind->apply(world_, action);
    recording_bytes_ += bytesOf(action);
    recording_.actions.push_back(std::move(action));
    done_ = recording_.actions.size();
    return discarded;
}

void Timeline::discardFuture() {
    target_.reset(), end_.reset();
    if (atEnd()) return;
    for (std::size_t i = step(); i < recording_.steps.size(); ++i) recording_bytes_ -= bytesOf(recording_.steps[i]);
    for (std::size_t i = done_; i < recording_.actions.size(); ++i) recording_bytes_ -= bytesOf(recording_.actions[i]);
    recording_.steps.resize(step()), recording_.actions.resize(done_);
    named_from_ = std::min(named_from_, recording_.steps.size());
    for (auto it = snapshots_.upper_bound(step()); it != snapshots_.end(); it = snapshots_.erase(it)) snapshot_bytes_ -= it->second.bytes;
    if (near_ && near_->world.steps() > step()) near_.reset();
    if (divergence_ && divergence_->step > step()) divergence_.reset();
}

void Timeline::aim(std::uint64_t to) {
    to = std::min(to, last());
    target_.reset();
    if (to == step()) return;
    if (atEnd()) end_ = snapshot();
    if (to == last() && end_) return restore(*end_);
    // From here if that is nearer than any snapshot.
    if (const Snapshot& from = nearest(to); step() > to || step() < from.world.steps()) restore(from);
    if (to != step()) target_ = to;
    else if (atEnd()) doActions();
}

bool Timeline::arrive(double seconds) {
    const auto start = Clock::now();
    while (target_) {
        forward();
        if (step() >= *target_) target_.reset();
        if (secondsSince(start) >= seconds) break;
    }
    return !target_;
}

std::optional<Divergence> replay(Recording recording, const std::function<void(const Timeline&)>& watch) {
    Timeline timeline(std::move(recording), {.spacing = 0});
    while (!timeline.atEnd() && !timeline.divergence()) {
        timeline.advance();
        if (watch) watch(timeline);
    }
    return timeline.divergence();
}

}  // namespace mb
