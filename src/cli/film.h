#pragma once
// A film, encoded by ffmpeg from the frames it is fed through a pipe.
#include "cli/cli.h"

#include <glm/vec2.hpp>

#include <span>

#include <sys/types.h>

namespace mb::cli {

class Film {
public:
    /// Starts ffmpeg; a failure carries code 4 where it is missing or refuses.
    Film(const std::string& path, glm::ivec2 size, double frames_per_second);
    ~Film();
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;
    /// One frame of RGB bytes, the top row first.
    void add(std::span<const std::uint8_t> rgb);
    /// Waits for ffmpeg and puts the film in its place; without it no file is left or changed.
    void finish();

private:
    [[noreturn]] void fail(const std::string& why);
    std::string path_, partial_;  // ffmpeg writes beside the film's place; finish() puts it there
    pid_t child_ = -1;
    int pipe_ = -1;
};

}  // namespace mb::cli
