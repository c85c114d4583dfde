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
enum class Stage { flight, static_contacts, broad_phase, body_contacts, spin, friction, restitution, continuous, sleeping, count };

struct Effect {
    std::string_view name, tip;
    /// Adds the records that call for it; may stop once `out` is full.
    void (*calls)(const Effect&, const Scene&, const Tree&, Calls& out) = nullptr;
    std::string_view counts;             // what one use of it is: "shadow rays' evaluations"

    // Of the picture: the switch its GLSL stands behind.
    std::string_view define = {};
    // Of a shape: the operator it is.
    const Operator* op = nullptr;
    // Of the physics.
    Stage stage = Stage::count;

    bool ofMotion() const { return stage != Stage::count; }
};
/// All rows: light and surfaces, the air, the film; the operators; the physics. The order is that of the work.
std::span<const Effect> effects();
/// The rows of the physics alone, in the order of Stage (table_motion.cpp).
std::span<const Effect> motionEffects();
/// The row of that name; it must exist.
const Effect& effectNamed(std::string_view name);

}  // namespace mb
