// The tests written in GLSL, tests/glsl/*.glsl, found by themselves.
#include "glsl_runner.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace mb;

TEST_CASE("the tests written in GLSL") {
    HeadlessRenderer headless;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(MARCHBOX_SOURCE "/tests/glsl"))
        if (entry.path().extension() == ".glsl") files.push_back(entry.path());
    std::ranges::sort(files);
    CHECK(!files.empty());
    for (const std::filesystem::path& file : files) {
        std::stringstream text;
        text << std::ifstream(file).rdbuf();
        const GlslResults results = runGlslTests("tests/glsl/" + file.filename().string(), text.str());
        CHECK_MESSAGE(results.compile_error.empty(), results.compile_error);
        CHECK_MESSAGE(!results.tests.empty(), file.filename().string() << " has no test");
        for (const GlslFailure& f : results.failed) CHECK_MESSAGE(f.place.empty(), f.place << ": CHECK failed in " << f.test);
    }
}

TEST_CASE("a failing test written in GLSL is reported with its file and line") {
    HeadlessRenderer headless;
    const GlslResults results = runGlslTests("tests/glsl/twin.glsl",
                                             "#include \"sdf/primitives.glsl\"\n"
                                             "\n"
                                             "void test_good() { CHECK(near(sdSphere(vec3(3.0, 0.0, 0.0), 1.0), 2.0)); }\n"
                                             "void test_bad() {\n"
                                             "    CHECK(true);\n"
                                             "    CHECK(near(sdSphere(vec3(3.0, 0.0, 0.0), 1.0), 2.1));\n"
                                             "    CHECK(false);\n"
                                             "}\n"
                                             "void test_nan() { CHECK(near(sqrt(-abs(gl_FragCoord.x)), 0.0)); }\n");
    CHECK(results.compile_error == "");
    CHECK(results.tests == std::vector<std::string>{"test_good", "test_bad", "test_nan"});
    REQUIRE(results.failed.size() == 2);
    CHECK(results.failed[0].test == "test_bad");
    CHECK(results.failed[0].place == "tests/glsl/twin.glsl:6");
    CHECK(results.failed[1].place == "tests/glsl/twin.glsl:9");
}

TEST_CASE("a test written in GLSL that does not compile is reported with its file and line") {
    HeadlessRenderer headless;
    const GlslResults wrong = runGlslTests("tests/glsl/twin.glsl", "#include \"sdf/primitives.glsl\"\n\nvoid test_x() { CHECK(unknown); }\n");
    CHECK_MESSAGE(wrong.compile_error.find("tests/glsl/twin.glsl:3") != std::string::npos, wrong.compile_error);
    CHECK_MESSAGE(wrong.compile_error.find("unknown") != std::string::npos, wrong.compile_error);
    const GlslResults missing = runGlslTests("tests/glsl/twin.glsl", "#include \"lib/nowhere.glsl\"\n\nvoid test_x() {}\n");
    CHECK_MESSAGE(missing.compile_error.find("lib/nowhere.glsl") != std::string::npos, missing.compile_error);
}
