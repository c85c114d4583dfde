#include "physics/crowd.h"

#include "core/effects/effect.h"

#include <array>
#include <bit>

namespace mb {
namespace {

struct LaneEnds {
    LaneVec velocity, spin;
};

template <bool drags> MB_INLINE void load(const LaneMotion* motion, const std::array<int, kLanes>& of, LaneEnds& out) {
    const LaneMotion &a = motion[of[0]], &b = motion[of[1]], &c = motion[of[2]], &d = motion[of[3]];
    out.velocity = transposed(a.velocity, b.velocity, c.velocity, d.velocity);
    if constexpr (drags) out.spin = transposed(a.spin, b.spin, c.spin, d.spin);
}
template <bool drags> MB_INLINE void store(LaneMotion* out_motion, const std::array<int, kLanes>& of, const LaneEnds& ends) {
    LaneMotion &a = out_motion[of[0]], &b = out_motion[of[1]], &c = out_motion[of[2]], &d = out_motion[of[3]];
    transposeBack(ends.velocity, a.velocity, b.velocity, c.velocity, d.velocity);
    if constexpr (drags) transposeBack(ends.spin, a.spin, b.spin, c.spin, d.spin);
}

template <bool drags> MB_INLINE int roundsOf(std::vector<Crowd::Batch>& io_batches, LaneMotion* io_motion, int rounds) {
    using Batch = Crowd::Batch;
    LaneEnds a, b;
    for (const Batch& batch : io_batches) {
        load<drags>(io_motion, batch.a, a), load<drags>(io_motion, batch.b, b);
        applyFirst<drags>(batch.row, a, b);
        store<drags>(io_motion, batch.a, a), store<drags>(io_motion, batch.b, b);
    }
    Pace pace(rounds);
    for (;;) {
        Change<Lanes> changed;
        for (Batch& batch : io_batches) {
            load<drags>(io_motion, batch.a, a), load<drags>(io_motion, batch.b, b);
            turn<drags>(batch.row, a, b, LaneVec{}, changed);
            store<drags>(io_motion, batch.a, a), store<drags>(io_motion, batch.b, b);
        }
        if (!pace.more(changed)) return pace.made();
        for (Batch& batch : io_batches) {
            load<drags>(io_motion, batch.a, a), load<drags>(io_motion, batch.b, b);
            goOn<drags>(batch.row, a, b, pace.share());
            store<drags>(io_motion, batch.a, a), store<drags>(io_motion, batch.b, b);
        }
    }
}

using Rounds = int (*)(std::vector<Crowd::Batch>&, LaneMotion*, int);
template <bool drags> int plainRounds(std::vector<Crowd::Batch>& io_batches, LaneMotion* io_motion, int rounds) {
    return roundsOf<drags>(io_batches, io_motion, rounds);
}
#if defined(__x86_64__)
template <bool drags>
[[gnu::target("avx2")]] int wideRounds(std::vector<Crowd::Batch>& io_batches, LaneMotion* io_motion, int rounds) {
    return roundsOf<drags>(io_batches, io_motion, rounds);
}
#endif

/// The same text compiled twice; both do the same to the bit.
template <bool drags> Rounds fastestRounds() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return wideRounds<drags>;
#endif
    return plainRounds<drags>;
}

}  // namespace

void Crowd::set(std::span<const Body> bodies, std::span<const Contact> contacts, std::span<const std::uint32_t> numbers, Stages stages,
                std::vector<std::uint64_t>& io_used) {
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
    for (const std::uint32_t number : numbers)
        for (const int i : {contacts[number].a, contacts[number].b})
            if (i != kStatic) io_used[static_cast<std::size_t>(i)] = 0;
    // Where each colour's batches begin, and how many lanes of its last are taken.
    std::array<std::uint32_t, kColours> lane{};
    std::uint32_t batches = 0;
    for (std::size_t k = 0; k < kColours; ++k) {
        const std::uint32_t count = begin[k + 1], each = k + 1 < kColours ? kLanes : 1;
        lane[k] = kLanes * batches;
        batches += (count + each - 1) / each;
    }
    batches_.resize(batches);
    for (Batch& batch : batches_) batch.contact.fill(kNone);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t colour = colours_[i];
        batches_[lane[colour] / kLanes].contact[lane[colour] % kLanes] = numbers[i];
        lane[colour] += colour + 1 < kColours ? 1 : kLanes;
    }
    for (Batch& batch : batches_) fill(batch, bodies, contacts, stages.has(Stage::spin));
}

/// Sets what a batch knows of its contacts' bodies. Where there is no contact, nothing is moved by anything.
void Crowd::fill(Batch& io_batch, std::span<const Body> bodies, std::span<const Contact> contacts, bool spins) {
    const int still = static_cast<int>(bodies.size());
    auto& row = io_batch.row;
    for (int l = 0; l < kLanes; ++l) {
        const auto k = static_cast<std::size_t>(l);
        if (io_batch.contact[k] == kNone) {
            io_batch.a[k] = io_batch.b[k] = still;
            setLane(row.normal, l, glm::dvec3{0}), setLane(row.drag, l, glm::dvec3{0});
            row.inverse_a[l] = row.inverse_b[l] = row.radius_a[l] = row.radius_b[l] = row.turn_a[l] = row.turn_b[l] = 0;
            row.normal_mass[l] = row.tangent_mass[l] = 1;
            row.friction[l] = row.target[l] = row.push[l] = 0;
            continue;
        }
        const Contact& c = contacts[io_batch.contact[k]];
        const BallNumbers of(bodies, c);
        io_batch.a[k] = c.a, io_batch.b[k] = c.b == kStatic ? still : c.b;
        setLane(row.normal, l, c.normal);
        row.inverse_a[l] = of.inverse_a, row.inverse_b[l] = of.inverse_b, row.normal_mass[l] = of.normalMass();
        row.radius_a[l] = spins ? of.radius_a : 0, row.radius_b[l] = spins ? of.radius_b : 0;
        row.turn_a[l] = spins ? of.turn_a : 0, row.turn_b[l] = spins ? of.turn_b : 0;
        row.tangent_mass[l] = of.tangentMass(spins), row.friction[l] = c.pairing.friction;
    }
}

void Crowd::aim(std::span<const Contact> contacts) {
    for (Batch& batch : batches_) {
        auto& row = batch.row;
        row.step = row.way = Lanes{}, row.drag_step = row.drag_way = LaneVec{};
        for (int l = 0; l < kLanes; ++l) {
            const std::uint32_t number = batch.contact[static_cast<std::size_t>(l)];
            if (number == kNone) continue;
            const Contact& c = contacts[number];
            row.target[l] = c.target, row.push[l] = c.push;
            setLane(row.drag, l, c.drag);
        }
    }
}

int Crowd::solve(std::span<LaneMotion> motion, int rounds, bool drags) {
    static const Rounds kSmooth = fastestRounds<false>(), kRough = fastestRounds<true>();
    return (drags ? kRough : kSmooth)(batches_, motion.data(), rounds);
}

void Crowd::finish(std::span<Contact> contacts) const {
    for (const Batch& batch : batches_)
        for (int l = 0; l < kLanes; ++l) {
            const std::uint32_t number = batch.contact[static_cast<std::size_t>(l)];
            if (number == kNone) continue;
            contacts[number].push = batch.row.push[l] + 0.0, contacts[number].drag = laneOf(batch.row.drag, l) + 0.0;  // of −0: 0
        }
}

}  // namespace mb
