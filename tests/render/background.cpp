// Programs compiled on a thread of their own: what is drawn meanwhile, and what is drawn then.
#include "headless.h"
#include "scenes.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>

using namespace mb;

namespace {

constexpr glm::ivec2 kSize{40, 30};
const Camera kCamera = cameraAt({0, 2, 5}, {0, 0.5, 0});

/// So many spheres on a floor: each number is another program, and beyond a dozen one that reads a grid.
Scene spheres(int count, double kr = 0) {
    Scene scene;
    scene.materials.push_back({.name = "clay", .color = {0.75, 0.3, 0.2}, .kr = kr});
    scene.lights.push_back({.name = "sun", .pos = {4, 8, 5}});
    addObject(scene, "plane", {0, 1, 0, 0});
    for (int i = 0; i < count; ++i) addObject(scene, "sphere", {0.3}, {0.5 * i - 1, 0.3, 0});
    for (Object& o : scene.objects) o.material = 0;
    return scene;
}

/// A context that others share, with a compiler's thread beside it.
struct Background {
    explicit Background(Headless which = Headless::any) : context(makeHeadless(which, why)) {
        REQUIRE_MESSAGE(context, why);
        compiler = Compiler::start(*context, why);
        REQUIRE_MESSAGE(compiler, why);
    }
    std::string why;
    std::unique_ptr<Context> context;
    std::unique_ptr<Compiler> compiler;
};

void rest() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

/// Draws it, however often it is put off.
std::vector<glm::vec3> drawInTheEnd(Renderer& renderer, const Scene& scene) {
    do {
        REQUIRE(renderer.draw(scene, kCamera, kSize) == "");
        while (renderer.compiling()) rest();
    } while (renderer.putOff());
    return renderer.readPicture();
}

Composed tinyProgram(const std::string& value) {
    return resolve({{"tiny.glsl", fmt::format("#version 330 core\nout vec4 color;\nvoid main() {{ color = vec4({}); }}\n", value)}}, "tiny.glsl");
}

}  // namespace

TEST_CASE("while a program is compiled the last picture stays to the bit; then it is the one drawn at once") {
    const std::vector<Scene> scenes = {spheres(1), spheres(1, 0.5), spheres(2), spheres(14), spheres(14, 0.5)};
    std::vector<std::vector<glm::vec3>> at_once;
    {
        HeadlessRenderer headless;
        for (const Scene& scene : scenes) at_once.push_back(headless.draw(scene, kCamera, kSize));
    }
    for (const Headless which : {Headless::osmesa, Headless::egl}) {
        if (std::string why; !makeHeadless(which, why)) {
            MESSAGE("only one back end is here: " << why);
            continue;
        }
        Background background(which);
        Renderer renderer(std::move(background.compiler));
        std::vector<glm::vec3> last;
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            CAPTURE(i);
            CHECK(renderer.draw(scenes[i], kCamera, kSize) == "");
            CHECK(renderer.putOff());
            if (i > 0) CHECK(renderer.readPicture() == last);
            last = drawInTheEnd(renderer, scenes[i]);
            CHECK(last == at_once[i]);
            CHECK(renderer.compiled() == static_cast<int>(i) + 1);
        }
        // What was compiled once is drawn at once.
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            CHECK(renderer.draw(scenes[i], kCamera, kSize) == "");
            CHECK_FALSE(renderer.putOff());
            CHECK(renderer.readPicture() == at_once[i]);
        }
        CHECK(gl.GetError() == GL_NO_ERROR);
    }
}

TEST_CASE("a value that only moves compiles nothing and is drawn at once, by straight code and through a grid") {
    for (const int count : {2, 14}) {
        Background background;
        Renderer renderer(std::move(background.compiler));
        Scene scene = spheres(count, 0.1);
        drawInTheEnd(renderer, scene);
        for (int i = 0; i < 20; ++i) {
            scene.objects[1].pos = {0.1 * i, 0.4, 0.05 * i}, scene.objects[1].numbers[0] = 0.2 + 0.02 * i;
            scene.materials[0].kr = 0.1 + 0.04 * i, scene.materials[0].color = {0.05 * i, 0.5, 0.5};
            scene.lights[0].intensity = 0.5 + 0.1 * i, scene.world.background = {0, 0.05 * i, 0};
            CHECK(renderer.draw(scene, kCamera, kSize) == "");
            CHECK_FALSE(renderer.putOff());
        }
        CHECK(renderer.compiled() == 1);
    }
}

TEST_CASE("counting is put off as drawing is, and counts the same") {
    const Scene scene = spheres(3);
    const Measured at_once = HeadlessRenderer().measure(scene, kCamera, kSize);
    Background background;
    Renderer renderer(std::move(background.compiler));
    Measured measured;
    CHECK(renderer.measure(scene, kCamera, kSize, measured) == "");
    CHECK(renderer.putOff());
    while (renderer.compiling()) rest();
    CHECK(renderer.measure(scene, kCamera, kSize, measured) == "");
    CHECK_FALSE(renderer.putOff());
    CHECK(measured.counts.evaluations.primary == at_once.counts.evaluations.primary);
    CHECK(measured.channels.depth == at_once.channels.depth);
    CHECK(measured.channels.normal == at_once.channels.normal);
}

TEST_CASE("of many programs asked for in a row one waits: the newest") {
    const Background background;
    constexpr int kAsked = 40;
    for (int i = 0; i < kAsked; ++i) {
        background.compiler->want({tinyProgram(fmt::format("{}.0", i)), 1, false, false});
        CHECK(background.compiler->waiting() <= 1);
    }
    const std::string newest = tinyProgram(fmt::format("{}.0", kAsked - 1)).text;
    int taken = 0;
    for (std::optional<Compiler::Done> done; !done || done->text != newest; rest()) {
        done = background.compiler->take();
        taken += done.has_value();
        if (done) CHECK_MESSAGE(done->program.usable(), done->program.log);
    }
    CHECK(taken <= 2);  // one may have been begun before the newest came
    CHECK(background.compiler->waiting() == 0);
    CHECK_FALSE(background.compiler->take());
}

TEST_CASE("a program that does not compile comes back with its log; one in work is finished before the thread ends") {
    {
        const Background background;
        background.compiler->want({tinyProgram("nothing"), 1, false, false});
        std::optional<Compiler::Done> done;
        while (!(done = background.compiler->take())) rest();
        CHECK_FALSE(done->program.usable());
        CHECK(done->program.log.find("tiny.glsl:3") != std::string::npos);
    }
    for (int i = 0; i < 5; ++i) {
        Background background;
        Renderer renderer(std::move(background.compiler));
        CHECK(renderer.draw(spheres(4 + i), kCamera, kSize) == "");
        if (i % 2) rest();
    }
}

TEST_CASE("at most 32 programs are alive, and the one dropped is compiled again") {
    for (const bool behind : {false, true}) {
        Background background;
        Renderer renderer(behind ? std::move(background.compiler) : nullptr);
        Scene scene = spheres(1);
        std::size_t most = 0;
        for (int lights = 1; lights <= 36; ++lights) {
            scene.lights.push_back({.name = "", .pos = {4, 8, 5}});
            drawInTheEnd(renderer, scene);
            most = std::max(most, renderer.programs() + (behind ? Compiler::kHeld : 0));
        }
        CHECK(most == 32);
        CHECK(renderer.compiled() == 36);
        scene.lights.resize(1);
        drawInTheEnd(renderer, scene);
        CHECK(renderer.compiled() == 37);
    }
}
