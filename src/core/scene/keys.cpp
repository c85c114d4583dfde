#include "core/scene/keys.h"

#include "core/effects/effect.h"

#include <vector>

namespace mb {
namespace {

constexpr double kFar = 1e9;     // m: no coordinate of a file lies further out
constexpr double kHuge = 1e12;

constexpr std::string_view kPatternWords[] = {"none", "checker"};

const Key<World> kWorld[] = {
    {"gravity", &World::gravity, "m/s²", "along `down`", -1e4, 1e4, 0, 30},
    {"down", &World::down, "", "where things fall to, of any length but 0", -kHuge, kHuge, -1, 1, false, false, false, true},
    {"restitution", &World::restitution, "", "bounciness of bodies that state none of their own", 0, 1, 0, 1},
    {"friction", &World::friction, "", "of bodies that state none of their own", 0, 1e3, 0, 2},
    {"rolling", &World::rolling, "m", "a contact resists rolling by at most this lever times its push", 0, 1e6, 0, 0.1},
    {"spinning", &World::spinning, "m", "a contact resists spinning on the spot by at most this lever times its push", 0, 1e6, 0, 0.1},
    {"background", &World::background, "", "colour where no ray hits", 0, 1e6, 0, 1},
    {"bounds", &World::bounds, "m", "a body further than this from the origin is removed", 1e-3, kFar, 1, 1000, false, true},
};
const Key<Camera> kCamera[] = {
    {"name", &Camera::name, "", ""},
    {"eye", &Camera::eye, "m", "", -kFar, kFar, -20, 20},
    {"target", &Camera::target, "m", "", -kFar, kFar, -20, 20},
    {"fov", &Camera::fov, "degrees", "vertical", 1e-3, 179, 10, 120},
    {"ortho", &Camera::ortho, "m", "height of a parallel view; 0: perspective", 0, kFar, 0, 20},
};
const Key<Light> kLight[] = {
    {"name", &Light::name, "", ""},
    {"pos", &Light::pos, "m", "", -kFar, kFar, -20, 20, true},
    {"color", &Light::color, "", "", 0, 1e6, 0, 1},
    {"intensity", &Light::intensity, "", "", 0, 1e6, 0, 5},
};
const Key<Material> kMaterial[] = {
    {"name", &Material::name, "", "", 0, 0, 0, 0, true},
    {"color", &Material::color, "", "", 0, 1e3, 0, 1},
    {"color2", &Material::color2, "", "the pattern's other colour", 0, 1e3, 0, 1},
    {"pattern", &Material::pattern, "", "fields of one metre, fixed to the object"},
    {"Ka", &Material::ka, "", "ambient", 0, 1e3, 0, 1},
    {"Kd", &Material::kd, "", "diffuse", 0, 1e3, 0, 1},
    {"Ks", &Material::ks, "", "specular", 0, 1e3, 0, 1},
    {"Kr", &Material::kr, "", "reflected", 0, 1, 0, 1},
    {"C", &Material::c, "", "shininess: the highlight's exponent", 0, 1e4, 1, 256, false, true},
};
const Key<RenderKnobs> kRender[] = {
    {"march_steps", &RenderKnobs::march_steps, "", "evaluations a primary or reflected ray may make", 1, 8192, 16, 2048, false, true},
    {"march_epsilon", &RenderKnobs::march_epsilon, "", "of the distance travelled: closer, a ray looks for a change of sign", 1e-6, 0.1,
     1e-6, 1e-2, false, true},
    {"max_distance", &RenderKnobs::max_distance, "m", "nothing further is seen", 1e-3, 1e6, 1, 1000, false, true},
    {"normal_epsilon", &RenderKnobs::normal_epsilon, "", "of the distance travelled: the reach of the normal's differences", 1e-6, 0.1,
     1e-5, 1e-2, false, true},
    {"relaxation", &RenderKnobs::relaxation, "", "of the lengthening of steps where nothing looks ahead; 0: plain sphere tracing", 0, 1, 0, 1},
    {"normal_taps", &RenderKnobs::normal_taps, "", "evaluations a normal takes: 6, or fewer: the 4 of a tetrahedron", 4, 6, 4, 6},
    {"bias", &RenderKnobs::bias, "", "hit tolerances: so far from a surface starts a ray that leaves it", 0, 1000, 0.5, 20, false, true},
    {"shadow_steps", &RenderKnobs::shadow_steps, "", "evaluations a shadow ray may make", 0, 8192, 0, 1024},
    {"reflections", &RenderKnobs::reflections, "", "bounces", 0, 64, 0, 16},
    {"samples", &RenderKnobs::samples, "", "a pixel", 1, 256, 1, 16},
    {"scale", &RenderKnobs::scale, "", "of the picture's width and height: drawn so much smaller, and enlarged", 0.05, 1, 0.05, 1},
    {"grid_scale", &RenderKnobs::grid_scale, "", "the grid's cells along a side, as a multiple of what is chosen by itself", 0.1, 4, 0.1, 4, false,
     true},
    {"show_undecided", &RenderKnobs::show_undecided, "", "tints the pixels whose rays ran out of steps"},
};
const Key<PhysicsKnobs> kPhysics[] = {
    {"dt", &PhysicsKnobs::dt, "s", "one step", 1e-6, 1, 1e-3, 1.0 / 30, false, true},
    {"substeps", &PhysicsKnobs::substeps, "", "parts of a step", 1, 1000, 1, 16},
    {"iterations", &PhysicsKnobs::iterations, "", "of the contact solver, a part", 1, 10'000, 1, 100, false, true},
    {"push_out", &PhysicsKnobs::push_out, "", "the share of an overlap undone in a part", 1e-3, 1, 0.01, 1, false, true},
    {"sleep_speed", &PhysicsKnobs::sleep_speed, "m/s", "slower for half a second, and touching, a body sleeps; 0: never", 0, 100, 0, 1},
};
const Key<Object> kObject[] = {
    {"name", &Object::name, "", ""},
    {"pos", &Object::pos, "m", "", -kFar, kFar, -5, 5},
    {"rot", &Object::rot, "degrees", "R = Rz·Ry·Rx", -kFar, kFar, -180, 180},
    {"scale", &Object::scale, "", "uniform", 1e-6, 1e6, 0.1, 5, false, true},
    {"hidden", &Object::hidden, "", "neither seen nor touched"},
    {"mass", &Object::mass, "kg", "0: it never moves", 0, kHuge, 0, 100, false, false, true},
    {"density", &Object::density, "kg/m³", "instead of a mass", 0, kHuge, 0, 10'000, false, false, true},
    {"vel", &Object::vel, "m/s", "", -1e4, 1e4, -10, 10, false, false, true},
    {"spin", &Object::spin, "rad/s", "", -1e5, 1e5, -20, 20, false, false, true},
    {"restitution", &Object::restitution, "", "bounciness; none: the world's", 0, 1, 0, 1, false, false, true},
    {"friction", &Object::friction, "", "none: the world's", 0, 1e3, 0, 2, false, false, true},
    {"rolling", &Object::rolling, "m", "the lever of the resistance to rolling; none: the world's", 0, 1e6, 0, 0.1, false, false, true},
    {"spinning", &Object::spinning, "m", "the lever of the resistance to spinning on the spot; none: the world's", 0, 1e6, 0, 0.1, false, false, true},
};

/// A record's own rows, and behind them those that effects bring to it.
template <class Record, std::size_t N> std::vector<Key<Record>> withEffects(const Key<Record> (&own)[N], Carrier carrier) {
    std::vector<Key<Record>> all(own, own + N);
    for (const Effect& effect : effects())
        for (const EffectKey& k : effect.keys)
            if (k.carrier == carrier)
                all.push_back({k.name, Slot{slotOf(k), k.whole}, k.unit, k.tip, k.lo, k.hi, k.slider_lo, k.slider_hi, false, k.logarithmic});
    return all;
}

}  // namespace

template <> std::span<const Key<World>> keys() {
    static const std::vector<Key<World>> all = withEffects(kWorld, Carrier::world);
    return all;
}
template <> std::span<const Key<Camera>> keys() { return kCamera; }
template <> std::span<const Key<Light>> keys() {
    static const std::vector<Key<Light>> all = withEffects(kLight, Carrier::light);
    return all;
}
template <> std::span<const Key<Material>> keys() {
    static const std::vector<Key<Material>> all = withEffects(kMaterial, Carrier::material);
    return all;
}
template <> std::span<const Key<RenderKnobs>> keys() {
    static const std::vector<Key<RenderKnobs>> all = withEffects(kRender, Carrier::render);
    return all;
}
template <> std::span<const Key<PhysicsKnobs>> keys() { return kPhysics; }
template <> std::span<const Key<Object>> keys() { return kObject; }

std::span<const std::string_view> patternWords() { return kPatternWords; }

}  // namespace mb
