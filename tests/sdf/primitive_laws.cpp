#include "sdf/primitive_laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace mb {
namespace {

using Point = sdf::Vec3<double>;

double norm(Point p) { return std::hypot(p.x, p.y, p.z); }
Point gradientOf(const sdf::Dual& d) { return {d.dx, d.dy, d.dz}; }
double& component(Point& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// What a double cannot tell from 0 at p: 64 roundings of the lengths that go in, where the longest chain (sdPrism) has some
/// forty operations.
double noise(const Specimen& s, Point p) { return 64 * 0x1p-53 * (s.size + norm(p)); }

Point drawPoint(Draw& draw, const Specimen& s) {
    const double reach = 2 * s.size;
    return {draw.uniform(-reach, reach), draw.uniform(-reach, reach), draw.uniform(-reach, reach)};
}

std::string describe(const Specimen& s, Point p) {
    return fmt::format("{}({}, {}, {}, {}) at ({}, {}, {})", s.row.name, s.k[0], s.k[1], s.k[2], s.k[3], p.x, p.y, p.z);
}

/// A point of the surface, found down the slope from p; off it by no more than noise where the row is a distance.
Point project(const Specimen& s, Point p) {
    const sdf::Dual d = s.slopeAt(p);
    if (s.row.exact) return p - gradientOf(d) * d.v;
    for (int i = 0; i < 200; ++i) {
        const sdf::Dual there = s.slopeAt(p);
        const Point g = gradientOf(there);
        p = p - g * (there.v / std::max(dot(g, g), 1e-12));
    }
    return p;
}

// --- the laws -------------------------------------------------------------------------------------------------------------

/// Forward-mode gradients against differences. Where the field bends within h, or has a crease there, the differences to
/// both sides disagree, and no more than that may the gradient be off.
std::string wrongGradient(const Specimen& s, Draw& draw) {
    for (int i = 0; i < 400; ++i) {
        const Point p = drawPoint(draw, s);
        const sdf::Dual d = s.slopeAt(p);
        if (d.v != s.at(p)) return describe(s, p) + ": the dual's value differs from the double's";
        const double h = 1e-5 * s.size;
        for (int axis = 0; axis < 3; ++axis) {
            Point ahead = p, behind = p;
            component(ahead, axis) += h, component(behind, axis) -= h;
            const double forward = (s.at(ahead) - d.v) / h, backward = (d.v - s.at(behind)) / h;
            Point g = gradientOf(d);
            const double error = std::fabs((forward + backward) / 2 - component(g, axis));
            if (!(error <= std::fabs(forward - backward) + 2 * noise(s, p) / h))
                return describe(s, p) + fmt::format(": d/d{} is {}, by differences {}", "xyz"[axis], component(g, axis), (forward + backward) / 2);
        }
    }
    return {};
}

/// |gradient| is at most 1, and 1 for a distance: but for rounding, which a point near the surface divides by how near it is.
std::string wrongSlope(const Specimen& s, Draw& draw) {
    for (int i = 0; i < 1000; ++i) {
        const Point p = drawPoint(draw, s);
        const sdf::Dual d = s.slopeAt(p);
        const double slope = norm(gradientOf(d)), slack = 1e-12 + noise(s, p) / std::max(std::fabs(d.v), 1e-6 * s.size);
        if (!(slope <= 1 + slack) || (s.row.exact && !(slope >= 1 - slack)))
            return describe(s, p) + fmt::format(": |gradient| is {}", slope);
    }
    return {};
}

std::string steeperThanOne(const Specimen& s, Draw& draw) {
    for (int i = 0; i < 1000; ++i) {
        const Point p = drawPoint(draw, s), away = drawPoint(draw, s);
        const Point q = draw.oneIn(2) ? away : p + away * draw.logUniform(1e-6, 1e-1);
        const double rise = std::fabs(s.at(p) - s.at(q));
        if (!(rise <= norm(p - q) + noise(s, p) + noise(s, q)))
            return describe(s, p) + fmt::format(": rises by {} over {}", rise, norm(p - q));
    }
    return {};
}

/// A distance is bracketed from both sides: no point of the surface is nearer than it says, and one is as near. Inside it may
/// say less than that (a torus that overlaps itself does), so there the point found must only not be outside.
std::string wrongDistance(const Specimen& s, Draw& draw) {
    std::vector<Point> surface;
    bool has_inside = false;
    for (int i = 0; i < 300; ++i) {
        const Point p = drawPoint(draw, s), q = project(s, p);
        const double f = s.at(p), tolerance = s.row.exact ? 4 * noise(s, p) : 1e-9 * s.size;
        if (s.row.exact && std::fabs(f) < 1e-3 * s.size) continue;  // its gradient's rounding would count
        const bool found = std::fabs(s.at(q)) <= tolerance;
        if (s.row.exact && f < 0 && s.at(q) < 0 && !found) continue;
        if (!found) return describe(s, p) + fmt::format(": {} further on, the surface is still {} away", f, s.at(q));
        has_inside = has_inside || s.at(q - gradientOf(s.slopeAt(p)) * (1e-6 * s.size)) < 0;  // not behind every sharp edge
        surface.push_back(q);
    }
    if (!has_inside) return describe(s, Point(0)) + ": nowhere is the sign negative behind the surface";
    for (int i = 0; i < 300; ++i) {
        const Point p = drawPoint(draw, s);
        const double f = std::fabs(s.at(p));
        for (const Point& q : surface)
            if (!(f <= norm(p - q) + 1e-9 * s.size)) return describe(s, p) + fmt::format(": says {}, the surface is {} away", f, norm(p - q));
    }
    return {};
}

sdf::Interval drawSide(Draw& draw, double size) {
    const double centre = draw.uniform(-2 * size, 2 * size);
    switch (draw.below(6)) {
        case 0: return {centre, centre};
        case 1: return {0, draw.uniform(0, size)};
        case 2: return {-draw.logUniform(1e-9, 1) * size, draw.logUniform(1e-9, 1) * size};
        case 3: return {-1e9, draw.uniform(0, 1e9)};
        default: {
            const double half = draw.logUniform(1e-9, 1) * size;
            return {centre - half, centre + half};
        }
    }
}

/// Intervals hold every value of their box without any slack: each operation rounds outwards.
std::string leakyInterval(const Specimen& s, Draw& draw) {
    for (int i = 0; i < 300; ++i) {
        const sdf::Vec3<sdf::Interval> box{drawSide(draw, s.size), drawSide(draw, s.size), drawSide(draw, s.size)};
        const sdf::Interval bound = s.row.distance<sdf::Interval>(box, s.k);
        for (int j = 0; j < 30; ++j) {
            const Point p{draw.member(box.x.lo, box.x.hi), draw.member(box.y.lo, box.y.hi), draw.member(box.z.lo, box.z.hi)};
            const double f = s.at(p);
            if (!(bound.lo <= f && f <= bound.hi)) return describe(s, p) + fmt::format(": {} is not in [{}, {}]", f, bound.lo, bound.hi);
        }
    }
    return {};
}

/// They are of use too: over small boxes, the median one is no wider than a few times the true range.
std::string looseInterval(const Specimen& s, Draw& draw) {
    constexpr double kMedianWidth = 4;  // box diagonals; the true width is at most 1
    std::vector<double> widths;
    for (int i = 0; i < 101; ++i) {
        const Point p = drawPoint(draw, s);
        const double half = 1e-3 * s.size;
        const auto around = [&](double x) { return sdf::Interval{x - half, x + half}; };
        const sdf::Interval bound = s.row.distance<sdf::Interval>({around(p.x), around(p.y), around(p.z)}, s.k);
        widths.push_back((bound.hi - bound.lo) / (2 * half * std::sqrt(3.0)));
    }
    std::ranges::nth_element(widths, widths.begin() + 50);
    if (!(widths[50] <= kMedianWidth)) return fmt::format("{}: intervals are {} diagonals wide", describe(s, Point(0)), widths[50]);
    return {};
}

/// float against double: within 16 ulps of the largest length that goes in. A dozen dependent roundings of half an ulp each
/// are usual, and the numbers themselves are rounded too.
std::string coarseFloat(const Specimen& s, Draw& draw) {
    constexpr double kUlps = 16;
    for (int i = 0; i < 1000; ++i) {
        const Point p = drawPoint(draw, s);
        const sdf::Vec3<float> q{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
        const double exact = s.at({q.x, q.y, q.z}), error = std::fabs(static_cast<double>(s.row.distance<float>(q, s.k)) - exact);
        const double ulp = 0x1p-23 * (s.size + norm(p));
        if (!(error <= kUlps * ulp)) return describe(s, p) + fmt::format(": float is off by {} ulps of the coordinates", error / ulp);
    }
    return {};
}

// --- extents --------------------------------------------------------------------------------------------------------------

/// The least distance over a face of a box, by ever finer grids around the best point of the last one.
double leastOnFace(const Specimen& s, const Box& box, int axis, bool upper) {
    const auto index = [](int i) { return static_cast<std::size_t>(i % 3); };
    Point best(0);
    double least = INFINITY;
    const auto look = [&](Point p) {
        if (const double f = s.at(p); f < least) least = f, best = p;
    };
    const auto side = [&](int a, double t) { return box.lo[index(a)] + (box.hi[index(a)] - box.lo[index(a)]) * t; };
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto pointAt = [&](double a, double b) {
        Point p(0);
        component(p, axis) = upper ? box.hi[index(axis)] : box.lo[index(axis)];
        component(p, u) = std::clamp(a, box.lo[index(u)], box.hi[index(u)]), component(p, v) = std::clamp(b, box.lo[index(v)], box.hi[index(v)]);
        return p;
    };
    constexpr int kCells = 16;
    for (int i = 0; i <= kCells; ++i)
        for (int j = 0; j <= kCells; ++j) look(pointAt(side(u, 1.0 * i / kCells), side(v, 1.0 * j / kCells)));
    for (double step = 1.0 / kCells; step > 1e-6; step /= 2) {
        Point from = best;
        const double du = side(u, step) - side(u, 0), dv = side(v, step) - side(v, 0);
        for (int i = -2; i <= 2; ++i)
            for (int j = -2; j <= 2; ++j) look(pointAt(component(from, u) + i * du, component(from, v) + j * dv));
    }
    return least;
}

/// Nothing sticks out of the extent and the shape touches each of its faces; a face at infinity is one that the shape
/// crosses wherever it is put.
std::string wrongExtent(const Specimen& s, Draw&) {
    Box box = s.row.extent(s.k);
    const double far = 1e3 * s.size, further = 1e6 * far;
    std::array<bool, 6> infinite{};
    for (std::size_t i = 0; i < 3; ++i) {
        infinite[2 * i] = std::isinf(box.lo[i]), infinite[2 * i + 1] = std::isinf(box.hi[i]);
        box.lo[i] = std::max(box.lo[i], -far), box.hi[i] = std::min(box.hi[i], far);
    }
    for (int face = 0; face < 6; ++face) {
        Box around = box;  // the face itself far away, and wide enough for a slanted plane to cross it
        for (std::size_t i = 0; i < 3; ++i) {
            if (static_cast<int>(i) == face / 2) continue;
            if (infinite[2 * i]) around.lo[i] = -further;
            if (infinite[2 * i + 1]) around.hi[i] = further;
        }
        const double least = leastOnFace(s, around, face / 2, face % 2 == 1);
        const bool at_infinity = infinite[static_cast<std::size_t>(face)];
        const auto what = [&](std::string_view fault) {
            return fmt::format("{}: {} its extent's {}{} by {}", describe(s, Point(0)), fault, face % 2 ? '+' : '-', "xyz"[face / 2], least);
        };
        if (at_infinity ? !(least < 0) : !(least <= 1e-4 * s.size)) return what("does not reach");
        if (!at_infinity && !(least >= -1e-9 * s.size)) return what("sticks out of");
    }
    return {};
}

/// A metre away from the shape adds a metre to a distance, and to a bound at least what its row says; seen from the extent,
/// which lies between the point and the shape.
std::string slowRise(const Specimen& s, Draw& draw) {
    const Box box = s.row.extent(s.k);
    const double rises = s.row.rises ? s.row.rises(s.k) : 1;
    const auto beyond = [&](std::size_t i, double x) { return std::max({box.lo[i] - x, x - box.hi[i], 0.0}); };
    for (int i = 0; i < 1000; ++i) {
        const Point p = drawPoint(draw, s);
        const double away = norm({beyond(0, p.x), beyond(1, p.y), beyond(2, p.z)});
        if (!(s.at(p) >= rises * away - noise(s, p)) && away > 0) return describe(s, p) + fmt::format(": {} at {} from the extent", s.at(p), away);
    }
    return {};
}

/// The distance to a convex set is a convex function: half-way between two places outside it is no more than the mean.
std::string notConvex(const Specimen& s, Draw& draw) {
    if (!s.row.convex) return {};
    if (!s.row.exact) return fmt::format("{}: convex, though not exact", s.row.name);
    for (int i = 0; i < 1000; ++i) {
        const Point a = drawPoint(draw, s), b = drawPoint(draw, s), middle = (a + b) * 0.5;
        const double mean = 0.5 * (s.at(a) + s.at(b));
        if (s.at(a) <= 0 || s.at(b) <= 0) continue;
        if (!(s.at(middle) <= mean + noise(s, a) + noise(s, b))) return describe(s, middle) + fmt::format(": {} half-way, {} in the mean", s.at(middle), mean);
    }
    return {};
}

}  // namespace

Specimen drawSpecimen(Draw& draw, const Primitive& row) {
    for (;;) {
        // Millimetres to kilometres; lengths of one shape within 1 to 100 of each other.
        const double size = draw.logUniform(1e-3, 1e3);
        const auto k = cooked(row, drawNumbers(draw, row, size, 10));
        if (!k) continue;
        Specimen s{row, *k, size};
        unsigned at = 0;
        for (const Parameter& p : row.parameters)
            for (int i = 0; i < p.size; ++i, ++at) s.size = p.isLength() ? std::max(s.size, std::fabs((*k)[at])) : s.size;
        return s;
    }
}

std::span<const PrimitiveLaw> primitiveLaws() {
    static constexpr PrimitiveLaw kLaws[] = {
        {"gradients match differences", wrongGradient, 60},
        {"the slope is one, or at most one", wrongSlope, 60},
        {"no pair is steeper than one", steeperThanOne, 60},
        {"the distance is that to the surface", wrongDistance, 20},
        {"intervals hold every sample of their box", leakyInterval, 60},
        {"intervals are of use", looseInterval, 20},
        {"float agrees with double", coarseFloat, 60},
        {"the extent is the tightest box", wrongExtent, 20},
        {"the value rises with the distance from the shape", slowRise, 40},
        {"what is called convex is", notConvex, 40},
    };
    return kLaws;
}

}  // namespace mb
