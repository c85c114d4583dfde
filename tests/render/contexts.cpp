// The two ways to render without a window, and what a driver is asked for.
#include "headless.h"
#include "scenes.h"

#include <fmt/format.h>

using namespace mb;

namespace {

Scene testScene() {
    Scene scene;
    scene.world.background = {0.2, 0.3, 0.4};
    scene.materials.push_back({"tile", {0.9, 0.9, 0.9}, {0.1, 0.1, 0.1}, Pattern::checker, 0.1, 0.7, 0.2, 0.3, 32});
    scene.lights.push_back({"", {3, 5, 4}, {1, 1, 1}, 1});
    addObject(scene, "plane", {0, 1, 0, 0});
    addObject(scene, "sphere", {0.7}, {-0.8, 0.7, 0});
    const int cut = addObject(scene, "subtract", {0.1}, {0.9, 0.5, 0});
    addObject(scene, "box", {1, 1, 1, 0.05}, {}, cut);
    addObject(scene, "sphere", {0.45}, {0, 0.5, 0.2}, cut);
    for (Object& o : scene.objects) o.material = 0;
    return scene;
}

}  // namespace

TEST_CASE("OSMesa and EGL give the same image") {
    std::vector<std::vector<glm::vec3>> pictures;
    for (const Headless which : {Headless::osmesa, Headless::egl}) {
        std::string why;
        const auto context = makeHeadless(which, why);
        if (!context) {
            MESSAGE("only one back end is here: " << why);
            continue;
        }
        Renderer renderer;
        CHECK(renderer.draw(testScene(), cameraAt({0, 2, 5}, {0, 0.5, 0}), {320, 180}).empty());
        pictures.push_back(renderer.readPicture());
    }
    REQUIRE(!pictures.empty());
    for (const auto& picture : pictures) CHECK(picture == pictures.front());
}

TEST_CASE("a context can be made again after another was destroyed") {
    std::vector<glm::vec3> first;
    for (int i = 0; i < 3; ++i) {
        HeadlessRenderer headless;
        const auto picture = headless.draw(testScene(), cameraAt({0, 2, 5}, {0, 0.5, 0}), {64, 48});
        if (i == 0) first = picture;
        CHECK(picture == first);
    }
}

TEST_CASE("every member of every block lies where C++ puts it") {
    HeadlessRenderer headless;
    // All switches on and two of everything, so that no member is optimised away.
    Texts texts = shaderLibrary();
    std::string uses = "#version 330 core\n#include \"lib/blocks.glsl\"\nout vec4 sum;\nvoid main() { sum = branches[0].position\n";
    for (const BlockMember& m : blockMembers()) uses += fmt::format(" + vec4({})\n", m.name);
    texts["offsets.glsl"] = uses + "; }\n";
    const Program program = makeProgram(resolve(texts, "offsets.glsl", "#define EFFECT_LIGHT 1\n" + head(Plan{}, {2, 2, 2, 2}, false)));
    REQUIRE_MESSAGE(program.usable(), program.log);
    for (const BlockMember& m : blockMembers()) {
        CAPTURE(m.name);
        // The driver names the first element of a member of a block without an instance name as written; the second
        // record of an array it reports by its stride.
        std::string name = m.name;
        const bool second = name.find("[1]") != std::string::npos;
        if (second) name.replace(name.find("[1]"), 3, "[0]");
        const char* text = name.c_str();
        GLuint index = GL_INVALID_INDEX;
        glGetUniformIndices(program.name, 1, &text, &index);
        GLint offset = -1;
        if (second) {
            const std::string second_name = m.name;
            const char* second_text = second_name.c_str();
            glGetUniformIndices(program.name, 1, &second_text, &index);
        }
        REQUIRE(index != GL_INVALID_INDEX);
        glGetActiveUniformsiv(program.name, 1, &index, GL_UNIFORM_OFFSET, &offset);
        CHECK(offset == static_cast<GLint>(m.offset));
    }
}

TEST_CASE("a canary: where this driver cuts loops off, the budget lies below") {
    HeadlessRenderer headless;
    const auto count = [&](int nested, int inner) {
        Texts texts;
        texts["loop.glsl"] = fmt::format(
            "#version 330 core\nout vec4 n;\nvoid main() {{ float k = 0.0; for (int i = 0; i < {}; ++i) for (int j = 0; j < {}; ++j) k += "
            "gl_FragCoord.x > -1.0 ? 1.0 : 2.0; n = vec4(k); }}\n",
            nested, inner);
        const Program program = makeProgram(resolve(texts, "loop.glsl"));
        REQUIRE_MESSAGE(program.usable(), program.log);
        const Targets target({8, 1}, 1);
        target.clear();
        glUseProgram(program.name);
        Quad().draw();
        return static_cast<int>(target.read(0)[0]);
    };
    const int all = count(1, 70'000);
    MESSAGE("a loop of 70,000 makes " << all << " on " << headless.renderer->rendererName());
    CHECK(all >= kLoopBudget);
    CHECK(count(1, kLoopBudget - 4) == kLoopBudget - 4);
    // Nested, the outer loop's rounds count too: 100 of them around 599 are 60,000 in all.
    CHECK(count(100, 599) == 59'900);
}

TEST_CASE("what cannot be drawn says so and leaves the last picture") {
    HeadlessRenderer headless;
    const Camera camera = cameraAt({0, 2, 5}, {0, 0.5, 0});
    const auto picture = headless.draw(testScene(), camera, {40, 30});
    Renderer& renderer = *headless.renderer;

    CHECK(renderer.draw(testScene(), camera, {0, 30}) != "");
    CHECK(renderer.draw(testScene(), camera, {maxTargetSize() + 1, 1}).find("between 1 and") != std::string::npos);

    Scene twisted = testScene();
    addObject(twisted, "plane", {0, 1, 0, 0}, {}, addObject(twisted, "twist", {1}));
    CHECK(renderer.draw(twisted, camera, {40, 30}).find("(twist) holds a shape without bounds") != std::string::npos);

    Scene crowded = testScene();
    for (int i = 0; i < 2000; ++i) addObject(crowded, "sphere", {0.1});
    renderer.setEvaluation(Evaluation::straight);
    CHECK(renderer.draw(crowded, camera, {40, 30}).find("2004 primitives") != std::string::npos);
    renderer.setEvaluation(Evaluation::automatic);

    Scene deep = testScene();
    for (Material& m : deep.materials) m.kr = 1;  // every bounce is worth following
    deep.render.reflections = 64, deep.render.march_steps = 8192;
    CHECK(renderer.draw(deep, camera, {40, 30}).find("reflections:64") != std::string::npos);
    CHECK(renderer.readPicture() == picture);
}

TEST_CASE("pictures of odd sizes are the crops and rows they should be") {
    HeadlessRenderer headless;
    const Camera camera = cameraAt({0, 2, 5}, {0, 0.5, 0});
    for (const glm::ivec2 size : {glm::ivec2{1, 1}, {1, 64}, {64, 1}, {641, 479}, {3, 5}}) {
        const auto picture = headless.draw(testScene(), camera, size);
        REQUIRE(picture.size() == static_cast<std::size_t>(size.x * size.y));
        for (const glm::vec3& c : picture) REQUIRE((std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z)));
    }
}

TEST_CASE("two renderers of one context draw each its own scene") {
    HeadlessRenderer headless;
    Renderer second;
    const Camera camera = cameraAt({0, 2, 5}, {0, 0.5, 0});
    const auto first = headless.draw(testScene(), camera, {40, 30});
    Scene other;
    addObject(other, "sphere", {1});
    CHECK(second.draw(other, camera, {40, 30}) == "");
    const auto ball = second.readPicture();
    CHECK(headless.draw(testScene(), camera, {40, 30}) == first);
    CHECK(second.draw(other, camera, {40, 30}) == "");
    CHECK(second.readPicture() == ball);
    CHECK(ball != first);
}
