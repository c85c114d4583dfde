#pragma once
// Makes a shader's text: the library with its includes resolved, the scene's own map() and nearest() in their place, what the
// effects called for do at their places in the story, and above it their switches.
#include "core/effects/plan.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mb {

/// A text put together from files, with `#line` directives so that a compiler's message can be traced back. Line l of file i
/// is called line i · kFileLines + l: Mesa forgets the file number that a #line states, but not the line.
struct Composed {
    std::string text;
    std::vector<std::string> files;
};
inline constexpr int kFileLines = 100'000;

/// The place of a line as a compiler knows it: "lib/march.glsl:12".
std::string readablePlace(const Composed& composed, long line);

using Texts = std::map<std::string, std::string, std::less<>>;

/// The texts of the shader library, by path below shaders/.
const Texts& shaderLibrary();

/// The file `path` of `texts` with every `#include "FILE"` line replaced by that file (once: a second include of the same
/// file is dropped) and `head` put behind its #version line. A missing file leaves an #error in its place. A line
/// `#effects PLACE` is replaced by the text of that name, which putEffects() makes, or by nothing.
Composed resolve(const Texts& texts, std::string_view path, std::string_view head = {});

/// A compiler's log with the places in `composed` replaced by names: "lib/march.glsl:12: …".
std::string readableLog(const Composed& composed, std::string_view log);

/// map() and nearest() for a tree, as straight-line GLSL that reads every number from the blocks by a constant index. Two
/// trees that differ in values only give the same text.
std::string sceneGlsl(const Tree& tree);

/// The same as a loop over the items of the point's cell (core/sdf/grid.h), for the types of primitives and operators that
/// the tree holds, and for the operators chosen beside: two trees of the same types give the same text.
std::string gridGlsl(const Tree& tree, const EffectSet& chosen = {});

/// Adds the texts that stand for `#effects PLACE`: behind "files" the effects' files and the functions that read their keys, at
/// every other place the statements of the effects in the plan, in the order of the table.
void putEffects(Texts& io_texts, const Plan& plan);

/// The definitions above a shader: array sizes, the switches of the effects in the plan, each the number of its row, and what else
/// is not in the text where it is not needed: loops over lights, turns of lights, normals.
struct Sizes {
    std::size_t leaves, branches, materials, lights;
    bool turned = true;  // some leaf or operator has other axes than its space
    bool carved = true;  // some operator takes away: there may be a surface without an inside
};
std::string head(const Plan& plan, const Sizes& sizes, bool counted, bool grid = false);

}  // namespace mb
