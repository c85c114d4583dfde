#pragma once
// A number that is equal for two states if they are equal to the bit, and else, but for chance, is not.
#include <bit>
#include <cstdint>

#include <glm/gtc/quaternion.hpp>

namespace mb {

/// FNV-1a, 64 bits. Source: Fowler, Noll, Vo, Eastlake, "The FNV Non-Cryptographic Hash Algorithm" (2012 draft).
class StateHash {
public:
    void add(std::uint64_t x) {
        for (int byte = 0; byte < 8; ++byte, x >>= 8) value_ = (value_ ^ (x & 0xff)) * 0x100000001b3u;
    }
    void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
    void add(const glm::dvec3& v) { add(v.x), add(v.y), add(v.z); }
    void add(const glm::dquat& q) { add(q.w), add(q.x), add(q.y), add(q.z); }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace mb
