#include "core/render/picture.h"

#include "core/measure/srgb.h"
#include "core/scene/file.h"

#include <fmt/format.h>
#include <png.h>

#include <bit>
#include <cmath>
#include <optional>

namespace mb {
namespace {

std::string orNothing(std::optional<std::string> why) { return why.value_or(std::string()); }

std::string writePfmBytes(const std::string& path, glm::ivec2 size, const char* kind, std::size_t channels, const float* pixels) {
    static_assert(std::endian::native == std::endian::little, "the file says so");
    std::string bytes = fmt::format("{}\n{} {}\n-1.0\n", kind, size.x, size.y);
    const std::size_t row = static_cast<std::size_t>(size.x) * channels;
    for (int y = size.y - 1; y >= 0; --y)  // a PFM counts its rows from the bottom
        bytes.append(reinterpret_cast<const char*>(pixels + static_cast<std::size_t>(y) * row), row * sizeof(float));
    return orNothing(writeFile(path, bytes, true));
}

}  // namespace

std::uint8_t srgb8(float linear) { return static_cast<std::uint8_t>(std::lround(255 * toSrgb(static_cast<double>(linear)))); }

std::vector<std::uint8_t> encodeSrgb(std::span<const glm::vec3> linear) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * linear.size());
    for (const glm::vec3& c : linear)
        for (int i = 0; i < 3; ++i) bytes.push_back(srgb8(c[i]));
    return bytes;
}

std::string writePng(const std::string& path, glm::ivec2 size, std::span<const glm::vec3> linear) {
    const std::vector<std::uint8_t> bytes = encodeSrgb(linear);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(size.x), image.height = static_cast<png_uint_32>(size.y);
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t room = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string file(room, '\0');
    if (!png_image_write_to_memory(&image, file.data(), &room, 0, bytes.data(), 0, nullptr)) return fmt::format("{}: {}", path, image.message);
    return orNothing(writeFile(path, std::string_view(file).substr(0, room), true));
}

std::string writePfm(const std::string& path, glm::ivec2 size, std::span<const float> channel) {
    return writePfmBytes(path, size, "Pf", 1, channel.data());
}
std::string writePfm(const std::string& path, glm::ivec2 size, std::span<const glm::vec3> channels) {
    return writePfmBytes(path, size, "PF", 3, &channels.data()->x);
}

}  // namespace mb
