#include "core/render/picture.h"

#include <fmt/format.h>
#include <png.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

namespace mb {
namespace {

struct CloseFile {
    void operator()(std::FILE* f) const { std::fclose(f); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Writes through `fill` into a file beside `path` and renames it, so that a failure leaves no half of a picture.
template <class F> std::string writeWhole(const std::string& path, F fill) {
    const std::string partial = path + ".part";
    File file(std::fopen(partial.c_str(), "wb"));
    if (!file) return fmt::format("{}: {}", path, std::strerror(errno));
    bool written = fill(file.get()) && std::fflush(file.get()) == 0;
    const int error = errno;
    written = std::fclose(file.release()) == 0 && written;
    if (written && std::rename(partial.c_str(), path.c_str()) == 0) return {};
    const std::string why = fmt::format("{}: {}", path, std::strerror(written ? errno : error));
    std::remove(partial.c_str());
    return why;
}

std::string writePfmBytes(const std::string& path, glm::ivec2 size, const char* kind, std::size_t channels, const float* pixels) {
    static_assert(std::endian::native == std::endian::little, "the file says so");
    return writeWhole(path, [&](std::FILE* file) {
        if (std::fprintf(file, "%s\n%d %d\n-1.0\n", kind, size.x, size.y) < 0) return false;
        const std::size_t row = static_cast<std::size_t>(size.x) * channels;
        for (int y = size.y - 1; y >= 0; --y)  // a PFM counts its rows from the bottom
            if (std::fwrite(pixels + static_cast<std::size_t>(y) * row, sizeof(float), row, file) != row) return false;
        return true;
    });
}

}  // namespace

std::uint8_t srgb8(float linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    const double c = static_cast<double>(linear);
    const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

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
    return writeWhole(path, [&](std::FILE* file) { return png_image_write_to_stdio(&image, file, 0, bytes.data(), 0, nullptr) != 0; });
}

std::string writePfm(const std::string& path, glm::ivec2 size, std::span<const float> channel) {
    return writePfmBytes(path, size, "Pf", 1, channel.data());
}
std::string writePfm(const std::string& path, glm::ivec2 size, std::span<const glm::vec3> channels) {
    return writePfmBytes(path, size, "PF", 3, &channels.data()->x);
}

}  // namespace mb
