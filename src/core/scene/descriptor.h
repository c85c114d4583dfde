#pragma once
// An open file that closes itself, and how a file's fault is told.
#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace mb {

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

inline std::string fault(const std::filesystem::path& path, std::string_view doing, int error) {
    return fmt::format("{}: {}: {}", path.string(), doing, std::generic_category().message(error));
}
inline std::string_view kindOf(mode_t mode) {
    return S_ISDIR(mode) ? "a folder" : S_ISFIFO(mode) ? "a pipe" : S_ISSOCK(mode) ? "a socket" : "a device";
}

}  // namespace mb
