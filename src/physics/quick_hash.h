#pragma once
// A hash for telling bodies apart at every step: a word at a time, so that it costs a tenth of StateHash's bytes.
#include "physics/hash.h"

namespace mb {

/// Takes what StateHash takes. Each word is mixed in by one multiplication; the odd factor is 2⁶⁴ over the golden ratio
/// (Knuth, "The Art of Computer Programming", vol. 3, 6.4).
class QuickHash {
public:
    void add(std::uint64_t x) {
        value_ = (value_ ^ x) * 0x9e3779b97f4a7c15u;
        value_ ^= value_ >> 32;
    }
    void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
    void add(const glm::dvec3& v) { add(v.x), add(v.y), add(v.z); }
    void add(const glm::dquat& q) { add(q.w), add(q.x), add(q.y), add(q.z); }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0x9e3779b97f4a7c15u;
};

}  // namespace mb
