// Where a ray is inside each primitive, with the outward normals at both ends.
#include "core/accuracy/solids.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace mb::accuracy {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Leaves of x what lies in the half-space normal·p <= offset.
void clip(Interval& x, const LocalRay& ray, glm::dvec3 normal, double offset) {
    const double height = glm::dot(normal, ray.origin) - offset, rate = glm::dot(normal, ray.direction);
    if (rate == 0) {
        if (height > 0) x = nothing();
        return;
    }
    const double t = -height / rate;
    if (rate < 0 && t > x.enter.t) x.enter = {t, normal, -1};
    if (rate > 0 && t < x.leave.t) x.leave = {t, normal, -1};
}

glm::dvec3 axisVector(int axis) {
    glm::dvec3 v{0};
    v[axis] = 1;
    return v;
}
void clipSlab(Interval& x, const LocalRay& ray, int axis, double middle, double half) {
    const glm::dvec3 n = axisVector(axis);
    clip(x, ray, n, middle + half);
    clip(x, ray, -n, half - middle);
}
Interval slabs(const LocalRay& ray, glm::dvec3 half) {
    Interval x = wholeLine();
    for (int axis = 0; axis < 3; ++axis) clipSlab(x, ray, axis, 0, half[axis]);
    return x;
}

/// Kahan's form of the quadratic: the distance of the centre from the ray, with no difference of near equals but the last.
Interval ball(const LocalRay& ray, glm::dvec3 centre, double radius) {
    const glm::dvec3 from = ray.origin - centre;
    const double b = -glm::dot(from, ray.direction), across = glm::length(from + b * ray.direction);
    if (across >= radius) return nothing();
    const double half = std::sqrt((radius - across) * (radius + across));
    const auto end = [&](double t) { return End{t, glm::normalize(from + t * ray.direction), -1}; };
    return {end(b - half), end(b + half)};
}

/// A cylinder along an axis, as a disc seen along it and a slab.
Interval column(const LocalRay& ray, int axis, glm::dvec3 centre, double radius, double half_length) {
    glm::dvec3 from = ray.origin - centre, flat = ray.direction;
    from[axis] = 0, flat[axis] = 0;
    const double across = glm::dot(flat, flat);
    Interval x = wholeLine();
    if (across > 0) {
        const double b = -glm::dot(from, flat) / across, miss = glm::length(from + b * flat);
        if (miss >= radius) return nothing();
        const double half = std::sqrt((radius - miss) * (radius + miss) / across);
        const auto end = [&](double t) { return End{t, glm::normalize(from + t * flat), -1}; };
        x = {end(b - half), end(b + half)};
    } else if (glm::length(from) >= radius) {
        return nothing();
    }
    clipSlab(x, ray, axis, centre[axis], half_length);
    return x;
}

/// The least interval around both: what a convex solid made of pieces has on the ray.
void widen(Interval& x, const Interval& piece) {
    if (piece.isEmpty()) return;
    if (piece.enter.t < x.enter.t) x.enter = piece.enter;
    if (piece.leave.t > x.leave.t) x.leave = piece.leave;
}

/// A box swollen by r, the box's half sides being `core`: the Minkowski sum is three boxes, twelve columns and eight balls.
Interval swollenBox(const LocalRay& ray, glm::dvec3 core, double r) {
    Interval x = nothing();
    for (int axis = 0; axis < 3; ++axis) {
        widen(x, slabs(ray, core + r * axisVector(axis)));
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const double s : {-1.0, 1.0})
            for (const double t : {-1.0, 1.0}) {
                glm::dvec3 centre{0};
                centre[u] = s * core[u], centre[v] = t * core[v];
                widen(x, column(ray, axis, centre, r, core[axis]));
            }
    }
    for (int corner = 0; corner < 8; ++corner)
        widen(x, ball(ray, core * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1), r));
    return x;
}

/// A cylinder swollen by r: two columns, and a torus around each rim.
Interval swollenCylinder(const LocalRay& ray, double radius, double half_height, double r) {
    Interval x = nothing();
    widen(x, column(ray, 1, {}, radius + r, half_height));
    widen(x, column(ray, 1, {}, radius, half_height + r));
    for (const double y : {-half_height, half_height}) {
        Inside rim;
        insideTorus({ray.origin - glm::dvec3(0, y, 0), ray.direction}, radius, r, rim);
        for (const Interval& piece : rim) widen(x, piece);
    }
    return x;
}

}  // namespace

void insideSphere(const LocalRay& ray, const LeafNumbers& k, Inside& inside) { inside.add(ball(ray, {}, k[0])); }

void insideBox(const LocalRay& ray, const LeafNumbers& k, Inside& inside) {
    const glm::dvec3 half{k[0] / 2, k[1] / 2, k[2] / 2};
    const double round = std::min({k[3], half.x, half.y, half.z});
    const Interval sharp = slabs(ray, half);
    if (sharp.isEmpty()) return;
    inside.add(round > 0 ? swollenBox(ray, half - round, round) : sharp);
}

void insidePlane(const LocalRay& ray, const LeafNumbers& k, Inside& inside) {
    Interval x = wholeLine();
    clip(x, ray, {k[0], k[1], k[2]}, k[3]);
    inside.add(x);
}

void insideTorus(const LocalRay& ray, const LeafNumbers& k, Inside& inside) { insideTorus(ray, k[0], k[1], inside); }

void insideCylinder(const LocalRay& ray, const LeafNumbers& k, Inside& inside) {
    const double half = k[1] / 2, round = std::min({k[2], k[0], half});
    const Interval sharp = column(ray, 1, {}, k[0], half);
    if (sharp.isEmpty()) return;
    inside.add(round > 0 ? swollenCylinder(ray, k[0] - round, half - round, round) : sharp);
}

void insideCapsule(const LocalRay& ray, const LeafNumbers& k, Inside& inside) {
    const double half = k[1] / 2;
    Interval x = nothing();
    widen(x, column(ray, 1, {}, k[0], half));
    for (const double y : {-half, half}) widen(x, ball(ray, {0, y, 0}, k[0]));
    inside.add(x);
}

// Within its slab the frustum is where x² + z² <= (middle + slope·y)², a quadratic in t; the slab's ends and the quadratic's roots cut
// the ray into pieces, each of which lies inside as its middle does.
void insideCone(const LocalRay& ray, const LeafNumbers& k, Inside& inside) {
    const double middle = (k[0] + k[1]) / 2, slope = (k[1] - k[0]) / k[2];
    const glm::dvec3 o = ray.origin, d = ray.direction;
    Interval x = wholeLine();
    clipSlab(x, ray, 1, 0, k[2] / 2);
    const Interval around = column(ray, 1, {}, std::max(k[0], k[1]), k[2] / 2);
    if (x.isEmpty() || around.isEmpty()) return;
    if (around.enter.t > x.enter.t) x.enter = around.enter;
    if (around.leave.t < x.leave.t) x.leave = around.leave;

    const double r = middle + slope * o.y, rise = slope * d.y;
    const double a = d.x * d.x + d.z * d.z - rise * rise, b = o.x * d.x + o.z * d.z - r * rise, c = o.x * o.x + o.z * o.z - r * r;
    const double discriminant = b * b - a * c, q = -(b + std::copysign(std::sqrt(std::max(discriminant, 0.0)), b));
    std::array<double, 4> cuts{x.enter.t, x.leave.t, x.leave.t, x.leave.t};
    if (discriminant > 0) {
        if (a != 0) cuts[1] = std::clamp(q / a, x.enter.t, x.leave.t);
        if (q != 0) cuts[2] = std::clamp(c / q, x.enter.t, x.leave.t);
        if (cuts[1] > cuts[2]) std::swap(cuts[1], cuts[2]);
    }

    const auto onSide = [&](double t) {
        const glm::dvec3 p = ray.at(t);
        return End{t, glm::normalize(glm::dvec3(p.x, -(middle + slope * p.y) * slope, p.z)), -1};
    };
    Interval solid = nothing();
    for (std::size_t i = 0; i < 3; ++i) {
        const double t = cuts[i] + (cuts[i + 1] - cuts[i]) / 2;
        if (!(cuts[i] < cuts[i + 1]) || (a * t + 2 * b) * t + c >= 0) continue;
        widen(solid, {cuts[i] == x.enter.t ? x.enter : onSide(cuts[i]), cuts[i + 1] == x.leave.t ? x.leave : onSide(cuts[i + 1])});
    }
    inside.add(solid);
}

// A ball in the space stretched by the radii, where the direction is not of unit length.
void insideEllipsoid(const LocalRay& ray, const LeafNumbers& k, Inside& inside) {
    const glm::dvec3 radii{k[0], k[1], k[2]}, o = ray.origin / radii, d = ray.direction / radii;
    const double a = glm::dot(d, d), b = -glm::dot(o, d) / a, miss = glm::length(o + b * d);
    if (miss >= 1) return;
    const double half = std::sqrt((1 - miss) * (1 + miss) / a);
    const auto end = [&](double t) { return End{t, glm::normalize((o + t * d) / radii), -1}; };
    inside.add({end(b - half), end(b + half)});
}

void insideOctahedron(const LocalRay& ray, const LeafNumbers& k, Inside& inside) {
    Interval x = wholeLine();
    for (int face = 0; face < 8; ++face) {
        const glm::dvec3 n = glm::dvec3(face & 1 ? 1 : -1, face & 2 ? 1 : -1, face & 4 ? 1 : -1) / std::sqrt(3.0);
        clip(x, ray, n, k[0] / std::sqrt(3.0));
    }
    inside.add(x);
}

// The first side faces along x.
void insidePrism(const LocalRay& ray, const LeafNumbers& k, Inside& inside) {
    const int sides = static_cast<int>(k[0]);
    Interval x = column(ray, 1, {}, k[1], k[2] / 2);
    if (x.isEmpty()) return;
    x = wholeLine();
    clipSlab(x, ray, 1, 0, k[2] / 2);
    const double apothem = k[1] * std::cos(kPi / sides);
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * kPi * i / sides;
        clip(x, ray, {std::cos(angle), 0, std::sin(angle)}, apothem);
    }
    inside.add(x);
}

}  // namespace mb::accuracy
