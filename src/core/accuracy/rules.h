#pragma once
// The operators once more, on values: the same meaning as the GLSL's, by other formulas.
#include "core/accuracy/intervals.h"
#include "core/sdf/shape.h"

#include <optional>
#include <string_view>

namespace mb::accuracy {

/// A row an operator that stands in a tree, by its name in operators(): a fold's functions or a wrap's.
struct Rule {
    std::string_view name;
    double (*fold)(double a, double b, double k) = nullptr;
    double (*lead)(double a, double b) = nullptr;          // of a fold that blends: how far the second is ahead of the first
    double (*wrap)(double d, glm::dvec3 p, const LeafNumbers&) = nullptr;
    glm::dvec3 (*warp)(glm::dvec3 p, const LeafNumbers&) = nullptr;
    std::optional<SetOperation> plain{};                   // what it is where nothing is blended
};
/// Null where there is none of that name.
const Rule* findRule(std::string_view name);

/// How much of the second child of a fold shows: the derivative of the value by it. Children whose values differ by no more than `tie`
/// are the first's.
double shareOfSecond(const Rule& rule, double a, double b, double k, double tie);

}  // namespace mb::accuracy
