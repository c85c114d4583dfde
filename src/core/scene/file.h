#pragma once
// Files that are read whole, and written whole or not at all: scenes, recordings, pictures, statistics.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace mb {

/// Puts the bytes at the path: other programs see the old file or the new one, whole. A link is followed and stays; the
/// file's permissions stay, and a read-only file is refused. What is no file (a device, a pipe) is refused, or, with
/// `to_streams`, written to as it is. Says why it failed; the old file is then as it was.
std::optional<std::string> writeFile(const std::filesystem::path& path, std::string_view bytes, bool to_streams = false);

/// What a file holds, or why it is not had.
struct FileText {
    std::string bytes;
    std::string disk_fault;  // it could not be read at all ("FILE: No such file or directory")
    std::string fault;       // it is too large
};
/// Reads a regular file of at most `most` bytes; whatever else stands at the path (a folder, a pipe, a device) is a fault of
/// the disk. Never waits.
FileText readFile(const std::filesystem::path& path, std::size_t most);

}  // namespace mb
