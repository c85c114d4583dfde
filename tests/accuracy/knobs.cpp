// The table of knobs, row by row.
#include "core/accuracy/knobs.h"
#include "core/scene/keys.h"
#include "core/scene/text.h"
#include "render/headless.h"

#include <algorithm>
#include <set>
#include <sstream>

using namespace mb;

namespace {

Scene sceneOf(const std::string& text) {
    const ReadResult read = readScene("marchbox 1\n" + text);
    REQUIRE_MESSAGE(read.ok(), (read.ok() ? "" : read.faults[0].message));
    return read.scene;
}

/// The range a file may use of a key of either record; nothing if there is no such key.
std::optional<std::pair<double, double>> rangeOf(std::string_view name) {
    for (const auto& key : keys<RenderKnobs>())
        if (key.name == name) return std::pair{key.lo, key.hi};
    for (const auto& key : keys<PhysicsKnobs>())
        if (key.name == name) return std::pair{key.lo, key.hi};
    return std::nullopt;
}
/// A setting with `--set` done to it, word by word.
Setting afterSet(const Setting& setting, const std::string& words) {
    Scene scene = withSetting({}, setting);
    std::istringstream stream(words);
    for (std::string word; stream >> word;) {
        const std::optional<std::string> fault = setKnob(scene, word);
        CHECK_MESSAGE(!fault, (word + ": " + fault.value_or("")));
    }
    return settingOf(scene);
}
bool has(const std::vector<const Knob*>& list, std::string_view key) { return std::ranges::find(list, key, &Knob::key) != list.end(); }

}  // namespace

TEST_CASE("knobs: each is a key of its record, with values in its range and in order") {
    std::set<std::string_view> seen;
    for (const Knob& knob : knobs()) {
        CAPTURE(std::string(knob.key));
        CHECK(seen.insert(knob.key).second);
        CHECK(&knobNamed(knob.key) == &knob);
        const auto range = rangeOf(knob.key);
        REQUIRE(range);
        REQUIRE(knob.values.size() >= 2);
        REQUIRE(!knob.moves.empty());
        CHECK(knob.title != "");
        const bool rises = knob.values[1] > knob.values[0];
        for (std::size_t i = 0; i < knob.values.size(); ++i) {
            CHECK(knob.values[i] >= range->first);
            CHECK(knob.values[i] <= range->second);
            if (i > 0) CHECK((knob.values[i] > knob.values[i - 1]) == rises);
            if (i > 0) CHECK(knob.values[i] != knob.values[i - 1]);
        }
        for (const Error e : knob.moves) CHECK(rowOf(e).motion == knob.ofMotion());
        CHECK(rowOf(knob.cost).motion == knob.ofMotion());
        // The default stands among the values, or takes its place there, as any other does.
        for (const double own : {valueOf({}, knob), knob.values.front(), knob.values.back(), 0.5 * (knob.values[0] + knob.values[1])}) {
            const std::vector<double> values = valuesWith(knob, {own});
            CHECK(std::ranges::count(values, own) == 1);
            const bool was_there = std::ranges::find(knob.values, own) != knob.values.end();
            CHECK(values.size() == knob.values.size() + (was_there ? 0 : 1));
            CHECK((std::ranges::is_sorted(values) || std::ranges::is_sorted(values, std::greater<>())));
        }
    }
    CHECK(seen.size() >= 18);
}

TEST_CASE("knobs: each is explained in two sentences of plain words") {
    for (const Knob& knob : knobs()) {
        CAPTURE(std::string(knob.key));
        int sentences = 0;
        for (std::size_t i = 0; i < knob.meaning.size(); ++i) sentences += knob.meaning[i] == '.' && (i + 1 == knob.meaning.size() || knob.meaning[i + 1] == ' ');
        CHECK(sentences == 2);
        CHECK(knob.meaning.back() == '.');
        CHECK(knob.meaning.size() > 60);
        for (const char* hard : {"epsilon", "Lipschitz", "gradient", "integrat", "derivative"}) CHECK(knob.meaning.find(hard) == std::string_view::npos);
    }
}

TEST_CASE("knobs: turned is what is read back, and nothing else moves") {
    for (const Knob& knob : knobs())
        for (const double value : knob.values) {
            CAPTURE(std::string(knob.key));
            CAPTURE(value);
            Setting before;
            before.render.samples = 7, before.physics.substeps = 3, before.render.scale = 0.6;
            const Setting after = turned(before, knob, value);
            CHECK(valueOf(after, knob) == value);
            for (const Knob& other : knobs())
                if (&other != &knob) CHECK(valueOf(after, other) == valueOf(before, other));
            // Back again it is the same, to the bit; and what --set makes of the difference is the setting.
            CHECK(differences(turned(after, knob, valueOf(before, knob)), before) == "");
            const Setting set = afterSet(before, differences(after, before));
            CHECK(differences(set, after) == "");
            CHECK(valueOf(set, knob) == value);
        }
}

TEST_CASE("knobs: the differences of random settings give them back") {
    std::uint64_t state = 1;
    const auto below = [&](std::size_t n) { return (state = state * 6364136223846793005u + 1442695040888963407u, (state >> 33) % n); };
    for (int round = 0; round < 200; ++round) {
        Setting a, b;
        for (const Knob& knob : knobs()) a = turned(a, knob, knob.values[below(knob.values.size())]), b = turned(b, knob, knob.values[below(knob.values.size())]);
        CHECK(differences(afterSet(b, differences(a, b)), a) == "");
        CHECK(differences(a, a) == "");
        // The defaults are every knob's of that kind, and no other's.
        for (const bool motion : {false, true})
            for (const Knob& knob : knobs()) CHECK(valueOf(defaultsOf(a, motion), knob) == (knob.ofMotion() == motion ? valueOf({}, knob) : valueOf(a, knob)));
        const Scene scene = withSetting({}, a);
        CHECK(differences(settingOf(scene), a) == "");
    }
}

TEST_CASE("knobs: a scene has those that can change anything in it") {
    const std::string ball = "object type:sphere radius:1\n", matte = "material name:m Ks:0\n";
    const auto of = [](const std::string& text, bool motion = false) { return knobsOf(sceneOf(text), motion); };
    const auto dark = of(ball), lit = of("light pos:3,3,3\n" + ball), unshadowed = of("render shadow_steps:0\nlight pos:3,3,3\n" + ball);
    for (const char* key : {"march_steps", "march_epsilon", "samples", "scale", "relaxation"}) CHECK(has(dark, key));
    for (const char* key : {"normal_epsilon", "normal_taps", "shadow_steps", "bias", "reflections", "shadow_rays", "ao_rays", "grid_scale"}) CHECK(!has(dark, key));
    for (const char* key : {"normal_epsilon", "normal_taps", "shadow_steps", "bias"}) CHECK(has(lit, key));
    CHECK(!has(lit, "reflections"));
    CHECK(has(unshadowed, "normal_taps"));
    CHECK(!has(unshadowed, "shadow_steps"));
    CHECK(!has(unshadowed, "bias"));
    const auto mirror = of("material name:m Kr:0.5\nobject type:sphere radius:1 material:m\n");
    CHECK(has(mirror, "reflections"));
    CHECK(has(mirror, "bias"));
    CHECK(!has(mirror, "shadow_steps"));
    CHECK(has(of("light pos:3,3,3 size:1\n" + ball), "shadow_rays"));
    CHECK(!has(lit, "shadow_rays"));
    CHECK(has(of("render ao:1\n" + ball), "ao_rays"));
    std::string many;
    for (int i = 0; i < 20; ++i) many += "object type:sphere radius:0.1 pos:" + std::to_string(i) + ",0,0\n";
    CHECK(has(of(many), "grid_scale"));
    CHECK(of(ball, true).empty());
    const auto moving = of("object type:sphere radius:1 mass:1\n", true);
    for (const Knob& knob : knobs()) CHECK(has(moving, knob.key) == knob.ofMotion());
    // In the order of the table.
    for (const auto& list : {dark, lit, mirror, moving}) CHECK(std::ranges::is_sorted(list));
}

TEST_CASE("knobs: each of a picture changes one somewhere, or says that only its price changes") {
    HeadlessRenderer headless;
    const char* const saves[] = {"evening", "mirrors", "blends"};
    for (const Knob& knob : knobs()) {
        if (knob.ofMotion()) continue;
        CAPTURE(std::string(knob.key));
        bool changes = false, matters = false;
        for (const char* save : saves) {
            const LoadResult loaded = loadScene(std::string(MARCHBOX_SOURCE "/saves/") + save + ".txt");
            REQUIRE(loaded.ok());
            if (changes || !has(knobsOf(loaded.scene, false), knob.key)) continue;
            matters = true;
            std::vector<glm::vec3> first;
            for (const double value : knob.values) {
                Scene scene = withSetting(loaded.scene, turned(settingOf(loaded.scene), knob, value));
                if (knob.key == "relaxation") scene.render.march_steps = 24;  // bold steps arrive where small ones run out
                if (headless.renderer->draw(scene, defaultCamera(scene), {48, 27}) != "") continue;  // too long for software OpenGL
                const std::vector<glm::vec3> picture = headless.renderer->readPicture();
                if (first.empty()) first = picture;
                if ((changes = picture != first)) break;
            }
        }
        CHECK(matters);
        const bool only_price = knob.meaning.find("only its price changes") != std::string_view::npos;
        const bool unseen = knob.meaning.find("change nothing that is seen") != std::string_view::npos;
        CHECK((changes || only_price || unseen));
        CHECK((knob.cost == Cost::ms) == only_price);
    }
}
