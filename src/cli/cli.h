#pragma once
// What the subcommands share: the exit codes, the options every one has, and reading a scene or saying why not.
#include "core/render/context.h"
#include "core/scene/text.h"
#include "core/sdf/tree.h"

#include <CLI/CLI.hpp>
#include <glm/vec2.hpp>

#include <memory>
#include <string>
#include <vector>

namespace mb::cli {

enum Exit : int { kDone = 0, kInputFault = 1, kCommandFault = 2, kNoOpenGl = 3, kDiskFault = 4 };

/// Ends the command with a code; main prints the message, if there is one. Thrown within the command line only.
struct Failure {
    Exit code;
    std::string message;
};

/// The scene's tree; a scene that cannot be evaluated is an input's fault.
inline Tree treeOf(const Scene& scene) {
    Tree tree = makeTree(scene);
    if (!tree.fault.empty()) throw Failure{kInputFault, tree.fault};
    return tree;
}

/// --quiet and --seed, which every command takes.
struct Common {
    bool quiet = false;
    std::uint64_t seed = 1;
};

/// A subcommand's row: its name, what --help says of it, an example, and what it does with its options.
struct Command {
    const char* name;
    const char* help;
    const char* example;
    /// Adds its options to `app` and returns what runs when it is chosen.
    std::function<void()> (*make)(CLI::App& app, Common& common);
};
extern const Command kEdit, kRender, kSimulate, kReplay, kEval, kEffects, kAccuracy, kCheck, kBench;

/// The scene of the file, with each `settings` KEY=VALUE applied. Prints the file's warnings unless told to be quiet, and
/// its faults; a failure carries code 1, 2 (a setting) or 4.
Scene readSceneFile(const std::string& path, const std::vector<std::string>& settings, const Common& common);

/// The scene's camera of that name, or the one looked through where the name is empty; a failure with code 1 where it has none.
Camera cameraNamed(const Scene& scene, const std::string& name);

/// Prints the faults (or the disk's fault) of a file on standard error; the code they mean.
Exit reportFaults(std::span<const Fault> warnings, std::span<const Fault> faults, const std::string& disk_fault, const std::string& path,
                  const Common& common);
template <class Loaded> Exit reportFaults(const Loaded& loaded, const std::string& path, const Common& common) {
    return reportFaults(loaded.warnings, loaded.faults, loaded.disk_fault, path, common);
}

/// A current context with no window, or a failure with code 3.
std::unique_ptr<Context> headlessContext();

/// A line on standard error that overwrites itself where that is a terminal; nothing in a pipe or when quiet.
class Progress {
public:
    Progress(std::string what, std::uint64_t total, const Common& common);
    ~Progress();
    void show(std::uint64_t done);

private:
    std::string what_;
    std::uint64_t total_;
    bool on_;
    int percent_ = -1;
};

/// The command line's --set, for the commands that take it.
void addSettings(CLI::App& app, std::vector<std::string>& settings);

/// The size of --size WxH, or a failure with code 2; and a failure where the current context cannot draw a picture of that size.
glm::ivec2 parseSize(const std::string& text);
void checkSize(glm::ivec2 size);

/// A number from lo to hi; not NaN, which CLI::Range lets through.
CLI::Validator within(double lo, double hi);

/// Text to a file, or to standard output for "-"; a failure carries code 4.
void writeText(const std::string& path, const std::string& text);

}  // namespace mb::cli
