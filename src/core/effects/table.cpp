// The rows of the picture, and of the operators. Each says why a scene calls for it.
#include "core/effects/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace mb {
namespace {

using Record = Because::Record;

/// Adds the materials some leaf shows that `asks` has something to say of; where that is the default material, the first object
/// that shows it.
template <class F> void addMaterials(const Scene& scene, const Tree& tree, Calls& out, F asks) {
    std::vector<char> seen(scene.materials.size() + 1, 0);
    for (const Leaf& leaf : tree.leaves) {
        if (out.full()) return;
        char& known = seen[static_cast<std::size_t>(leaf.material + 1)];
        if (std::exchange(known, 1)) continue;
        if (std::string what = asks(materialOf(scene, leaf.material)); what.empty()) continue;
        else if (leaf.material == kNoMaterial) out.add({Record::object, leaf.index, what + " of the default material"});
        else out.add({Record::material, static_cast<std::size_t>(leaf.material), std::move(what)});
    }
}
/// Adds the lights that `asks` says yes to; in an empty scene none.
template <class F> void addLights(const Scene& scene, const Tree& tree, Calls& out, F asks) {
    if (tree.leaves.empty()) return;
    for (std::size_t i = 0; i < scene.lights.size() && !out.full(); ++i)
        if (std::string what = asks(scene.lights[i]); !what.empty()) out.add({Record::light, i, std::move(what)});
}

double keyOf(const Extra& extra, const EffectKey& key) { return extra[slotOf(key)]; }
std::string said(const EffectKey& key, double value) { return value > 0 ? fmt::format("{}:{}", key.name, value) : ""; }

/// An effect whose first key is its amount: called for wherever that is above 0.
void amountCalls(const Effect& effect, const Scene& scene, const Tree& tree, Calls& out) {
    const EffectKey& key = effect.keys.front();
    const auto one = [&](Record record, const Extra& extra) {
        if (std::string what = said(key, keyOf(extra, key)); !what.empty()) out.add({record, 0, std::move(what)});
    };
    switch (key.carrier) {
    case Carrier::world: one(Record::world, scene.world.extra); break;
    case Carrier::render: one(Record::render, scene.render.extra); break;
    case Carrier::light: addLights(scene, tree, out, [&](const Light& l) { return said(key, keyOf(l.extra, key)); }); break;
    case Carrier::material: addMaterials(scene, tree, out, [&](const Material& m) { return said(key, keyOf(m.extra, key)); }); break;
    }
}

constexpr EffectKey kSoftShadowKeys[] = {
    {Carrier::light, "size", "m", "diameter of the light; 0: a point", 0, 1e6, 0, 5, 0, "lightSize"},
    {Carrier::render, "shadow_rays", "", "to each light that has a size", 1, 256, 1, 64, 16, "renderShadowRays", true},
};
constexpr EffectKey kAoKeys[] = {
    {Carrier::render, "ao", "m", "ambient light is blocked by what is nearer than this; 0: by nothing", 0, 1e6, 0, 5, 0, "renderAo"},
    {Carrier::render, "ao_rays", "", "from each point, where ao is not 0", 1, 256, 1, 64, 16, "renderAoRays", true},
};
constexpr EffectKey kEmissionKeys[] = {{Carrier::material, "emission", "", "light of its own, times the color", 0, 1e3, 0, 4, 0, "materialEmission"}};
constexpr EffectKey kFogKeys[] = {{Carrier::world, "fog", "1/m", "how fast light fades into the background: 1/e is left after 1/fog metres", 0, 1e3, 0, 0.3, 0, "worldFog"}};
constexpr EffectKey kToneKeys[] = {{Carrier::render, "exposure", "", "of the film, which bright colors never saturate; 0: colors above 1 are cut", 0, 1e6, 0, 8, 0, "renderExposure"}};

/// Its rays have the shadows' budget of steps.
void ambientCalls(const Effect& effect, const Scene& scene, const Tree& tree, Calls& out) {
    if (scene.render.shadow_steps > 0) amountCalls(effect, scene, tree, out);
}
void lightCalls(const Effect&, const Scene& scene, const Tree& tree, Calls& out) {
    addLights(scene, tree, out, [](const Light& l) { return fmt::format("intensity:{}", l.intensity); });
}
void shadowCalls(const Effect& effect, const Scene& scene, const Tree& tree, Calls& out) {
    const bool soft = !effect.keys.empty();
    if (scene.render.shadow_steps == 0) return;
    addLights(scene, tree, out, [&](const Light& l) {
        const double size = keyOf(l.extra, kSoftShadowKeys[0]);
        return soft == (size > 0) ? fmt::format("size:{}, shadow_steps:{}", size, scene.render.shadow_steps) : "";
    });
}
void specularCalls(const Effect&, const Scene& scene, const Tree& tree, Calls& out) {
    if (scene.lights.empty()) return;
    addMaterials(scene, tree, out, [](const Material& m) { return m.ks > 0 ? fmt::format("Ks:{}", m.ks) : ""; });
}
void checkerCalls(const Effect&, const Scene& scene, const Tree& tree, Calls& out) {
    addMaterials(scene, tree, out, [](const Material& m) { return std::string(m.pattern == Pattern::checker ? "pattern:checker" : ""); });
}
void blendCalls(const Effect&, const Scene& scene, const Tree& tree, Calls& out) {
    for (const Branch& b : tree.branches)
        if (b.blend > 0 && !out.full())
            out.add({Record::object, b.index, fmt::format("{}:{}", b.op->parameters[0].name, scene.objects[b.index].numbers[0])});
}
void reflectionCalls(const Effect&, const Scene& scene, const Tree& tree, Calls& out) {
    if (scene.render.reflections == 0) return;
    addMaterials(scene, tree, out, [](const Material& m) { return m.kr > 0 ? fmt::format("Kr:{}", m.kr) : ""; });
}
void sampleCalls(const Effect&, const Scene& scene, const Tree&, Calls& out) {
    if (scene.render.samples > 1) out.add({Record::render, 0, fmt::format("samples:{}", scene.render.samples)});
}
void gridCalls(const Effect&, const Scene&, const Tree& tree, Calls& out) {
    for (const Leaf& leaf : tree.leaves)
        if (tree.leaves.size() > kStraightLeaves && !out.full())
            out.add({Record::object, leaf.index, fmt::format("one of {} primitives; more than {} need it", tree.leaves.size(), kStraightLeaves)});
}
void operatorCalls(const Effect& effect, const Scene& scene, const Tree&, Calls& out) {
    for (std::size_t i = 0; i < scene.objects.size() && !out.full();) {
        const Object& o = scene.objects[i];
        if (!o.hidden && o.type == effect.op) out.add({Record::object, i, std::string("type:") + std::string(o.type->name)});
        i = o.hidden ? subtreeEnd(scene, i) : i + 1;
    }
}

/// A row's file may call what the rows above it bring.
constexpr Effect kPicture[] = {
    {"grid", "cells that keep the part of the scene that matters in them", gridCalls, ""},
    {"checker", "a pattern of fields fixed to the object", checkerCalls, "points looked up"},
    {"blend", "rounded seams that carry the colors of both sides", blendCalls, "seams looked up"},
    {"ambient occlusion", "ambient light blocked by what is near: short rays from each point", ambientCalls, "points that sent rays", "around", "around *= openness(s);", kAoKeys},
    {"emission", "surfaces with a light of their own", amountCalls, "points shaded", "around", "around += emitted(s);", kEmissionKeys},
    {"hard shadow", "a marched ray to each light that is a point, from each place that faces it", shadowCalls, "rays", "shadow", "clear *= hardShadow(s, i);"},
    {"soft shadow", "many marched rays to each light that has a size", shadowCalls, "points that sent rays", "shadow", "clear *= softShadow(s, i);", kSoftShadowKeys},
    {"specular", "highlights", specularCalls, "points shaded", "highlight", "shine += highlight(s, to_light, direction);"},
    {"light", "diffuse light from each light", lightCalls, "points shaded", "lights", "color += lit(s, direction);"},
    {"fog", "air that hides what is far", amountCalls, "stretches of rays", "air", "throughFog(march.t, color, weight);", kFogKeys},
    {"reflection", "marched rays from mirror to mirror", reflectionCalls, "bounces", "onward", "goes_on = reflected(surface, ray, weight);"},
    {"samples", "several rays a pixel, which smooth its edges", sampleCalls, ""},
    {"tone mapping", "a film that bright colors never saturate", amountCalls, "", "film", "c = developed(c);", kToneKeys},
};

constexpr bool fits(Carrier carrier) {
    std::size_t keys = 0;
    for (const Effect& effect : kPicture)
        for (const EffectKey& key : effect.keys) keys += key.carrier == carrier;
    return keys <= Extra().size();
}
static_assert(fits(Carrier::world) && fits(Carrier::render) && fits(Carrier::light) && fits(Carrier::material),
              "a record's Extra (core/scene/scene.h) has no room for so many keys");

}  // namespace

std::span<const Effect> effects() {
    static const std::vector<Effect> all = [] {
        std::vector<Effect> rows(std::begin(kPicture), std::end(kPicture));
        for (const Operator& op : operators()) {
            Effect row{op.name, op.tip, operatorCalls, "times evaluated"};
            row.op = &op;
            rows.push_back(row);
        }
        rows.insert(rows.end(), motionEffects().begin(), motionEffects().end());
        return rows;
    }();
    return all;
}

const Effect& effectNamed(std::string_view name) {
    const auto found = std::ranges::find(effects(), name, &Effect::name);
    assert(found != effects().end());
    return *found;
}

std::size_t numberOf(const Effect& effect) { return static_cast<std::size_t>(&effect - effects().data()); }

std::string fileNameOf(const Effect& effect) {
    std::string name(effect.name);
    std::ranges::replace(name, ' ', '_');
    return name;
}

std::size_t slotOf(const EffectKey& key) {
    std::size_t slot = 0;
    for (const Effect& effect : kPicture)
        for (const EffectKey& other : effect.keys) {
            if (&other == &key) return slot;
            slot += other.carrier == key.carrier;
        }
    assert(false);
    return slot;
}

Extra initialExtra(Carrier carrier) {
    Extra extra{};
    std::size_t slot = 0;
    for (const Effect& effect : kPicture)
        for (const EffectKey& key : effect.keys)
            if (key.carrier == carrier) extra[slot++] = key.initial;
    return extra;
}

std::string describe(const Scene& scene, const Because& because) {
    constexpr std::string_view kKinds[] = {"world", "render", "physics", "light", "material", "object"};
    const std::string_view kind = kKinds[static_cast<std::size_t>(because.record)];
    const auto named = [&](const std::string& name) { return fmt::format("{} '{}' ({})", kind, name, because.what); };
    switch (because.record) {
    case Record::light:
        if (const std::string& name = scene.lights[because.index].name; !name.empty()) return named(name);
        return fmt::format("light {} ({})", because.index, because.what);
    case Record::material: return named(scene.materials[because.index].name);
    case Record::object: return named(label(scene, because.index));
    default: return fmt::format("{} {}", kind, because.what);
    }
}

}  // namespace mb
