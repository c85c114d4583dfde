#pragma once
// Pictures as files: 8-bit sRGB PNG, and 32-bit float PFM for the channels that numbers are read from.
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mb {

/// Linear to sRGB, 8 bits, rounded (IEC 61966-2-1, 1999); clamped to [0, 1]; NaN becomes 0.
std::uint8_t srgb8(float linear);
/// RGB bytes of linear pixels.
std::vector<std::uint8_t> encodeSrgb(std::span<const glm::vec3> linear);

/// Each writes a whole file or leaves the old one as it was (core/scene/file.h), and returns what went wrong, or nothing.
/// The top row comes first in the pixels given.
std::string writePng(const std::string& path, glm::ivec2 size, std::span<const glm::vec3> linear);
std::string writePfm(const std::string& path, glm::ivec2 size, std::span<const float> channel);
std::string writePfm(const std::string& path, glm::ivec2 size, std::span<const glm::vec3> channels);

}  // namespace mb
