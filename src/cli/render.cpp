// marchbox render: pictures without a window.
#include "cli/budget.h"
#include "cli/film.h"

#include "core/render/picture.h"
#include "core/render/renderer.h"
#include "physics/world.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace mb::cli {
namespace {

struct Options {
    std::string scene, out, camera, stats, size = "640x360", max_error;
    std::vector<std::string> settings, aov;
    double at_s = 0, fps = 25, max_ms = 0;
    int frames = 0;
};

/// One row a channel: its name, and how it is written.
struct Aov {
    std::string_view name;
    std::string (*write)(const std::string& path, const Measured& measured, const std::vector<glm::vec3>& color);
};
constexpr Aov kAovs[] = {
    {"depth", [](const std::string& p, const Measured& m, const auto&) { return writePfm(p, m.channels.size, m.channels.depth); }},
    {"normal", [](const std::string& p, const Measured& m, const auto&) { return writePfm(p, m.channels.size, m.channels.normal); }},
    {"object", [](const std::string& p, const Measured& m, const auto&) { return writePfm(p, m.channels.size, m.channels.object); }},
    {"color", [](const std::string& p, const Measured& m, const auto& color) { return writePfm(p, m.channels.size, color); }},
    {"steps", [](const std::string& p, const Measured& m, const auto&) { return writePfm(p, m.channels.size, m.channels.steps); }},
    {"state", [](const std::string& p, const Measured& m, const auto&) { return writePfm(p, m.channels.size, m.channels.state); }},
};

std::string aovNames() {
    std::string names;
    for (const Aov& aov : kAovs) names += fmt::format("{}{}", names.empty() ? "" : ", ", aov.name);
    return names;
}

std::vector<const Aov*> parseAovs(const std::vector<std::string>& names) {
    std::vector<const Aov*> wanted;
    for (const std::string& name : names) {
        const auto row = std::ranges::find(kAovs, name, &Aov::name);
        if (row == std::end(kAovs))
            throw Failure{kCommandFault, fmt::format("--aov {}: there are {}", name, aovNames())};
        wanted.push_back(row);
    }
    return wanted;
}

/// The one place of a "%04d" or "%d" in a sequence's name: its text before, after, and the digits.
struct SequenceName {
    std::string before, after;
    int digits = 0;
    std::string of(int frame) const { return fmt::format("{}{:0{}}{}", before, frame, digits, after); }
};
SequenceName parseSequenceName(const std::string& out) {
    const std::size_t percent = out.find('%');
    const std::size_t d = percent == std::string::npos ? percent : out.find('d', percent);
    const std::string digits = d == std::string::npos ? "x" : out.substr(percent + 1, d - percent - 1);
    if (digits.find_first_not_of("0123456789") != std::string::npos || digits.size() > 2 || out.find('%', percent + 1) != std::string::npos)
        throw Failure{kCommandFault, fmt::format("-o {}: a sequence needs a name like NAME_%04d.png, or NAME.mp4", out)};
    if (!out.ends_with(".png")) throw Failure{kCommandFault, fmt::format("-o {}: pictures are written as .png, films as .mp4", out)};
    return {out.substr(0, percent), out.substr(d + 1), digits.empty() ? 0 : std::stoi(digits)};
}

/// A still's name: a .png without a frame's place in it, or a device.
void checkStillName(const std::string& out) {
    if (out.starts_with("/dev/")) return;
    if (!out.ends_with(".png")) throw Failure{kCommandFault, fmt::format("-o {}: a picture is written as .png; a film (.mp4) needs --frames", out)};
    if (out.find('%') != std::string::npos) throw Failure{kCommandFault, fmt::format("-o {}: a sequence needs --frames", out)};
}

void orInputFault(const std::string& why) {
    if (!why.empty()) throw Failure{kInputFault, why};
}
void orDiskFault(const std::string& why) {
    if (!why.empty()) throw Failure{kDiskFault, why};
}

/// The scene's bodies moved on by whole steps; a scene without bodies has no world.
class Motion {
public:
    explicit Motion(const Scene& scene) : dt_s_(scene.physics.dt) {
        if (std::ranges::any_of(scene.objects, &Object::isBody)) world_.emplace(scene);
    }
    void advanceTo(double time_s, Scene& scene, const Common& common) {
        if (!world_) return;
        const auto steps = static_cast<std::uint64_t>(std::llround(time_s / dt_s_));
        Progress progress("simulating", steps, common);
        while (world_->steps() < steps) {
            world_->step();
            progress.show(world_->steps());
        }
        world_->writeTo(scene);
    }

private:
    double dt_s_;
    std::optional<PhysicsWorld> world_;
};

nlohmann::ordered_json byKind(const Counts::ByKind& k) {
    return {{"primary", k.primary}, {"normal", k.normal}, {"shadow", k.shadow}, {"reflection", k.reflection}, {"soft", k.soft}, {"occlusion", k.occlusion}};
}

nlohmann::ordered_json rays(const Counts::ByKind& k) {
    nlohmann::ordered_json json = byKind(k);
    json.erase("normal");
    return json;
}

/// What the first frame took, then the later ones; `grid` is the first frame's work.
nlohmann::ordered_json statistics(const Renderer& renderer, const Measured& m, double first_ms, const GridWork& grid, std::vector<double> later_ms) {
    std::ranges::sort(later_ms);
    const Counts& c = m.counts;
    nlohmann::ordered_json json = {
        {"width", m.channels.size.x}, {"height", m.channels.size.y},
        {"frame_ms", later_ms[later_ms.size() / 2]}, {"first_frame_ms", first_ms},
        {"rays", rays(c.rays)},
        {"evaluations", byKind(c.evaluations)}, {"touched", byKind(c.touched)},
        {"pixels", {{"hit", c.pixels.hit}, {"miss", c.pixels.miss}, {"undecided", c.pixels.undecided}}},
        {"undecided_rays", rays(c.undecided_rays)}};
    json["undecided_rays"].erase("primary");  // pixels.undecided
    json["effects"] = nlohmann::ordered_json::array();
    for (const Plan::Called& called : renderer.plan().called) json["effects"].push_back(called.effect->name);
    if (grid.whole) json["grid"] = {{"cells", grid.cells}, {"evaluations", grid.evaluations}, {"build_ms", grid.ms}};
    json["passes"] = renderer.plan().passes.size();
    json["renderer"] = renderer.rendererName();
    return json;
}

/// Draws once and says how long it took, to the last pixel.
double drawTimed(Renderer& renderer, const Scene& scene, const Camera& camera, glm::ivec2 size) {
    const auto from = std::chrono::steady_clock::now();
    orInputFault(renderer.draw(scene, camera, size));
    gl.Finish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count();
}

void renderStill(const Options& options, Scene scene, glm::ivec2 size, const Common& common) {
    checkStillName(options.out);
    const std::vector<const Aov*> aovs = parseAovs(options.aov);
    Motion(scene).advanceTo(options.at_s, scene, common);
    const Camera camera = cameraNamed(scene, options.camera);
    const auto context = headlessContext();
    checkSize(size);
    Renderer renderer;
    if (const Budget budget = parseBudget(options.max_error, options.max_ms); budget.isAsked()) scene = withinBudget(scene, camera, size, budget, renderer, common);
    const double first_ms = drawTimed(renderer, scene, camera, size);
    const GridWork grid = renderer.gridWork();
    const std::vector<glm::vec3> picture = renderer.readPicture();
    orDiskFault(writePng(options.out, size, renderer.readShown()));
    const std::size_t drawn = static_cast<std::size_t>(renderer.picture().size().x) * static_cast<std::size_t>(renderer.picture().size().y);
    if (const std::size_t undecided = renderer.countUndecided(); undecided > 0 && !common.quiet)
        fmt::print(stderr, "{}: note: {} of {} pixels hold an undecided ray ({:.3f} %); --set show_undecided=1 shows them\n",
                   options.scene, undecided, drawn, 100.0 * static_cast<double>(undecided) / static_cast<double>(drawn));
    if (aovs.empty() && options.stats.empty()) return;

    constexpr int kTimedFrames = 3;
    std::vector<double> later_ms;
    for (int i = 0; i < kTimedFrames && !options.stats.empty(); ++i) later_ms.push_back(drawTimed(renderer, scene, camera, size));
    Measured measured;
    orInputFault(renderer.measure(scene, camera, size, measured));
    const std::string stem = options.out.ends_with(".png") ? options.out.substr(0, options.out.size() - 4) : options.out;
    for (const Aov* aov : aovs) orDiskFault(aov->write(fmt::format("{}.{}.pfm", stem, aov->name), measured, picture));
    if (!options.stats.empty()) writeText(options.stats, statistics(renderer, measured, first_ms, grid, later_ms).dump(2) + '\n');
}

void renderSequence(const Options& options, Scene scene, glm::ivec2 size, const Common& common) {
    if (!options.aov.empty() || !options.stats.empty()) throw Failure{kCommandFault, "--aov and --stats are for one picture, without --frames"};
    const bool film_wanted = options.out.ends_with(".mp4");
    if (film_wanted && options.out.find('%') != std::string::npos)
        throw Failure{kCommandFault, fmt::format("-o {}: a film is one file, without a frame's place in its name", options.out)};
    const SequenceName name = film_wanted ? SequenceName{} : parseSequenceName(options.out);
    Motion motion(scene);
    const auto context = headlessContext();
    checkSize(size);
    Renderer renderer;
    motion.advanceTo(options.at_s, scene, common);
    if (const Budget budget = parseBudget(options.max_error, options.max_ms); budget.isAsked())
        scene = withinBudget(scene, cameraNamed(scene, options.camera), size, budget, renderer, common);
    std::optional<Film> film;
    if (film_wanted) film.emplace(options.out, size, options.fps);
    Progress progress("rendering", static_cast<std::uint64_t>(options.frames), common);
    Common quiet = common;
    quiet.quiet = true;
    for (int i = 0; i < options.frames; ++i) {
        motion.advanceTo(options.at_s + i / options.fps, scene, quiet);
        orInputFault(renderer.draw(scene, cameraNamed(scene, options.camera), size));
        const std::vector<glm::vec3> picture = renderer.readShown();
        if (film) film->add(encodeSrgb(picture));
        else orDiskFault(writePng(name.of(i), size, picture));
        progress.show(static_cast<std::uint64_t>(i) + 1);
    }
    if (film) film->finish();
}

std::function<void()> make(CLI::App& app, Common& common) {
    const auto o = std::make_shared<Options>();
    app.add_option("SCENE", o->scene, "scene file")->required();
    app.add_option("-o,--output", o->out, "the picture: OUT.png, or with --frames NAME_%04d.png or NAME.mp4")->required();
    app.add_option("--size", o->size, "WxH pixels")->capture_default_str();
    app.add_option("--at", o->at_s, "simulate this many seconds first")->check(within(0, 1e6));
    app.add_option("--camera", o->camera, "the scene's camera of that name");
    addSettings(app, o->settings);
    app.add_option("--aov", o->aov, "also write OUT.NAME.pfm of " + aovNames() + ": a list with commas")->delimiter(',');
    app.add_option("--stats", o->stats, "write what it took, as JSON, to this file ('-': standard output)");
    app.add_option("--max-error", o->max_error, "pick the cheapest setting of the knobs whose color error is at most this (0.01 is a hundredth of white), or NAME=E of another error: shade, state, depth, normal");
    app.add_option("--max-ms", o->max_ms, "pick the least wrong setting whose frame takes at most so many milliseconds")->check(within(1e-3, 1e9));
    app.add_option("--frames", o->frames, "how many frames of a sequence or film")->check(within(1, 1e6));
    app.add_option("--fps", o->fps, "frames a second")->capture_default_str()->check(within(1e-3, 1e4));
    return [o, &common] {
        const glm::ivec2 size = parseSize(o->size);
        const Scene scene = readSceneFile(o->scene, o->settings, common);
        o->frames > 0 ? renderSequence(*o, scene, size, common) : renderStill(*o, scene, size, common);
    };
}

}  // namespace

const Command kRender{"render", "renders without a window", "marchbox render saves/welcome.txt -o welcome.png --size 1280x720 --set samples=4", make};

}  // namespace mb::cli
