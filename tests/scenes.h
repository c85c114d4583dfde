#pragma once
// Small scenes made in code, for tests.
#include "core/scene/scene.h"

#include <initializer_list>
#include <string_view>

namespace mb {

/// Adds an object of that type with those numbers (of its own keys, in their order) and returns its index.
inline int addObject(Scene& scene, std::string_view type, std::initializer_list<double> numbers, glm::dvec3 pos = {}, int parent = kNoParent) {
    Object o;
    o.id = scene.newId();
    o.type = findShapeType(type);
    o.numbers = initialNumbers(*o.type);
    std::copy(numbers.begin(), numbers.end(), o.numbers.begin());
    o.pos = pos, o.parent = parent;
    scene.objects.push_back(o);
    return static_cast<int>(scene.objects.size()) - 1;
}

inline Camera cameraAt(glm::dvec3 eye, glm::dvec3 target, double fov = 50) { return {"", eye, target, fov, 0}; }

}  // namespace mb
