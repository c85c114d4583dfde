// The table of knobs. To add one: a row here; its key is a row of core/scene/keys.cpp or an effect's own.
#include "core/accuracy/knobs.h"

#include "core/scene/keys.h"
#include "core/scene/text_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace mb {
namespace {

using enum Error;
constexpr Error kGeometry[] = {depth, state, shade}, kWhether[] = {state, shade}, kNormals[] = {normal, shade}, kLook[] = {shade, color}, kArea[] = {color},
                kSize[] = {color, state, depth, normal},
                kPlaces[] = {position, energy, penetration, restitution}, kOverlaps[] = {penetration, position, energy},
                kRests[] = {position, energy};

constexpr double kTolerances[] = {0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6};
constexpr double kSteps[] = {4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048};
constexpr double kShares[] = {0, 0.25, 0.5, 0.75, 1};
constexpr double kReaches[] = {0.03, 0.01, 3e-3, 1e-3, 5e-4, 2e-4, 1e-4, 3e-5, 1e-5};
constexpr double kTaps[] = {4, 6};
constexpr double kBiases[] = {64, 16, 8, 4, 2, 1, 0.5};
constexpr double kBounces[] = {0, 1, 2, 3, 4, 6, 8, 12, 16};
constexpr double kSamples[] = {1, 2, 3, 4, 6, 8, 12, 16, 24};
constexpr double kRays[] = {1, 2, 4, 8, 16, 32, 64};
constexpr double kCells[] = {0.35, 0.5, 0.7, 1, 1.4, 2};
constexpr double kScales[] = {0.25, 0.35, 0.5, 0.7, 0.85, 1};
constexpr double kTimes[] = {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480, 1.0 / 960};
constexpr double kParts[] = {1, 2, 4, 8, 16};
constexpr double kTurns[] = {1, 2, 5, 10, 20, 50, 100, 200};
constexpr double kPushes[] = {0.02, 0.05, 0.1, 0.2, 0.4, 0.8};
constexpr double kStills[] = {1, 0.3, 0.1, 0.03, 0.01, 3e-3, 0};

bool hasRays(const Scene&, const Plan& plan) { return plan.has("hard shadow") || plan.has("soft shadow") || plan.has("ambient occlusion"); }
bool leaves(const Scene& scene, const Plan& plan) { return hasRays(scene, plan) || plan.has("reflection"); }
bool shades(const Scene&, const Plan& plan) { return plan.has("light") || plan.has("reflection"); }
bool mirrors(const Scene&, const Plan& plan) { return plan.has("reflection"); }
bool softens(const Scene&, const Plan& plan) { return plan.has("soft shadow"); }
bool occludes(const Scene&, const Plan& plan) { return plan.has("ambient occlusion"); }
bool isGridded(const Scene&, const Plan& plan) { return plan.has("grid"); }
bool moves(const Scene& scene, const Plan&) { return std::ranges::any_of(scene.objects, &Object::isBody); }

constexpr Knob kKnobs[] = {
    {"march_epsilon", "How near is a hit", "A ray walks towards a surface in steps that get smaller and smaller, and this says how near it must come, as a share of the way from the eye, before it looks for the surface itself. A smaller number puts surfaces more exactly where they are, and takes more steps.", kTolerances, kGeometry},
    {"march_steps", "Steps a ray may take", "A ray that runs out of steps stops without an answer, and its pixel is a guess. Most rays need few steps, so that more of them cost little and save those that graze a surface.", kSteps, kWhether},
    {"relaxation", "How boldly rays step", "Far from everything a ray may step further than is proved to be safe, and go back if it went too far. Bold steps save work and change nothing that is seen.", kShares, kWhether},
    {"normal_epsilon", "Reach of the surface's slope", "Which way a surface faces is found by asking a little to each side of a point, and this says how far to each side. Too far rounds edges off, too near drowns in the last digits of the numbers: the best lies between.", kReaches, kNormals, Cost::evaluations, shades},
    {"normal_taps", "Questions a surface's slope takes", "Which way a surface faces can be found with four questions or with six. Six are more exact on curved surfaces.", kTaps, kNormals, Cost::evaluations, shades},
    {"shadow_steps", "Steps a shadow's ray may take", "From each lit point a ray walks towards the light to see whether anything is in its way. If it runs out of steps nothing is found, and light falls where there should be shadow.", kSteps, kLook, Cost::evaluations, hasRays},
    {"bias", "How far off rays start", "A ray that leaves a surface must start a little above it, or it would meet that same surface again. Too far off lets light in where things touch, too near covers surfaces with specks.", kBiases, kLook, Cost::evaluations, leaves},
    {"reflections", "Bounces between mirrors", "A mirror shows what another mirror shows, and so on, each time a little darker. Every bounce costs another ray, and after a few nothing new is seen.", kBounces, kLook, Cost::evaluations, mirrors},
    {"samples", "Rays a pixel", "One ray says what is at the middle of a pixel, but a pixel is an area, and at edges its color is a mixture. More rays smooth the stairs of edges, and cost as many times as much.", kSamples, kArea},
    {"shadow_rays", "Rays to a lamp that has a size", "A lamp that has a size makes shadows with soft edges, which are found by asking many points of the lamp. Too few make the soft edge grainy.", kRays, kLook, Cost::evaluations, softens},
    {"ao_rays", "Rays to the sky", "Corners are darker because little of the sky is seen from them, and this is how many directions are asked. Too few make corners grainy.", kRays, kLook, Cost::evaluations, occludes},
    {"grid_scale", "How fine the grid is", "Space is cut into cells that know which shapes matter in them, and this makes the cells finer or coarser. The picture stays the same: only its price changes.", kCells, kLook, Cost::ms, isGridded},
    {"scale", "Size the picture is drawn at", "The picture can be drawn smaller and then enlarged. Half the size is a quarter of the work, and edges get soft.", kScales, kSize},
    {"dt", "Length of a step of time", "Motion is computed in small steps of time. Shorter steps follow curved paths more closely, and there are more of them.", kTimes, kPlaces, Cost::visits, moves},
    {"substeps", "Parts of a step of time", "Each step of time can be cut into equal parts. That is as exact as shorter steps.", kParts, kPlaces, Cost::visits, moves},
    {"iterations", "Turns of the contacts' solver", "Where many things touch, each push changes all the others, so the pushes are corrected again and again. Too few turns let piles sag into one another.", kTurns, kOverlaps, Cost::visits, moves},
    {"push_out", "How fast overlaps are undone", "Where two things overlap a little they are moved apart, this share of the overlap at a time. Much at a time is firm but may shake, little is soft.", kPushes, kOverlaps, Cost::visits, moves},
    {"sleep_speed", "How slow is at rest", "What has been slower than this for half a second stops being computed. Too high a speed freezes what would still have rolled on.", kStills, kRests, Cost::visits, moves},
};

/// Calls visit(record, key) for the key of that name.
template <class Any, class F> void withKey(Any& setting, std::string_view name, F visit) {
    for (const auto& key : keys<RenderKnobs>())
        if (key.name == name) return visit(setting.render, key);
    for (const auto& key : keys<PhysicsKnobs>())
        if (key.name == name) return visit(setting.physics, key);
    assert(false);
}

template <class Record> void addDifferences(const Record& a, const Record& b, std::string& out) {
    for (const Key<Record>& key : keys<Record>())
        std::visit([&](auto member) {
            if (text::sameBits(valueAt(a, member), valueAt(b, member))) return;
            out += fmt::format("{}{}={}", out.empty() ? "" : " ", key.name, text::valueText(valueAt(a, member)));
        }, key.member);
}

}  // namespace

std::span<const Knob> knobs() { return kKnobs; }

const Knob& knobNamed(std::string_view key) {
    const auto found = std::ranges::find(knobs(), key, &Knob::key);
    assert(found != knobs().end());
    return *found;
}

std::vector<const Knob*> knobsOf(const Scene& scene, bool motion) {
    const Plan plan = makePlan(scene, makeTree(scene));
    std::vector<const Knob*> found;
    for (const Knob& knob : knobs())
        if (knob.ofMotion() == motion && (!knob.matters || knob.matters(scene, plan))) found.push_back(&knob);
    return found;
}

double valueOf(const Setting& setting, const Knob& knob) {
    double value = 0;
    withKey(setting, knob.key, [&](const auto& record, const auto& key) {
        std::visit([&](auto member) {
            if constexpr (std::is_convertible_v<std::remove_cvref_t<decltype(valueAt(record, member))>, double>) value = static_cast<double>(valueAt(record, member));
        }, key.member);
    });
    return value;
}

Setting turned(Setting setting, const Knob& knob, double value) {
    withKey(setting, knob.key, [&](auto& record, const auto& key) {
        std::visit([&](auto member) {
            auto& field = valueAt(record, member);
            if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(field)>>) field = static_cast<std::remove_cvref_t<decltype(field)>>(value);
        }, key.member);
    });
    return setting;
}

Setting withKnobs(Setting setting, const Setting& of, bool motion) {
    for (const Knob& knob : knobs())
        if (knob.ofMotion() == motion) setting = turned(setting, knob, valueOf(of, knob));
    return setting;
}
bool sameKnobs(const Setting& a, const Setting& b, bool motion) {
    return std::ranges::all_of(knobs(), [&](const Knob& knob) { return knob.ofMotion() != motion || valueOf(a, knob) == valueOf(b, knob); });
}
bool sameButKnobs(const Scene& a, const Scene& b) {
    const auto plain = [](const Scene& scene) {
        Scene out = withSetting(scene, defaultsOf(defaultsOf(settingOf(scene), false), true));
        out.render.show_undecided = false, out.cameras.clear(), out.comment.clear();
        return out;
    };
    return sameScene(plain(a), plain(b));
}
Setting defaultsOf(Setting setting, bool motion) { return withKnobs(setting, {}, motion); }
Setting settingOf(const Scene& scene) { return {scene.render, scene.physics}; }
Scene withSetting(Scene scene, const Setting& setting) {
    scene.render = setting.render, scene.physics = setting.physics;
    return scene;
}

std::string differences(const Setting& setting, const Setting& from) {
    std::string out;
    addDifferences(setting.render, from.render, out), addDifferences(setting.physics, from.physics, out);
    return out;
}

std::vector<double> valuesWith(const Knob& knob, std::initializer_list<double> more) {
    std::vector<double> values(knob.values.begin(), knob.values.end());
    const bool falls = values.front() > values.back();
    for (const double x : more)
        if (std::ranges::find(values, x) == values.end())
            values.insert(std::ranges::find_if(values, [&](double v) { return falls ? v < x : v > x; }), x);
    return values;
}

}  // namespace mb
