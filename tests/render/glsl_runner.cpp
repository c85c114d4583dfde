#include "glsl_runner.h"

#include "core/render/blocks.h"
#include "core/render/targets.h"

#include <fmt/format.h>

#include <cmath>

namespace mb {
namespace {

// The first failure counts: a test goes on behind it, so that nothing depends on how a driver treats an early return.
constexpr std::string_view kPrelude = R"(
int failed_line_ = 0;
void check_(bool held, int line) {
    if (!held && failed_line_ == 0) failed_line_ = line;
}
#define CHECK(condition) check_(condition, __LINE__)

// Equal but for rounding: 1e-5 of the larger of 1 and what is expected.
bool near(float a, float b) { return abs(a - b) <= 1e-5 * max(1.0, abs(b)); }
bool near(vec2 a, vec2 b) { return near(a.x, b.x) && near(a.y, b.y); }
bool near(vec3 a, vec3 b) { return near(a.x, b.x) && near(a.y, b.y) && near(a.z, b.z); }
)";

std::string mainCalling(const std::vector<std::string>& tests) {
    std::string text = "layout(location = 0) out vec4 out_failure;\nvoid main() {\n    int test = int(gl_FragCoord.x);\n";
    for (std::size_t i = 0; i < tests.size(); ++i) text += fmt::format("    if (test == {}) {}();\n", i, tests[i]);
    return text + "    out_failure = vec4(float(failed_line_), 1.0, 0.0, 0.0);\n}\n";
}

/// The picture that the tests' frame is of.
GpuFrame testFrame() {
    GpuFrame frame = packFrame({}, {"", {0, 0, 0}, {0, 0, -1}, 90, 0}, rasterOf({64, 48}), 0);
    frame.reach.w = 1;
    frame.pass = {0, 0, 1, 0};
    return frame;
}

}  // namespace

std::vector<std::string> glslTests(std::string_view text) {
    constexpr std::string_view kStart = "\nvoid test_";
    std::vector<std::string> tests;
    for (std::size_t at = text.find(kStart); at != text.npos; at = text.find(kStart, at + 1)) {
        const std::size_t name = at + kStart.size() - 5;
        tests.emplace_back(text.substr(name, text.find('(', name) - name));
    }
    return tests;
}

GlslResults runGlslTests(std::string_view path, std::string_view text) {
    GlslResults results{glslTests(text), {}, {}};
    Texts texts = shaderLibrary();
    texts.emplace(path, text);
    texts["prelude.glsl"] = kPrelude;
    texts["main.glsl"] = mainCalling(results.tests);
    texts["tests.glsl"] = fmt::format("#version 330 core\n#include \"prelude.glsl\"\n#include \"sdf/dialect.glsl\"\n#include \"sdf/domains.glsl\"\n"
                                      "#include \"{}\"\n#include \"main.glsl\"\n", path);
    const Composed composed = resolve(texts, "tests.glsl", "#define LEAVES 1\n#define BRANCHES 1\n#define MATERIALS 1\n#define LIGHTS 1\n"
                                                          "#define EFFECT_CHECKER 1\n#define COUNTED\n");
    const Program program = makeProgram(composed);
    if (!program.usable()) {
        results.compile_error = program.log;
        return results;
    }

    const Targets output({static_cast<int>(std::max<std::size_t>(results.tests.size(), 1)), 1}, 1);
    const GpuFrame frame = testFrame();
    GLuint buffer = 0;
    glGenBuffers(1, &buffer);
    const OwnedBuffer owned(buffer);
    glBindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(BlockPoint::frame), owned);
    glBufferData(GL_UNIFORM_BUFFER, sizeof frame, &frame, GL_STATIC_DRAW);
    glUseProgram(program.name);
    output.clear();
    const Quad quad;
    quad.draw();
    const std::vector<float> pixels = output.read(0);
    for (std::size_t i = 0; i < results.tests.size(); ++i) {
        REQUIRE(pixels[4 * i + 1] == 1);  // it ran
        const long line = std::lround(pixels[4 * i]);  // below 2^24, so exact
        if (line != 0) results.failed.push_back({results.tests[i], readablePlace(composed, line)});
    }
    return results;
}

}  // namespace mb
