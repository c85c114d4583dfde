// marchbox simulate: the physics without drawing.
#include "cli/cli.h"

#include "core/effects/effect.h"
#include "core/measure/timing.h"
#include "physics/recording.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace mb::cli {
namespace {

struct Options {
    std::string scene, trace, record;
    double seconds = 0;
    std::uint64_t every = 1;
    double dt = 0;
    int substeps = 0;
    unsigned threads = 0;  // 0: what the world takes by itself
    bool json = true;
    std::vector<std::string> settings;
};

/// The trace: a row for each body at each step, in the columns of the command line's description.
class Trace {
public:
    Trace(const std::string& path) : path_(path), file_(path.empty() ? nullptr : std::fopen(path.c_str(), "wb")) {
        if (!path.empty() && !file_) throw Failure{kDiskFault, fmt::format("{}: {}", path, std::strerror(errno))};
        write("time,name,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n");
    }
    ~Trace() {
        if (file_) std::fclose(file_);
    }
    Trace(const Trace&) = delete;
    Trace& operator=(const Trace&) = delete;

    void add(const PhysicsWorld& world) {
        if (!file_) return;
        for (const Body& b : world.bodies())
            write(fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", world.time_s(), quoted(b.name), b.position.x, b.position.y,
                              b.position.z, b.orientation.w, b.orientation.x, b.orientation.y, b.orientation.z, b.velocity.x, b.velocity.y,
                              b.velocity.z, b.spin.x, b.spin.y, b.spin.z));
    }
    void finish() {
        if (!file_) return;
        const bool flushed = std::fclose(std::exchange(file_, nullptr)) == 0;
        if (!flushed) fail();
    }

private:
    static std::string quoted(const std::string& name) {
        if (name.find_first_of(",\"\n\r") == std::string::npos) return name;
        std::string text = "\"";
        for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
        return text + '"';
    }
    void write(const std::string& text) {
        if (file_ && std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail();
    }
    [[noreturn]] void fail() { throw Failure{kDiskFault, fmt::format("{}: {}", path_, std::strerror(errno))}; }

    std::string path_;
    std::FILE* file_;
};

nlohmann::json namesOf(Stages stages) {
    nlohmann::json names = nlohmann::json::array();
    for (const Effect& row : motionEffects())
        if (stages.has(row.stage)) names.push_back(row.name);
    return names;
}

nlohmann::ordered_json asJson(const StepCounts& counts) {
    nlohmann::ordered_json json;
    for (const Counter& counter : counters()) json[std::string(counter.name)] = counts.*counter.of;
    return json;
}

void run(const Options& options, const Common& common) {
    Scene scene = readSceneFile(options.scene, options.settings, common);
    if (options.dt > 0) scene.physics.dt = options.dt;
    if (options.substeps > 0) scene.physics.substeps = options.substeps;
    const double wanted = std::round(options.seconds / scene.physics.dt);
    if (!(wanted < 1e12)) throw Failure{kCommandFault, fmt::format("--seconds {}: that is {} steps of {} s", options.seconds, wanted, scene.physics.dt)};
    const auto steps = static_cast<std::uint64_t>(wanted);

    PhysicsWorld world(scene);
    if (options.threads > 0) world.setThreads(options.threads);
    const Stages called = world.stages();
    constexpr double kWorthSaying = 1e-3;  // m; less is undone within a few steps
    if (const double depth = world.maxPenetration(); depth > kWorthSaying && !common.quiet)
        fmt::print(stderr, "{}: note: bodies overlap something by up to {:.3g} m at the start\n", options.scene, depth);
    Trace trace(options.trace);
    trace.add(world);
    Recording recording{std::make_shared<const Scene>(scene), {}, {}};
    std::vector<double> step_ms;
    Progress progress("simulating", steps, common);
    for (std::uint64_t i = 1; i <= steps; ++i) {
        const bool moves = world.awake() > 0;
        const auto from = std::chrono::steady_clock::now();
        world.step();
        if (moves) step_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count());
        if (i % options.every == 0) trace.add(world);
        if (!options.record.empty()) recording.steps.push_back(hashOf(world));
        progress.show(i);
    }
    trace.finish();
    if (!options.record.empty())
        if (const auto why = saveRecording(options.record, recording)) throw Failure{kDiskFault, *why};
    if (!common.quiet)
        for (const std::string& note : world.notes()) fmt::print(stderr, "{}: note: {}\n", options.scene, note);

    const auto energy = world.energy();
    const glm::dvec3 p = world.momentum(), l = world.angularMomentum();
    const nlohmann::ordered_json json = {
        {"seconds", world.time_s()}, {"steps", world.steps()}, {"bodies", world.bodies().size()}, {"awake", world.awake()},
        {"step_ms", step_ms.empty() ? 0 : median(step_ms)}, {"energy", {{"kinetic", energy.kinetic}, {"potential", energy.potential}}},
        {"momentum", {p.x, p.y, p.z}}, {"angular_momentum", {l.x, l.y, l.z}}, {"max_penetration", world.maxPenetration()},
        {"contacts", world.contacts()}, {"held", world.held()}, {"removed", world.removed()}, {"frozen", world.frozen().size()},
        {"stages", namesOf(called)}, {"counts", asJson(world.counts())}, {"state", world.stateText()}};
    writeText("-", json.dump() + '\n');
}

std::function<void()> make(CLI::App& app, Common& common) {
    const auto options = std::make_shared<Options>();
    app.add_option("SCENE", options->scene, "scene file")->required();
    app.add_option("--seconds", options->seconds, "how long")->required()->check(within(0, 1e9));
    app.add_option("--dt", options->dt, "seconds a step, instead of the scene's")->check(within(1e-6, 1));
    app.add_option("--substeps", options->substeps, "parts of a step, instead of the scene's")->check(within(1, 1000));
    app.add_option("--threads", options->threads, "threads that look for contacts, for as many as there are cores, 4 at most; the result is the same")->check(within(1, 256));
    app.add_option("--trace", options->trace, "a CSV file with a row for each body at each step");
    app.add_option("--every", options->every, "rows only for every Nth step")->check(within(1, 1e12));
    app.add_option("--record", options->record, "a recording, which marchbox replay makes again and compares");
    app.add_flag("--json", options->json, "the answer is JSON with or without this");
    addSettings(app, options->settings);
    return [options, &common] { run(*options, common); };
}

}  // namespace

const Command kSimulate{"simulate", "runs the physics without drawing, and prints a line of JSON (step_ms: the median of the steps that began with a body awake)",
                        "marchbox simulate saves/bowl.txt --seconds 5 --trace bowl.csv", make};

}  // namespace mb::cli
