// Balls that lie on one another: a crowd. How exact the path of one of them is matters less than that all keep apart, for one
// pass over the contacts a part.
//
// The velocities at the end of the part are those the balls move with through it (the semi-implicit Euler rule), so that no
// contact comes nearer than its gap is. What overlaps gets a velocity apart; when all are moved the rounds go on without it, so
// that it leaves none behind (the soft step and its relaxation: Catto, "Solver2D", 2024).
#include "core/effects/effect.h"
#include "physics/rows.h"
#include "physics/world.h"

namespace mb {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// How fast the contact may close, or shall open: its gap within the part, or the share of its overlap that is undone.
double biasOf(const Contact& c, double slop, double push_out, double h) {
    if (c.gap >= 0) return -c.gap / h;
    return std::min(kPushOutSpeed, push_out * std::max(-c.gap - slop, 0.0) / h);
}

template <bool spins, bool drags> class Crowd {
public:
    /// Of one island.
    Crowd(std::span<const Body> bodies, std::span<Contact> contacts, std::span<Motion> io_motion, StepCounts& io_counts)
        : contacts_(contacts), counts_(io_counts) {
        rows_.reserve(contacts.size());
        for (Contact& c : contacts) applyFirst<drags>(rows_.emplace_back(bodies, c, io_motion[at(c.a)], c.b == kStatic ? still_ : io_motion[at(c.b)]));
    }
    Crowd(const Crowd&) = delete;
    Crowd& operator=(const Crowd&) = delete;

    void solve(int rounds) {
        for (int round = 0; round < rounds; ++round) {
            double changed = 0;
            for (auto& row : rows_) changed = std::max(changed, turn<drags>(row, counts_.drags));
            ++counts_.rounds;
            if (changed <= kSettled) break;
        }
        for (const auto& row : rows_) row.finish();
    }
    /// Targets for when all have moved by h at their present velocities: what is then in touch does not approach.
    void relax(double h) {
        for (auto& row : rows_) row.target = std::min(-(row.contact->gap + h * row.approach()) / h, 0.0);
    }

private:
    std::span<Contact> contacts_;
    StepCounts& counts_;
    Motion still_;
    std::vector<BallRow<spins>> rows_;
};

}  // namespace

template <bool spins, bool drags>
void PhysicsWorld::settleCrowd(std::span<Contact> contacts, double h, std::span<Motion> io_motion, std::span<Motion> io_moving) {
    bool overlaps = false;
    for (Contact& c : contacts) {
        c.target = biasOf(c, 0.5 * depthOf(c), knobs_.push_out, h);
        overlaps = overlaps || c.target > 0;
    }
    const int rounds = knobs_.iterations, last = overlaps ? std::max(rounds / 4, 1) : 0;
    Crowd<spins, drags> crowd(bodies_, contacts, io_motion, counts_);
    crowd.solve(std::max(rounds - last, 1));
    for (const Contact& c : contacts)
        for (const int i : {c.a, c.b})
            if (i != kStatic) io_moving[at(i)] = io_motion[at(i)];
    if (!overlaps) return;
    crowd.relax(h);
    crowd.solve(last);
}

/// A ball that nothing pushes keeps falling, which is exact; the others move at the velocities found, without acceleration.
void PhysicsWorld::settleCrowds(std::span<Contact> contacts, double h, std::span<Motion> io_accelerations) {
    if (contacts.empty()) return;
    takeKept(contacts);
    std::vector<Motion> motion(bodies_.size()), moving(bodies_.size());
    for (const Contact& c : contacts)
        for (const int i : {c.a, c.b})
            if (i != kStatic) motion[at(i)] = {bodies_[at(i)].velocity + glm::dvec3{0, -world_.gravity * h, 0}, bodies_[at(i)].spin};
    const bool spins = has(Stage::spin), drags = has(Stage::friction);
    const auto settle = spins ? (drags ? &PhysicsWorld::settleCrowd<true, true> : &PhysicsWorld::settleCrowd<true, false>)
                              : (drags ? &PhysicsWorld::settleCrowd<false, true> : &PhysicsWorld::settleCrowd<false, false>);
    for (std::size_t begin = 0, end = 0; begin < contacts.size(); begin = end) {
        while (end < contacts.size() && contacts[end].island == contacts[begin].island) ++end;
        (this->*settle)(contacts.subspan(begin, end - begin), h, motion, moving);
    }
    std::vector<char> pushed(bodies_.size(), 0);
    for (const Contact& c : contacts) {
        if (c.push == 0) continue;
        pushed[at(c.a)] = 1;
        if (c.b != kStatic) pushed[at(c.b)] = 1;
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (!pushed[i]) continue;
        Body& b = bodies_[i];
        const glm::dvec3 way = h * (moving[i].velocity - motion[i].velocity);
        const double length = glm::length(way), most = std::min(kPushOutSpeed * h, 0.25 * b.inner);
        if (length > 0) b.position += (length > most ? most / length : 1.0) * way;
        b.velocity = motion[i].velocity, b.spin = motion[i].spin;
        io_accelerations[i] = {};
    }
}

}  // namespace mb
