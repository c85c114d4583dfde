// What a scene calls for, and that no accepted scene comes near the driver's loop limit.
#include "headless.h"
#include "scenes.h"

#include "core/scene/keys.h"

using namespace mb;

namespace {

Scene scene(double kr, int lights, Pattern pattern = Pattern::none) {
    Scene s;
    s.materials.push_back({"m", {0.5, 0.5, 0.5}, {0, 0, 0}, pattern, 0.1, 0.7, 0.2, kr, 32});
    addObject(s, "sphere", {1});
    s.objects[0].material = 0;
    for (int i = 0; i < lights; ++i) s.lights.push_back({"", {2.0 + i % 7, 3, 4.0 + i % 5}, {1, 1, 1}, 1.0 / lights});
    return s;
}

std::vector<std::string_view> names(const Plan& plan) {
    std::vector<std::string_view> all;
    for (const auto& c : plan.called) all.push_back(c.effect->name);
    return all;
}

}  // namespace

TEST_CASE("only what the scene calls for is planned") {
    const auto planned = [](const Scene& s) { return names(makePlan(s, makeTree(s))); };
    CHECK(planned(scene(0, 0)).empty());
    CHECK(planned(scene(0, 1)) == std::vector<std::string_view>{"hard shadow", "specular", "light"});
    CHECK(planned(scene(0.5, 0)) == std::vector<std::string_view>{"reflection"});
    CHECK(planned(scene(0, 0, Pattern::checker)) == std::vector<std::string_view>{"checker"});

    Scene no_shadow = scene(0.5, 1);
    no_shadow.render.shadow_steps = 0, no_shadow.render.reflections = 0;
    CHECK(planned(no_shadow) == std::vector<std::string_view>{"specular", "light"});

    Scene unused = scene(0, 0);
    unused.materials.push_back({"mirror", {1, 1, 1}, {1, 1, 1}, Pattern::checker, 0, 0, 0, 1, 1});
    CHECK(planned(unused).empty());  // nothing shows that material

    Scene reason = scene(0.25, 1);
    CHECK(makePlan(reason, makeTree(reason)).called.back().by == "material 'm' (Kr:0.25)");
}

TEST_CASE("a matte scene makes no reflection, an unlit one no shadow") {
    HeadlessRenderer headless;
    const Camera camera = cameraAt({0, 1, 4}, {0, 0, 0});
    const Counts matte = headless.measure(scene(0, 1), camera, {64, 48}).counts;
    CHECK(matte.evaluations.reflection == 0);
    CHECK(matte.rays.reflection == 0);
    CHECK(matte.rays.shadow > 0);
    const Counts unlit = headless.measure(scene(0.5, 0), camera, {64, 48}).counts;
    CHECK(unlit.evaluations.shadow == 0);
    CHECK(unlit.rays.reflection > 0);
}

TEST_CASE("no scene that is accepted comes near the loop limit") {
    static_assert(kLoopBudget < kLoopLimit);
    const auto range = [](std::string_view name) {
        for (const auto& key : keys<RenderKnobs>())
            if (key.name == name) return std::vector<int>{static_cast<int>(key.lo), 1, 64, 512, static_cast<int>(key.hi / 2), static_cast<int>(key.hi)};
        return std::vector<int>{};
    };
    int accepted = 0, refused = 0;
    for (const int march : range("march_steps"))
        for (const int shadow : range("shadow_steps"))
            for (const int bounces : range("reflections"))
                for (const int lights : {0, 1, 2, 7, 100, static_cast<int>(Limits::lights)})
                    for (const double kr : {0.0, 0.5}) {
                        Scene s = scene(kr, lights);
                        s.render.march_steps = march, s.render.shadow_steps = shadow, s.render.reflections = bounces;
                        const Plan plan = makePlan(s, makeTree(s));
                        if (!plan.refused.empty()) {
                            ++refused;
                            continue;
                        }
                        ++accepted;
                        REQUIRE(plan.loop_iterations <= kLoopBudget);
                        int next = 0;  // every light has one turn
                        for (const LightPass& pass : plan.passes) {
                            REQUIRE(pass.first == next);
                            next = pass.last;
                        }
                        REQUIRE(next == lights);
                    }
    MESSAGE(accepted << " accepted, " << refused << " refused");
    CHECK(accepted > 100);
    CHECK(refused > 10);
}

TEST_CASE("lights in several passes give the picture of one") {
    HeadlessRenderer headless;
    const Camera camera = cameraAt({0, 1, 4}, {0, 0, 0});
    Scene many = scene(0.3, 40, Pattern::checker);
    addObject(many, "plane", {0, 1, 0, -1});
    many.render.shadow_steps = 128;
    const auto one = headless.draw(many, camera, {96, 64});
    CHECK(headless.renderer->plan().passes.size() == 1);
    many.render.shadow_steps = 4096;  // no ray of this scene takes 128: the pictures differ by rounding only
    const auto several = headless.draw(many, camera, {96, 64});
    CHECK(headless.renderer->plan().passes.size() > 3);
    float worst = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
        for (int k = 0; k < 3; ++k) worst = std::max(worst, std::fabs(one[i][k] - several[i][k]));
    CHECK(worst < 1e-5f);  // the sums of 40 floats in another order
}

TEST_CASE("a change of values compiles nothing; a change of topology does") {
    HeadlessRenderer headless;
    Renderer& renderer = *headless.renderer;
    Scene s = scene(0.5, 2, Pattern::checker);
    addObject(s, "box", {1, 1, 1, 0}, {1, 0, 0});
    const Camera camera = cameraAt({0, 1, 4}, {0, 0, 0});
    headless.draw(s, camera, {16, 16});
    CHECK(renderer.compiled() == 1);
    s.objects[1].pos = {0.5, 0.2, 0}, s.objects[1].rot = {10, 20, 30}, s.objects[1].scale = 0.7;
    s.materials[0].color = {1, 0, 0}, s.lights[0].pos = {0, 9, 0}, s.render.march_steps = 100, s.world.background = {1, 1, 1};
    s.objects[0].numbers[0] = 0.3, s.objects[1].material = 0;
    headless.draw(s, cameraAt({1, 1, 4}, {0, 0, 0}, 30), {16, 16});
    CHECK(renderer.compiled() == 1);
    addObject(s, "sphere", {0.2});
    headless.draw(s, camera, {16, 16});
    CHECK(renderer.compiled() == 2);
    s.objects.pop_back();
    headless.draw(s, camera, {16, 16});
    CHECK(renderer.compiled() == 2);  // the first program is still there
}
