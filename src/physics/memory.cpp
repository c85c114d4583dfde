#include "physics/memory.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <iterator>
#include <tuple>

namespace mb {
namespace {

Pose seenFrom(const Pose& b, const Pose& a) { return {b.fromWorld(a.position), glm::transpose(b.rotation) * a.rotation}; }

bool before(const ManifoldMemory::Entry& x, const ManifoldMemory::Entry& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); }

/// What no point within the radius has moved by more than between two poses.
double movedBetween(const Pose& x, const Pose& y, double radius) {
    double turn = 0;  // the sum of squares of a matrix is no less than the square of what it stretches by
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 d = x.rotation[i] - y.rotation[i];
        turn += glm::dot(d, d);
    }
    return glm::length(x.position - y.position) + radius * std::sqrt(turn);
}

}  // namespace

void ManifoldMemory::begin() {
    last_ = std::move(now_);
    now_.clear();
}

void ManifoldMemory::end(std::span<const std::uint32_t> asleep) {
    const auto sleeps = [&](std::uint32_t object) { return object == 0 || std::ranges::binary_search(asleep, object); };
    for (Entry& e : last_)
        if (!e.taken && sleeps(e.a) && sleeps(e.b)) now_.push_back(std::move(e));
    std::ranges::sort(now_, before);  // no two are equal
}

ManifoldMemory::Entry* ManifoldMemory::lastOf(std::uint32_t a, std::uint32_t b) {
    Entry wanted;
    wanted.a = a, wanted.b = b;
    const auto found = std::lower_bound(last_.begin(), last_.end(), wanted, before);
    return found != last_.end() && found->a == a && found->b == b ? &*found : nullptr;
}

void ManifoldMemory::add(Share&& share) {
    now_.insert(now_.end(), std::make_move_iterator(share.found_.begin()), std::make_move_iterator(share.found_.end()));
}

const ManifoldMemory::Entry* ManifoldMemory::Share::follow(std::uint32_t a, std::uint32_t b, const Pose& pose_a, const Pose& pose_b, double radius,
                                                    double margin) {
    Entry* last = memory_->lastOf(a, b);
    if (!last) return nullptr;
    const double moved = movedBetween(last->found, seenFrom(pose_b, pose_a), radius);
    if (moved > last->slack || margin + moved > last->reach) return nullptr;
    found_.push_back(std::move(*last));
    last->taken = true;
    return &found_.back();
}

const ManifoldMemory::Entry& ManifoldMemory::Share::remember(std::uint32_t a, std::uint32_t b, const Pose& pose_a, const Pose& pose_b, double slack,
                                                      const Manifold& found) {
    if (Entry* last = memory_->lastOf(a, b)) last->taken = true;
    // Where there are no points, none comes before the room is used up, however far that is.
    Entry entry{a, b, seenFrom(pose_b, pose_a), found.points.empty() ? std::max(slack, found.room) : slack, found.room};
    for (const ManifoldPoint& p : found.points)
        entry.points.push_back({pose_a.fromWorld(p.point), pose_b.fromWorld(p.point - p.gap * p.normal), p.normal * pose_b.rotation, p.feature});
    found_.push_back(std::move(entry));
    return found_.back();
}

void ManifoldMemory::addTo(StateHash& io_hash) const {
    for (const Entry& e : now_) {
        io_hash.add(std::uint64_t{e.a}), io_hash.add(std::uint64_t{e.b});
        io_hash.add(e.found.position), io_hash.add(e.slack), io_hash.add(e.reach);
        for (int i = 0; i < 3; ++i) io_hash.add(e.found.rotation[i]);
        for (const FollowedPoint& p : e.points) io_hash.add(p.on_a), io_hash.add(p.on_b), io_hash.add(p.normal), io_hash.add(p.feature);
    }
}

void ManifoldMemory::forget(std::uint32_t object) {
    std::erase_if(now_, [&](const Entry& e) { return e.a == object || e.b == object; });
}

std::size_t ManifoldMemory::bytes() const {
    std::size_t sum = 0;
    for (const std::vector<Entry>* entries : {&last_, &now_})
        for (const Entry& e : *entries) sum += sizeof e + e.points.size() * sizeof e.points[0];
    return sum;
}

ManifoldPoint pointOf(const FollowedPoint& followed, const Pose& pose_a, const Pose& pose_b) {
    ManifoldPoint p;
    p.point = pose_a.toWorld(followed.on_a);
    p.normal = pose_b.rotation * followed.normal;
    p.gap = glm::dot(p.normal, p.point - pose_b.toWorld(followed.on_b));
    p.feature = followed.feature;
    return p;
}

}  // namespace mb
