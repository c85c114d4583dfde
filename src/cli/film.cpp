#include "cli/film.h"

#include <fmt/format.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <utility>

namespace mb::cli {

Film::Film(const std::string& path, glm::ivec2 size, double frames_per_second)
    : path_(path), partial_(fmt::format("{}.{}.part.mp4", path, getpid())) {
    int ends[2];
    if (pipe(ends) != 0) fail(std::strerror(errno));
    std::signal(SIGPIPE, SIG_IGN);  // an ffmpeg that dies is an error of write
    const std::string out = "file:" + partial_;  // whatever the name begins with, it is no option and no protocol
    const std::string pixels = fmt::format("{}x{}", size.x, size.y), rate = fmt::format("{}", frames_per_second);
    child_ = fork();
    if (child_ == 0) {
        dup2(ends[0], STDIN_FILENO);
        close(ends[0]);
        close(ends[1]);
        // H.264 in 4:2:0 wants even sides: an odd one is padded by a pixel.
        execlp("ffmpeg", "ffmpeg", "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", pixels.c_str(), "-r", rate.c_str(),
               "-i", "-", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", out.c_str(), static_cast<char*>(nullptr));
        _exit(127);
    }
    close(ends[0]);
    pipe_ = ends[1];
    if (child_ < 0) fail(std::strerror(errno));
}

Film::~Film() {
    if (pipe_ >= 0) close(pipe_);
    if (child_ > 0) waitpid(child_, nullptr, 0);
    std::remove(partial_.c_str());
}

void Film::add(std::span<const std::uint8_t> rgb) {
    while (!rgb.empty()) {
        const ssize_t written = write(pipe_, rgb.data(), rgb.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) finish();
        if (written < 0) fail("ffmpeg stopped reading");
        rgb = rgb.subspan(static_cast<std::size_t>(written));
    }
}

void Film::finish() {
    close(std::exchange(pipe_, -1));
    int status = 0;
    waitpid(std::exchange(child_, -1), &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127) fail("ffmpeg, which encodes films, is not installed");
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail("ffmpeg failed");
    if (std::rename(partial_.c_str(), path_.c_str()) != 0) fail(std::strerror(errno));
}

void Film::fail(const std::string& why) { throw Failure{kDiskFault, path_ + ": " + why}; }

}  // namespace mb::cli
