#include "cli/cli.h"

#include "core/render/targets.h"
#include "core/scene/file.h"

#include <fmt/format.h>

#include <algorithm>

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>

namespace mb::cli {

Exit reportFaults(std::span<const Fault> warnings, std::span<const Fault> faults, const std::string& disk_fault, const std::string& path,
                  const Common& common) {
    if (!common.quiet)
        for (const Fault& fault : warnings) fmt::print(stderr, "{}\n", describe(fault, path, "warning"));
    for (const Fault& fault : faults) fmt::print(stderr, "{}\n", describe(fault, path));
    if (!disk_fault.empty()) {
        fmt::print(stderr, "{}\n", disk_fault);
        return kDiskFault;
    }
    return faults.empty() ? kDone : kInputFault;
}

Scene readSceneFile(const std::string& path, const std::vector<std::string>& settings, const Common& common) {
    LoadResult loaded = loadScene(path);
    if (const Exit code = reportFaults(loaded, path, common); code != kDone) throw Failure{code, {}};
    for (const std::string& setting : settings)
        if (const auto why = setKnob(loaded.scene, setting)) throw Failure{kCommandFault, "--set " + setting + ": " + *why};
    return std::move(loaded.scene);
}

std::unique_ptr<Context> headlessContext() {
    std::string why;
    auto context = makeHeadless(Headless::any, why);
    if (!context) throw Failure{kNoOpenGl, "no OpenGL context can be had: " + why};
    return context;
}

Progress::Progress(std::string what, std::uint64_t total, const Common& common)
    : what_(std::move(what)), total_(total), on_(!common.quiet && total > 1 && isatty(STDERR_FILENO)) {}

Progress::~Progress() {
    if (on_ && percent_ >= 0) fmt::print(stderr, "\r\033[K");
}

void Progress::show(std::uint64_t done) {
    const int percent = static_cast<int>(100 * done / total_);
    if (!on_ || percent == percent_) return;
    percent_ = percent;
    constexpr int kWidth = 30;
    const int filled = kWidth * percent / 100;
    fmt::print(stderr, "\r{} [{:#<{}}{:.<{}}] {:3} %", what_, "", filled, "", kWidth - filled, percent);
    std::fflush(stderr);
}

Camera cameraNamed(const Scene& scene, const std::string& name) {
    if (name.empty()) return defaultCamera(scene);
    const auto camera = std::ranges::find(scene.cameras, name, &Camera::name);
    if (camera == scene.cameras.end()) throw Failure{kInputFault, fmt::format("the scene has no camera named '{}'", name)};
    return *camera;
}

void addSettings(CLI::App& app, std::vector<std::string>& settings) {
    app.add_option("--set", settings, "any key of the scene's render, physics or world record, as KEY=VALUE; repeatable")
        ->allow_extra_args(false);
}

void writeText(const std::string& path, const std::string& text) {
    if (path != "-") {
        if (const auto why = writeFile(path, text, true)) throw Failure{kDiskFault, *why};
        return;
    }
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
        throw Failure{kDiskFault, fmt::format("standard output: {}", std::strerror(errno))};
}

glm::ivec2 parseSize(const std::string& text) {
    glm::ivec2 size{0};
    const char* const end = text.data() + text.size();
    const auto [x, x_error] = std::from_chars(text.data(), end, size.x);
    if (x_error == std::errc{} && x != end && *x == 'x') {
        const auto [y, y_error] = std::from_chars(x + 1, end, size.y);
        if (y_error == std::errc{} && y == end && size.x > 0 && size.y > 0) return size;
    }
    throw Failure{kCommandFault, fmt::format("--size {}: expected WxH, as in 640x360", text)};
}

void checkSize(glm::ivec2 size) {
    if (const int most = maxTargetSize(); size.x > most || size.y > most)
        throw Failure{kCommandFault, fmt::format("--size {}x{}: each side must be at most {}", size.x, size.y, most)};
}

CLI::Validator within(double lo, double hi) {
    return CLI::Validator(
        [lo, hi](std::string& text) -> std::string {
            double value = 0;
            const bool number = CLI::detail::lexical_cast(text, value);
            return number && value >= lo && value <= hi ? "" : fmt::format("{}: expected a number from {} to {}", text, lo, hi);
        },
        fmt::format("{}..{}", lo, hi));
}

}  // namespace mb::cli
