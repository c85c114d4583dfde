#pragma once
// The benchmarks' own shaders and the twins' scenes, put into the program when it is built.
#include "core/render/shader_texts.h"

namespace mb {

std::span<const ShaderText> benchTexts();

}  // namespace mb
