// Files read whole, and scenes as files.
#include "core/scene/descriptor.h"
#include "core/scene/file.h"
#include "core/scene/keys.h"
#include "core/scene/text.h"

namespace mb {
namespace {

namespace fs = std::filesystem;

/// Reads to the end, or to the first byte beyond the limit.
bool readAll(int fd, std::size_t limit, std::string& out) {
    char buffer[1 << 16];
    while (out.size() <= limit) {
        const ssize_t n = ::read(fd, buffer, sizeof buffer);
        if (n == 0) return true;
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        out.append(buffer, static_cast<std::size_t>(n));
    }
    return true;
}

}  // namespace

FileText readFile(const fs::path& path, std::size_t most) {
    FileText result;
    Descriptor file;
    file.open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY);  // a pipe without a writer would wait
    struct stat info{};
    if (!file || ::fstat(file.get(), &info) != 0)
        result.disk_fault = fault(path, "cannot read", errno);
    else if (!S_ISREG(info.st_mode))
        result.disk_fault = fmt::format("{}: cannot read: it is {}, expected a file", path.string(), kindOf(info.st_mode));
    else if (info.st_size > static_cast<off_t>(most))
        result.fault = fmt::format("the file has {} bytes, expected at most {} ({} MiB)", info.st_size, most, most >> 20);
    else if (!readAll(file.get(), most, result.bytes))
        result.disk_fault = fault(path, "cannot read", errno);
    return result;
}

LoadResult loadScene(const fs::path& path) {
    FileText file = readFile(path, Limits::file_bytes);
    LoadResult result;
    if (!file.disk_fault.empty()) result.disk_fault = std::move(file.disk_fault);
    else if (!file.fault.empty()) result.faults.push_back({1, 1, std::move(file.fault)});
    else static_cast<ReadResult&>(result) = readScene(file.bytes);
    return result;
}

std::optional<std::string> saveScene(const fs::path& path, const Scene& scene) {
    const std::string bytes = writeScene(scene);
    if (const ReadResult back = readScene(bytes); !back.ok())
        return fmt::format("{}: not saved: {}", path.string(), back.faults.front().message);
    return writeFile(path, bytes);
}

}  // namespace mb
