// Each is the integral of 1, y, x², y² and z² over the solid, by +, −, ·, ÷ and √ alone: the numbers are a body's mass, and
// must be the same on every machine.
#include "core/sdf/primitive_matter.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mb {
namespace {

constexpr double kPi = 3.14159265358979323846;

double square(double x) { return x * x; }
double cube(double x) { return x * x * x; }

/// About the origin, from the integrals of 1, x², y² and z².
Matter centred(double volume, double xx, double yy, double zz) { return {volume, 0, {xx / volume, yy / volume, zz / volume}}; }

}  // namespace

std::optional<Matter> sphereMatter(const LeafNumbers& k) {
    const double spread = square(k[0]) / 5;
    return Matter{4 * kPi / 3 * cube(k[0]), 0, {spread, spread, spread}};
}

std::optional<Matter> ellipsoidMatter(const LeafNumbers& k) {
    return Matter{4 * kPi / 3 * k[0] * k[1] * k[2], 0, {square(k[0]) / 5, square(k[1]) / 5, square(k[2]) / 5}};
}

/// A box swelled by the radius of its edges falls into pieces by the sides that a point lies beyond of the inner box: none,
/// one (slabs), two (quarters of cylinders) or three (eighths of a ball).
/// Source: Steiner, "Über parallele Flächen" (1840).
std::optional<Matter> boxMatter(const LeafNumbers& k) {
    const double r = std::min(k[3], 0.5 * std::min({k[0], k[1], k[2]}));
    // For n sides and r = 1: the volume of all pieces alike; the mean of how far beyond a side a point lies, and of its square.
    constexpr double kVolume[] = {1, 2, kPi, 4 * kPi / 3}, kBeyond[] = {0, 1.0 / 2, 4 / (3 * kPi), 3.0 / 8};
    constexpr double kSquare[] = {0, 1.0 / 3, 1.0 / 4, 1.0 / 5};
    double volume = 0, second[3] = {};
    for (unsigned sides = 0; sides < 8; ++sides) {
        const int n = std::popcount(sides);
        double piece = kVolume[n];
        for (unsigned i = 0; i < 3; ++i) piece *= sides >> i & 1 ? r : k[i] - 2 * r;
        volume += piece;
        for (unsigned i = 0; i < 3; ++i) {
            const double inner = k[i] - 2 * r;
            const double beyond = square(inner) / 4 + inner * r * kBeyond[n] + square(r) * kSquare[n];
            second[i] += piece * (sides >> i & 1 ? beyond : square(inner) / 12);
        }
    }
    return centred(volume, second[0], second[1], second[2]);
}

/// Turned around y (Pappus): of its quarter profile the part within the inner radius, the part beside it, and the round edge, a
/// quarter of a disc at (inner, level). The integral of ρ^i·y^j over the profile is M(i, j).
std::optional<Matter> cylinderMatter(const LeafNumbers& k) {
    const double r = std::min(k[2], std::min(k[0], 0.5 * k[1])), half = 0.5 * k[1], inner = k[0] - r, level = half - r;
    const double disc = kPi / 4 * square(r), r3 = cube(r) / 3, r4 = kPi / 16 * square(square(r)), r5 = square(r) * cube(r) / 15;
    const double inner2 = square(inner) / 2, beside2 = (square(k[0]) - square(inner)) / 2;
    const double inner4 = square(square(inner)) / 4, beside4 = square(square(k[0])) / 4 - inner4;
    const double m10 = inner2 * half + beside2 * level + inner * disc + r3;
    const double m30 = inner4 * half + beside4 * level + cube(inner) * disc + 3 * square(inner) * r3 + 3 * inner * r4 + 2 * r5;
    const double m12 = inner2 * cube(half) / 3 + beside2 * cube(level) / 3 + inner * (square(level) * disc + 2 * level * r3 + r4) +
                       square(level) * r3 + 2 * level * square(square(r)) / 8 + r5;
    return centred(4 * kPi * m10, 2 * kPi * m30, 4 * kPi * m12, 2 * kPi * m30);
}

/// A cylinder between two halves of a ball.
std::optional<Matter> capsuleMatter(const LeafNumbers& k) {
    const double r = k[0], half = 0.5 * k[1], column = kPi * square(r) * k[1], ball = 4 * kPi / 3 * cube(r);
    const double across = column * square(r) / 4 + ball * square(r) / 5;
    const double along = column * square(half) / 3 + ball * (square(half) + half * r * 3 / 4 + square(r) / 5);
    return centred(column + ball, across, along, across);
}

/// A tube of radius r whose middle is a circle of radius R, turned around y (Pappus).
std::optional<Matter> torusMatter(const LeafNumbers& k) {
    if (k[1] > k[0]) return std::nullopt;  // it meets itself
    const double across = square(k[0]) / 2 + 3 * square(k[1]) / 8;
    return Matter{2 * square(kPi) * k[0] * square(k[1]), 0, {across, square(k[1]) / 4, across}};
}

/// Discs whose radius goes from a at the base to b at the top.
std::optional<Matter> coneMatter(const LeafNumbers& k) {
    const double a = k[0], b = k[1], h = k[2], s = square(a) + a * b + square(b), a4 = square(square(a)), b4 = square(square(b));
    const double across = 3.0 / 20 * (a4 + cube(a) * b + square(a * b) + a * cube(b) + b4) / s;
    const double along = 3.0 / 80 * square(h / s) * (a4 + 4 * cube(a) * b + 10 * square(a * b) + 4 * a * cube(b) + b4);
    return Matter{kPi / 3 * h * s, h * (square(b) - square(a)) / (4 * s), {across, along, across}};
}

std::optional<Matter> octahedronMatter(const LeafNumbers& k) {
    const double spread = square(k[0]) / 10;
    return Matter{4.0 / 3 * cube(k[0]), 0, {spread, spread, spread}};
}

/// Triangles from the axis to each side; a regular polygon's second moments are the same along every direction.
std::optional<Matter> prismMatter(const LeafNumbers& k) {
    const double apothem = k[3], half_side = std::sqrt(std::max(square(k[1]) - square(apothem), 0.0));
    const double across = square(apothem) / 4 + square(half_side) / 12;
    return Matter{k[0] * apothem * half_side * k[2], 0, {across, square(k[2]) / 12, across}};
}

}  // namespace mb
