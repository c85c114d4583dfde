// marchbox effects: what a scene calls for, why, what it costs and what it shows.
#include "cli/cli.h"

#include "core/render/ledger.h"
#include "physics/ledger.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mb::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string scene, size = "320x180";
    std::vector<std::string> settings;
    int rounds = 5;
    bool json = false, objects = false, glsl = false;
};

Json toJson(const Price& p) {
    Json json;
    if (p.measured)
        json = {{"evaluations", p.evaluations}, {"ms", p.ms}, {"ms_least", p.ms_least}, {"ms_most", p.ms_most}, {"mean", p.mean}, {"largest", p.largest}};
    if (!p.note.empty()) json["note"] = p.note;
    return json;
}
Json toJson(const Scene& scene, const std::vector<Because>& because) {
    Json by = Json::array();
    for (const Because& b : because) by.push_back(describe(scene, b));
    return by;
}

std::string namesOf(const Scene& scene, const std::vector<Because>& because) {
    std::string text;
    for (const Because& b : because) text += fmt::format("{}{}", text.empty() ? "" : ", ", describe(scene, b));
    return text;
}
std::string columns(const Price& p, double pixels) {
    if (!p.measured) return fmt::format("{:>9} {:>19} {:>9} {:>9} {:>8}", "", "", "", "", "");
    return fmt::format("{:>9.2f} {:>19} {:>9.2f} {:>9.5f} {:>8.3f}", p.ms, fmt::format("[{:.2f}, {:.2f}]", p.ms_least, p.ms_most),
                       static_cast<double>(p.evaluations) / pixels, p.mean, p.largest);
}
constexpr std::string_view kPriceHeads = "       ms       [least, most]  evals/px      mean  largest";

struct Ledgers {
    PictureLedger picture;
    MotionLedger motion;
    bool moves;
};
Ledgers fill(const Scene& scene, glm::ivec2 size, const Options& options, Renderer& renderer, const Common& common) {
    const bool moves = PhysicsWorld(scene).stages().has(Stage::flight);
    Ledgers all{{scene, defaultCamera(scene), {size, options.rounds, 8, true, options.objects}}, {scene, {120, options.rounds}}, moves};
    constexpr std::uint64_t kParts = 1000;
    Progress progress("pricing", kParts, common);
    while (all.picture.step(renderer)) progress.show(static_cast<std::uint64_t>(static_cast<double>(kParts) * all.picture.progress()));
    while (moves && all.motion.step()) progress.show(static_cast<std::uint64_t>(static_cast<double>(kParts) * all.motion.progress()));
    return all;
}

Json asJson(const Scene& scene, const Ledgers& all, const Counts& counts, glm::ivec2 size) {
    Json json;
    json["width"] = size.x, json["height"] = size.y;
    const auto& e = counts.evaluations;
    json["evaluations"] = {{"primary", e.primary}, {"normal", e.normal}, {"shadow", e.shadow}, {"reflection", e.reflection}, {"soft", e.soft}, {"occlusion", e.occlusion}};
    json["saved"] = toJson(all.picture.saved());
    json["dropped"] = ownIsSlower(all.picture.saved());
    json["effects"] = Json::array();
    for (const EffectPrice& row : all.picture.effects()) {
        Json line = {{"name", row.effect->name}, {"what", row.effect->tip}, {"called", row.called}, {"by", toJson(scene, row.because)}};
        if (!row.effect->counts.empty()) line["uses"] = row.uses, line["counts"] = row.effect->counts;
        line["price"] = toJson(row.price);
        json["effects"].push_back(std::move(line));
    }
    json["stages"] = Json::array();
    for (const StagePrice& row : all.motion.rows()) {
        Json line = {{"name", row.effect->name}, {"what", row.effect->tip}, {"called", row.called}, {"by", toJson(scene, row.because)}};
        if (all.moves) line["uses_per_step"] = row.uses_per_step, line["price"] = {{"ms_per_step", row.ms_per_step}, {"ms_least", row.ms_least}, {"ms_most", row.ms_most}, {"moved_m", row.moved_m}, {"lost", row.lost}};
        json["stages"].push_back(std::move(line));
    }
    if (all.picture.records().empty()) return json;
    json["records"] = Json::array();
    for (const RecordPrice& row : all.picture.records())
        json["records"].push_back({{"name", describe(scene, row.record)}, {"seen", row.seen()}, {"price", toJson(row.price)}});
    return json;
}

/// What leaving out saves in all.
std::string savedLine(const Price& saved) {
    if (!saved.measured) return saved.note + '\n';
    return fmt::format("a frame takes {:.1f} ms; with everything there is in its program, {:.1f} ms{}\n\n", saved.frame_ms - saved.ms, saved.frame_ms,
                       ownIsSlower(saved) ? ": the scene's own program measured slower, and is dropped for that one" : "");
}
std::string pictureTable(const Scene& scene, const Ledgers& all, double pixels) {
    std::string called, left;
    for (const EffectPrice& row : all.picture.effects()) {
        const std::string why = row.called ? namesOf(scene, row.because) : std::string(row.effect->tip);
        (row.called ? called : left) += fmt::format("{:<18}{}  {}{}{}\n", row.effect->name, columns(row.price, pixels), row.price.note, row.price.note.empty() ? "" : "; ", why);
    }
    std::string text = fmt::format("CALLED FOR: what it costs a frame and changes in it, the dearest for what it shows first\n{:<18}{}  by\n{}", "effect", kPriceHeads, called);
    return text + fmt::format("\nLEFT OUT: what its code would cost in the program\n{:<18}{}  what it does\n{}", "effect", kPriceHeads, left);
}
std::string recordTable(const Scene& scene, const Ledgers& all, double pixels) {
    std::string text = fmt::format("\nOBJECTS AND LIGHTS: the picture with each less without it, what is never seen first\n{:<30}{}\n", "record", kPriceHeads);
    for (const RecordPrice& row : all.picture.records()) {
        const std::string note = !row.price.note.empty() ? row.price.note : row.seen() ? "" : "never seen";
        text += fmt::format("{:<30}{}  {}\n", describe(scene, row.record), columns(row.price, pixels), note);
    }
    return text;
}
std::string motionTable(const Scene& scene, const Ledgers& all) {
    std::string text = fmt::format("\nTHE PHYSICS: what a stage costs a step\n{:<18}{:>12}{:>12} {:>22}{:>12}  by\n", "stage", "uses/step", "ms/step", "[least, most]", "moves, m");
    for (const StagePrice& row : all.motion.rows())
        text += fmt::format("{:<18}{:>12.2f}{:>12.5f} {:>22}{:>12.4g}  {}\n", row.effect->name, row.uses_per_step, row.ms_per_step,
                            fmt::format("[{:.5f}, {:.5f}]", row.ms_least, row.ms_most), row.moved_m,
                            row.called ? namesOf(scene, row.because) : fmt::format("left out: {}", row.effect->tip));
    return text;
}

void run(const Options& options, const Common& common) {
    const Scene scene = readSceneFile(options.scene, options.settings, common);
    treeOf(scene);
    const glm::ivec2 size = parseSize(options.size);
    const auto context = headlessContext();
    checkSize(size);
    Renderer renderer;
    if (options.glsl) return writeText("-", renderer.textOf(scene));

    Measured measured;
    if (const std::string why = renderer.measure(scene, defaultCamera(scene), size, measured); !why.empty()) throw Failure{kInputFault, why};
    const Ledgers all = fill(scene, size, options, renderer, common);
    if (options.json) return writeText("-", asJson(scene, all, measured.counts, size).dump() + '\n');
    const double pixels = static_cast<double>(size.x) * size.y;
    std::string text = fmt::format("{}: {}x{}, {:.2f} evaluations of the scene's distance a pixel, drawn by {}\n", options.scene, size.x, size.y,
                                   static_cast<double>(measured.counts.evaluations.total()) / pixels, renderer.rendererName());
    text += savedLine(all.picture.saved()) + pictureTable(scene, all, pixels);
    text += all.moves ? motionTable(scene, all) : fmt::format("\nTHE PHYSICS: no body calls for a step; all {} stages are left out\n", all.motion.rows().size());
    if (options.objects) text += recordTable(scene, all, pixels);
    writeText("-", text);
}

std::function<void()> make(CLI::App& app, Common& common) {
    const auto o = std::make_shared<Options>();
    app.add_option("SCENE", o->scene, "scene file")->required();
    app.add_option("--size", o->size, "WxH pixels of the picture that is priced")->capture_default_str();
    app.add_option("--rounds", o->rounds, "turns each comparison takes")->capture_default_str()->check(within(1, 1000));
    app.add_flag("--objects", o->objects, "price each object and light too");
    app.add_flag("--json", o->json, "print JSON");
    app.add_flag("--glsl", o->glsl, "print the text of the scene's shader instead: what was called for and nothing else");
    addSettings(app, o->settings);
    return [o, &common] { run(*o, common); };
}

}  // namespace

const Command kEffects{"effects", "what a scene calls for, why, what it costs and what it shows", "marchbox effects saves/mirrors.txt --objects", make};

}  // namespace mb::cli
