#pragma once
// Random draws for the tests of laws: the same on every machine for one seed. TEST_SEED chooses another seed, TEST_COUNT
// multiplies how often each law is tried.
#include "core/sdf/shape.h"

#include <cstdint>
#include <cstdlib>
#include <optional>

namespace mb {

inline std::uint64_t environmentNumber(const char* name, std::uint64_t otherwise) {
    const char* text = std::getenv(name);
    return text ? std::strtoull(text, nullptr, 10) : otherwise;
}
inline std::uint64_t testSeed() { return environmentNumber("TEST_SEED", 1); }
inline int times(int usual) { return usual * static_cast<int>(environmentNumber("TEST_COUNT", 1)); }

/// A stream of draws of its own for each name (FNV-1a), so that a new row leaves the others' draws alone.
constexpr std::uint64_t streamOf(std::string_view name) {
    std::uint64_t hash = 0xCBF29CE484222325u;
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
    return hash;
}

/// SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", 2014): the standard library's
/// distributions differ from one library to the next.
class Draw {
public:
    explicit Draw(std::uint64_t stream = 0) : state_(testSeed() * 0x9E3779B97F4A7C15u + stream) {}

    std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    double uniform(double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(bits() >> 11) * 0x1p-53); }
    double logUniform(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }
    int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
    bool oneIn(int n) { return below(n) == 0; }
    /// A member of [lo, hi]; an end two times in three, the hardest choice for a bound.
    double member(double lo, double hi) {
        const int choice = below(3);
        return choice == 0 ? lo : choice == 1 ? hi : std::min(std::max(uniform(lo, hi), lo), hi);
    }

private:
    std::uint64_t state_;
};

/// A type's numbers, as a file would hold them, for a shape of about this size: lengths within a factor of `ratio` of it.
inline Numbers drawNumbers(Draw& draw, const ShapeType& type, double size, double ratio) {
    Numbers numbers{};
    unsigned at = 0;
    for (const Parameter& p : type.parameters) {
        for (int i = 0; i < p.size; ++i, ++at) {
            double x = p.isLength() ? draw.logUniform(size / ratio, size * ratio) : draw.uniform(p.slider_lo, p.slider_hi);
            if (p.lo < 0 && draw.oneIn(2)) x = -x;
            if (p.lo <= 0 && draw.oneIn(4)) x = 0;
            if (p.kind == Parameter::Kind::whole) x = std::round(x);
            if (p.kind == Parameter::Kind::word) x = draw.below(static_cast<int>(p.words.size()));
            numbers[at] = std::clamp(x, p.lo, p.hi);
        }
    }
    return numbers;
}

/// The same cooked, or nothing where the row cannot be given such numbers (a plane whose normal is 0).
inline std::optional<LeafNumbers> cooked(const Primitive& row, const Numbers& numbers, double scale = 1) {
    LeafNumbers k{};
    unsigned at = 0;
    for (const Parameter& p : row.parameters)
        for (int i = 0; i < p.size; ++i, ++at) k[at] = numbers[at] * (p.isLength() ? scale : 1);
    if (row.cook) row.cook(k);
    for (const double x : k)
        if (!std::isfinite(x)) return std::nullopt;
    return k;
}

}  // namespace mb
