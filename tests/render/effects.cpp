// That leaving out what a scene does not call for changes nothing: the specialised picture is the general one, to the bit.
#include "headless.h"
#include "scenes.h"

#include "core/render/ledger.h"

#include <fmt/format.h>

#include <cstring>
#include <functional>
#include <random>
#include <set>

using namespace mb;

namespace {

constexpr glm::ivec2 kSize{72, 48};
const Camera kCamera = cameraAt({1.2, 2.2, 4.5}, {0, 0.6, 0});

double& extra(Extra& numbers, std::string_view effect, std::size_t key = 0) { return numbers[slotOf(effectNamed(effect).keys[key])]; }

/// A switch of a scene: the row it calls for, and how.
struct Switch {
    std::string_view row;
    std::function<void(Scene&)> on;
    std::string_view needs = {};  // a row without which this one is not called for
};
const Switch kOwn[] = {
    {"checker", [](Scene& s) { s.materials[0].pattern = Pattern::checker; }},
    {"blend", [](Scene& s) { s.objects[2].numbers[0] = 0.2; }},
    {"ambient occlusion", [](Scene& s) { extra(s.render.extra, "ambient occlusion") = 0.8, extra(s.render.extra, "ambient occlusion", 1) = 5; }, "hard shadow"},
    {"light", [](Scene& s) { s.lights.push_back({"point", {3, 5, 2}, {1, 0.9, 0.8}, 0.6}); }},
    {"hard shadow", [](Scene& s) { s.render.shadow_steps = 256; }, "light"},
    {"soft shadow", [](Scene& s) { s.lights.push_back({"lamp", {-4, 4, 3}, {0.7, 0.8, 1}, 0.5}), extra(s.lights.back().extra, "soft shadow") = 1.5,
                                   extra(s.render.extra, "soft shadow", 1) = 4; }, "hard shadow"},
    {"specular", [](Scene& s) { for (Material& m : s.materials) m.ks = 0.4; }, "light"},
    {"reflection", [](Scene& s) { s.materials[0].kr = 0.3; }},
    {"samples", [](Scene& s) { s.render.samples = 2; }},
};
/// And of every other row the key it brings: a row that is added to the table is held to the equality by itself.
std::vector<Switch> makeSwitches() {
    std::vector<Switch> all(std::begin(kOwn), std::end(kOwn));
    for (const Effect& effect : effects()) {
        if (effect.keys.empty() || std::ranges::find(all, effect.name, &Switch::row) != all.end()) continue;
        const EffectKey& key = effect.keys.front();
        const auto on = [&key](Scene& s) {
            Extra* const carriers[] = {&s.world.extra, &s.render.extra, s.lights.empty() ? nullptr : &s.lights[0].extra, &s.materials[1].extra};
            if (Extra* extra = carriers[static_cast<std::size_t>(key.carrier)]) (*extra)[slotOf(key)] = 0.3 * key.slider_hi;
        };
        all.push_back({effect.name, on, key.carrier == Carrier::light ? "light" : ""});
    }
    return all;
}
const std::vector<Switch> kSwitches = makeSwitches();
const std::size_t kCount = kSwitches.size();
using Setting = std::bitset<16>;

std::size_t switchOf(std::string_view row) {
    for (std::size_t i = 0; i < kCount; ++i)
        if (kSwitches[i].row == row) return i;
    return kCount;
}
bool feasible(const Setting& setting) {
    for (std::size_t i = 0; i < kCount; ++i)
        if (setting[i] && !kSwitches[i].needs.empty() && !setting[switchOf(kSwitches[i].needs)]) return false;
    return true;
}

/// A floor, a ball, and a box less a ball; nothing but ambient light until switches say so.
Scene sceneOf(const Setting& setting) {
    Scene s;
    s.world.background = {0.3, 0.5, 0.8};
    s.render.shadow_steps = 0;
    s.materials = {{"floor", {0.8, 0.7, 0.6}, {0.2, 0.1, 0.1}, Pattern::none, 0.3, 0.6, 0, 0, 20},
                   {"thing", {0.4, 0.6, 0.5}, {0, 0, 0}, Pattern::none, 0.2, 0.7, 0, 0, 40}};
    addObject(s, "plane", {0, 1, 0, 0});
    addObject(s, "sphere", {0.5}, {-0.9, 0.5, 0.4});
    const int cut = addObject(s, "subtract", {0}, {0.5, 0.5, 0});
    addObject(s, "box", {1, 1, 1, 0.05}, {}, cut);
    addObject(s, "sphere", {0.45}, {0.2, 0.5, 0.3}, cut);
    s.objects[2].rot = {0, 30, 0};
    s.objects[0].material = s.objects[4].material = 0, s.objects[1].material = s.objects[2].material = 1;
    for (std::size_t i = 0; i < kCount; ++i)
        if (setting[i]) kSwitches[i].on(s);
    return s;
}

/// A pair of switches, each with its position; four to a pair of them.
using Pair = std::array<std::size_t, 4>;
std::set<Pair> pairsOf(const Setting& setting) {
    std::set<Pair> pairs;
    for (std::size_t i = 0; i < kCount; ++i)
        for (std::size_t j = i + 1; j < kCount; ++j) pairs.insert({i, j, setting[i], setting[j]});
    return pairs;
}
std::set<Pair> feasiblePairs() {
    std::set<Pair> pairs;
    for (unsigned long bits = 0; bits < 1ul << kCount; ++bits)
        if (feasible(bits)) pairs.merge(pairsOf(bits));
    return pairs;
}

/// Few settings in which every pair of switches takes every pair of positions it can: each the best of many drawn at random.
std::vector<Setting> pairwise() {
    std::set<Pair> left = feasiblePairs();
    std::vector<Setting> chosen{Setting()};
    for (const Pair& p : pairsOf({})) left.erase(p);
    std::mt19937 random(1);
    while (!left.empty()) {
        Setting best;
        std::size_t most = 0;
        for (int i = 0; i < 400; ++i) {
            const Setting drawn(random() % (1ul << kCount));
            if (!feasible(drawn)) continue;
            const std::set<Pair> pairs = pairsOf(drawn);
            const auto news = static_cast<std::size_t>(std::ranges::count_if(pairs, [&](const Pair& p) { return left.contains(p); }));
            if (news > most) most = news, best = drawn;
        }
        if (most == 0) continue;
        chosen.push_back(best);
        for (const Pair& p : pairsOf(best)) left.erase(p);
    }
    return chosen;
}

/// How many pixels of two pictures are not the same to the bit.
std::size_t differing(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    REQUIRE(a.size() == b.size());
    std::size_t n = 0;
    for (std::size_t i = 0; i < a.size(); ++i) n += std::memcmp(&a[i], &b[i], sizeof a[i]) != 0;
    return n;
}

std::vector<glm::vec3> drawn(Renderer& renderer, const Scene& scene, const Choice& choice) {
    renderer.choose(choice);
    const std::string why = renderer.draw(scene, kCamera, kSize);
    REQUIRE_MESSAGE(why.empty(), why);
    return renderer.readShown();
}

std::string namesOf(const Setting& setting) {
    std::string names;
    for (std::size_t i = 0; i < kCount; ++i)
        if (setting[i]) names += fmt::format("{}{}", names.empty() ? "" : ", ", kSwitches[i].row);
    return names;
}

/// In how many pixels the specialised picture is not the general one.
std::size_t difference(Renderer& renderer, const Setting& setting) {
    const Scene scene = sceneOf(setting);
    const auto special = drawn(renderer, scene, {}), general = drawn(renderer, scene, {everyEffect(), {}});
    return differing(special, general);
}

/// A change of a row's GLSL that shows where nothing calls for it.
struct Mutant {
    std::string_view row;
    struct Edit {
        const char *file, *from, *to;
    };
    std::vector<Edit> edits;
};
const Mutant kMutants[] = {
    {"checker", {{"lib/found.glsl", "material.phong.w != 0.0 && isDarkField(at)", "isDarkField(at)"}}},
    {"blend", {{"lib/found.glsl", "both.look = mixed(a.look, b.look, share)", "both.look = mixed(a.look, b.look, 0.5 * share)"}}},
    {"ambient occlusion", {{"lib/effects/ambient_occlusion.glsl", "/ float(rays) : 1.0", "/ float(rays) : 0.9"}}},
    {"emission", {{"lib/effects/emission.glsl", "materialEmission(s.look)", "(materialEmission(s.look) + 0.01)"}}},
    {"light", {{"lib/effects/light.glsl", "vec3 sum = vec3(0.0)", "vec3 sum = vec3(0.01)"}}},
    {"hard shadow", {{"lib/effects/hard_shadow.glsl", "? 0.0 : 1.0", "? 0.0 : 0.9"}}},
    {"soft shadow", {{"lib/effects/soft_shadow.glsl", "/ float(rays) : 1.0", "/ float(rays) : 0.9"}}},
    {"specular", {{"lib/effects/specular.glsl", "s.specular *", "(s.specular + 0.01) *"}}},
    {"fog", {{"lib/effects/fog.glsl", "exp(-worldFog()", "exp(-(worldFog() + 0.01)"}}},
    {"reflection", {{"lib/blocks.glsl", "return frame.limits.z;", "return frame.limits.z + 1;"},
                    {"lib/effects/reflection.glsl", "weight *= s.reflectance;", "weight *= max(s.reflectance, 0.1);"}}},
    {"tone mapping", {{"develop.glsl", "#effects film", "#effects film\n    c *= 0.9;"}}},
};
Texts mutated(const Mutant& mutant) {
    Texts texts = shaderLibrary();
    for (const auto& [file, from, to] : mutant.edits) {
        std::string& text = texts.find(file)->second;
        const std::size_t at = text.find(from);
        REQUIRE_MESSAGE(at != text.npos, file << ": " << from);
        text.replace(at, std::strlen(from), to);
    }
    return texts;
}

}  // namespace

TEST_CASE("every switch calls for its row, and nothing else does") {
    for (std::size_t i = 0; i < kCount; ++i) {
        Setting setting;
        for (std::size_t at = i; at < kCount; at = kSwitches[at].needs.empty() ? kCount : switchOf(kSwitches[at].needs)) setting.set(at);
        CAPTURE(kSwitches[i].row);
        const Scene with = sceneOf(setting);
        CHECK(makePlan(with, makeTree(with)).has(kSwitches[i].row));
        if (!feasible(setting.reset(i))) continue;
        const Scene without = sceneOf(setting);
        CHECK(!makePlan(without, makeTree(without)).has(kSwitches[i].row));
    }
    // Every row of the picture has a switch here, but the grid, which is a way to evaluate: two_ways.cpp.
    for (const Effect& effect : effects())
        if (effect.ofPicture() && effect.name != "grid") CHECK_MESSAGE(switchOf(effect.name) < kCount, effect.name);
}

TEST_CASE("the specialised picture is the general one to the bit, pairwise over the rows") {
    HeadlessRenderer headless;
    const std::vector<Setting> settings = pairwise();
    MESSAGE(settings.size() << " settings hold " << feasiblePairs().size() << " pairs");
    for (const Evaluation evaluation : {Evaluation::straight, Evaluation::grid}) {
        headless.renderer->setEvaluation(evaluation);
        for (const Setting& setting : settings) {
            const std::size_t n = difference(*headless.renderer, setting);
            CHECK_MESSAGE(n == 0, n << " pixels differ with " << namesOf(setting));
        }
    }
}

TEST_CASE("a change of any row's GLSL that shows uncalled for breaks the equality") {
    HeadlessRenderer headless;
    const std::vector<Setting> settings = pairwise();
    for (const Mutant& mutant : kMutants) {
        headless.renderer->setLibrary(mutated(mutant));
        const std::size_t row = switchOf(mutant.row);
        const bool seen = std::ranges::any_of(settings, [&](const Setting& s) { return !s[row] && difference(*headless.renderer, s) > 0; });
        CHECK_MESSAGE(seen, mutant.row);
    }
}

TEST_CASE("a program that measured slower than the general one is dropped for it, and the picture stays") {
    const auto saved = [](double ms, double least, double most) {
        Price price;
        price.measured = true, price.ms = ms, price.ms_least = least, price.ms_most = most, price.frame_ms = 10;
        return price;
    };
    CHECK(ownIsSlower(saved(-1, -2, -0.5)));
    CHECK(!ownIsSlower(saved(-1, -2, 0.5)));       // not in every round
    CHECK(!ownIsSlower(saved(-0.1, -0.2, -0.05))); // by less than a fiftieth
    CHECK(!ownIsSlower(saved(1, 0.5, 2)));
    CHECK(!ownIsSlower(Price{}));

    HeadlessRenderer headless;
    Renderer& renderer = *headless.renderer;
    const Scene scene = sceneOf(Setting().set(switchOf("light")));
    const auto own = drawn(renderer, scene, {});
    CHECK(!renderer.plan().has("fog"));
    renderer.preferGeneral(scene);
    const auto general = drawn(renderer, scene, {});
    CHECK(renderer.plan().has("fog"));
    CHECK(differing(own, general) == 0);
    drawn(renderer, sceneOf(Setting().set(switchOf("fog"))), {});
    CHECK(!renderer.plan().has("light"));  // another scene keeps its own
}

TEST_CASE("the ledger prices what is called for, says what was left out, and puts first what costs and is never seen") {
    HeadlessRenderer headless;
    Scene scene = sceneOf(Setting().set(switchOf("light")).set(switchOf("hard shadow")));
    addObject(scene, "sphere", {0.3}, {0, 0.5, -300});  // beyond what can be seen
    scene.objects.back().name = "unseen", scene.objects.back().material = 1;
    PictureLedger ledger(scene, kCamera, {kSize, 1, 8, true, true});
    double before = 0;
    while (ledger.step(*headless.renderer)) {
        CHECK(ledger.progress() >= before);
        before = ledger.progress();
    }
    CHECK(ledger.progress() == 1);
    CHECK(ledger.effects().size() + motionEffects().size() == effects().size());
    for (const EffectPrice& row : ledger.effects()) {
        CAPTURE(row.effect->name);
        CHECK((row.price.measured || !row.price.note.empty()));
        CHECK(row.called == !row.because.empty());
        const bool seen = row.called && row.effect->name != "subtract";
        if (!row.called && row.effect->name != "grid") CHECK(row.price.largest == 0);  // code that is there changes nothing
        if (seen) CHECK(row.price.largest > 0);
        if (row.effect->name == "hard shadow") CHECK(row.price.evaluations > 0);
        if (row.effect->name == "hard shadow") CHECK(describe(scene, row.because[0]) == "light 'point' (size:0, shadow_steps:256)");
    }
    const auto unseen = std::ranges::find_if(ledger.records(), [&](const RecordPrice& r) { return describe(scene, r.record).find("unseen") != std::string::npos; });
    REQUIRE(unseen != ledger.records().end());
    CHECK(!unseen->seen());
    const auto seen = std::ranges::find_if(ledger.records(), &RecordPrice::seen);
    CHECK(seen - ledger.records().begin() == std::ranges::count_if(ledger.records(), [](const RecordPrice& r) { return !r.seen(); }));
    CHECK(std::ranges::any_of(ledger.records(), [](const RecordPrice& r) { return r.record.record == Because::Record::light && r.seen(); }));
}
