#include "physics/collide.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace mb {
namespace {
/// Of a contact with what does not move: less is undone by any way.
bool isDeep(const Contact& c, const Body& body) { return c.gap < -0.02 * body.inner; }

constexpr double kOneInAnother = 0.1;  // of half the thinner thickness: shapes whose middles are so near are parted without a look at their surfaces
constexpr double kFollowed = 0.01;  // of half the thinner thickness: how far shapes may move against one another and keep their points
}

void Collider::withStatics(int i, const Body& body, const Pose& pose, double margin, NearStatics& io_near, std::vector<Contact>& io_contacts) const {
    const std::size_t before = io_contacts.size();
    if (body.isBall()) {
        io_near.moveTo(field_, pose.position, body.radius, counts_);
        for (const Touch& touch : io_near.touches())
            if (touch.gap <= margin) addBallContact(i, body, touch.normal, touch.gap, pairing(world_, body), io_contacts);
    } else if (!field_.empty()) {
        const auto find = [&](double within, std::uint64_t& io_evaluations) {
            std::vector<Placed> others;
            field_.eachNear(pose.position, body.radius + within, [&](std::size_t s) {
                const Solid& solid = field_.solid(s);
                if (distanceTo(solid.box, pose.position) <= body.radius + within) others.push_back({&solid, {}, static_cast<std::uint32_t>(s)});
            });
            ++counts_.static_queries;
            return others.empty() ? Manifold{{}, within} : manifold({body.solid.get(), pose, 0}, others, within, io_evaluations);
        };
        addPoints(i, body, pose, kStatic, nullptr, {}, margin, find, io_contacts);
        const auto found = std::span(io_contacts).subspan(before);
        if (std::ranges::any_of(found, [&](const Contact& c) { return isDeep(c, body); })) leaveBlocked(i, body, pose, before, io_contacts);
        else leaveBuried(i, body, pose, io_contacts);  // it may lie on a floor, in a box that stands there
    }
    counts_.static_contacts += io_contacts.size() - before;
}

void Collider::betweenBalls(int i, const Body& a, int j, const Body& b, const Pairing& pairing, double margin,
                            std::vector<Contact>& io_contacts) const {
    ++counts_.body_gaps;
    const glm::dvec3 apart = a.position - b.position;
    const double reach = std::max(a.radius + b.radius + margin, 0.0) * (1 + 1e-12);
    if (glm::dot(apart, apart) > reach * reach) return;
    addBallContact(i, a, j, b, pairing, io_contacts);
    if (io_contacts.back().gap > margin) io_contacts.pop_back();
    else ++counts_.body_contacts;
}

void Collider::between(int i, const Body& a, const Pose& pose_a, int j, const Body& b, const Pose& pose_b, double margin,
                       std::vector<Contact>& io_contacts) const {
    if (a.isBall() && b.isBall()) return betweenBalls(i, a, j, b, pairing(world_, a, b), margin, io_contacts);
    const std::size_t before = io_contacts.size();
    ++counts_.body_gaps;
    if (a.isBall()) {
        ballWithShape(i, a, pose_a, j, b, pose_b, margin, io_contacts);
    } else if (b.isBall()) {
        ballWithShape(j, b, pose_b, i, a, pose_a, margin, io_contacts);
    } else if (glm::length(pose_a.position - pose_b.position) > kOneInAnother * std::min(a.inner, b.inner) ||
               !part(i, a, pose_a, j, b, pose_b, io_contacts)) {
        const auto find = [&](double within, std::uint64_t& io_evaluations) {
            const Placed other{b.solid.get(), pose_b, 0};
            return manifold({a.solid.get(), pose_a, 0}, {&other, 1}, within, io_evaluations);
        };
        addPoints(i, a, pose_a, j, &b, pose_b, margin, find, io_contacts);
        if (io_contacts.size() == before) part(i, a, pose_a, j, b, pose_b, io_contacts);
    }
    counts_.body_contacts += io_contacts.size() - before;
}

void Collider::ballWithShape(int i, const Body& ball, const Pose& at, int j, const Body& shape, const Pose& pose, double margin,
                             std::vector<Contact>& io_contacts) const {
    std::vector<Touch> touches;
    std::uint64_t evaluations = 0;
    addTouches(*shape.solid, {pose.fromWorld(at.position), ball.radius}, margin, touches, evaluations);
    keepUnhidden(touches, ball.radius);
    field_.countEvaluations(evaluations);
    for (const Touch& touch : touches) {
        if (touch.gap > margin) continue;
        Contact& c = addBallContact(i, ball, pose.rotation * touch.normal, touch.gap, pairing(world_, ball, shape), io_contacts);
        c.b = j, c.arm_b = pose.rotation * touch.point, c.depth = std::min(c.depth, restDepth(shape.inner));
    }
}

/// Whether a place is in the body, when that is so placed. (A ring's middle is not in the ring.)
bool Collider::holds(const Body& body, const Pose& pose, glm::dvec3 place) const {
    field_.countEvaluations(1);
    return body.solid->at(pose.fromWorld(place)) < 0;
}

/// Two shapes so deep in one another that no surface faces the other's are parted along the line of their centres, if one of these or the
/// middle between them is in both. Says whether they are.
bool Collider::part(int i, const Body& a, const Pose& pose_a, int j, const Body& b, const Pose& pose_b, std::vector<Contact>& io_contacts) const {
    const double deep = a.inner + b.inner - glm::length(pose_a.position - pose_b.position);
    if (!(deep > 0)) return false;
    const auto in_both = [&](glm::dvec3 place) { return holds(a, pose_a, place) && holds(b, pose_b, place); };
    if (!in_both(0.5 * (pose_a.position + pose_b.position)) && !in_both(pose_a.position) && !in_both(pose_b.position)) return false;
    Contact c;
    c.a = i, c.b = j, c.normal = directionApart(a, b), c.gap = -deep, c.depth = restDepth(std::min(a.inner, b.inner)), c.way_out = true;
    c.arm_b = pose_a.position - pose_b.position;
    io_contacts.push_back(c);
    return true;
}

/// A shape whose middle is in what does not move, where no surface that faces its own says so, is parted along the field's slope
/// there, or if that leads into another solid, the shortest way.
void Collider::leaveBuried(int i, const Body& body, const Pose& pose, std::vector<Contact>& io_contacts) const {
    if (!field_.contains(pose.position) || !holds(body, pose, pose.position)) return;
    Slope deepest;
    field_.eachNear(pose.position, body.radius, [&](std::size_t s) {
        const Solid& solid = field_.solid(s);
        if (distanceTo(solid.box, pose.position) > 0) return;
        field_.countEvaluations(1);
        if (const Slope slope = solid.slopeAt(pose.position); slope.distance < deepest.distance) deepest = slope;
    });
    WayOut way{wayOutAlong(deepest), -deepest.distance};
    if (!isSloping(deepest) || field_.isBlocked(pose.position + way.length * way.direction, way.direction, body.inner))
        way = field_.wayOut(pose.position, body.inner).value_or(way);
    addWayOut(i, body, {}, way, io_contacts);
}

void Collider::addWayOut(int i, const Body& body, glm::dvec3 arm, const WayOut& way, std::vector<Contact>& io_contacts) const {
    Contact& c = io_contacts.emplace_back();
    c.a = i, c.normal = way.direction, c.gap = -way.length - body.inner, c.arm_a = arm;
    c.depth = restDepth(body.inner), c.way_out = true;
}

/// Of the contacts from `first` on leaves out those deep in one solid whose way out is into another, and adds the way out of both.
void Collider::leaveBlocked(int i, const Body& body, const Pose& pose, std::size_t first, std::vector<Contact>& io_contacts) const {
    double deepest = 0;
    glm::dvec3 from{0};
    const std::size_t before = io_contacts.size();
    io_contacts.erase(std::remove_if(io_contacts.begin() + static_cast<std::ptrdiff_t>(first), io_contacts.end(), [&](const Contact& c) {
        if (!isDeep(c, body)) return false;
        const glm::dvec3 at = pose.position + c.arm_a;
        if (!field_.isBlocked(at - c.gap * c.normal, c.normal, body.inner)) return false;
        if (c.gap < deepest) deepest = c.gap, from = c.arm_a;
        return true;
    }), io_contacts.end());
    if (io_contacts.size() == before) return;
    if (field_.contains(pose.position)) from = {};
    if (const auto way = field_.wayOut(pose.position + from, body.inner)) addWayOut(i, body, from, *way, io_contacts);
}

template <class Find>
void Collider::addPoints(int i, const Body& a, const Pose& pose_a, int j, const Body* b, const Pose& pose_b, double margin, Find find,
                         std::vector<Contact>& io_contacts) const {
    const Pairing pair = b ? pairing(world_, a, *b) : pairing(world_, a);
    // The circle of a ball as thick as the thinner one that has sunk in by the depth of rest.
    const double inner = b ? std::min(a.inner, b->inner) : a.inner, depth = restDepth(inner), patch = std::sqrt(2 * inner * depth);
    const auto add = [&](const ManifoldPoint& p) {
        if (p.gap > margin) return;
        Contact c;
        c.a = i, c.b = j, c.normal = p.normal, c.gap = p.gap, c.depth = depth, c.feature = p.feature, c.pairing = pair, c.patch = patch;
        c.arm_a = p.point - pose_a.position;
        if (b) c.arm_b = p.point - pose_b.position;
        io_contacts.push_back(c);
    };
    std::uint64_t evaluations = 0;
    if (!memory_) {
        for (const ManifoldPoint& p : find(margin, evaluations).points) add(p);
    } else {
        // What is looked for within the margin and a little more holds until it has moved by that little.
        const std::uint32_t id_a = a.object.value, id_b = b ? b->object.value : 0;
        const double slack = kFollowed * inner;
        const ManifoldMemory::Entry* entry = memory_->follow(id_a, id_b, pose_a, pose_b, a.radius, margin);
        if (!entry) {
            const Manifold found = find(margin + slack, evaluations);
            entry = &memory_->remember(id_a, id_b, pose_a, pose_b, slack, found);
        }
        for (const FollowedPoint& p : entry->points) add(pointOf(p, pose_a, pose_b));
    }
    field_.countEvaluations(evaluations);
}

}  // namespace mb
