#pragma once
// Scenes drawn at random, and a second evaluator to hold the first one to: it walks the objects themselves, each in its own
// frame, with 4x4 matrices, and knows nothing of how makeTree lays a tree out.
#include "core/sdf/tree.h"
#include "scenes.h"
#include "sdf/draw.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>

#include <vector>

namespace mb {

struct SceneKind {
    int levels = 4;            // of objects below one another
    int children = 4;          // of an operator, at most
    double hidden = 0;         // the share of objects that are
    bool blends = true;
    bool bounded = false;      // no planes
    double extent = 2;         // m: positions, and about the size of the largest shapes
};

/// Numbers of an operator that leave something to see: few copies, seams of a size that matters.
inline void tame(Draw& draw, const SceneKind& kind, const Operator& op, Numbers& numbers) {
    if (op.blends) numbers[0] = kind.blends && draw.oneIn(2) ? draw.uniform(0, 0.3) : 0;
    if (op.name == "repeat") numbers = {draw.uniform(0.3, 1), draw.oneIn(2) ? 0 : 0.5, 0, 1.0 + draw.below(3), 1.0 + draw.below(2), 1};
}

inline Object drawObject(Draw& draw, const SceneKind& kind, const ShapeType& type, int level) {
    Object o;
    o.type = &type;
    const double share = std::pow(0.7, level);
    do o.numbers = drawNumbers(draw, type, (type.isOperator() ? 0.03 : 0.3) * kind.extent * share, 2);
    while (!type.isOperator() && !cooked(asPrimitive(type), o.numbers));
    if (type.isOperator()) tame(draw, kind, asOperator(type), o.numbers);
    const auto side = [&] { return draw.oneIn(4) ? 0 : draw.uniform(-0.5, 0.5) * kind.extent * share; };
    o.pos = {side(), side(), side()};
    const auto angle = [&] { return draw.oneIn(3) ? 90.0 * draw.below(4) : draw.uniform(-180, 180); };
    if (!draw.oneIn(3)) o.rot = {angle(), angle(), angle()};
    if (draw.oneIn(2)) o.scale = draw.uniform(0.6, 1.6);
    o.hidden = draw.uniform(0, 1) < kind.hidden;
    return o;
}

inline const Primitive& anyPrimitive(Draw& draw) { return primitives()[static_cast<std::size_t>(draw.below(static_cast<int>(primitives().size())))]; }
inline const Operator& anyOperator(Draw& draw) { return operators()[static_cast<std::size_t>(draw.below(static_cast<int>(operators().size())))]; }
inline const Primitive& anyPrimitive(Draw& draw, bool bounded) {
    for (;;) {
        const Primitive& row = anyPrimitive(draw);
        if (!bounded || isFinite(row.extent(*cooked(row, initialNumbers(row))))) return row;
    }
}

/// Adds an object with all that is below it.
inline void addRandom(Scene& scene, Draw& draw, SceneKind kind, int parent = kNoParent, int level = 0) {
    const bool leaf = level + 1 >= kind.levels || (level > 0 && draw.oneIn(2));
    Object o = leaf ? drawObject(draw, kind, anyPrimitive(draw, kind.bounded), level) : drawObject(draw, kind, anyOperator(draw), level);
    kind.bounded = kind.bounded || (!leaf && asOperator(*o.type).warp_by);
    o.id = scene.newId(), o.parent = parent;
    scene.objects.push_back(o);
    const int self = static_cast<int>(scene.objects.size()) - 1;
    if (!leaf)
        for (int i = std::clamp(draw.below(kind.children) + 1, o.type->min_children, o.type->max_children); i > 0; --i) addRandom(scene, draw, kind, self, level + 1);
}

inline glm::dmat4 placed(const Object& o) {
    glm::dmat4 m = glm::translate(glm::dmat4(1), o.pos);
    m = glm::rotate(m, glm::radians(o.rot.z), glm::dvec3(0, 0, 1));
    m = glm::rotate(m, glm::radians(o.rot.y), glm::dvec3(0, 1, 0));
    m = glm::rotate(m, glm::radians(o.rot.x), glm::dvec3(1, 0, 0));
    return glm::scale(m, glm::dvec3(o.scale));
}

/// What an object alone says at a point of its parent's frame, in that frame's metres, and which object's surface it is.
struct Found {
    double distance;
    std::size_t object;
};
inline std::optional<Found> foundBelow(const Scene& scene, std::size_t i, glm::dvec3 p);

/// The first descendants of object i as a scene of their own.
inline Scene childrenOf(const Scene& scene, std::size_t i) {
    Scene alone;
    for (std::size_t c = i + 1; c < subtreeEnd(scene, i); ++c) {
        alone.objects.push_back(scene.objects[c]);
        alone.objects.back().parent = scene.objects[c].parent == static_cast<int>(i) ? kNoParent : scene.objects[c].parent - static_cast<int>(i) - 1;
        alone.objects.back().mass = alone.objects.back().density = 0;
    }
    return alone;
}
inline double easeOf(const Scene& scene, std::size_t i);
/// The greatest of what the children's values were divided by.
inline double easeOfChildren(const Scene& scene, std::size_t i) {
    double greatest = 0;
    for (std::size_t c = i + 1; c < subtreeEnd(scene, i); ++c)
        if (scene.objects[c].parent == static_cast<int>(i) && foundBelow(scene, c, {0, 0, 0})) greatest = std::max(greatest, easeOf(scene, c));
    return greatest > 0 ? greatest : 1;
}
/// A wrap's numbers: its lengths are those of a value that was eased.
inline LeafNumbers wrapNumbers(const Scene& scene, std::size_t i) {
    const Object& o = scene.objects[i];
    const Operator& op = asOperator(*o.type);
    LeafNumbers k{};
    std::copy_n(o.numbers.begin(), k.size(), k.begin());
    for (std::size_t n = 0; n < op.parameters.size(); ++n)
        if (op.parameters[n].isLength()) k[n] *= easeOfChildren(scene, i);  // each parameter of a wrap is one number
    if (op.cook) op.cook(k, bounds(makeTree(childrenOf(scene, i))));
    return k;
}
inline double easeOf(const Scene& scene, std::size_t i) {
    const Object& o = scene.objects[i];
    if (o.hidden || !o.type->isOperator()) return 1;
    const Operator& op = asOperator(*o.type);
    double ease = easeOfChildren(scene, i);
    for (std::size_t n = 0; n < op.derived.size(); ++n)
        if (op.derived[n] == "ease") ease *= wrapNumbers(scene, i)[op.parameters.size() + n];
    return ease;
}
inline std::optional<Found> foundWrapped(const Scene& scene, std::size_t i, glm::dvec3 q) {
    const Object& o = scene.objects[i];
    const Operator& op = asOperator(*o.type);
    const LeafNumbers k = wrapNumbers(scene, i);
    const sdf::Vec3<double> at{q.x, q.y, q.z}, asked = op.warp_by ? op.warped(at, k) : at;
    std::optional<Found> child = foundBelow(scene, i + 1, {asked.x, asked.y, asked.z});
    if (child) child->distance = o.scale * op.wrap(child->distance, at, k);
    return child;
}
inline std::optional<Found> foundCopies(const Scene& scene, std::size_t i, glm::dvec3 q) {
    const Object& o = scene.objects[i];
    const Operator& op = asOperator(*o.type);
    std::optional<Found> nearest;
    for (std::size_t n = 0; n < static_cast<std::size_t>(op.count(o.numbers)); ++n) {
        const Copy c = op.copy(o.numbers, n);
        const glm::dvec3 back{c.mirror[0] * (q.x - c.offset[0]), c.mirror[1] * (q.y - c.offset[1]), c.mirror[2] * (q.z - c.offset[2])};
        const std::optional<Found> copy = foundBelow(scene, i + 1, back);
        if (copy && (!nearest || copy->distance < nearest->distance)) nearest = copy;
    }
    if (nearest) nearest->distance *= o.scale;
    return nearest;
}

inline std::optional<Found> foundBelow(const Scene& scene, std::size_t i, glm::dvec3 p) {
    const Object& o = scene.objects[i];
    if (o.hidden) return std::nullopt;
    const glm::dvec3 q = glm::dvec3(glm::inverse(placed(o)) * glm::dvec4(p, 1));
    if (!o.type->isOperator()) {
        const Primitive& row = asPrimitive(*o.type);
        return Found{row.distance<double>({q.x, q.y, q.z}, *cooked(row, o.numbers)) * o.scale, i};
    }
    const Operator& op = asOperator(*o.type);
    if (op.kind == Operator::Kind::wrap) return foundWrapped(scene, i, q);
    if (op.kind == Operator::Kind::copies) return foundCopies(scene, i, q);
    // A child that is not there is the empty set: it adds nothing and takes nothing away, but shares nothing either, and
    // nothing lies between it and another.
    const double k = o.numbers[0] * (op.parameters[0].isLength() ? easeOfChildren(scene, i) : 1);
    std::optional<Found> sum;
    bool first = true;
    for (std::size_t c = i + 1; c < scene.objects.size(); ++c) {
        if (scene.objects[c].parent != static_cast<int>(i)) continue;
        const std::optional<Found> child = foundBelow(scene, c, q);
        if (!child && (op.intersects || op.min_children > 1 || (op.first_only && first))) return std::nullopt;
        first = false;
        if (!child) continue;
        if (!sum) sum = child;
        else sum = Found{op.fold<double>(sum->distance, child->distance, k),
                         op.shareOfSecond<double>(sum->distance, child->distance, k) > 0.5 ? child->object : sum->object};
    }
    if (sum) sum->distance *= o.scale;
    return sum;
}
inline std::optional<Found> found(const Scene& scene, glm::dvec3 p) {
    std::optional<Found> nearest;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        if (scene.objects[i].parent != kNoParent) continue;
        const std::optional<Found> o = foundBelow(scene, i, p);
        if (o && (!nearest || o->distance < nearest->distance)) nearest = o;
    }
    return nearest;
}

}  // namespace mb
