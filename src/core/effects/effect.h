#pragma once
// The table of effects: everything a picture or a step of the physics may hold, one row each, with the records of a scene
// that call for it. What no record calls for is neither in the shader's text nor in the step.
#include "core/scene/keys.h"
#include "core/sdf/tree.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mb {

/// A record that calls for an effect, and what in it does: "Kr:0.3".
struct Because {
    enum class Record { world, render, physics, light, material, object };
    Record record = Record::world;
    std::size_t index = 0;    // in the scene's list; 0 for the records there is one of
    std::string what;
};
/// The record as a message names it: "material 'mirror' (Kr:0.3)".
std::string describe(const Scene& scene, const Because& because);

/// The records that call for an effect, as many as whoever asks wants: a plan needs one, the ledger all.
class Calls {
public:
    explicit Calls(std::size_t most) : most_(most) {}
    void add(Because because) { if (!full()) found_.push_back(std::move(because)); }
    bool full() const { return found_.size() >= most_; }
    bool any() const { return !found_.empty(); }
    const std::vector<Because>& found() const { return found_; }

private:
    std::size_t most_;
    std::vector<Because> found_;
};

/// The stages of a physics step, each a row of the table.
enum class Stage { flight, static_contacts, broad_phase, body_contacts, spin, friction, restitution, continuous, sleeping, rolling, count };

/// A key that an effect brings to a record of the scene: a number, which the shader reads through a function of its own.
struct EffectKey {
    Carrier carrier;
    std::string_view name, unit, tip;
    double lo, hi, slider_lo, slider_hi, initial;
    std::string_view glsl;               // worldFog(), lightSize(light), materialEmission(look), renderAo()
    bool whole = false, logarithmic = false;
};

struct Effect {
    std::string_view name, tip;
    /// Adds the records that call for it; may stop once `out` is full.
    void (*calls)(const Effect&, const Scene&, const Tree&, Calls& out) = nullptr;
    std::string_view counts;             // what one use of it is; empty: its uses are not counted

    // Of the picture. Its GLSL is shaders/lib/effects/NAME.glsl, if there is one; its switch is EFFECT_NAME.
    std::string_view at = {};            // the place in the story where `statement` stands: "#effects AT" in shaders/
    std::string_view statement = {};
    std::span<const EffectKey> keys = {};
    // Of a shape: the operator it is.
    const Operator* op = nullptr;
    // Of the physics.
    Stage stage = Stage::count;

    bool ofMotion() const { return stage != Stage::count; }
    bool ofPicture() const { return !op && !ofMotion(); }
};
/// All rows: those of light, surfaces, air and film; the operators; the physics. The order is that of the work.
std::span<const Effect> effects();
/// The rows of the physics alone, in the order of Stage (table_motion.cpp).
std::span<const Effect> motionEffects();
/// The row of that name; it must exist.
const Effect& effectNamed(std::string_view name);
/// Its place in effects().
std::size_t numberOf(const Effect& effect);
/// Its name as a file's and, in capitals, as a switch's: hard_shadow.
std::string fileNameOf(const Effect& effect);

/// Where a row's key lies in its record's `extra`.
std::size_t slotOf(const EffectKey& key);

}  // namespace mb
