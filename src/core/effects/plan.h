#pragma once
// What a scene calls for: which effects the shader is composed with, which record asked for each, and how many passes a
// frame takes. What is not on this list costs nothing, because it is not in the program that draws.
#include "core/sdf/tree.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mb {

/// One row an effect: its name, the shader's switch (or none, where the scene's own text carries it), what it does, and
/// the record that calls for it ("" where none does).
struct Effect {
    std::string_view name, define, what;
    std::string (*calledForBy)(const Scene&, const Tree&);
};
std::span<const Effect> effects();

/// A light's turn: lights [first, last) are summed in one pass; the ambient light comes with the first one.
struct LightPass {
    int first = 0, last = 0;
};

struct Plan {
    struct Called {
        const Effect* effect;
        std::string by;
    };
    std::vector<Called> called;
    std::vector<LightPass> passes;     // at least one
    std::int64_t loop_iterations = 0;  // the most that any pixel of any pass can make, over all loops of the shader
    std::string refused;               // why the scene cannot be drawn; empty if it can

    bool has(std::string_view name) const;
};

/// llvmpipe ends every shader at 65,535 loop iterations in all, without a word. No pass is planned to come near.
inline constexpr int kLoopLimit = 65'535, kLoopBudget = 60'000;

/// What drawing the scene takes. Where a single light's pass would need more than kLoopBudget, `refused` says which knobs
/// to lower.
Plan makePlan(const Scene& scene, const Tree& tree);

}  // namespace mb
