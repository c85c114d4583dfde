#pragma once
// The scenes of the benchmarks, made from a seed. A Model is a list of parts in a vocabulary that every contender has:
// spheres, boxes and cylinders along the axes, united or subtracted. What marchbox draws, the closed-form truth
// (bench/truth.h), the seed's uniform block (bench/seed.h) and the text for POV-Ray (bench/povray.h) are all made from it.
#include "core/scene/camera.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace mb::bench {

/// A convex shape along the axes of the world.
struct Solid {
    enum class Kind { sphere, box, cylinder, plane } kind = Kind::sphere;
    glm::dvec3 centre{0};
    glm::dvec3 half{0};  // from the centre to the faces; a cylinder stands upright; a plane is solid below its centre
};

/// A solid, or an operator on parts.
struct Part {
    enum class Op { solid, unite, subtract } op = Op::solid;
    Solid solid{};
    double blend = 0;         // m, of an operator
    int material = 0;         // of kMaterials; children have their operator's
    std::vector<Part> parts{};  // of an operator: subtract takes all others from the first
};

struct Model {
    std::string_view family;
    int n = 0;                // primitives, a ground plane not counted
    std::vector<Part> objects;
    Camera camera;
    double far = 4;           // m: no ray is followed further
    bool blends = false;      // then there is no closed form
};

struct Finish {
    glm::dvec3 color;
};
/// The materials, in turn: they differ in colour alone.
std::span<const Finish> materials();
inline constexpr double kAmbient = 0.1, kDiffuse = 0.7, kSpecular = 0.4, kShininess = 32, kReflected = 0.3;
/// The one light: far enough to be nearly parallel, and at one point, so that every contender shadows alike.
glm::dvec3 lightPosition(const Model& model);

/// The linear congruential generator of the scenes (constants of Press et al., "Numerical Recipes", 1992): the same numbers
/// everywhere, which std::distribution does not promise.
class Lcg {
public:
    explicit Lcg(std::uint32_t seed) : state_(seed) {}
    double operator()() {  // in [0, 1), a multiple of 2^-24
        state_ = state_ * 1664525u + 1013904223u;
        return (state_ >> 8) / 16777216.0;
    }

private:
    std::uint32_t state_;
};
inline constexpr std::uint32_t kSeed = 12345;  // the one whose check values the tests hold

/// One row a family: its name, what it is, and how n primitives of it are made.
struct Family {
    std::string_view name, what;
    Model (*make)(int n, std::uint32_t seed);
};
std::span<const Family> families();
/// The model of that family, which must be one of the rows.
Model makeModel(std::string_view family, int n, std::uint32_t seed);

/// What marchbox draws, with this many reflections.
Scene sceneOf(const Model& model, int reflections = 1);

}  // namespace mb::bench
