// The table of solids: a row a primitive, by its name in primitives().
#include "core/accuracy/solids.h"

#include <glm/geometric.hpp>

namespace mb::accuracy {
namespace {

constexpr Solid kSolids[] = {
    {"sphere", insideSphere, distanceOfSphere},
    {"box", insideBox, distanceOfBox},
    {"plane", insidePlane, distanceOfPlane, false},
    {"torus", insideTorus, distanceOfTorus},
    {"cylinder", insideCylinder, distanceOfCylinder},
    {"capsule", insideCapsule, distanceOfCapsule},
    {"cone", insideCone, distanceOfCone},
    {"ellipsoid", insideEllipsoid, distanceOfEllipsoid},
    {"octahedron", insideOctahedron, distanceOfOctahedron},
    {"prism", insidePrism, distanceOfPrism},
};

}  // namespace

const Solid* findSolid(std::string_view name) {
    for (const Solid& solid : kSolids)
        if (solid.name == name) return &solid;
    return nullptr;
}

Inside insideOf(const Solid& solid, const LocalRay& ray, const LeafNumbers& numbers) {
    Inside inside;
    if (!solid.bounded) return solid.inside(ray, numbers, inside), inside;
    const double nearest = -glm::dot(ray.origin, ray.direction);
    solid.inside({ray.at(nearest), ray.direction}, numbers, inside);
    for (std::size_t i = 0; i < inside.count; ++i) inside.list[i].enter.t += nearest, inside.list[i].leave.t += nearest;
    return inside;
}

}  // namespace mb::accuracy
