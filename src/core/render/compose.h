#pragma once
// Makes a shader's text: the library with its includes resolved, the scene's own map() and nearest() in their place, and
// above it what the scene calls for.
#include "core/effects/plan.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mb {

/// A text put together from files, with `#line` directives so that a compiler's message can be traced back.
struct Composed {
    std::string text;
    std::vector<std::string> files;  // the file that the compiler calls number i
};

using Texts = std::map<std::string, std::string, std::less<>>;

/// The texts of the shader library, by path below shaders/.
const Texts& shaderLibrary();

/// The file `path` of `texts` with every `#include "FILE"` line replaced by that file (once: a second include of the same
/// file is dropped) and `head` put behind its #version line. A missing file leaves an #error in its place.
Composed resolve(const Texts& texts, std::string_view path, std::string_view head = {});

/// A compiler's log with the file numbers of `composed` replaced by names: "lib/march.glsl:12: …".
std::string readableLog(const Composed& composed, std::string_view log);

/// map() and nearest() for a tree, as straight-line GLSL that reads every number from the blocks by a constant index. Two
/// trees that differ in values only give the same text.
std::string sceneGlsl(const Tree& tree);

/// The definitions above a shader: array sizes, and the switches of the effects called for.
struct Sizes {
    std::size_t leaves, branches, materials, lights;
};
std::string head(const Plan& plan, const Sizes& sizes, bool counted);

}  // namespace mb
