#pragma once
// A bin that balls fall into, for any engine: the same balls at the same places, the same walls, and one measure of how far
// they end up inside one another.
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace mb::bench {

/// Balls of one size above the middle of a box without a lid. Metres, seconds, kilograms; y is up.
struct SphereBin {
    static constexpr double kRadius = 0.5, kMass = 1, kFriction = 0.5, kRestitution = 0, kGravity = 9.81;
    static constexpr double kStep = 1.0 / 60;
    static constexpr int kSteps = 120;

    struct Wall {
        glm::dvec3 centre, half;
    };
    double inner = 0, height = 0;    // inside, from wall to wall; of the walls
    std::vector<glm::dvec3> balls;   // where each begins
    std::array<Wall, 5> walls() const;  // the floor, whose top is y = 0, and four around it
};

/// The bin is 1.25 m wide for each ball along an edge of the cube they would fill. They lie 1.1 m apart in layers from y = 1 up, as
/// many as there is room for, each moved by up to 0.04 m along each axis. A float holds every number.
SphereBin makeBin(int balls, std::uint64_t seed);

/// What each engine is asked for.
class BinPeer {
public:
    virtual ~BinPeer() = default;
    virtual void step() = 0;                                // of SphereBin::kStep
    virtual std::vector<glm::dvec3> positions() const = 0;  // of all balls, in the bin's order; NaN where one is gone
};

/// An engine, by the row of a table. Those the program was built without have no `make`.
struct BinEngine {
    std::string_view name;
    std::string_view package;        // of Debian, that it is built with
    std::unique_ptr<BinPeer> (*make)(const SphereBin&);
    std::string_view version;
};
/// marchbox, then its peers.
std::span<const BinEngine> binEngines();

std::unique_ptr<BinPeer> marchboxBin(const SphereBin& bin);

/// From positions alone: between any two balls, and any ball and a wall's inner face, that overlap.
struct Overlaps {
    double largest = 0, mean = 0;    // m; the mean of those there are
    int count = 0;
    int outside = 0;                 // balls whose centre is not in the bin; they overlap nothing
};
Overlaps overlapsOf(const SphereBin& bin, std::span<const glm::dvec3> balls);

}  // namespace mb::bench
