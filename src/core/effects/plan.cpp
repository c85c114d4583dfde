#include "core/effects/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mb {
namespace {

/// How many bounces are worth following: to the last whose weight is a step of an 8-bit picture (LEAST_WEIGHT in
/// shaders/lib/effects/reflection.glsl), and no more than the knob allows.
int bouncesOf(const Scene& scene, const Tree& tree) {
    double largest = 0;
    for (const Leaf& leaf : tree.leaves) largest = std::max(largest, materialOf(scene, leaf.material).kr);
    int bounces = 0;
    for (double weight = largest; weight >= 1.0 / 255 && bounces < scene.render.reflections; weight *= largest) ++bounces;
    return bounces;
}

constexpr std::int64_t kRetry = 2;  // shaders/lib/march.glsl: primary budgets for the second tries of a pixel's rays

/// Evaluations a normal takes: the four of a tetrahedron, or those of central differences.
int tapsOf(const RenderKnobs& knobs) { return knobs.normal_taps < 6 ? 4 : 6; }

/// Loop iterations of one pass, each loop's last look at its condition included.
struct Loops {
    const RenderKnobs& knobs;
    std::int64_t bounces = 1;        // and the first stretch
    std::int64_t hard_rays = 0, soft_rays = 0, ambient_rays = 0;  // to a light, and from a point

    std::int64_t of(int lights) const {
        constexpr std::int64_t look = 1;
        const std::int64_t normal = tapsOf(knobs);
        const std::int64_t ray = knobs.shadow_steps + look;
        const auto many = [&](std::int64_t rays) { return rays > 0 ? rays * (look + ray) + look : 0; };
        const std::int64_t light = look + hard_rays * ray + many(soft_rays);
        return look + kRetry * knobs.march_steps +
               bounces * (look + knobs.march_steps + look + normal + look + many(ambient_rays) + lights * light + look);
    }
};

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

/// Whether it is in the program and the scene calls for it: what is there by choice alone sends no rays.
bool sendsRays(const Plan& plan, std::string_view effect) {
    return std::ranges::any_of(plan.called, [&](const Plan::Called& c) { return c.effect->name == effect && !c.by.empty(); });
}
std::int64_t raysOf(const Plan& plan, const Scene& scene, std::string_view effect) {
    return sendsRays(plan, effect) ? static_cast<std::int64_t>(scene.render.extra[slotOf(effectNamed(effect).keys.back())]) : 0;
}

}  // namespace

EffectSet everyEffect() {
    EffectSet all;
    for (std::size_t i = 0; i < effects().size(); ++i) all[i] = !effects()[i].ofMotion();
    return all;
}

bool Plan::has(std::string_view name) const {
    return std::ranges::any_of(called, [&](const Called& c) { return c.effect->name == name; });
}

Plan makePlan(const Scene& scene, const Tree& tree, const Choice& choice) {
    Plan plan;
    for (std::size_t i = 0; i < effects().size(); ++i) {
        const Effect& effect = effects()[i];
        if (effect.ofMotion() || choice.off[i]) continue;
        Calls calls(1);
        effect.calls(effect, scene, tree, calls);
        if (calls.any() || choice.on[i]) plan.called.push_back({&effect, calls.any() ? describe(scene, calls.found().front()) : std::string()});
    }

    plan.tetrahedron = tapsOf(scene.render) == 4;

    // As many lights a pass as the loop budget holds.
    if (plan.has("reflection")) plan.bounces = bouncesOf(scene, tree);
    const bool hard = sendsRays(plan, "hard shadow");
    const Loops loops{scene.render, plan.bounces + 1, hard ? 1 : 0, raysOf(plan, scene, "soft shadow"), raysOf(plan, scene, "ambient occlusion")};
    const int lights = plan.has("light") ? static_cast<int>(scene.lights.size()) : 0;
    int batch = lights;
    while (batch > 1 && loops.of(batch) > kLoopBudget) batch = (batch + 1) / 2;
    plan.loop_iterations = loops.of(batch);
    plan.refused = notFinite(scene, tree);
    if (plan.refused.empty() && plan.loop_iterations > kLoopBudget) {
        std::string rays;
        if (loops.soft_rays > 0) rays += fmt::format(", shadow_rays:{}", loops.soft_rays);
        if (loops.ambient_rays > 0) rays += fmt::format(", ao_rays:{}", loops.ambient_rays);
        plan.refused = fmt::format(
            "render: march_steps:{} and shadow_steps:{}{} with reflections:{} may take {} loop iterations a pixel, and software OpenGL "
            "ends a shader at {}: lower one of them until they need at most {}",
            scene.render.march_steps, hard || !rays.empty() ? scene.render.shadow_steps : 0, rays, plan.bounces, plan.loop_iterations, kLoopLimit, kLoopBudget);
    }
    plan.passes.push_back({0, std::min(batch, lights)});
    for (int first = batch; first < lights; first += batch) plan.passes.push_back({first, std::min(first + batch, lights)});
    return plan;
}

Scene withoutOperator(const Scene& scene, const Effect& effect) {
    Scene without = scene;
    const ShapeType& plain = *findShapeType("union");
    for (std::size_t i = 0; i < without.objects.size() && effect.op; ++i) {
        Object& o = without.objects[i];
        if (o.type != effect.op) continue;
        const bool first_only = effect.op->first_only;
        o.type = &plain, o.numbers = initialNumbers(plain);
        if (!first_only) continue;
        for (std::size_t child = i + 1, end = subtreeEnd(without, i); child < end; child = subtreeEnd(without, child))
            without.objects[child].hidden = without.objects[child].hidden || child > i + 1;
    }
    return without;
}

}  // namespace mb
