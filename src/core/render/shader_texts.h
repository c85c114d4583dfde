#pragma once
// The shader library, put into the program when it is built.
#include <span>
#include <string_view>

namespace mb {

struct ShaderText {
    std::string_view path;  // below shaders/: "lib/march.glsl"
    std::string_view text;
};
std::span<const ShaderText> shaderTexts();

}  // namespace mb
