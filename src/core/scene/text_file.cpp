// Scenes as files. Reading never waits for a writer, and a save is another file renamed over the old one.
#include "core/scene/keys.h"
#include "core/scene/text.h"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace mb {
namespace {

namespace fs = std::filesystem;

class Descriptor {
public:
    explicit Descriptor(int fd = -1) : fd_(fd) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }
    int get() const { return fd_; }
    explicit operator bool() const { return fd_ >= 0; }
    bool close() { return fd_ < 0 || ::close(std::exchange(fd_, -1)) == 0; }
    void open(const char* path, int flags, mode_t mode = 0) {
        close();
        do fd_ = ::open(path, flags | O_CLOEXEC, mode); while (fd_ < 0 && errno == EINTR);
    }

private:
    int fd_;
};

std::string reason(int error) { return std::generic_category().message(error); }
std::string fault(const fs::path& path, std::string_view doing, int error) {
    return fmt::format("{}: {}: {}", path.string(), doing, reason(error));
}
std::string_view kindOf(mode_t mode) {
    return S_ISDIR(mode) ? "a folder" : S_ISFIFO(mode) ? "a pipe" : S_ISSOCK(mode) ? "a socket" : "a device";
}

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

bool writeAll(int fd, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(fd, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
}

/// The file that a path's links lead to, which need not exist; errno tells of a failure.
std::optional<fs::path> followLinks(fs::path path) {
    for (int links = 0; links < 40; ++links) {
        std::error_code error;
        if (!fs::is_symlink(fs::symlink_status(path, error))) return path;
        const fs::path to = fs::read_symlink(path, error);
        if (error) return errno = error.value(), std::nullopt;
        path = path.parent_path() / to;  // the whole of `to` where that is absolute
    }
    return errno = ELOOP, std::nullopt;
}

fs::path folderOf(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

/// The one place where a save of this file keeps its unfinished text: what a killed save left there, the next one clears.
fs::path unfinished(const fs::path& path) {
    std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a of the name, which may itself be as long as names can be
    for (const char c : path.filename().string()) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return folderOf(path) / fmt::format(".marchbox-{:016x}.tmp", hash);
}

/// Makes the unfinished file, new and empty. While it is being written its lock is held; one that is there and not locked
/// was left by a save that was killed.
bool create(const fs::path& temp, Descriptor& file) {
    using namespace std::chrono_literals;
    for (int attempt = 0; attempt < 500; ++attempt) {
        file.open(temp.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, 0666);
        if (file) {
            struct stat made{};
            if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) continue;  // taken for a stale one
            if (::fstat(file.get(), &made) == 0 && made.st_nlink == 0) continue;
            return true;
        }
        if (errno != EEXIST) return false;
        Descriptor other;
        other.open(temp.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
        if (!other && errno == ENOENT) continue;
        if (!other) return false;
        if (::flock(other.get(), LOCK_EX | LOCK_NB) == 0) {
            struct stat opened{}, named{};
            const bool same = ::fstat(other.get(), &opened) == 0 && ::lstat(temp.c_str(), &named) == 0 &&
                              opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
            if (same && ::unlink(temp.c_str()) != 0) return false;
        } else std::this_thread::sleep_for(10ms);
    }
    return errno = EBUSY, false;
}

/// Replaces the file by these bytes; errno tells why it could not, and `doing` at what.
bool replace(const fs::path& path, const struct stat* old, std::string_view bytes, std::string_view& doing) {
    const fs::path temp = unfinished(path);
    Descriptor file;
    doing = "cannot make a file beside it";
    if (!create(temp, file)) return false;
    const auto fail = [&] {
        const int error = errno;
        ::unlink(temp.c_str());  // before the lock goes
        return errno = error, false;
    };
    doing = "cannot write";
    if (old) {
        if (::fchown(file.get(), old->st_uid, old->st_gid) != 0) errno = 0;  // only root can give files away
        if (::fchmod(file.get(), old->st_mode & 07777) != 0) return fail();
    }
    if (!writeAll(file.get(), bytes)) return fail();
    if (::fsync(file.get()) != 0 && errno != EINVAL && errno != ENOTSUP) return fail();
    doing = "cannot replace";
    if (::rename(temp.c_str(), path.c_str()) != 0) return fail();
    doing = "cannot write";
    if (!file.close()) return false;
    // The new file is in place. That its name outlives a power failure too is asked for; not every file system can promise.
    Descriptor folder;
    folder.open(folderOf(path).c_str(), O_RDONLY | O_DIRECTORY);
    if (folder) ::fsync(folder.get());
    return true;
}

}  // namespace

LoadResult loadScene(const fs::path& path) {
    LoadResult result;
    Descriptor file;
    file.open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY);  // a pipe without a writer would wait
    struct stat info{};
    if (!file || ::fstat(file.get(), &info) != 0) {
        result.disk_fault = fault(path, "cannot read", errno);
    } else if (!S_ISREG(info.st_mode)) {
        result.disk_fault = fmt::format("{}: cannot read: it is {}, expected a file", path.string(), kindOf(info.st_mode));
    } else if (info.st_size > static_cast<off_t>(Limits::file_bytes)) {
        result.faults.push_back({1, 1, fmt::format("the file has {} bytes, expected at most {} (64 MiB)", info.st_size, Limits::file_bytes)});
    } else if (std::string bytes; readAll(file.get(), Limits::file_bytes, bytes)) {
        static_cast<ReadResult&>(result) = readScene(bytes);
    } else {
        result.disk_fault = fault(path, "cannot read", errno);
    }
    return result;
}

std::optional<std::string> saveScene(const fs::path& path, const Scene& scene) {
    const std::string bytes = writeScene(scene);
    if (const ReadResult back = readScene(bytes); !back.ok())
        return fmt::format("{}: not saved: {}", path.string(), back.faults.front().message);

    const std::optional<fs::path> target = followLinks(path);
    if (!target) return fault(path, "cannot write", errno);
    struct stat old{};
    const bool exists = ::stat(target->c_str(), &old) == 0;
    if (!exists && errno != ENOENT) return fault(path, "cannot write", errno);
    if (exists && !S_ISREG(old.st_mode))
        return fmt::format("{}: cannot write: it is {}, expected a file", path.string(), kindOf(old.st_mode));
    // A rename would replace a file that its owner made read-only.
    if (exists && ::faccessat(AT_FDCWD, target->c_str(), W_OK, AT_EACCESS) != 0) return fault(path, "cannot write", errno);
    std::string_view doing;
    if (!replace(*target, exists ? &old : nullptr, bytes, doing)) return fault(path, doing, errno);
    return std::nullopt;
}

}  // namespace mb
