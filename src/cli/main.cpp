// marchbox: chooses the subcommand.
#include "cli/cli.h"

#include <fmt/format.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>

namespace {

using namespace mb::cli;

const Command* const kCommands[] = {&kEdit, &kRender, &kSimulate, &kReplay, &kEval, &kEffects, &kAccuracy, &kCheck, &kBench};

/// A word in a command's place that is neither a command nor a file is taken for a mistyped command.
void refuseUnknown(const std::string& word) {
    if (word.find_first_of("./") != std::string::npos || std::filesystem::exists(word)) return;
    throw Failure{kCommandFault, fmt::format("there is neither a command nor a scene '{}'; marchbox --help lists the commands", word)};
}

/// Runs what the arguments ask for; with no subcommand, the editor on the scene named, if any.
int run(int argc, char** argv) {
    CLI::App app{"marchbox: a scene editor and laboratory for signed distance functions", "marchbox"};
    app.set_version_flag("--version", "marchbox 0.1");
    app.require_subcommand(0, 1);
    app.footer("marchbox [SCENE] opens the editor. Each command has its own --help.");
    Common common;
    std::vector<std::function<void()>> runs;
    std::vector<CLI::App*> subcommands;
    for (const Command* command : kCommands) {
        CLI::App* sub = app.add_subcommand(command->name, command->help);
        sub->footer(std::string("Example:\n  ") + command->example);
        sub->add_flag("--quiet", common.quiet, "say nothing but errors");
        sub->add_option("--seed", common.seed, "of what is random: where the editor's throws begin, the benchmarks' scenes");
        runs.push_back(command->make(*sub, common));
        subcommands.push_back(sub);
    }

    // `marchbox SCENE` is `marchbox edit SCENE`.
    std::vector<std::string> arguments(argv + 1, argv + argc);
    const auto is_command = [&](const std::string& word) { return std::ranges::any_of(kCommands, [&](auto c) { return word == c->name; }); };
    if (!arguments.empty() && !arguments[0].starts_with('-') && !is_command(arguments[0])) refuseUnknown(arguments[0]);
    if (arguments.empty() || (!arguments[0].starts_with('-') && !is_command(arguments[0]))) arguments.insert(arguments.begin(), kEdit.name);
    std::reverse(arguments.begin(), arguments.end());  // CLI11 takes a vector from its end
    try {
        app.parse(arguments);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? kDone : kCommandFault;
    }
    for (std::size_t i = 0; i < runs.size(); ++i)
        if (subcommands[i]->parsed()) runs[i]();
    return kDone;
}

}  // namespace

int main(int argc, char** argv) {
#ifdef __GLIBC__
    // What a step or a frame gives back the next one takes again; else the system takes it and clears it each time.
    mallopt(M_MMAP_THRESHOLD, 1 << 28);
    mallopt(M_TRIM_THRESHOLD, 1 << 28);
#endif
    try {
        return run(argc, argv);
    } catch (const Failure& failure) {
        if (!failure.message.empty()) fmt::print(stderr, "marchbox: error: {}\n", failure.message);
        return failure.code;
    } catch (const std::bad_alloc&) {
        std::fputs("marchbox: error: out of memory\n", stderr);
        return kDiskFault;
    } catch (const std::exception& e) {
        fmt::print(stderr, "marchbox: error: {}\n", e.what());
        return kDiskFault;
    }
}
