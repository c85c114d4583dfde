#include "core/effects/plan.h"

#include <fmt/format.h>

#include <cmath>

namespace mb {
namespace {

/// The first leaf whose material `asks`, as a sentence, or nothing.
template <class F> std::string firstMaterial(const Scene& scene, const Tree& tree, F asks) {
    for (const Leaf& leaf : tree.leaves) {
        const Material& material = materialOf(scene, leaf.material);
        if (const std::string why = asks(material); !why.empty())
            return fmt::format("material '{}' ({}) of object '{}'", material.name, why, label(scene, leaf.index));
    }
    return {};
}

std::string lightCalls(const Scene& scene, const Tree& tree) {
    return scene.lights.empty() || tree.leaves.empty() ? "" : fmt::format("{} light record{}", scene.lights.size(), scene.lights.size() == 1 ? "" : "s");
}
std::string shadowCalls(const Scene& scene, const Tree& tree) {
    if (lightCalls(scene, tree).empty() || scene.render.shadow_steps == 0) return {};
    return fmt::format("{}, shadow_steps:{}", lightCalls(scene, tree), scene.render.shadow_steps);
}
std::string reflectionCalls(const Scene& scene, const Tree& tree) {
    if (scene.render.reflections == 0) return {};
    return firstMaterial(scene, tree, [](const Material& m) { return m.kr > 0 ? fmt::format("Kr:{}", m.kr) : ""; });
}
std::string checkerCalls(const Scene& scene, const Tree& tree) {
    return firstMaterial(scene, tree, [](const Material& m) { return std::string(m.pattern == Pattern::checker ? "pattern:checker" : ""); });
}
std::string blendCalls(const Scene& scene, const Tree& tree) {
    for (const Branch& b : tree.branches)
        if (b.blend > 0) return fmt::format("object '{}' ({}:{})", label(scene, b.index), b.op->parameters[0].name, scene.objects[b.index].numbers[0]);
    return {};
}
std::string sampleCalls(const Scene& scene, const Tree&) {
    return scene.render.samples > 1 ? fmt::format("render samples:{}", scene.render.samples) : "";
}

constexpr Effect kEffects[] = {
    {"light", "EFFECT_LIGHT", "diffuse and specular light from each light", lightCalls},
    {"shadow", "EFFECT_SHADOW", "one marched ray to each light from each point that faces it", shadowCalls},
    {"reflection", "EFFECT_REFLECTION", "marched rays from mirror to mirror", reflectionCalls},
    {"checker", "EFFECT_CHECKER", "a pattern fixed to the object", checkerCalls},
    {"blend", "EFFECT_BLEND", "rounded seams that carry the colours of both sides", blendCalls},
    {"samples", "", "several rays a pixel", sampleCalls},
};

constexpr std::int64_t kRetry = 2;  // shaders/lib/march.glsl: primary budgets for the second tries of a pixel's rays

/// Loop iterations of one pass of `lights` lights, each loop's last look at its condition included.
std::int64_t iterations(const RenderKnobs& knobs, bool reflects, bool shadows, int lights) {
    const std::int64_t bounces = reflects ? knobs.reflections + 1 : 1;
    const int normal = 6, look = 1;
    const std::int64_t light = look + (shadows ? knobs.shadow_steps + look : 0);
    return look + kRetry * knobs.march_steps + bounces * (look + knobs.march_steps + look + normal + look + lights * light + look);
}

/// The first leaf with a number that is none, as a sentence, or nothing: min and max drop a NaN, and the shape would be
/// missing from the picture without a word.
std::string notFinite(const Scene& scene, const Tree& tree) {
    for (const Leaf& leaf : tree.leaves) {
        double sum = leaf.position.x + leaf.position.y + leaf.position.z;
        for (int axis = 0; axis < 3; ++axis) sum += leaf.rotation[axis].x + leaf.rotation[axis].y + leaf.rotation[axis].z;
        for (const double x : leaf.numbers) sum += x;
        if (!std::isfinite(sum)) return fmt::format("object '{}' has a number that is not finite", label(scene, leaf.index));
    }
    return {};
}

}  // namespace

std::span<const Effect> effects() { return kEffects; }

bool Plan::has(std::string_view name) const {
    for (const Called& c : called)
        if (c.effect->name == name) return true;
    return false;
}

Plan makePlan(const Scene& scene, const Tree& tree) {
    Plan plan;
    for (const Effect& effect : kEffects)
        if (std::string by = effect.calledForBy(scene, tree); !by.empty()) plan.called.push_back({&effect, std::move(by)});

    // As many lights a pass as the loop budget holds.
    const bool reflects = plan.has("reflection"), shadows = plan.has("shadow");
    const int lights = plan.has("light") ? static_cast<int>(scene.lights.size()) : 0;
    const auto cost = [&](int n) { return iterations(scene.render, reflects, shadows, n); };
    int batch = lights;
    while (batch > 1 && cost(batch) > kLoopBudget) batch = (batch + 1) / 2;
    plan.loop_iterations = cost(batch);
    plan.refused = notFinite(scene, tree);
    if (plan.refused.empty() && plan.loop_iterations > kLoopBudget) {
        plan.refused = fmt::format(
            "render: march_steps:{} and shadow_steps:{} with reflections:{} may take {} loop iterations a pixel, and software OpenGL "
            "ends a shader at {}: lower one of them until they need at most {}",
            scene.render.march_steps, shadows ? scene.render.shadow_steps : 0, reflects ? scene.render.reflections : 0,
            plan.loop_iterations, kLoopLimit, kLoopBudget);
    }
    plan.passes.push_back({0, std::min(batch, lights)});
    for (int first = batch; first < lights; first += batch) plan.passes.push_back({first, std::min(first + batch, lights)});
    return plan;
}

}  // namespace mb
