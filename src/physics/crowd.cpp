#include "physics/crowd.h"

#include "core/effects/effect.h"

#include <array>
#include <bit>

namespace mb {
namespace {

using Row = BallRowOf<true, Lanes, LaneVec>;

/// Of four balls, what a batch moves: a LaneMotion each.
struct LaneEnds {
    LaneVec velocity, spin, apart;
    Lanes inverse{}, turn{}, radius{};
};
struct ApartEnds {
    LaneVec& velocity;
};

MB_INLINE LaneVec gathered(const LaneMotion* motion, const std::array<int, kLanes>& of, Lanes LaneMotion::*what, Lanes& out_number) {
    return transposed(motion[of[0]].*what, motion[of[1]].*what, motion[of[2]].*what, motion[of[3]].*what, out_number);
}
MB_INLINE void scatter(const LaneVec& v, const Lanes& number, LaneMotion* out_motion, const std::array<int, kLanes>& of, Lanes LaneMotion::*what) {
    transposeBack(v, number, out_motion[of[0]].*what, out_motion[of[1]].*what, out_motion[of[2]].*what, out_motion[of[3]].*what);
}
template <bool drags, bool parts> MB_INLINE void load(const LaneMotion* motion, const std::array<int, kLanes>& of, LaneEnds& out) {
    out.velocity = gathered(motion, of, &LaneMotion::velocity, out.inverse);
    if constexpr (drags) out.spin = gathered(motion, of, &LaneMotion::spin, out.turn);
    if constexpr (drags || parts) out.apart = gathered(motion, of, &LaneMotion::apart, out.radius);
}
template <bool drags, bool parts> MB_INLINE void store(const LaneEnds& ends, LaneMotion* out_motion, const std::array<int, kLanes>& of) {
    scatter(ends.velocity, ends.inverse, out_motion, of, &LaneMotion::velocity);
    if constexpr (drags) scatter(ends.spin, ends.turn, out_motion, of, &LaneMotion::spin);
    if constexpr (parts) scatter(ends.apart, ends.radius, out_motion, of, &LaneMotion::apart);
}

/// Does something with the row of each batch, and its two sides.
template <bool drags, bool parts, class Do> MB_INLINE void visit(std::span<Crowd::Batch> io_batches, LaneMotion* io_motion, Do what) {
    for (Crowd::Batch& batch : io_batches) {
        LaneEnds a, b;
        load<drags, parts>(io_motion, batch.a, a), load<drags, parts>(io_motion, batch.b, b);
        Row row;
        row.normal = batch.normal, row.normal_mass = batch.normal_mass, row.tangent_mass = batch.tangent_mass;
        row.friction = batch.friction, row.target = batch.target, row.push = batch.push, row.drag = batch.drag;
        row.inverse_a = a.inverse, row.inverse_b = b.inverse, row.turn_a = a.turn, row.turn_b = b.turn;
        row.radius_a = a.radius, row.radius_b = b.radius;
        what(batch, row, a, b);
        store<drags, parts>(a, io_motion, batch.a), store<drags, parts>(b, io_motion, batch.b);
    }
}

/// What bodies went on by follows from what they did in the last round, as it is linear in what the rows went on by.
template <bool drags, bool parts> MB_INLINE void goOnBodies(std::span<const int> balls, Crowd::Motions& io_motions, double share, double apart_share) {
    const auto go = [](Lanes& io_now, Lanes& io_way, Lanes& io_last, double by) MB_INLINE_CALL {
        goOn(io_now, io_way, Lanes(io_now - io_last), by);
        io_last = io_now;
    };
    for (const int i : balls) {
        LaneMotion &now = io_motions.now[i], &way = io_motions.way[i], &last = io_motions.last[i];
        go(now.velocity, way.velocity, last.velocity, share);
        if constexpr (drags) go(now.spin, way.spin, last.spin, share);
        if constexpr (parts) go(now.apart, way.apart, last.apart, apart_share);
    }
}

/// The displacements are solved for as velocities are, in the same rounds, without friction.
template <bool drags, bool parts>
MB_INLINE int roundsOf(std::span<Crowd::Batch> io_batches, std::span<const int> balls, Crowd::Motions& io_motions, int rounds) {
    using Batch = Crowd::Batch;
    LaneMotion* const motion = io_motions.now.data();
    const auto apply = [](Batch&, Row& row, LaneEnds& a, LaneEnds& b) MB_INLINE_CALL { applyFirst<drags>(row, a, b); };
    visit<drags, false>(io_batches, motion, apply);
    for (const int i : balls) io_motions.last[i] = io_motions.now[i], io_motions.way[i] = {};
    Pace pace(rounds), apart_pace(rounds);
    for (;;) {
        Change<Lanes> changed, apart_changed;
        const double share = pace.share(), apart_share = apart_pace.share();
        visit<drags, parts>(io_batches, motion, [&](Batch& batch, Row& row, LaneEnds& a, LaneEnds& b) MB_INLINE_CALL {
            goOn(row.push, batch.way, batch.step, share);
            if constexpr (drags) goOn(row.drag, batch.drag_way, batch.drag_step, share);
            const ImpulsesOf<Lanes, LaneVec> step = turn<drags>(row, a, b, LaneVec{}, changed);
            batch.push = row.push, batch.step = step.push;
            if constexpr (drags) batch.drag = row.drag, batch.drag_step = step.drag;
            if constexpr (parts) {
                goOn(batch.apart, batch.apart_way, batch.apart_step, apart_share);
                ApartEnds apart_a{a.apart}, apart_b{b.apart};
                batch.apart_step = turnPush(row, batch.apart, batch.apart_target, apart_a, apart_b, apart_changed);
            }
        });
        const bool more = pace.more(changed), more_apart = parts && apart_pace.more(apart_changed);
        if (!more && !more_apart) return pace.made();
        goOnBodies<drags, parts>(balls, io_motions, pace.share(), apart_pace.share());
    }
}

using Rounds = int (*)(std::span<Crowd::Batch>, std::span<const int>, Crowd::Motions&, int);
template <bool drags, bool parts>
int plainRounds(std::span<Crowd::Batch> io_batches, std::span<const int> balls, Crowd::Motions& io_motions, int rounds) {
    return roundsOf<drags, parts>(io_batches, balls, io_motions, rounds);
}
#if defined(__x86_64__)
template <bool drags, bool parts>
[[gnu::target("avx2")]] int wideRounds(std::span<Crowd::Batch> io_batches, std::span<const int> balls, Crowd::Motions& io_motions, int rounds) {
    return roundsOf<drags, parts>(io_batches, balls, io_motions, rounds);
}
#endif

/// The same text compiled twice; both do the same to the bit.
template <bool drags, bool parts> Rounds fastestRounds() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return wideRounds<drags, parts>;
#endif
    return plainRounds<drags, parts>;
}

}  // namespace

void Crowd::set(const Motions& motions, std::span<const Contact> contacts, std::span<const std::uint32_t> numbers,
                std::span<const double> apart, std::vector<std::uint64_t>& io_used) {
    constexpr int kColours = 64;  // the last is of those for whom there was none, each in a batch of its own
    std::array<std::uint32_t, kColours + 1> begin{};
    colours_.clear();
    for (const std::uint32_t number : numbers) {
        const Contact& c = contacts[number];
        std::uint64_t none = 0;
        std::uint64_t &a = io_used[static_cast<std::size_t>(c.a)], &b = c.b == kStatic ? none : io_used[static_cast<std::size_t>(c.b)];
        const int colour = std::min(std::countr_one(a | b), kColours - 1);
        a |= std::uint64_t{1} << colour, b |= std::uint64_t{1} << colour;
        colours_.push_back(static_cast<std::uint8_t>(colour)), ++begin[static_cast<std::size_t>(colour) + 1];
    }
    // Where each colour's batches begin, and how many lanes of its last are taken.
    std::array<std::uint32_t, kColours> lane{};
    std::uint32_t count = 0;
    for (std::size_t k = 0; k < kColours; ++k) {
        const std::uint32_t each = k + 1 < kColours ? kLanes : 1;
        lane[k] = kLanes * count;
        count += (begin[k + 1] + each - 1) / each;
    }
    count_ = count;
    if (batches_.size() < count_) batches_.resize(count_);
    for (Batch& batch : batches()) batch.contact.fill(kNone);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t colour = colours_[i];
        batches_[lane[colour] / kLanes].contact[lane[colour] % kLanes] = numbers[i];
        lane[colour] += colour + 1 < kColours ? 1 : kLanes;
    }
    for (Batch& batch : batches()) fill(batch, motions, contacts, apart);
}

/// Sets what a batch knows of its contacts and their bodies. Where there is no contact, nothing is moved by anything.
void Crowd::fill(Batch& io_batch, const Motions& motions, std::span<const Contact> contacts, std::span<const double> apart) {
    const int still = static_cast<int>(motions.way.size());
    Batch& b = io_batch;
    b.step = b.way = b.apart = b.apart_step = b.apart_way = Lanes{}, b.drag_step = b.drag_way = LaneVec{};
    for (int l = 0; l < kLanes; ++l) {
        const auto k = static_cast<std::size_t>(l);
        if (b.contact[k] == kNone) {
            b.a[k] = b.b[k] = still;
            setLane(b.normal, l, glm::dvec3{0}), setLane(b.drag, l, glm::dvec3{0});
            b.normal_mass[l] = b.tangent_mass[l] = 1;
            b.friction[l] = b.target[l] = b.push[l] = b.apart_target[l] = 0;
            continue;
        }
        const Contact& c = contacts[b.contact[k]];
        b.a[k] = c.a, b.b[k] = c.b == kStatic ? still : c.b;
        const LaneMotion &of_a = motions.now[static_cast<std::size_t>(b.a[k])], &of_b = motions.now[static_cast<std::size_t>(b.b[k])];
        const BallNumbers of{of_a.velocity[3], of_b.velocity[3], of_a.apart[3], of_b.apart[3], of_a.spin[3], of_b.spin[3]};
        b.normal_mass[l] = of.normalMass(), b.tangent_mass[l] = of.tangentMass();
        setLane(b.normal, l, c.normal), setLane(b.drag, l, c.drag);
        b.friction[l] = c.pairing.friction, b.target[l] = c.target, b.push[l] = c.push, b.apart_target[l] = apart[b.contact[k]];
    }
}

int Crowd::solve(std::span<const int> balls, Motions& io_motions, int rounds, bool drags, bool parts) {
    static const std::array<Rounds, 4> kRounds{fastestRounds<false, false>(), fastestRounds<false, true>(), fastestRounds<true, false>(),
                                               fastestRounds<true, true>()};
    return kRounds[(drags ? 2 : 0) + (parts ? 1 : 0)](batches(), balls, io_motions, rounds);
}

void Crowd::finish(std::span<Contact> contacts, std::vector<std::uint64_t>& out_marks) const {
    for (const Batch& batch : std::span(batches_).first(count_))
        for (int l = 0; l < kLanes; ++l) {
            const auto k = static_cast<std::size_t>(l);
            if (batch.contact[k] == kNone) continue;
            Contact& c = contacts[batch.contact[k]];
            c.push = batch.push[l] + 0.0, c.drag = laneOf(batch.drag, l) + 0.0;  // of −0: 0
            if (c.push == 0) continue;
            out_marks[static_cast<std::size_t>(c.a)] = 1;
            if (c.b != kStatic) out_marks[static_cast<std::size_t>(c.b)] = 1;
        }
}

}  // namespace mb
