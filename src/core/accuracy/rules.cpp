#include "core/accuracy/rules.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>

namespace mb::accuracy {
namespace {

constexpr double kTwoPi = 6.28318530717958647692;

// Quilez, "Smooth minimum" (2013), the quadratic polynomial: where the values differ by less than k, the parabola that meets both
// lines with their slopes.
double unite(double a, double b, double k) {
    const double apart = b - a;
    if (std::fabs(apart) >= k) return std::min(a, b);
    return (a + b) / 2 - k / 4 - apart * apart / (4 * k);
}
double intersect(double a, double b, double k) { return -unite(-a, -b, k); }
double subtract(double a, double b, double k) { return intersect(a, -b, k); }
double morph(double a, double b, double t) { return a + t * (b - a); }

double leadOfUnion(double a, double b) { return a - b; }
double leadOfIntersect(double a, double b) { return b - a; }
double leadOfSubtract(double a, double b) { return -b - a; }

/// Inside the shape, and not deeper than the wall is thick.
double shell(double d, glm::dvec3, const LeafNumbers& k) { return std::max(d, -d - k[0]); }
double swell(double d, glm::dvec3, const LeafNumbers& k) { return d - k[0]; }
/// Numbers: amplitude, frequency, ease.
double displace(double d, glm::dvec3 p, const LeafNumbers& k) {
    const glm::dvec3 phase = p * (kTwoPi * k[1]);
    const double waves = d + k[0] * std::sin(phase.x) * std::sin(phase.y) * std::sin(phase.z);
    return std::max(waves * k[2], d - k[0]);
}

// Numbers of a warp: turns a metre, reach, ease. The child lies within the reach of the axis. A point beyond it is asked about the
// nearest point within, and its value is the way there and the eased value from there, at right angles.
glm::dvec2 pulledIn(glm::dvec2 q, double reach) {
    const double away = glm::length(q);
    return away > reach ? q * (reach / away) : q;
}
glm::dvec2 turned(glm::dvec2 q, double turns) {
    const double c = std::cos(kTwoPi * turns), s = std::sin(kTwoPi * turns);
    return {c * q.x - s * q.y, s * q.x + c * q.y};
}
double easedValue(double d, glm::dvec2 across, const LeafNumbers& k) {
    const double beyond = glm::length(across) - k[1];
    return beyond > 0 ? std::hypot(beyond, std::max(k[2] * d, 0.0)) : k[2] * d;
}
glm::dvec3 warpTwist(glm::dvec3 p, const LeafNumbers& k) {
    const glm::dvec2 q = turned(pulledIn({p.x, p.z}, k[1]), k[0] * p.y);
    return {q.x, p.y, q.y};
}
glm::dvec3 warpBend(glm::dvec3 p, const LeafNumbers& k) {
    const glm::dvec2 in = pulledIn({p.x, p.y}, k[1]), q = turned(in, -k[0] * in.x);
    return {q.x, q.y, p.z};
}
double twist(double d, glm::dvec3 p, const LeafNumbers& k) { return easedValue(d, {p.x, p.z}, k); }
double bend(double d, glm::dvec3 p, const LeafNumbers& k) { return easedValue(d, {p.x, p.y}, k); }

constexpr Rule kRules[] = {
    {.name = "union", .fold = unite, .lead = leadOfUnion, .plain = SetOperation::unite},
    {.name = "intersect", .fold = intersect, .lead = leadOfIntersect, .plain = SetOperation::intersect},
    {.name = "subtract", .fold = subtract, .lead = leadOfSubtract, .plain = SetOperation::subtract},
    {.name = "morph", .fold = morph},
    {.name = "shell", .wrap = shell},
    {.name = "round", .wrap = swell},
    {.name = "displace", .wrap = displace},
    {.name = "twist", .wrap = twist, .warp = warpTwist},
    {.name = "bend", .wrap = bend, .warp = warpBend},
};

}  // namespace

const Rule* findRule(std::string_view name) {
    for (const Rule& rule : kRules)
        if (rule.name == name) return &rule;
    return nullptr;
}

double shareOfSecond(const Rule& rule, double a, double b, double k, double tie) {
    if (!rule.lead) return k;  // a morph's
    const double lead = rule.lead(a, b), ahead = k > tie ? lead : lead - tie;
    return k > 0 ? std::clamp((k + ahead) / (2 * k), 0.0, 1.0) : ahead > 0 ? 1 : 0;
}

}  // namespace mb::accuracy
