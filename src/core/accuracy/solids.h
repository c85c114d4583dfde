#pragma once
// The primitives once more, as solids in their own frames: where a ray is inside, by the roots of each one's equation, and how far a
// point is from the surface. Nothing here comes from shaders/sdf/: this is what pictures drawn by those functions are held to.
#include "core/accuracy/intervals.h"
#include "core/sdf/shape.h"

#include <array>
#include <string_view>

namespace mb::accuracy {

/// A ray in the solid's frame; the direction has unit length.
struct LocalRay {
    glm::dvec3 origin, direction;
    glm::dvec3 at(double t) const { return origin + t * direction; }
};

/// The stretches inside one solid: a torus has two at most, what is convex one.
struct Inside {
    std::array<Interval, 2> list{};
    std::size_t count = 0;
    void add(const Interval& x) {
        if (!x.isEmpty()) list[count++] = x;
    }
    const Interval* begin() const { return list.data(); }
    const Interval* end() const { return list.data() + count; }
};

struct Solid {
    std::string_view name;                                                       // of the row of primitives()
    void (*inside)(const LocalRay&, const LeafNumbers&, Inside&) = nullptr;
    double (*distance)(glm::dvec3 p, const LeafNumbers&) = nullptr;              // negative inside; of an ellipsoid the bound
    bool bounded = true;
};

/// Null where there is none of that name.
const Solid* findSolid(std::string_view name);

/// The stretches of a ray inside the solid. What has a centre is asked about the ray's point nearest to it, so that nothing is lost to
/// rounding from far away (Haines, Guenther and Akenine-Moeller, "Precision Improvements for Ray/Sphere Intersection", 2019).
Inside insideOf(const Solid& solid, const LocalRay& ray, const LeafNumbers& numbers);

// The rows' functions (solid_rays.cpp, solid_torus.cpp, solid_distances.cpp).
void insideSphere(const LocalRay&, const LeafNumbers&, Inside&);
void insideBox(const LocalRay&, const LeafNumbers&, Inside&);
void insidePlane(const LocalRay&, const LeafNumbers&, Inside&);
void insideTorus(const LocalRay&, const LeafNumbers&, Inside&);
void insideCylinder(const LocalRay&, const LeafNumbers&, Inside&);
void insideCapsule(const LocalRay&, const LeafNumbers&, Inside&);
void insideCone(const LocalRay&, const LeafNumbers&, Inside&);
void insideEllipsoid(const LocalRay&, const LeafNumbers&, Inside&);
void insideOctahedron(const LocalRay&, const LeafNumbers&, Inside&);
void insidePrism(const LocalRay&, const LeafNumbers&, Inside&);
double distanceOfSphere(glm::dvec3, const LeafNumbers&);
double distanceOfBox(glm::dvec3, const LeafNumbers&);
double distanceOfPlane(glm::dvec3, const LeafNumbers&);
double distanceOfTorus(glm::dvec3, const LeafNumbers&);
double distanceOfCylinder(glm::dvec3, const LeafNumbers&);
double distanceOfCapsule(glm::dvec3, const LeafNumbers&);
double distanceOfCone(glm::dvec3, const LeafNumbers&);
double distanceOfEllipsoid(glm::dvec3, const LeafNumbers&);
double distanceOfOctahedron(glm::dvec3, const LeafNumbers&);
double distanceOfPrism(glm::dvec3, const LeafNumbers&);

/// A torus around y, centred on the origin.
void insideTorus(const LocalRay& ray, double major, double minor, Inside& inside);

}  // namespace mb::accuracy
