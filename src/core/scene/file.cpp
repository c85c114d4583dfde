// A save is another file, renamed over the old one.
#include "core/scene/file.h"

#include "core/scene/descriptor.h"

#include <chrono>
#include <cstdint>
#include <thread>

#include <sys/file.h>

namespace mb {
namespace {

namespace fs = std::filesystem;

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

/// Writes into what is there already, from its beginning.
std::optional<std::string> writeStream(const fs::path& path, std::string_view bytes) {
    Descriptor stream;
    stream.open(path.c_str(), O_WRONLY | O_NOCTTY);
    if (!stream || !writeAll(stream.get(), bytes) || !stream.close()) return fault(path, "cannot write", errno);
    return std::nullopt;
}

}  // namespace

std::optional<std::string> writeFile(const fs::path& path, std::string_view bytes, bool to_streams) {
    const std::optional<fs::path> target = followLinks(path);
    if (!target) return fault(path, "cannot write", errno);
    struct stat old{};
    const bool exists = ::stat(target->c_str(), &old) == 0;
    if (!exists && errno != ENOENT) return fault(path, "cannot write", errno);
    if (exists && !S_ISREG(old.st_mode)) {
        if (to_streams && !S_ISDIR(old.st_mode)) return writeStream(*target, bytes);
        return fmt::format("{}: cannot write: it is {}, expected a file", path.string(), kindOf(old.st_mode));
    }
    // A rename would replace a file that its owner made read-only; what root may do is not what was meant.
    const bool read_only = exists && (old.st_mode & 0222) == 0;
    if (read_only || (exists && ::faccessat(AT_FDCWD, target->c_str(), W_OK, AT_EACCESS) != 0))
        return fault(path, "cannot write", read_only ? EACCES : errno);
    std::string_view doing;
    if (!replace(*target, exists ? &old : nullptr, bytes, doing)) return fault(path, doing, errno);
    return std::nullopt;
}

}  // namespace mb
