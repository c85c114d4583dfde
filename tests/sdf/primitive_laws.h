#pragma once
// What every row of primitives() promises, as functions that look for a violation: so the tests can hold the table to
// them, and hold them to rows that are known to be bad.
#include "sdf/draw.h"

#include <span>
#include <string>
#include <string_view>

namespace mb {

/// One shape: a row, numbers for it, and a box's worth of space around it to draw points from.
struct Specimen {
    const Primitive& row;
    LeafNumbers k{};
    double size = 1;     // of the lengths that go into a distance near it, in metres

    double at(sdf::Vec3<double> p) const { return row.distance<double>(p, k); }
    sdf::Dual slopeAt(sdf::Vec3<double> p) const { return row.distance<sdf::Dual>({{p.x, 1, 0, 0}, {p.y, 0, 1, 0}, {p.z, 0, 0, 1}}, k); }
};
Specimen drawSpecimen(Draw& draw, const Primitive& row);

struct PrimitiveLaw {
    std::string_view name;
    std::string (*violation)(const Specimen&, Draw&);  // what is wrong; empty: nothing was found
    int specimens;                                     // of each row, where TEST_COUNT is 1
};
std::span<const PrimitiveLaw> primitiveLaws();

/// What is wrong with how the row is declared in the library's text, or nothing.
std::string signatureViolation(const Primitive& row, std::string_view glsl);
/// What is wrong with a type's name and how it is found, or with its parameters' names, ranges and initial values.
std::string nameViolation(const ShapeType& type);
std::string rangeViolation(std::span<const Parameter> parameters);

}  // namespace mb
