// The program as a user calls it: what it prints, what it writes, and how it ends.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace {

std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder of this test's own, gone with it.
struct Scratch {
    fs::path path = fs::temp_directory_path() / ("marchbox_cli_" + std::to_string(getpid()));
    Scratch() { fs::create_directories(path); }
    ~Scratch() { fs::remove_all(path); }
    std::string operator/(const std::string& name) const { return path / name; }
};

struct Ran {
    int code = -1;
    std::string out, err;
};
/// Runs the program in a shell; the arguments are of this file, so no quoting is at stake.
Ran run(const Scratch& scratch, const std::string& arguments) {
    const std::string out = scratch / "out", err = scratch / "err";
    const int status = std::system((std::string(MARCHBOX_BINARY) + " " + arguments + " >" + out + " 2>" + err + " </dev/null").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(out), read(err)};
}

/// The code of a command whose standard output goes there.
int runInto(const std::string& out, const std::string& arguments) {
    const int status = std::system((std::string(MARCHBOX_BINARY) + " " + arguments + " >" + out + " 2>/dev/null </dev/null").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

const std::string kScene = "marchbox 1\nworld restitution:0.5\nlight pos:3,5,4\nobject name:floor type:plane\n"
                           "object name:ball type:sphere pos:0,2.5,0 radius:0.5 mass:1\ncamera name:front eye:0,2,6\ncamera name:side eye:6,1,0 target:0,1,0\n";
std::string write(const Scratch& scratch, const std::string& name, const std::string& text) {
    std::ofstream(scratch / name, std::ios::binary) << text;
    return scratch / name;
}

/// The floats of a PFM, the top row first, with its channels and size.
struct Pfm {
    std::string kind;
    int width = 0, height = 0;
    std::vector<float> values;
};
Pfm readPfm(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    Pfm pfm;
    double scale = 0;
    file >> pfm.kind >> pfm.width >> pfm.height >> scale;
    file.get();
    CHECK(scale == -1.0);
    const std::size_t row = static_cast<std::size_t>(pfm.width) * (pfm.kind == "PF" ? 3 : 1);
    pfm.values.resize(row * static_cast<std::size_t>(pfm.height));
    for (int y = pfm.height - 1; y >= 0; --y)
        file.read(reinterpret_cast<char*>(pfm.values.data() + static_cast<std::size_t>(y) * row), static_cast<std::streamsize>(row * 4));
    CHECK(file.good());
    return pfm;
}

}  // namespace

TEST_CASE("help and version; a command line at fault ends with 2") {
    const Scratch scratch;
    for (const char* command : {"", "edit", "render", "simulate", "replay", "eval", "effects", "check", "bench", "bench render", "bench effects"}) {
        CAPTURE(command);
        const Ran help = run(scratch, std::string(command) + " --help");
        CHECK(help.code == 0);
        CHECK(help.out.find(*command ? "Example:" : "simulate") != std::string::npos);
    }
    CHECK(run(scratch, "--version").out.starts_with("marchbox "));
    const std::string scene = write(scratch, "s.txt", kScene);
    for (const std::string& arguments :
         {std::string("render"), "render " + scene, "render " + scene + " -o x.png --size 0x9", "render " + scene + " -o x.png --size 9",
          "render " + scene + " -o x.png --set nonsense", "render " + scene + " -o x.png --set march_step=9",
          "render " + scene + " -o x.png --set march_steps=0", "render " + scene + " -o x.png --aov deep", "render " + scene + " -o x.png --frames 2",
          "render " + scene + " -o x.mp4", "render " + scene + " -o x.jpg", "render " + scene + " -o -",
          "render " + scene + " -o x_%04d.png", "render " + scene + " -o x_%04d.mp4 --frames 2", "render " + scene + " -o x.png --at nan",
          "render " + scene + " -o x.png --size 99999x9", "simulate " + scene + " --seconds nan", "simulate " + scene + " --seconds 1 --dt nan",
          std::string("bench"), std::string("bench nothing"), std::string("bench render --only nonsense"), std::string("bench render --rounds 4"), std::string("bench render --quick --seed 4294967296"),
          std::string("bench render --quick --size 0x4"), std::string("bench render extra"), std::string("bench effects --only seed"), std::string("bench effects --rounds 4"), std::string("accuracy"), std::string("replay"), std::string("rendr"), "simulate " + scene, "simulate " + scene + " --seconds -1", "simulate " + scene + " --seconds 1e300", "eval " + scene,
          std::string("--nonsense")}) {
        CAPTURE(arguments);
        const Ran ran = run(scratch, arguments);
        CHECK(ran.code == 2);
        CHECK(ran.err != "");
    }
    CHECK(run(scratch, "render " + scene + " -o x.png --set march_step=9").err.find("march_steps") != std::string::npos);
}

TEST_CASE("an input at fault ends with 1 and its places; a file at fault ends with 4") {
    const Scratch scratch;
    const std::string bad = write(scratch, "bad.txt", "marchbox 1\nobject type:spher radius:1\nlight pos:1,2\n");
    const Ran checked = run(scratch, "check " + bad);
    CHECK(checked.code == 1);
    CHECK(checked.err.find(bad + ":2:") == 0);
    CHECK(checked.err.find("error: ") != std::string::npos);
    CHECK(checked.err.find("'sphere'") != std::string::npos);
    CHECK(checked.err.find(bad + ":3:") != std::string::npos);
    CHECK(run(scratch, "render " + bad + " -o " + scratch / "x.png").code == 1);
    CHECK(!fs::exists(scratch / "x.png"));

    CHECK(run(scratch, "check " + scratch / "missing.txt").code == 4);
    CHECK(run(scratch, "check " + scratch.path.string()).code == 4);
    CHECK(run(scratch, "check /dev/zero").code == 4);
    const std::string scene = write(scratch, "s.txt", kScene);
    CHECK(run(scratch, "render " + scene + " --size 16x9 -o " + scratch / "no/such/folder.png").code == 4);
    CHECK(run(scratch, "render " + scene + " --size 16x9 -o " + scratch / "x.png" + " --camera nobody").code == 1);
    CHECK(run(scratch, "eval " + scene + " --points " + scratch.path.string()).code == 4);
    // A full device is an error and stays a device; a link leads to its file; a file its owner made read-only stays.
    for (const char* command : {"check ", "effects --glsl ", "simulate --seconds 0.1 "}) CHECK(runInto("/dev/full", command + scene) == 4);
    CHECK(run(scratch, "render " + scene + " --size 16x9 -o /dev/full").code == 4);
    CHECK(fs::is_character_file("/dev/full"));
    fs::create_symlink("target.png", scratch / "link.png");
    CHECK(run(scratch, "render " + scene + " --size 16x9 -o " + scratch / "link.png").code == 0);
    CHECK(fs::is_symlink(scratch / "link.png"));
    CHECK(fs::is_regular_file(scratch / "target.png"));
    write(scratch, "kept.png", "mine");
    fs::permissions(scratch / "kept.png", fs::perms::owner_read);
    CHECK(run(scratch, "render " + scene + " --size 16x9 -o " + scratch / "kept.png").code == 4);
    CHECK(read(scratch / "kept.png") == "mine");
    const std::string greedy = write(scratch, "greedy.txt", kScene + "material name:m Kr:1\nobject type:sphere material:m radius:1\nrender reflections:64 march_steps:8192\n");
    CHECK(run(scratch, "check " + greedy).err.starts_with(greedy + ":10:1: error: "));
    CHECK(run(scratch, "check " + write(scratch, "plane.txt", "marchbox 1\nobject name:p type:plane mass:1\n")).err.find("is infinite") != std::string::npos);
    CHECK(run(scratch, "check --quiet " + scene).out == "");
    CHECK(run(scratch, "check " + scene + " " + bad).code == 1);
}

TEST_CASE("render writes the picture, its channels and its statistics") {
    const Scratch scratch;
    const std::string scene = write(scratch, "s.txt", kScene);
    const Ran ran = run(scratch, "render " + scene + " -o " + scratch / "p.png --size 64x36 --aov depth,normal,object,color,steps,state --stats " +
                                     scratch / "p.json");
    REQUIRE_MESSAGE(ran.code == 0, ran.err);
    CHECK(read(scratch / "p.png").starts_with("\x89PNG"));
    const Pfm depth = readPfm(scratch / "p.depth.pfm"), normal = readPfm(scratch / "p.normal.pfm"), object = readPfm(scratch / "p.object.pfm");
    const Pfm color = readPfm(scratch / "p.color.pfm"), steps = readPfm(scratch / "p.steps.pfm"), state = readPfm(scratch / "p.state.pfm");
    CHECK(depth.kind == "Pf");
    CHECK(normal.kind == "PF");
    CHECK(color.values.size() == 64u * 36 * 3);
    std::size_t hits = 0, misses = 0;
    double evaluations = 0;
    for (std::size_t i = 0; i < state.values.size(); ++i) {
        evaluations += static_cast<double>(steps.values[i]);
        if (state.values[i] == 1) {
            ++hits;
            CHECK((std::isfinite(depth.values[i]) && object.values[i] >= 0));
        } else if (state.values[i] == 0) {
            ++misses;
            CHECK((std::isinf(depth.values[i]) && object.values[i] == -1 && normal.values[3 * i] == 0));
        }
    }
    const auto stats = nlohmann::json::parse(read(scratch / "p.json"));
    CHECK(stats["width"] == 64);
    CHECK(stats["pixels"]["hit"] == hits);
    CHECK(stats["pixels"]["miss"] == misses);
    CHECK(stats["evaluations"]["primary"] == evaluations);
    CHECK(stats["rays"]["primary"] == 64 * 36);
    CHECK(stats["rays"]["reflection"] == 0);
    CHECK(stats["effects"] == nlohmann::json({"hard shadow", "specular", "light"}));
    CHECK(stats["frame_ms"] > 0);
    CHECK(stats["renderer"] != "");

    // Counts are the same on every run.
    run(scratch, "render " + scene + " -o " + scratch / "q.png --size 64x36 --stats " + scratch / "q.json");
    CHECK(nlohmann::json::parse(read(scratch / "q.json"))["evaluations"] == stats["evaluations"]);
    CHECK(read(scratch / "q.png") == read(scratch / "p.png"));
}

TEST_CASE("render --at, --camera, --set and --frames change what they say") {
    const Scratch scratch;
    const std::string scene = write(scratch, "s.txt", kScene);
    const auto picture = [&](const std::string& more) {
        const std::string file = scratch / "p.png";
        const Ran ran = run(scratch, "render " + scene + " --size 32x18 -o " + file + more);
        REQUIRE_MESSAGE(ran.code == 0, ran.err);
        return read(file);
    };
    const std::string plain = picture("");
    CHECK(picture(" --at 0.5") != plain);
    CHECK(picture(" --camera side") != plain);
    CHECK(picture(" --set background=1,0,0") != plain);
    CHECK(picture(" --set gravity=0 --set dt=0.01 --at 1") == plain);
    REQUIRE(run(scratch, "render " + scene + " --size 16x9 --frames 3 --fps 10 -o " + scratch / "f_%03d.png").code == 0);
    CHECK(fs::exists(scratch / "f_002.png"));
    CHECK(!fs::exists(scratch / "f_003.png"));
    if (std::system("command -v ffmpeg >/dev/null") == 0) {
        CHECK(run(scratch, "render " + scene + " --size 17x9 --frames 3 -o " + scratch / "f.mp4").code == 0);
        CHECK(fs::file_size(scratch / "f.mp4") > 100);
    } else {
        MESSAGE("no ffmpeg here: films are not tested");
    }
}

TEST_CASE("simulate prints one line of JSON, and a trace whose last row is the end") {
    const Scratch scratch;
    const std::string scene = write(scratch, "s.txt", kScene);
    const Ran ran = run(scratch, "simulate " + scene + " --seconds 0.5 --dt 0.01 --every 10 --trace " + scratch / "t.csv");
    REQUIRE_MESSAGE(ran.code == 0, ran.err);
    const auto json = nlohmann::json::parse(ran.out);
    CHECK(json["seconds"] == doctest::Approx(0.5));
    CHECK(json["steps"] == 50);
    CHECK(json["bodies"] == 1);
    CHECK(json["state"].get<std::string>().size() == 16);
    // One ball makes no pair: no stage for pairs is called for, and none counts anything.
    CHECK(json["stages"].dump().find("\"flight\"") != std::string::npos);
    CHECK(json["counts"]["integrations"] == 100);
    CHECK(json["stages"].dump().find("broad_phase") == std::string::npos);
    CHECK(json["counts"]["broad_phases"] == 0);
    // After half a second of free fall: v = g t, and the energy it began with.
    CHECK(json["energy"]["kinetic"].get<double>() == doctest::Approx(0.5 * std::pow(9.81 * 0.5, 2)).epsilon(1e-9));
    CHECK(json["momentum"][1].get<double>() == doctest::Approx(-9.81 * 0.5));
    CHECK(json["angular_momentum"] == nlohmann::json{0.0, 0.0, 0.0});
    CHECK(json["frozen"] == 0);
    CHECK(json["contacts"] == 0);

    std::istringstream trace(read(scratch / "t.csv"));
    std::string line, last;
    int rows = 0;
    std::getline(trace, line);
    CHECK(line == "time,name,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz");
    for (; std::getline(trace, line); ++rows) last = line;
    CHECK(rows == 6);
    CHECK(last.starts_with("0.5,ball,0,"));

    const auto state = [&](const std::string& more) { return nlohmann::json::parse(run(scratch, "simulate " + scene + more).out)["state"]; };
    CHECK(state(" --seconds 2") == state(" --seconds 2"));
    CHECK(state(" --seconds 2") != state(" --seconds 2.5"));
}

TEST_CASE("a recorded run is made again; where it differs, step and body are named") {
    const Scratch scratch;
    const std::string scene = write(scratch, "s.txt", kScene), file = scratch / "r.rec";
    const Ran simulated = run(scratch, "simulate " + scene + " --seconds 2 --dt 0.01 --set restitution=0.3 --record " + file);
    REQUIRE(simulated.code == 0);
    const auto json = [&](const std::string& recording) { return nlohmann::json::parse(run(scratch, "replay --json " + recording).out); };
    const Ran same = run(scratch, "replay " + file);
    CHECK(same.code == 0);
    CHECK(same.out.find(file + ": equal: 200 steps") == 0);
    CHECK(json(file)["equal"] == true);
    CHECK(json(file)["state"] == nlohmann::json::parse(simulated.out)["state"]);

    const std::string text = read(file);
    const auto changed = [&](const std::string& from, const std::string& to) {
        const std::size_t at = text.find(from);
        REQUIRE(at != std::string::npos);
        return write(scratch, "changed.rec", std::string(text).replace(at, from.size(), to));
    };
    const std::string pushed = changed("mass:1", "mass:1 vel:0,1e-9,0");
    const Ran other = run(scratch, "replay " + pushed);
    CHECK(other.code == 1);
    CHECK(other.err.find(pushed + ": diverged at step 1: body 'ball' is another") != std::string::npos);
    CHECK(json(pushed)["equal"] == false);
    CHECK(json(pushed)["step"] == 1);
    CHECK(json(pushed)["body"] == "ball");
    const std::size_t hash = text.find("step n:120 state:") + 17;
    const Ran flipped = run(scratch, "replay " + changed(text.substr(hash, 16), (text[hash] == '0' ? "1" : "0") + text.substr(hash + 1, 15)));
    CHECK(flipped.code == 1);
    CHECK(flipped.err.find("diverged at step 120: ") != std::string::npos);

    const Ran bad = run(scratch, "replay " + changed("radius:0.5", "radius:zero"));
    CHECK(bad.code == 1);
    CHECK(bad.err.find("changed.rec:") != std::string::npos);
    CHECK(bad.err.find(": error: 'radius' is 'zero'") != std::string::npos);
    const Ran cut = run(scratch, "replay " + write(scratch, "cut.rec", text.substr(0, text.size() / 2)));
    CHECK(cut.code == 1);
    CHECK(cut.err.find(": error: ") != std::string::npos);
    CHECK(run(scratch, "replay " + scratch / "missing.rec").code == 4);
    CHECK(run(scratch, "simulate " + scene + " --seconds 0.1 --record " + scratch / "no/such/folder.rec").code == 4);
}

TEST_CASE("eval agrees with itself on both processors") {
    const Scratch scratch;
    const std::string scene = write(scratch, "s.txt", kScene), points = write(scratch, "p.csv", "0,0.75,0\n0,2.5,0\n\n3,1,-2\r\n");
    const auto numbers = [&](const std::string& on) {
        const Ran ran = run(scratch, "eval " + scene + " --points " + points + " --on " + on);
        REQUIRE_MESSAGE(ran.code == 0, ran.err);
        std::vector<double> values;
        std::istringstream text(ran.out);
        for (std::string value; std::getline(text, value, ',');) {
            const std::size_t line = value.find('\n');
            values.push_back(std::stod(value.substr(0, line)));
            if (line != std::string::npos && line + 1 < value.size()) values.push_back(std::stod(value.substr(line + 1)));
        }
        return values;
    };
    const std::vector<double> cpu64 = numbers("cpu64"), cpu = numbers("cpu"), gpu = numbers("gpu");
    REQUIRE(cpu64.size() == 24);
    REQUIRE(cpu.size() == 24);
    REQUIRE(gpu.size() == 24);
    CHECK(cpu64[3] == 0.75);
    CHECK(cpu64[7] == 0);
    CHECK(cpu64[8 + 3] == -0.5);
    CHECK(cpu64[8 + 7] == 1);
    for (std::size_t i = 0; i < 24; ++i) {
        if (i / 8 == 1 && i % 8 >= 4 && i % 8 <= 6) continue;  // the ball's centre has no gradient
        CHECK(cpu[i] == doctest::Approx(cpu64[i]).epsilon(1e-6));
        CHECK(gpu[i] == doctest::Approx(cpu64[i]).epsilon(1e-4));
    }
    const std::string bad = write(scratch, "bad.csv", "1,2,3\n1,2\n");
    const Ran ran = run(scratch, "eval " + scene + " --points " + bad);
    CHECK(ran.code == 1);
    CHECK(ran.err.starts_with(bad + ":2:3: error: "));
}

TEST_CASE("effects says what was called for, by what, and what it costs and shows") {
    const Scratch scratch;
    const std::string scene = write(scratch, "s.txt", kScene + "material name:mirror Kr:0.4\nobject type:sphere radius:0.4 material:mirror pos:1,0.5,0\n");
    const Ran ran = run(scratch, "effects --size 32x18 --rounds 1 --objects --json " + scene);
    REQUIRE_MESSAGE(ran.code == 0, ran.err);
    const auto json = nlohmann::json::parse(ran.out);
    std::map<std::string, nlohmann::json> rows;
    for (const auto& effect : json["effects"]) rows[effect["name"]] = effect;
    const nlohmann::json& reflection = rows.at("reflection");
    CHECK(reflection["called"] == true);
    CHECK(reflection["by"][0].get<std::string>().find("Kr:") != std::string::npos);
    CHECK(reflection["uses"] > 0);
    CHECK(reflection["price"]["evaluations"] > 0);
    CHECK(reflection["price"]["largest"] > 0);
    const nlohmann::json& fog = rows.at("fog");
    CHECK(fog["called"] == false);
    CHECK(fog["by"].empty());
    CHECK(fog["uses"] == 0);
    CHECK(fog["price"]["largest"] == 0);
    CHECK(json["records"].size() > 3);
    CHECK(json["stages"].size() == 10);

    const Ran table = run(scratch, "effects --size 32x18 --rounds 1 " + scene);
    for (const char* text : {"CALLED FOR", "LEFT OUT", "THE PHYSICS", "hard shadow", "restitution", "with everything there is in its program"})
        CHECK_MESSAGE(table.out.find(text) != std::string::npos, text);
    const Ran glsl = run(scratch, "effects --glsl " + scene);
    CHECK(glsl.out.starts_with("#version 330 core\n"));
    CHECK(glsl.out.find("hardShadow") != std::string::npos);
    CHECK(glsl.out.find("softShadow") == std::string::npos);
    CHECK(run(scratch, "effects --size 0x5 " + scene).code == 2);
}

TEST_CASE("accuracy writes a table, a chart for each knob and a page that names only what is there") {
    const Scratch scratch;
    const std::string scene = write(scratch, "s.txt", kScene), folder = scratch / "report/of it";
    const Ran ran = run(scratch, "accuracy " + scene + " --size 32x18 --together 10 -o '" + folder + "'");
    REQUIRE(ran.code == 0);
    CHECK(ran.out.find("settings") != std::string::npos);
    CHECK(ran.out.find("index.html") != std::string::npos);
    for (const char* file : {"accuracy.csv", "index.html", "overview.svg", "overview_motion.svg", "march_epsilon.svg", "march_steps.svg", "samples.svg", "scale.svg", "dt.svg", "sleep_speed.svg"})
        CHECK_MESSAGE(fs::file_size(fs::path(folder) / file) > 100, file);
    CHECK(!fs::exists(fs::path(folder) / "reflections.svg"));  // nothing mirrors
    const std::string page = read(fs::path(folder) / "index.html"), table = read(fs::path(folder) / "accuracy.csv");
    CHECK(page.starts_with("<!doctype html>"));
    int files = 0;
    for (std::size_t at = page.find("src=\""); at != std::string::npos; at = page.find("src=\"", at + 1), ++files) {
        const std::string name = page.substr(at + 5, page.find('"', at + 5) - at - 5);
        CHECK_MESSAGE(fs::is_regular_file(fs::path(folder) / name), name);
        CHECK(name.find('/') == std::string::npos);
    }
    CHECK(files > 20);
    // Every chart is on the page; every knob and ten settings together are in the table.
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".svg" || entry.path().extension() == ".png") CHECK_MESSAGE(page.find("\"" + entry.path().filename().string() + "\"") != std::string::npos, entry.path());
    int together = 0;
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) together += line.starts_with("picture,together,");
    CHECK(together == 10);
    for (const char* start : {"kind,knob,value,set,color,", "\npicture,own,", "\npicture,default,", "\npicture,samples,", "\nmotion,own,", "\nmotion,dt,"}) CHECK_MESSAGE(table.find(start) != std::string::npos, start);

    // Nothing else is said where nothing is to be; what cannot be written or read says so.
    const std::string still = write(scratch, "still.txt", "marchbox 1\nlight pos:3,5,4\nobject type:sphere radius:1\n");
    const Ran quiet = run(scratch, "accuracy " + still + " --size 16x9 --together 0 --quiet -o " + scratch / "quiet");
    CHECK(quiet.code == 0);
    CHECK(quiet.out == "");
    CHECK(quiet.err == "");
    CHECK(fs::exists(scratch / "quiet/index.html"));
    CHECK(!fs::exists(scratch / "quiet/overview_motion.svg"));
    for (const std::string& out : {scratch / "s.txt", scratch / "s.txt/below"}) {
        const Ran refused = run(scratch, "accuracy " + still + " --size 16x9 --together 0 -o " + out);
        CHECK(refused.code == 4);
        CHECK(refused.err.find("s.txt") != std::string::npos);
    }
    const std::string bad = write(scratch, "bad.txt", "marchbox 1\nobject type:spher radius:1\n");
    CHECK(run(scratch, "accuracy " + bad + " -o " + scratch / "none").code == 1);
    CHECK(!fs::exists(scratch / "none"));
    CHECK(run(scratch, "accuracy " + scratch / "missing.txt" + " -o " + scratch / "none").code == 4);
    for (const std::string& wrong : {"accuracy " + still, "accuracy " + still + " -o " + scratch / "none --size 0x9", "accuracy " + still + " -o " + scratch / "none --together -1"}) CHECK(run(scratch, wrong).code == 2);
}

TEST_CASE("render --max-error picks a setting, says which, and says so where none is good enough") {
    const Scratch scratch;
    const std::string scene = write(scratch, "still.txt", "marchbox 1\nlight pos:3,5,4\nobject type:plane\nobject type:sphere pos:0,1,0 radius:1\n"), to = " --size 32x18 -o " + scratch / "x.png";
    const Ran met = run(scratch, "render " + scene + to + " --max-error 0.1"), unmet = run(scratch, "render " + scene + to + " --max-error color=1e-9");
    CHECK(met.code == 0);
    CHECK(met.err.starts_with("picked "));
    CHECK(met.err.find("cannot be met") == std::string::npos);
    CHECK(fs::file_size(scratch / "x.png") > 100);
    CHECK(unmet.code == 0);
    CHECK(unmet.err.find("cannot be met") != std::string::npos);
    CHECK(run(scratch, "render " + scene + to + " --quiet --max-error 0.1").err == "");
    for (const char* wrong : {" --max-error nonsense=1", " --max-error position=1", " --max-error -1", " --max-error 0.1x", " --max-error 0.1 --max-ms 3"}) CHECK(run(scratch, "render " + scene + to + wrong).code == 2);
}

TEST_CASE("bench effects --quick prints two lines of JSON a twin") {
    const Scratch scratch;
    const Ran ran = run(scratch, "bench effects --quick");
    REQUIRE(ran.code == 0);
    CHECK(ran.err == "");
    std::map<std::string, int> lines;
    std::istringstream text(ran.out);
    for (std::string line; std::getline(text, line);) {
        CAPTURE(line);
        const nlohmann::json json = nlohmann::json::parse(line);
        ++lines[json["figure"]];
        if (json["figure"] == "about") continue;
        CHECK(json["width"] == 64);
        CHECK(json["rounds"] == 5);
        CHECK(json["pixels_differ"] == 0);
    }
    CHECK(lines == std::map<std::string, int>{{"about", 1}, {"effects", 3}, {"general", 3}});
}

TEST_CASE("bench render --quick prints a line of JSON a figure") {
    const Scratch scratch;
    const Ran ran = run(scratch, "bench render --quick --only seed,growth,counts");
    REQUIRE(ran.code == 0);
    CHECK(ran.err == "");
    std::map<std::string, int> lines;
    std::istringstream text(ran.out);
    for (std::string line; std::getline(text, line);) {
        CAPTURE(line);
        const nlohmann::json json = nlohmann::json::parse(line);
        ++lines[json["figure"]];
        if (json["figure"] == "about" || json.contains("skipped")) continue;
        CHECK(json["n"] > 0);
        CHECK(json["width"] == 64);
        CHECK(json["error"]["marchbox"]["wrong"] < 0.002);
        if (json.contains("march")) {
            CHECK(json["march"]["plain_over_least"] > 1.5);
            CHECK(json["march"]["plain_over_least"] < 1.9);
        }
        if (!json.contains("ratio")) continue;
        CHECK(json["rounds"] == 5);
        CHECK(json["ratio"]["min"] <= json["ratio"]["median"]);
        CHECK(json["ratio"]["median"] <= json["ratio"]["max"]);
        CHECK(json["ms"]["marchbox"] > 0);
    }
    CHECK(lines == std::map<std::string, int>{{"about", 1}, {"seed", 1}, {"growth", 2}, {"counts", 5}});

    // Counts are the same on every run, and another seed makes other scenes.
    const std::string first = run(scratch, "bench render --quick --only counts").out;
    CHECK(run(scratch, "bench render --quick --only counts").out == first);
    CHECK(run(scratch, "bench render --quick --only counts --seed 3").out != first);
}
