#pragma once
// A scene's objects made ready for evaluation: transforms multiplied down to the leaves, scales multiplied into lengths,
// copies made, the tree laid out as a postfix program. The same Tree is evaluated on the CPU (for any scalar), written out
// as GLSL, and cut into a grid of shorter programs (grid.h).
#include "core/scene/scene.h"

#include <functional>
#include <vector>

namespace mb {

/// A primitive in the world, or in the space that warps above it make: `warps` counts those.
struct Leaf {
    const Primitive* primitive = nullptr;
    glm::dmat3 rotation{1};      // from the leaf's frame to its space's; orthonormal, of either handedness
    glm::dvec3 position{0};
    LeafNumbers numbers{};       // cooked: what the GLSL function takes
    int object = 0;              // the top-level object's number, counting top-level objects from 0
    int material = kNoMaterial;  // the effective one
    std::size_t index = 0;       // of the object in Scene::objects
    int warps = 0;
};

/// An operator in the world, or in the space that warps above it make. Copies have none: they are leaves and joins.
struct Branch {
    const Operator* op = nullptr;
    double blend = 0;            // of a fold: its number, scaled
    std::size_t index = 0;       // of the object in Scene::objects
    LeafNumbers numbers{};       // of a wrap, cooked
    glm::dmat3 rotation{1};      // of a wrap: its frame
    glm::dvec3 position{0};
    int warps = 0;
};

/// One step of a tape. A leaf pushes its distance; a fold makes one value of the two topmost, a join their plain
/// union; a wrap changes the topmost. `enter` opens the space of a warp, which its wrap closes again.
struct Instruction {
    enum class Kind : std::uint8_t { leaf, fold, join, enter, wrap } kind;
    std::uint32_t index;         // of the leaf or the branch
};
using Tape = std::vector<Instruction>;

/// The distance nobody can be nearer than where there is nothing: finite, so that no difference of two is NaN.
inline constexpr double kEmptyDistance = 1e9;
/// More leaves than this no tree may have, copies included.
inline constexpr std::size_t kMostLeaves = 200'000;

struct Tree {
    std::vector<Leaf> leaves;
    std::vector<Branch> branches;
    Tape program;                // the whole tree's
    /// The tree is the plain union of these: ranges of the program, the joins between them left out.
    struct Part {
        std::uint32_t begin = 0, end = 0;
    };
    std::vector<Part> parts;
    int depth = 0;               // values the stack must hold
    int warps = 0;               // spaces within one another, the world not counted
    std::string fault;           // why it cannot be evaluated, as a sentence; then it is empty
    std::size_t fault_object = 0;  // in Scene::objects
};

/// What an evaluation found: the distance, and the leaf whose surface is nearest there (the first of equals; -1: none).
template <class R> struct Nearest {
    R distance;
    int leaf = -1;
};

/// The objects `wanted` says yes to (asked by index, top level only), less the hidden ones, as one tree: their union.
Tree makeTree(const Scene& scene, const std::function<bool(std::size_t)>& wanted = {});
/// Of one top-level object alone.
Tree makeTreeOf(const Scene& scene, std::size_t object);

/// The signed distance bound of the tree at p, for R = float, double, sdf::Dual or sdf::Interval: never more than the
/// distance to the nearest surface, negative inside. No two points' values differ by more than the points' distance.
template <class R> R distance(const Tree& tree, sdf::Vec3<R> p);
/// The same, with the leaf it came from; of leaves whose values differ by no more than `tie`, the first. R = float or double.
template <class R> Nearest<R> nearest(const Tree& tree, sdf::Vec3<R> p, double tie = 0);
/// The value of a tape over the tree's leaves and branches: of a part, of one node, or of what is left of the tree in a
/// cell; p lies in the space behind that many warps.
template <class R> R distance(const Tree& tree, std::span<const Instruction> tape, sdf::Vec3<R> p, int warps = 0);
template <class R> Nearest<R> nearest(const Tree& tree, std::span<const Instruction> tape, sdf::Vec3<R> p, double tie = 0);

/// Distance and gradient in double, exact up to rounding; the gradient is that of one side on a crease, and may be 0.
struct Slope {
    double distance = 0;
    glm::dvec3 gradient{0};
};
Slope slope(const Tree& tree, glm::dvec3 p);

/// Whether every solid point lies in some leaf: nothing swells, warps or blends.
bool staysWithinLeaves(const Branch& branch);
bool staysWithinLeaves(const Tree& tree);

/// A point of a space seen from a frame in it.
template <class R> sdf::Vec3<R> toFrame(const glm::dmat3& rotation, glm::dvec3 position, const sdf::Vec3<R>& p);

/// A box that holds the whole shape; of an empty tree, an empty box.
Box bounds(const Tree& tree);
/// A box that holds the shape a tape makes, in the space it is asked in.
Box bounds(const Tree& tree, std::span<const Instruction> tape);
/// A box that holds the leaf, in the leaf's space.
Box bounds(const Leaf& leaf);
bool isFinite(const Box& box);

}  // namespace mb
