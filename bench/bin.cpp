#include "bench/bin.h"

#include "bench/bullet.h"
#include "bench/ode.h"
#include "physics/random.h"
#include "physics/world.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mb::bench {
namespace {

constexpr BinEngine kEngines[] = {
    {"marchbox", "", marchboxBin, ""},
#ifdef MARCHBOX_BULLET
    {"bullet", "libbullet-dev", bulletBin, MARCHBOX_BULLET},
#else
    {"bullet", "libbullet-dev", nullptr, ""},
#endif
#ifdef MARCHBOX_ODE
    {"ode", "libode-dev", odeBin, MARCHBOX_ODE},
#else
    {"ode", "libode-dev", nullptr, ""},
#endif
};

/// A multiple of 2⁻¹² m: less than a quarter of a millimetre off, and a float's as well as a double's.
double coarse(double x) { return std::floor(x * 4096 + 0.5) / 4096; }

class MarchboxBin : public BinPeer {
public:
    explicit MarchboxBin(const SphereBin& bin) : scene_(sceneOf(bin)), world_(scene_) { world_.setThreads(1); }
    void step() override { world_.step(); }
    std::vector<glm::dvec3> positions() const override {
        constexpr double kGone = std::numeric_limits<double>::quiet_NaN();
        std::vector<glm::dvec3> all;
        auto body = world_.bodies().begin();
        for (const Object& o : scene_.objects) {
            if (!o.isBody()) continue;
            const bool there = body != world_.bodies().end() && body->object == o.id;
            all.push_back(there ? (body++)->position : glm::dvec3{kGone});
        }
        return all;
    }

private:
    static Scene sceneOf(const SphereBin& bin) {
        Scene s;
        s.world.gravity = SphereBin::kGravity, s.world.friction = SphereBin::kFriction, s.world.restitution = SphereBin::kRestitution;
        s.world.bounds = 1e4;
        s.physics.dt = SphereBin::kStep, s.physics.substeps = 1, s.physics.iterations = 3, s.physics.push_out = 0.8, s.physics.sleep_speed = 0;
        const auto add = [&](std::string_view type, glm::dvec3 at) -> Object& {
            Object& o = s.objects.emplace_back();
            o.id = s.newId(), o.type = findShapeType(type), o.pos = at;
            return o;
        };
        for (const SphereBin::Wall& wall : bin.walls()) {
            const glm::dvec3 size = 2.0 * wall.half;
            add("box", wall.centre).numbers = {size.x, size.y, size.z, 0};
        }
        for (const glm::dvec3& at : bin.balls) {
            Object& o = add("sphere", at);
            o.numbers = {SphereBin::kRadius}, o.mass = SphereBin::kMass;
        }
        return s;
    }

    Scene scene_;
    PhysicsWorld world_;
};

}  // namespace

std::span<const BinEngine> binEngines() { return kEngines; }

std::unique_ptr<BinPeer> marchboxBin(const SphereBin& bin) { return std::make_unique<MarchboxBin>(bin); }

std::array<SphereBin::Wall, 5> SphereBin::walls() const {
    constexpr double kHalf = 1;  // of the walls' thickness
    const double out = inner / 2 + kHalf, half = inner / 2 + 2 * kHalf, up = height / 2;
    return {{{{0, -kHalf, 0}, {half, kHalf, half}},
             {{-out, up, 0}, {kHalf, up, half}},
             {{out, up, 0}, {kHalf, up, half}},
             {{0, up, -out}, {half, up, kHalf}},
             {{0, up, out}, {half, up, kHalf}}}};
}

SphereBin makeBin(int balls, std::uint64_t seed) {
    constexpr double kApart = 1.1, kJitter = 0.04;
    int edge = 1;
    while (edge * edge * edge < balls) ++edge;
    SphereBin bin;
    bin.inner = 1.25 * edge, bin.height = kApart * edge + 5;
    const int row = 1 + static_cast<int>((bin.inner - 2 * (SphereBin::kRadius + kJitter)) / kApart);
    Random random(seed);
    for (int i = 0; i < balls; ++i) {
        const glm::dvec3 cell{i % row - 0.5 * (row - 1), i / row / row, i / row % row - 0.5 * (row - 1)};
        glm::dvec3 at = kApart * cell + glm::dvec3{0, 1, 0};
        for (int axis = 0; axis < 3; ++axis) at[axis] = coarse(at[axis] + random.in(-kJitter, kJitter));
        bin.balls.push_back(at);
    }
    return bin;
}

Overlaps overlapsOf(const SphereBin& bin, std::span<const glm::dvec3> balls) {
    constexpr double kTwo = 2 * SphereBin::kRadius;
    const double side = bin.inner / 2;
    Overlaps found;
    double sum = 0;
    const auto overlap = [&](double depth) {
        if (depth <= 0) return;
        ++found.count, sum += depth, found.largest = std::max(found.largest, depth);
    };
    std::vector<glm::dvec3> inside;
    for (const glm::dvec3& p : balls) {
        const bool in = std::fabs(p.x) <= side && std::fabs(p.z) <= side && p.y >= 0 && p.y <= bin.height;  // false of NaN
        if (in) inside.push_back(p);
        else ++found.outside;
    }
    std::ranges::sort(inside, {}, &glm::dvec3::x);
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const glm::dvec3 p = inside[i];
        for (const double gap : {p.y, side - p.x, side + p.x, side - p.z, side + p.z}) overlap(SphereBin::kRadius - gap);
        for (std::size_t k = i + 1; k < inside.size() && inside[k].x - p.x < kTwo; ++k) overlap(kTwo - glm::length(inside[k] - p));
    }
    if (found.count > 0) found.mean = sum / found.count;
    return found;
}

}  // namespace mb::bench
