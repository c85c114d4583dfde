// Every fault, with its place and its words.
#include "core/scene/keys.h"
#include "core/scene/text.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

using namespace mb;

namespace {

/// Everything that is wrong with a text, "LINE:COLUMN: message" a line.
std::string faults(std::string_view text) {
    std::string out;
    for (const Fault& f : readScene(text).faults) out += fmt::format("{}:{}: {}\n", f.line, f.column, f.message);
    if (!out.empty()) out.pop_back();
    return out;
}
/// The same, of records behind the first one.
std::string in(std::string_view records) { return faults(fmt::format("marchbox 1\n{}", records)); }

std::string repeated(std::string_view text, std::size_t n) {
    std::string out;
    for (std::size_t i = 0; i < n; ++i) out += text;
    return out;
}

}  // namespace

TEST_CASE("a fault is told as FILE:LINE:COLUMN: error: what is wrong") {
    CHECK(describe({3, 7, "no such thing"}, "a.txt") == "a.txt:3:7: error: no such thing");
    CHECK(describe({3, 7, "mind this"}, "a.txt", "warning") == "a.txt:3:7: warning: mind this");
}

TEST_CASE("the first record is marchbox 1") {
    CHECK(faults("") == "1:1: there is no record, expected 'marchbox 1'");
    CHECK(faults("\n# nothing\n") == "1:1: there is no record, expected 'marchbox 1'");
    CHECK(faults("world gravity:1\nmarchbox 1\n") ==
          "1:1: the first record is not 'marchbox 1', expected it before all others\n"
          "2:1: a second 'marchbox', expected one, at the start of the file");
    CHECK(faults("hello world\n") == "1:1: the first record is not 'marchbox 1', expected it before all others");
    CHECK(faults("marchbox 2\nfuture thing\n") ==
          "1:10: the file is of version 2, expected at most 1: a newer marchbox wrote it");
    CHECK(faults("marchbox 99999999999999999999\n").starts_with("1:10: the file is of version 99999999999999999999,"));
    CHECK(faults("marchbox 0\n") == "1:10: the version is not known, expected 'marchbox 1'");
    CHECK(faults("marchbox\n") == "1:1: the version is not known, expected 'marchbox 1'");
    CHECK(faults("marchbox one\n") == "1:10: the version is not known, expected 'marchbox 1'");
    CHECK(faults("marchbox 1 2\n") == "1:10: the version is not known, expected 'marchbox 1'");
    CHECK(faults("  marchbox 1\n") == "1:3: 'marchbox' is indented, expected it at the start of the line");
}

TEST_CASE("what is not known names the nearest that is") {
    CHECK(in("wrold gravity:1\n") == "2:1: unknown keyword 'wrold', the nearest is 'world'");
    CHECK(in("world gravty:1\n") == "2:7: unknown key 'gravty' of 'world', the nearest is 'gravity'");
    CHECK(in("object type:shpere radius:1\n") == "2:13: unknown type 'shpere', the nearest is 'sphere'");
    CHECK(in("object type:sphere raduis:1\n") ==
          "2:1: no 'radius', which a 'sphere' must have\n2:20: unknown key 'raduis' of a 'sphere', the nearest is 'radius'");
    CHECK(in("material name:clay ka:1\n") == "2:20: unknown key 'ka' of 'material', the nearest is 'Ka'");
    CHECK(in("material name:m pattern:chequer\n") ==
          "2:25: 'pattern' is 'chequer', expected none, checker, the nearest is 'checker'");
    CHECK(in("object type:sphere radius:1 material:clya\nmaterial name:clay\nmaterial name:gold\n") ==
          "2:38: unknown material 'clya', the nearest is 'clay'");
    CHECK(in("object type:sphere radius:1 material:clay\n") == "2:38: unknown material 'clay'");
    CHECK(in("object type:mirror axis:w\n  object type:sphere radius:1\n") ==
          "2:25: 'axis' is 'w', expected x, y, z, the nearest is 'x'");
}

TEST_CASE("a key stands once, a name is unlike the others, and what is required is there") {
    CHECK(in("world gravity:1 gravity:2\n") == "2:17: 'gravity' stands twice in this record, expected once");
    CHECK(in("object type:sphere type:box radius:1\n") == "2:20: 'type' stands twice in this record, expected once");
    CHECK(in("object type:sphere radius:1 radius:2\n") == "2:29: 'radius' stands twice in this record, expected once");
    CHECK(in("material name:a\nmaterial name:\"a\"\n") ==
          "3:15: the material of line 2 is called 'a' too, expected a name of its own");
    CHECK(in("camera name:a\ncamera name:a\n") == "3:13: the camera of line 2 is called 'a' too, expected a name of its own");
    CHECK(in("light pos:0,0,0 name:a\nlight pos:0,0,0 name:a\n") ==
          "3:22: the light of line 2 is called 'a' too, expected a name of its own");
    CHECK(in("object type:sphere radius:1 name:a\nobject type:sphere radius:1 name:a\n") ==
          "3:34: the object of line 2 is called 'a' too, expected a name of its own");
    CHECK(in("camera name:a\nlight pos:0,0,0 name:a\nmaterial name:a\nobject type:sphere radius:1 name:a\n").empty());
    CHECK(in("object name:\"\" type:sphere radius:1\nobject name:\"\" type:sphere radius:1\n").empty());
    CHECK(in("light\n") == "2:1: no 'pos', which 'light' must have");
    CHECK(in("material Ka:0\n") == "2:1: no 'name', which 'material' must have");
    CHECK(in("material name:\"\"\n") == "2:15: the name of a material is empty, expected one");
    CHECK(in("object name:a\n") == "2:1: no 'type', which an object must have");
    CHECK(in("object type:torus major:1\n") == "2:1: no 'minor', which a 'torus' must have");
    for (const char* word : {"world", "render", "physics"})
        CHECK(in(fmt::format("{0}\n{0}\n", word)) == fmt::format("3:1: a second '{}' record, expected one: the first is on line 2", word));
}

TEST_CASE("a value has the shape and the range of its key") {
    CHECK(in("world gravity:fast\n") == "2:15: 'gravity' is 'fast', expected a number from -10000 to 10000");
    CHECK(in("world gravity:\"9\"\n") == "2:15: 'gravity' is text in quotes, expected a number from -10000 to 10000");
    CHECK(in("world gravity:1,2\n") == "2:15: 'gravity' has 2 values, expected 1 number");
    CHECK(in("world background:1,2\n") == "2:18: 'background' has 2 values, expected 3 numbers joined by commas");
    CHECK(in("world background:1,2,3,4\n") == "2:18: 'background' has 4 values, expected 3 numbers joined by commas");
    CHECK(in("world background:1,,3\n") == "2:20: 'background' is '', expected a number from 0 to 1e6");
    CHECK(in("world background:1,-2,3\n") == "2:20: 'background' is -2, expected a number from 0 to 1e6");
    CHECK(in("object type:sphere radius:-1\n") == "2:27: 'radius' is -1, expected a number from 1e-6 to 1e6");
    CHECK(in("camera fov:0\n") == "2:12: 'fov' is 0, expected a number from 0.001 to 179");
    CHECK(in("object type:sphere radius:1 scale:0\n") == "2:35: 'scale' is 0, expected a number from 1e-6 to 1e6");
    CHECK(in("render samples:1.5\n") == "2:16: 'samples' is 1.5, expected a whole number from 1 to 256");
    CHECK(in("render samples:1e9\n") == "2:16: 'samples' is 1e9, expected a whole number from 1 to 256");
    CHECK(in("object type:prism sides:4.5 radius:1 height:1\n") == "2:25: 'sides' is 4.5, expected a whole number from 3 to 12");
    CHECK(in("object type:repeat cell:1,1,1 count:1,2.5,1\n  object type:sphere radius:1\n") ==
          "2:39: 'count' is 2.5, expected a whole number from 1 to 1e6");
    CHECK(in("object type:sphere radius:1 hidden:2\n") == "2:36: 'hidden' is 2, expected a whole number from 0 to 1");
    CHECK(in("object type:sphere radius:1 name:7\n") == "2:34: 'name' is '7', expected a word, or text in quotes");
    CHECK(in("object type:plane normal:0,0,0\n") == "2:26: 'normal' has no length, expected a direction");
    CHECK(in("object type:plane normal:1e-200,0,0\n") == "2:26: 'normal' has no length, expected a direction");
    CHECK(in("camera eye:1,2,3 target:1,2,3\n") == "2:1: 'eye' and 'target' are the same point, expected two");
    CHECK(in("camera eye:0,1,0\n") == "2:1: 'eye' and 'target' are the same point, expected two");
}

TEST_CASE("numbers: what is one and what is not") {
    const auto gravity = [](std::string_view number) {
        const ReadResult r = readScene(fmt::format("marchbox 1\nworld gravity:{}\n", number));
        return r.ok() ? fmt::format("{}", r.scene.world.gravity) : "refused: " + r.faults.front().message;
    };
    for (const auto& row : {std::pair{"1", "1"}, {"-1", "-1"}, {"1.", "1"}, {".5", "0.5"}, {"-.5", "-0.5"}, {"1e3", "1000"},
                                      {"1E+3", "1000"}, {"1e-3", "0.001"}, {"007", "7"}, {"-0", "-0"}, {"5e-324", "5e-324"}})
        CHECK_MESSAGE(gravity(row.first) == row.second, row.first);
    for (const char* text : {"nan", "inf", "-inf", "+1", "0x1p3", "0x1", "1e", "1e+", "--1", "1-1", ".", "-", "e5", "1.2.3", "1f", "1_000",
                             "٣", "1;", "NaN", "Infinity", "1e1.5", "1 e5"})
        CHECK_MESSAGE(gravity(text).starts_with("refused: "), text);
    CHECK(gravity("1e400") == "refused: 'gravity' is 1e400, which no double holds, expected a number from -10000 to 10000");
    CHECK(gravity("1e-400") == "refused: 'gravity' is 1e-400, which no double holds, expected a number from -10000 to 10000");
    CHECK(gravity("1e999999999999").starts_with("refused: 'gravity' is 1e999999999999, which"));
    CHECK(gravity("0." + std::string(126, '1')).starts_with("0.1111"));
    CHECK(gravity("0." + std::string(126, '0')) == "0");
    CHECK(gravity("0." + std::string(127, '0')) == "refused: 'gravity' has 129 characters, expected a number of at most 128");
}

TEST_CASE("pieces that are none") {
    CHECK(in("world gravity\n") == "2:7: 'gravity' is no key, expected key:value");
    CHECK(in("world gravity:\n") == "2:15: no value behind 'gravity:'");
    CHECK(in("world gravity: 9\n") == "2:15: no value behind 'gravity:'\n2:16: '9' is no key, expected key:value");
    CHECK(in("world :9\n") == "2:7: ':9' is no key, expected key:value");
    CHECK(in("world 9:9\n") == "2:7: '9:9' is no key, expected key:value");
    CHECK(in("pos:1,2,3\n") == "2:1: the record has no keyword, expected one of world, camera, light, material, render, physics, object");
    CHECK(in("material name:\"a\n") == "2:15: the quotes are not closed, expected \" before the end of the line");
    CHECK(in("material name:\"a\\n\"\n") == "2:17: a backslash in quotes, expected \\\" or \\\\");
    CHECK(in("material name:\"a\"b\n") == "2:18: text behind a closing quote inside a value, expected quotes around the whole of it");
    CHECK(in("material name:a\"b\"\n") == "2:16: a quote inside a value, expected quotes around the whole of it");
    CHECK(in("world \"a\"\n") == "2:7: text in quotes without a key, expected key:\"text\"");
    CHECK(in(fmt::format("world {:a>300}:1\n", "")) == fmt::format("2:7: '{:a>40}…' is no key, expected key:value", ""));
}

TEST_CASE("columns are characters") { CHECK(in("object name:\"åß€😀\" type:shpere\n") == "2:25: unknown type 'shpere', the nearest is 'sphere'"); }

TEST_CASE("indents and children") {
    const std::string ball = "object type:sphere radius:1\n";
    CHECK(in("object type:union\n " + ball) ==
          "2:1: 'union' has 0 children, expected at least 1 child\n3:2: an indent of 1 spaces, expected two a level");
    CHECK(in(ball + "    " + ball) == "3:5: an indent of 4 spaces, expected at most 2 here");
    CHECK(in("  " + ball) == "2:3: an indent of 2 spaces, expected at most 0 here");
    CHECK(in("object type:union\n\t" + ball).find("3:1: a tab in the indent, expected two spaces a level") != std::string::npos);
    CHECK(in(ball + "  " + ball) == "3:3: 'sphere' takes no children, expected an operator such as union");
    CHECK(in("world\n  " + ball) == "3:3: the record above it takes no children, expected an object that is an operator");
    CHECK(in("object type:union\n  " + ball + "  light pos:0,0,0\n") ==
          "4:3: 'light' is indented, expected it at the start of the line: only objects are children");
    CHECK(in("object type:union\n") == "2:1: 'union' has 0 children, expected at least 1 child");
    CHECK(in("object type:morph\n  " + ball) == "2:1: 'morph' has 1 child, expected 2 children");
    CHECK(in("object type:shell thickness:1\n  " + ball + "  " + ball + "  " + ball) ==
          "4:3: one child too many of 'shell', expected 1 child");
    // What cannot be read says nothing of its children.
    CHECK(in("object type:unoin\n  " + ball) == "2:13: unknown type 'unoin', the nearest is 'union'");
    CHECK(in("objekt type:union\n  " + ball) == "2:1: unknown keyword 'objekt', the nearest is 'object'");
    CHECK(in("object type:union name:\"\n  " + ball) == "2:24: the quotes are not closed, expected \" before the end of the line");
    CHECK(in("object type:union\n# \x01\n  " + ball) == "3:3: a control character (0x01), expected text");
    CHECK(in("object type:union\n  \x01\n    " + ball) == "3:3: a control character (0x01), expected text");
}

TEST_CASE("a body stands at the top and has one mass") {
    for (const char* key : {"mass:1", "density:1", "vel:1,0,0", "spin:1,0,0", "restitution:1", "friction:1", "rolling:1", "spinning:1"}) {
        const std::string name(key, std::string_view(key).find(':'));
        CHECK(in(fmt::format("object type:union\n  object type:sphere radius:1 {}\n", key)) ==
              fmt::format("3:31: '{}' is of a body, expected it only at the top level", name));
        CHECK(in(fmt::format("object type:union {}\n  object type:sphere radius:1\n", key)).empty());
    }
    CHECK(in("object type:sphere radius:1 mass:1 density:1\n") == "2:36: both 'mass' and 'density', expected one of them");
}

TEST_CASE("faults are collected across the file, twenty of them") {
    CHECK(in("world gravity:a\nlight\ncamera fov:0\n") ==
          "2:15: 'gravity' is 'a', expected a number from -10000 to 10000\n"
          "3:1: no 'pos', which 'light' must have\n"
          "4:12: 'fov' is 0, expected a number from 0.001 to 179");
    CHECK(readScene("marchbox 1\n" + repeated("light\n", 19)).faults.size() == 19);
    const ReadResult many = readScene("marchbox 1\n" + repeated("light\n", 5000));
    CHECK(many.faults.size() == kMaxFaults);
    CHECK(many.faults.back().line == 21);
    CHECK(many.scene.lights.empty());
}

TEST_CASE("encodings") {
    using namespace std::string_literals;
    CHECK(in("world gravity:1\0\n"s) == "2:16: a NUL byte, expected text");
    CHECK(faults("\xff\xfem\0a\0"s) == "1:1: the file is UTF-16, expected UTF-8");
    CHECK(faults("\xfe\xff\0m\0a"s) == "1:1: the file is UTF-16, expected UTF-8");
    CHECK(faults("m\0a\0r\0"s) == "1:1: the file is UTF-16, expected UTF-8");
    CHECK(faults("\0m\0a\0r"s) == "1:1: the file is UTF-16, expected UTF-8");
    CHECK(faults("\0\0\0\0"s) == "1:1: a NUL byte, expected text");
    CHECK(in("# caf\xe9\n") == "2:6: a byte (0xe9) that is not UTF-8, expected UTF-8");
    for (const char* bad : {"\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80", "\x80", "\xe2\x82", "\xff"})
        CHECK_MESSAGE(in(fmt::format("#{}\n", bad)).find("not UTF-8") != std::string::npos, bad);
    CHECK(in("world gravity:1\rlight\n") == "2:16: a carriage return inside a line, expected lines that end in LF or CRLF");
    CHECK(in("# a bell \a\n") == "2:10: a control character (0x07), expected text");
}

TEST_CASE("every limit has its own error") {
    std::string line(Limits::line_bytes, 'x');
    line[0] = '#';
    CHECK(in(line + "\n").empty());
    CHECK(in(line + "\r\n").empty());
    CHECK(in(line + "x\n") == "2:4097: the line has 4097 bytes, expected at most 4096");

    std::string whole = "marchbox 1\n";
    while (whole.size() < Limits::file_bytes) whole += line.substr(0, std::min(line.size(), Limits::file_bytes - whole.size() - 1)) + "\n";
    CHECK(whole.size() == Limits::file_bytes);
    CHECK(faults(whole).empty());
    CHECK(faults(whole + "\n") == "1:1: the file has 67108865 bytes, expected at most 67108864 (64 MiB)");

    const std::string ball = "object type:sphere radius:1\n", light = "light pos:0,0,0\n";
    CHECK(in(repeated(ball, Limits::objects)).empty());
    CHECK(in(repeated(ball, Limits::objects + 1)) == "100002:1: more than 100000 objects, expected at most as many");
    CHECK(in(repeated(light, Limits::lights)).empty());
    CHECK(in(repeated(light, Limits::lights + 1)) == "1026:1: more than 1024 lights, expected at most as many");
    CHECK(in(repeated("camera\n", Limits::cameras)).empty());
    CHECK(in(repeated("camera\n", Limits::cameras + 1)) == "1026:1: more than 1024 cameras, expected at most as many");
    std::string materials;
    for (std::size_t i = 0; i < Limits::materials; ++i) materials += fmt::format("material name:m{}\n", i);
    CHECK(in(materials).empty());
    CHECK(in(materials + "material name:one_more\n") == "4098:1: more than 4096 materials, expected at most as many");

    const auto nested = [&](std::size_t levels) {
        std::string text;
        for (std::size_t i = 0; i + 1 < levels; ++i) text += std::string(2 * i, ' ') + "object type:union\n";
        return text + std::string(2 * (levels - 1), ' ') + ball;
    };
    CHECK(in(nested(Limits::levels)).empty());
    CHECK(in(nested(Limits::levels + 1)).find("34:65: the record stands on level 33, expected at most 32") != std::string::npos);
    CHECK(!in(nested(2000)).empty());
}
