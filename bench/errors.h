#pragma once
// How far a picture is from the truth.
#include "bench/truth.h"
#include "core/render/renderer.h"

#include <nlohmann/json_fwd.hpp>

namespace mb::bench {

/// A picture's surfaces, the top row first, in whatever a contender can say of them.
struct Surfaces {
    std::vector<float> object;          // the top-level object's number; −1 for none
    std::vector<float> depth;           // m, +inf for a miss; empty: not known
    std::vector<bool> undecided, left_out;  // empty: none
};
Surfaces surfacesOf(const Channels& channels);

/// Fractions of the pixels asked. A pixel that is left out, or undecided, is counted as that and as nothing else.
struct Errors {
    std::size_t pixels = 0;             // asked
    double left_out = 0, undecided = 0;
    double wrong = 0;                   // a hit for a miss, or a miss for a hit
    double wrong_object = 0;            // a hit, but of another object
    double wrong_depth = 0;             // the right object, but more than kDepthTolerance from where it is
    double depth_median = 0, depth_max = 0;  // m, of |depth − truth| where the object is right
};
inline constexpr double kDepthTolerance = 2e-3;  // m: two tolerances of plain sphere tracing to a millimetre
Errors errorsOf(const Surfaces& surfaces, const TruthPicture& truth);

/// Whether a is at most as far from the truth as b; an undecided pixel counts as a wrong one.
bool noWorse(const Errors& a, const Errors& b);

void to_json(nlohmann::ordered_json& json, const Errors& errors);

}  // namespace mb::bench
