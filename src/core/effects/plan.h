#pragma once
// What a picture of a scene takes: which effects its shader is composed with, which record asked for each, how many bounces
// its rays can be worth, and how many passes a frame has. What is not on this list costs nothing, because it is not in the
// program that draws.
#include "core/effects/effect.h"

#include <bitset>

namespace mb {

/// Beyond so many primitives the scene's distance is evaluated through the grid.
inline constexpr std::size_t kStraightLeaves = 12;

/// Rows of the table, by number.
using EffectSet = std::bitset<64>;
/// What is in the program against the scene's own word: to prove that it changes nothing, and to price it.
struct Choice {
    EffectSet on, off;
    friend bool operator==(const Choice&, const Choice&) = default;
};
/// Every row of the picture and every operator.
EffectSet everyEffect();

/// A light's turn: lights [first, last) are summed in one pass; the ambient light comes with the first one.
struct LightPass {
    int first = 0, last = 0;
};

struct Plan {
    struct Called {
        const Effect* effect;
        std::string by;                // the first record that calls for it; empty: it was chosen
    };
    std::vector<Called> called;        // of the picture and the operators, in the order of the table
    int bounces = 0;                   // reflections that the largest Kr is worth following
    bool tetrahedron = false;          // a normal takes 4 evaluations, not 6
    std::vector<LightPass> passes;     // at least one
    std::int64_t loop_iterations = 0;  // the most that any pixel of any pass can make, over all loops of the shader
    std::string refused;               // why the scene cannot be drawn; empty if it can

    bool has(std::string_view name) const;
};

/// llvmpipe ends every shader at 65,535 loop iterations in all, without a word. No pass is planned to come near.
inline constexpr int kLoopLimit = 65'535, kLoopBudget = 60'000;

/// What drawing the scene takes. Where a single light's pass would need more than kLoopBudget, `refused` says which knobs
/// to lower.
Plan makePlan(const Scene& scene, const Tree& tree, const Choice& choice = {});

/// The scene without an operator: of a subtraction the first child, of any other all the children. Without an effect of the
/// picture it is the scene itself: those are left out of the plan.
Scene withoutOperator(const Scene& scene, const Effect& effect);

}  // namespace mb
