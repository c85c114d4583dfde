#pragma once
// Runs tests written in GLSL: every `void test_name()` of a text, on the GPU, one pixel each.
#include "core/render/compose.h"
#include "headless.h"

#include <map>
#include <string>
#include <vector>

namespace mb {

struct GlslFailure {
    std::string test, place;  // "tests/glsl/march.glsl:17"
};
struct GlslResults {
    std::vector<std::string> tests;
    std::vector<GlslFailure> failed;
    std::string compile_error;  // in names of files; then nothing ran
};

/// Runs the tests of the file `path` with that text. It may include the files of the shader library and must define what
/// they ask for (map(), nearest()). It is given CHECK(condition), near(a, b), the dialect of shaders/sdf/, and, where it
/// includes lib/blocks.glsl, the frame of a 64 x 48 picture seen from the origin along -z with a vertical angle of 90
/// degrees and the default knobs.
GlslResults runGlslTests(std::string_view path, std::string_view text);

/// The names of the functions `void test_…()` that the text defines, in their order.
std::vector<std::string> glslTests(std::string_view text);

}  // namespace mb
