#pragma once
// Files that are written whole or not at all: scenes, pictures, statistics.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace mb {

/// Puts the bytes at the path: other programs see the old file or the new one, whole. A link is followed and stays; the
/// file's permissions stay, and a read-only file is refused. What is no file (a device, a pipe) is refused, or, with
/// `to_streams`, written to as it is. Says why it failed; the old file is then as it was.
std::optional<std::string> writeFile(const std::filesystem::path& path, std::string_view bytes, bool to_streams = false);

}  // namespace mb
