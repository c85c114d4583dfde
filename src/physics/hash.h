#pragma once
// A number that is equal for two states if they are equal to the bit, and else, but for chance, is not.
#include <bit>
#include <cstdint>

#include <glm/gtc/quaternion.hpp>

namespace mb {

/// Takes what a state is made of, in words that Mix stirs in one after the other: Mix::kStart is the hash of nothing.
template <class Mix> class WordHash {
public:
    void add(std::uint64_t x) { value_ = Mix::stir(value_, x); }
    void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
    void add(const glm::dvec3& v) { add(v.x), add(v.y), add(v.z); }
    void add(const glm::dquat& q) { add(q.w), add(q.x), add(q.y), add(q.z); }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = Mix::kStart;
};

/// FNV-1a, 64 bits. Source: Fowler, Noll, Vo, Eastlake, "The FNV Non-Cryptographic Hash Algorithm" (2012 draft).
struct ByteMix {
    static constexpr std::uint64_t kStart = 0xcbf29ce484222325u;
    static std::uint64_t stir(std::uint64_t value, std::uint64_t x) {
        for (int byte = 0; byte < 8; ++byte, x >>= 8) value = (value ^ (x & 0xff)) * 0x100000001b3u;
        return value;
    }
};
using StateHash = WordHash<ByteMix>;

/// A word at a time, so that it costs a tenth of that: for telling bodies apart at every step. The odd factor is 2⁶⁴ over the golden
/// ratio (Knuth, "The Art of Computer Programming", vol. 3, 6.4).
struct WordMix {
    static constexpr std::uint64_t kStart = 0x9e3779b97f4a7c15u;
    static std::uint64_t stir(std::uint64_t value, std::uint64_t x) {
        value = (value ^ x) * kStart;
        return value ^ (value >> 32);
    }
};
using QuickHash = WordHash<WordMix>;

}  // namespace mb
