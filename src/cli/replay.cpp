// marchbox replay: makes a recorded run again and compares every step.
#include "cli/cli.h"

#include "physics/timeline.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mb::cli {
namespace {

struct Options {
    std::string file;
    bool json = false;
};

nlohmann::ordered_json asJson(const Options& options, std::uint64_t steps, const std::optional<Divergence>& d, const std::string& state) {
    nlohmann::ordered_json json = {{"file", options.file}, {"equal", !d.has_value()}, {"steps", steps}, {"state", state}};
    if (d) json["step"] = d->step, json["body"] = d->body, json["recorded"] = fmt::format("{:016x}", d->recorded);
    return json;
}

void run(const Options& options, const Common& common) {
    RecordingResult loaded = loadRecording(options.file);
    if (const Exit code = reportFaults(loaded, options.file, common); code != kDone) throw Failure{code, {}};
    const std::uint64_t steps = loaded.recording.steps.size();
    std::string state = PhysicsWorld(*loaded.recording.start).stateText();
    Progress progress("replaying", steps, common);
    const auto divergence = replay(std::move(loaded.recording), [&](const Timeline& timeline) {
        progress.show(timeline.step());
        if (timeline.atEnd() || timeline.divergence()) state = timeline.world().stateText();
    });
    if (options.json) writeText("-", asJson(options, steps, divergence, state).dump() + '\n');
    else if (!divergence && !common.quiet) writeText("-", fmt::format("{}: equal: {} steps, state {}\n", options.file, steps, state));
    if (divergence) throw Failure{kInputFault, fmt::format("{}: diverged {}", options.file, describe(*divergence))};
}

std::function<void()> make(CLI::App& app, Common& common) {
    const auto options = std::make_shared<Options>();
    app.add_option("FILE", options->file, "a recording")->required();
    app.add_flag("--json", options->json, "prints a line of JSON: whether all is equal, else the first step and body that are not");
    return [options, &common] { run(*options, common); };
}

}  // namespace

const Command kReplay{"replay", "makes a recorded run again and says where it differs, by step and body",
                      "marchbox simulate saves/bowl.txt --seconds 5 --record bowl.rec && marchbox replay bowl.rec", make};

}  // namespace mb::cli
