// What the repository says of itself must be true: the arrows between its parts, the files its documents name, the README's
// scene and its commands.
#include <doctest/doctest.h>

#include "core/scene/text.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace {

const fs::path kRoot = MARCHBOX_SOURCE;

std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The part a path below src/ belongs to: core/render is one of its own. bench/ lies beside src/, and is included as such.
std::string part(const std::string& path) {
    if (path.starts_with("core/render/")) return "render";
    return path.substr(0, path.find('/'));
}

/// The program's sources, and what each is called in an include.
std::map<fs::path, std::string> sources() {
    std::map<fs::path, std::string> found;
    for (const auto& [folder, from] : {std::pair{kRoot / "src", kRoot / "src"}, std::pair{kRoot / "bench", kRoot}})
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") found[entry.path()] = fs::relative(entry.path(), from);
    return found;
}

/// Every match of the pattern's first group, line by line.
std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
    std::vector<std::string> found;
    for (std::sregex_iterator m(text.begin(), text.end(), pattern), end; m != end; ++m) found.push_back((*m)[1]);
    return found;
}

}  // namespace

TEST_CASE("the arrows: nothing includes what it may not") {
    const std::map<std::string, std::set<std::string>> may = {
        {"core", {"core"}}, {"physics", {"physics", "core"}}, {"render", {"render", "core"}},
        {"gui", {"gui", "render", "physics", "core"}}, {"bench", {"bench", "render", "physics", "core"}},
        {"cli", {"cli", "gui", "bench", "render", "physics", "core"}}};
    const std::regex quoted(R"re(\n#include "([^"\n]{1,200})")re"), angled(R"re(\n#include <([^>\n]{1,200})>)re");
    int files = 0;
    for (const auto& [file, path] : sources()) {
        ++files;
        const std::string text = '\n' + read(file);
        CAPTURE(path);
        REQUIRE(may.contains(part(path)));
        for (const std::string& included : matches(text, quoted)) {
            CAPTURE(included);
            if (included.starts_with("../")) CHECK(path == "core/sdf/glsl.h");  // the GLSL that C++ compiles
            else CHECK(may.at(part(path)).contains(part(included)));
        }
        for (const std::string& included : matches(text, angled)) {
            CAPTURE(included);
            if (included.starts_with("GL/") || included.starts_with("EGL/")) CHECK(part(path) == "render");
            if (included.starts_with("imgui") || included.starts_with("GLFW/")) CHECK(part(path) == "gui");
        }
    }
    CHECK(files > 50);
}

TEST_CASE("the documents name files that exist") {
    const std::regex ticked(R"(`((?:src|shaders|tests|saves|docs|tools|bench)/[A-Za-z0-9_./*-]{0,80}|run|test|LICENSE)`)");
    for (const char* document : {"README.md", "docs/architecture.md", "docs/extending.md", "docs/hard_cases.md", "docs/benchmarks.md", "docs/effects.md", "docs/accuracy.md"}) {
        for (const std::string& named : matches(read(kRoot / document), ticked)) {
            CAPTURE(document);
            CHECK_MESSAGE(fs::exists(kRoot / named), named);
        }
    }
    CHECK(fs::exists(kRoot / "docs/welcome.png"));
}

TEST_CASE("the README's scene reads without a fault, and its commands are of saves that are there") {
    const std::string readme = read(kRoot / "README.md");
    const std::size_t from = readme.find("```\nmarchbox 1"), to = readme.find("```", from + 4);
    REQUIRE(from != std::string::npos);
    const mb::ReadResult result = mb::readScene(std::string_view(readme).substr(from + 4, to - from - 4));
    for (const mb::Fault& fault : result.faults) FAIL_CHECK(mb::describe(fault, "README.md"));
    CHECK(result.scene.objects.size() == 5);
    for (const std::string& save : matches(readme, std::regex(R"((saves/[a-z_]{1,40}\.txt))"))) CHECK_MESSAGE(fs::exists(kRoot / save), save);
}

TEST_CASE("no file of the program is so long that it should be two") {
    for (const auto& [file, path] : sources()) CHECK_MESSAGE(std::ranges::count(read(file), '\n') <= 330, path);
}

TEST_CASE("the effect of docs/extending.md is the one in the program, line by line") {
    const std::string document = read(kRoot / "docs/extending.md");
    const std::size_t begin = document.find("## An effect"), end = document.find("\n## ", begin + 1);
    const std::string files = read(kRoot / "src/core/effects/table.cpp") + read(kRoot / "shaders/lib/effects/fog.glsl");
    std::istringstream lines(document.substr(begin, end - begin));
    int compared = 0;
    bool code = false;
    for (std::string line; std::getline(lines, line);) {
        const std::string text = line.substr(std::min(line.find_first_not_of(' '), line.size()));
        if (text.starts_with("```")) {
            code = !code;
        } else if (code && !text.empty()) {
            CHECK_MESSAGE(files.find(text) != std::string::npos, text);
            ++compared;
        }
    }
    CHECK(compared > 5);
}
