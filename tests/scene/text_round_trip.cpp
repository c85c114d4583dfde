// What is written reads back to the same bits, and what is read keeps its meaning.
#include "core/scene/text.h"
#include "core/scene/text_lex.h"
#include "scene/random_scene.h"

#include <doctest/doctest.h>

#include <bit>
#include <clocale>
#include <fstream>
#include <locale>
#include <set>
#include <sstream>

using namespace mb;

namespace {

std::string contents(const std::string& path) {
    std::ostringstream out;
    out << std::ifstream(path, std::ios::binary).rdbuf();
    return out.str();
}
std::string sample(std::string_view name) { return contents(fmt::format(MARCHBOX_SOURCE "/tests/fuzz/corpus/{}", name)); }

/// The first fault of a text, for a message.
std::string why(const ReadResult& r) { return r.ok() ? "" : describe(r.faults.front(), "scene"); }

/// Reads, writes and reads again; both scenes and both texts must be equal.
void roundTrips(const Scene& scene) {
    const std::string text = writeScene(scene);
    const ReadResult back = readScene(text);
    REQUIRE_MESSAGE(back.ok(), why(back), "\n", text);
    REQUIRE_MESSAGE(sameScene(back.scene, scene), text);
    REQUIRE(writeScene(back.scene) == text);
}

}  // namespace

TEST_CASE("the format's own example") {
    const ReadResult r = readScene(sample("die.txt"));
    REQUIRE_MESSAGE(r.ok(), why(r));
    const Scene& s = r.scene;
    CHECK(s.world.background == glm::dvec3{0.55, 0.7, 0.9});
    CHECK(s.cameras.at(0).fov == 55);
    CHECK(s.lights.at(0).pos == glm::dvec3{4, 6, 3});
    CHECK(s.materials.at(0).pattern == Pattern::checker);
    CHECK(s.materials.at(1).kd == 0.8);
    REQUIRE(s.objects.size() == 5);
    CHECK(s.objects[1].mass == 1);
    CHECK(s.objects[2].density == 700);
    CHECK(s.objects[2].type == findShapeType("subtract"));
    CHECK(s.objects[3].parent == 2);
    CHECK(s.objects[4].parent == 2);
    CHECK(s.objects[3].numbers[3] == 0.05);
    CHECK(s.objects[0].material == 0);
    CHECK(s.objects[3].material == kNoMaterial);
    std::set<std::uint32_t> ids;
    for (const Object& o : s.objects) ids.insert(o.id.value);
    CHECK(ids.size() == 5);
    CHECK(ids.count(0) == 0);
    CHECK(r.warnings.empty());
    roundTrips(s);
}

TEST_CASE("an empty scene is one line, and what says nothing is not written") {
    CHECK(writeScene(Scene{}) == "marchbox 1\n");
    CHECK(writeScene(readScene("marchbox 1\nworld\nrender samples:1\ncamera\nobject type:box size:1,1,1 round:0 rot:0,0,0\n").scene) ==
          "marchbox 1\ncamera\nobject type:box size:1,1,1\n");
    CHECK(writeScene(readScene("marchbox 1\nobject type:mirror axis:x\n  object type:plane rot:-0,0,0 name:\"a b\"\n").scene) ==
          "marchbox 1\nobject type:mirror axis:x\n  object name:\"a b\" type:plane rot:-0,0,0\n");
}

TEST_CASE("every type is read and written, and what cannot be drawn is warned of") {
    const ReadResult r = readScene(sample("types.txt"));
    REQUIRE_MESSAGE(r.ok(), why(r));
    roundTrips(r.scene);
    CHECK(r.scene.materials[0].name == "a \"quoted\" \\ name");
    CHECK(r.warnings.empty());
    const ReadResult twisted = readScene("marchbox 1\nobject type:union\n  object name:spiral type:twist turns:1\n    object type:plane\n");
    REQUIRE(twisted.warnings.size() == 1);
    CHECK(twisted.warnings[0].message.find("object 'spiral' (twist) holds a shape without bounds") == 0);
    CHECK(twisted.warnings[0].line == 3);
    CHECK(readScene("marchbox 1\nobject type:sphere radius:1 mass:1\n").warnings.empty());
}

TEST_CASE("scenes at random round-trip to the bit") {
    std::mt19937_64 random(test::fromEnvironment("TEST_SEED", 1));
    test::RandomScene scene(random);
    const unsigned long count = test::fromEnvironment("TEST_COUNT", 10'000);
    for (unsigned long i = 0; i < count; ++i) roundTrips(scene());
}

TEST_CASE("doubles at random are written in the fewest digits that give them back") {
    std::mt19937_64 random(test::fromEnvironment("TEST_SEED", 1));
    for (int i = 0; i < 100'000; ++i) {
        const double x = std::bit_cast<double>(random());
        if (!std::isfinite(x)) continue;
        bool overflow = false;
        const std::string text = text::number(x);
        const std::optional<double> back = text::parseNumber(text, overflow);
        REQUIRE_MESSAGE(back, text);
        REQUIRE(std::bit_cast<std::uint64_t>(*back) == std::bit_cast<std::uint64_t>(x));
        REQUIRE(text.size() <= 24);
    }
    CHECK(text::number(0.1) == "0.1");
    CHECK(text::number(1e6) == "1e6");
    CHECK(text::number(1e-7) == "1e-7");
    CHECK(text::number(1e100) == "1e100");
    CHECK(text::number(-0.0) == "-0");
}

TEST_CASE("a name that no text can hold is made into one that can") {
    Scene s;
    s.cameras.emplace_back().name = std::string("a\nb\0c\xff", 6);
    const ReadResult back = readScene(writeScene(s));
    REQUIRE_MESSAGE(back.ok(), why(back));
    CHECK(back.scene.cameras[0].name == "a b c\ufffd");
}

TEST_CASE("line ends, a byte order mark, blanks and comments change nothing but the comment at the head") {
    const std::string plain = sample("die.txt");
    const Scene scene = readScene(plain).scene;
    std::string crlf, noisy = "\n# one\n";
    for (const char c : plain) {
        if (c == '\n') crlf += '\r', noisy += "  # behind\n\n   \t\n# before";
        crlf += c, noisy += c;
    }
    for (const std::string& text : {"\xef\xbb\xbf" + plain, crlf, noisy, plain.substr(0, plain.size() - 1)}) {
        ReadResult r = readScene(text);
        CHECK_MESSAGE(r.ok(), why(r));
        r.scene.comment = scene.comment;  // the one thing they do change
        CHECK(sameScene(r.scene, scene));
    }
    CHECK(readScene("marchbox 1\nmaterial name:\"a # b\" # c\n").scene.materials.at(0).name == "a # b");
}

TEST_CASE("the older form") {
    const ReadResult r = readScene(sample("older.txt"));
    REQUIRE_MESSAGE(r.ok(), why(r));
    const Scene& s = r.scene;
    REQUIRE(s.materials.size() == 3);
    CHECK(s.materials[0].color == glm::dvec3{0.9, 0.1, 0.1});
    CHECK(s.materials[0].kr == 0.3);
    CHECK(s.materials[1].kr == 0);
    CHECK(s.materials[2].pattern == Pattern::checker);
    CHECK(s.cameras.size() == 1);
    REQUIRE(s.lights.size() == 1);
    CHECK(s.lights[0].pos == glm::dvec3{5, 10, 5});
    CHECK(s.lights[0].color == glm::dvec3{1});
    REQUIRE(s.objects.size() == 4);
    CHECK(s.objects[0].type->name == "sphere");
    CHECK(s.objects[0].mass == 1);
    CHECK(s.objects[1].numbers[0] == 1);
    CHECK(!s.objects[1].isBody());
    CHECK(s.objects[2].numbers[0] == 1);
    CHECK(s.objects[2].numbers[1] == 0.25);
    CHECK(s.objects[3].type->name == "plane");
    CHECK(s.objects[3].material == 2);
    roundTrips(s);

    const auto faults = [](std::string_view text) {
        std::string out;
        for (const Fault& f : readScene(text).faults) out += fmt::format("{}:{}: {};", f.line, f.column, f.message);
        return out;
    };
    const std::string material = "r:1 g:1 b:1 Ka:0 Kd:0 Ks:0 C:1\n";
    CHECK(faults(material + "type:0 material:1 pos:0,0,0 radius:1 mass:1\n") ==
          "2:17: 'material' is 1, expected one of the file's 1, counted from 0;");
    CHECK(faults("type:0 material:0 pos:0,0,0 radius:1 mass:1\n" + material).empty());
    CHECK(faults(material + "type:3 material:0 pos:0,0,0 radius:1 mass:1\n") == "2:6: 'type' is 3, expected a whole number from 0 to 2;");
    CHECK(faults(material + "type:0 material:-1 pos:0,0,0 radius:1 mass:1\n").starts_with("2:17: 'material' is -1,"));
    CHECK(faults(material + "type:0 material:0 pos:0,0 radius:1\n") ==
          "2:1: no 'mass', which an object must have;2:23: 'pos' has 2 values, expected 3 numbers joined by commas;");
    CHECK(faults("r:1 g:1 b:1 Ka:0 Kd:0 Ks:0 Kq:1 C:1\n") == "1:28: unknown key 'Kq' of a material, the nearest is 'Ka';");
    CHECK(faults(material + "object type:sphere radius:1\n") ==
          "2:1: a line of no known form, expected 'r:… g:… b:… …', 'type:… …', or 'marchbox 1' first;");
    CHECK(faults(material + "  " + material) == "2:3: an indented line, expected none in a file without 'marchbox 1';");
}

TEST_CASE("every prefix and every changed byte of a sample is read or refused") {
    std::mt19937_64 random(test::fromEnvironment("TEST_SEED", 1));
    for (const char* name : {"die.txt", "types.txt", "older.txt"}) {
        const std::string text = sample(name);
        for (std::size_t n = 0; n < text.size(); ++n)
            if (const ReadResult r = readScene(std::string(text.substr(0, n))); r.ok()) roundTrips(r.scene);
        for (std::size_t i = 0; i < text.size(); ++i)
            for (const char c : {'\0', '"', '\\', '#', ':', ',', ' ', '\n', '\r', '-', '9', 'x', '\xff', static_cast<char>(random())}) {
                std::string changed = text;
                changed[i] = c;
                if (const ReadResult r = readScene(changed); r.ok()) roundTrips(r.scene);
                else REQUIRE(r.faults.size() <= kMaxFaults);
            }
    }
}

TEST_CASE("the locale changes nothing") {
    const std::string text = sample("die.txt");
    const Scene scene = readScene(text).scene;
    const std::string written = writeScene(scene);
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
    for (const char* name : {"C", "de_DE.UTF-8", "tr_TR.UTF-8"}) {
        if (!std::setlocale(LC_ALL, name)) continue;  // not installed here
        CHECK(sameScene(readScene(text).scene, scene));
        CHECK(writeScene(scene) == written);
    }
    std::setlocale(LC_ALL, "C");
    std::locale::global(before);
}

TEST_CASE("one knob at a time") {
    Scene s;
    CHECK(!setKnob(s, "samples=4"));
    CHECK(s.render.samples == 4);
    CHECK(!setKnob(s, "gravity=-1.5"));
    CHECK(s.world.gravity == -1.5);
    CHECK(!setKnob(s, "background=1,0.5,0"));
    CHECK(s.world.background == glm::dvec3{1, 0.5, 0});
    CHECK(!setKnob(s, "dt=0.001"));
    CHECK(s.physics.dt == 0.001);
    CHECK(!setKnob(s, "show_undecided=1"));
    const Scene before = s;
    CHECK(setKnob(s, "samples=0") == "'samples' is 0, expected a whole number from 1 to 256");
    CHECK(setKnob(s, "smaples=2") == "unknown key 'smaples' of world, render or physics, the nearest is 'samples'");
    CHECK(setKnob(s, "samples") == "'samples' has no '=', expected KEY=VALUE");
    CHECK(setKnob(s, "=1")->starts_with("unknown key ''"));
    CHECK(setKnob(s, "background=1,2,x") == "'background' is 'x', expected a number from 0 to 1e6");
    CHECK(setKnob(s, "gravity=")->starts_with("'gravity' is ''"));
    CHECK(setKnob(s, "samples=\x1b[2J")->starts_with("'samples' is '?[2J'"));
    CHECK(setKnob(s, "samples=" + std::string(100'000, '1'))->starts_with("'samples' has 100000 characters"));
    CHECK(sameScene(s, before));
}

TEST_CASE("edit distance") {
    CHECK(text::editDistance("", "abc") == 3);
    CHECK(text::editDistance("raduis", "radius") == 1);
    CHECK(text::editDistance("kitten", "sitting") == 3);
    CHECK(text::editDistance("same", "same") == 0);
}

TEST_CASE("the comment at the head of a file is kept, and those below are not") {
    const std::string text = "marchbox 1\n\n# one\n   #two\r\n\n# \"three\nworld gravity:1\n# four\n";
    const ReadResult read = readScene(text);
    REQUIRE(read.ok());
    CHECK(read.scene.comment == "# one\n#two\n# \"three\n");
    CHECK(writeScene(read.scene) == "marchbox 1\n# one\n#two\n# \"three\nworld gravity:1\n");
    Scene other = read.scene;
    other.comment = "# another\n";
    CHECK(!sameScene(read.scene, other));
}
