#pragma once
// A scene's objects made ready for evaluation: transforms multiplied down to the leaves, scales multiplied into lengths,
// the tree laid out as a postfix program. The same Tree is evaluated on the CPU (for any scalar) and written out as GLSL.
#include "core/scene/scene.h"

#include <functional>
#include <vector>

namespace mb {

/// A primitive in the world.
struct Leaf {
    const Primitive* primitive = nullptr;
    glm::dmat3 rotation{1};      // from the leaf's frame to the world's; orthonormal
    glm::dvec3 position{0};
    LeafNumbers numbers{};       // cooked: what the GLSL function takes
    int object = 0;              // the top-level object's number, counting top-level objects from 0
    int material = kNoMaterial;  // the effective one
    std::size_t index = 0;       // of the object in Scene::objects
};

/// An operator in the world.
struct Branch {
    const Operator* op = nullptr;
    double blend = 0;            // m, scaled
    std::size_t index = 0;       // of the object in Scene::objects
};

/// One step of the program: push a leaf's distance, or fold the two topmost values into one.
struct Instruction {
    enum class Kind : std::uint8_t { leaf, fold, join } kind;  // join: the plain union of two top-level objects
    std::uint32_t index;         // of the leaf or the branch
};

/// The distance nobody can be nearer than where there is nothing: finite, so that no difference of two is NaN.
inline constexpr double kEmptyDistance = 1e9;

struct Tree {
    std::vector<Leaf> leaves;
    std::vector<Branch> branches;
    std::vector<Instruction> program;
    int depth = 0;               // values the stack must hold
};

/// What an evaluation found: the distance, and the leaf whose surface is nearest there (the first of equals; -1: none).
template <class R> struct Nearest {
    R distance;
    int leaf = -1;
};

/// The objects `wanted` says yes to (asked by index, top level only), less the hidden ones, as one tree: their union.
/// Objects whose type no evaluator knows must not be among them: see firstUnevaluated.
Tree makeTree(const Scene& scene, const std::function<bool(std::size_t)>& wanted = {});

/// The first object whose type this version cannot evaluate, if any; and that as a sentence, empty where there is none.
std::optional<std::size_t> firstUnevaluated(const Scene& scene);
std::string whyUnevaluated(const Scene& scene);

/// The signed distance bound of the tree at p, for R = float, double, sdf::Dual or sdf::Interval: never more than the
/// distance to the nearest surface, negative inside.
template <class R> R distance(const Tree& tree, sdf::Vec3<R> p);
/// The same, with the leaf it came from. R = float or double.
template <class R> Nearest<R> nearest(const Tree& tree, sdf::Vec3<R> p);

/// Distance and gradient in double, exact up to rounding; the gradient is that of one side on a crease, and may be 0.
struct Slope {
    double distance = 0;
    glm::dvec3 gradient{0};
};
Slope slope(const Tree& tree, glm::dvec3 p);

/// A box that holds the whole shape; of an empty tree, an empty box.
Box bounds(const Tree& tree);
/// A box that holds the leaf.
Box bounds(const Leaf& leaf);

}  // namespace mb
