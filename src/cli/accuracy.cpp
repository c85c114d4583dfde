// marchbox accuracy: what accuracy costs in time, as a table, charts and a page that explains them.
#include "cli/cli.h"

#include "core/accuracy/report.h"
#include "core/render/picture.h"
#include "core/render/picture_sweep.h"
#include "physics/motion_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace mb::cli {
namespace {

struct Options {
    std::string scene, out, size = "160x90", camera;
    std::vector<std::string> settings;
    int together = -1;
};

void orDiskFault(const std::string& why) {
    if (!why.empty()) throw Failure{kDiskFault, why};
}

/// Writes a report's files.
class Folder {
public:
    explicit Folder(std::string path) : path_(std::move(path)) {
        std::error_code failed;
        std::filesystem::create_directories(path_, failed);
        if (failed || !std::filesystem::is_directory(path_)) throw Failure{kDiskFault, fmt::format("{}: {}", path_, failed ? failed.message() : "not a folder")};
    }
    void text(const std::string& name, const std::string& content) const { writeText(path_ + "/" + name, content); }
    void picture(const std::string& name, glm::ivec2 size, std::span<const glm::vec3> light) const { orDiskFault(writePng(path_ + "/" + name, size, light)); }

private:
    std::string path_;
};

/// The numbers of the three runs of a knob to show: the first, the own and the last, each once.
std::vector<std::size_t> threeOf(const std::vector<Run>& runs, const Knob& knob) {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < runs.size(); ++i)
        if (runs[i].knob == knob.key) all.push_back(i);
    if (all.size() <= 3) return all;
    const double own_value = valueOf(runs[kOwnRun].setting, knob);
    std::size_t own = all[all.size() / 2];
    for (const std::size_t i : all)
        if (runs[i].value == own_value) own = i;
    if (own == all.front() || own == all.back()) own = all[all.size() / 2];
    return {all.front(), own, all.back()};
}
std::string captionOf(const Run& run, const Knob& knob) {
    const Error error = knob.moves.front();
    return fmt::format("{} {}: {}", knob.key, brief(run.value),
                       run.failed() ? "failed, " + run.failure : fmt::format("{} error {}, {} {} {}", rowOf(error).name, brief(run.errors[error]), brief(run.costs[knob.cost]), rowOf(knob.cost).name, rowOf(knob.cost).unit));
}

Shots writeShots(const Folder& folder, const PictureSweep& sweep, const Knob& knob) {
    Shots shots;
    for (const std::size_t run : threeOf(sweep.runs(), knob)) {
        const auto shot = std::ranges::find(sweep.shots(), run, &PictureSweep::Shot::run);
        if (shot == sweep.shots().end()) continue;
        const std::string name = fmt::format("{}_{}", knob.key, shots.shots.size() + 1);
        folder.picture(name + ".png", sweep.frame().size, shot->shown), folder.picture(name + "_errors.png", sweep.frame().size, shot->errors);
        shots.shots.push_back({name + ".png", name + "_errors.png", captionOf(sweep.runs()[run], knob)});
    }
    return shots;
}

/// The scene as three settings of a knob of the motion leave it, held against the scene as the reference leaves it.
Shots writeMotionShots(const Folder& folder, const MotionSweep& sweep, const Knob& knob, const Scene& scene, const Frame& frame, Renderer& renderer) {
    const auto draw = [&](const Scene& moved) {
        if (const std::string why = renderer.draw(moved, frame.camera, frame.size); !why.empty()) throw Failure{kInputFault, why};
        return renderer.readShown();
    };
    const std::vector<glm::vec3> truth = draw(movedScene(scene, settingOf(referenceScene(scene)), sweep.plan().seconds));
    Shots shots;
    for (const std::size_t run : threeOf(sweep.runs(), knob)) {
        const std::vector<glm::vec3> shown = draw(movedScene(scene, sweep.runs()[run].setting, sweep.plan().seconds));
        const std::string name = fmt::format("{}_{}", knob.key, shots.shots.size() + 1);
        folder.picture(name + ".png", frame.size, shown), folder.picture(name + "_errors.png", frame.size, differenceMap(shown, truth));
        shots.shots.push_back({name + ".png", name + "_errors.png", captionOf(sweep.runs()[run], knob)});
    }
    return shots;
}

std::string referenceOf(const PictureSweep& sweep) {
    const TruePictureWork& truth = sweep.truth();
    std::string text = fmt::format("the true picture, in double precision, {} to {} rays a pixel; its own colors may be off by {} of white", TruePictureWork::kFew * TruePictureWork::kFew,
                                   TruePictureWork::kMost * TruePictureWork::kMost, brief(truth.picture().noise));
    const Oracle& oracle = truth.oracle();
    text += oracle.isExact() ? "; every surface by its own equation" : fmt::format("; surfaces that have no equation of their own to {} m, none thicker than {} m missed", brief(oracle.rootError()), brief(oracle.resolution()));
    for (const std::string& note : oracle.notes()) text += "; " + note;
    return text + ".";
}
std::string referenceOf(const MotionSweep& sweep) {
    if (sweep.isClosed()) return fmt::format("the closed form of {} s of motion.", sweep.plan().seconds);
    return fmt::format("{} s of the same motion in steps a sixty-fourth as long, without sleep; the same in steps twice those ends {} m from it, with {} of the energy of motion more or less, so that smaller errors mean nothing.",
                       sweep.plan().seconds, brief(sweep.truthErrors()[Error::position]), brief(sweep.truthErrors()[Error::energy]));
}

/// Runs a sweep to its end, showing its progress.
PictureSweep& run(PictureSweep& io_sweep, Renderer& renderer, const Common& common) {
    constexpr std::uint64_t kParts = 1000;
    const auto parts = [](double share) { return static_cast<std::uint64_t>(share * static_cast<double>(kParts)); };
    {
        Progress progress("the true picture", kParts, common);
        io_sweep.finishTruth([&](double share) { progress.show(parts(share)); });
    }
    Progress progress("pictures", kParts, common);
    while (io_sweep.step(renderer)) progress.show(parts(io_sweep.progress()));
    return io_sweep;
}
MotionSweep& run(MotionSweep& io_sweep, const Common& common) {
    constexpr std::uint64_t kParts = 1000;
    Progress progress("motion", kParts, common);
    while (io_sweep.step()) progress.show(static_cast<std::uint64_t>(io_sweep.progress() * static_cast<double>(kParts)));
    return io_sweep;
}

void run(const Options& options, const Common& common) {
    const Scene scene = readSceneFile(options.scene, options.settings, common);
    treeOf(scene);
    const Camera camera = cameraNamed(scene, options.camera);
    const glm::ivec2 shape = parseSize(options.size);
    const auto context = headlessContext();
    checkSize(shape);
    const Folder folder(options.out);
    Renderer renderer;
    PictureSweep::Affordable affordable = PictureSweep::affordable(scene, camera, shape, renderer, static_cast<double>(shape.x) * shape.y);
    if (!affordable.why.empty()) throw Failure{kInputFault, affordable.why};
    if (options.together >= 0) affordable.plan.together = static_cast<std::size_t>(options.together);

    PictureSweep pictures(scene, {camera, affordable.size, 1}, affordable.plan);
    run(pictures, renderer, common);
    std::vector<Sweep> sweeps{{pictures.runs(), pictureTerms(pictures.truth().picture().noise), false, referenceOf(pictures)}};
    std::optional<MotionSweep> motions;
    if (!knobsOf(scene, true).empty() && PhysicsWorld(scene).bodies().size() > 0) {
        motions.emplace(scene);
        run(*motions, common);
        sweeps.push_back({motions->runs(), motions->terms(), true, referenceOf(*motions)});
    }

    Page page{options.scene, renderer.rendererName(), fmt::format("{} by {} pixels", affordable.size.x, affordable.size.y), {}, {}};
    for (const Sweep& sweep : sweeps) {
        const std::string name = sweep.motion ? "overview_motion.svg" : "overview.svg";
        folder.text(name, chartSvg(overviewPanels(sweep)));
        page.overviews.push_back({&sweep, name});
        if (!sweep.motion) folder.text(page.front = "front.svg", chartSvg({overviewPanels(sweep).front()}));
        for (const Knob* knob : knobsOf(scene, sweep.motion)) {
            const std::string file = fmt::format("{}.svg", knob->key);
            folder.text(file, chartSvg(knobPanels(sweep, *knob)));
            page.knobs.push_back({knob, &sweep, file, sweep.motion ? writeMotionShots(folder, *motions, *knob, scene, pictures.frame(), renderer) : writeShots(folder, pictures, *knob)});
        }
    }
    folder.text("accuracy.csv", runsCsv(sweeps));
    folder.text("index.html", reportHtml(page));
    if (common.quiet) return;
    for (const Sweep& sweep : sweeps) fmt::print("{}\n", frontSays(sweep));
    fmt::print("{}/index.html explains it\n", options.out);
}

std::function<void()> make(CLI::App& app, Common& common) {
    const auto o = std::make_shared<Options>();
    app.add_option("SCENE", o->scene, "scene file")->required();
    app.add_option("-o,--output", o->out, "a folder, made if it is not there: accuracy.csv, a chart for each knob, index.html")->required();
    app.add_option("--size", o->size, "WxH pixels of the pictures at most; a scene that is slow to draw gets smaller ones of that shape")->capture_default_str();
    app.add_option("--camera", o->camera, "the scene's camera of that name");
    app.add_option("--together", o->together, "settings of all the picture's knobs together to try; else as many as there is time for")->check(within(0, 1e5));
    addSettings(app, o->settings);
    return [o, &common] { run(*o, common); };
}

}  // namespace

const Command kAccuracy{"accuracy", "what accuracy costs in time: each knob and all together, held against the truth", "marchbox accuracy saves/welcome.txt -o report", make};

}  // namespace mb::cli
