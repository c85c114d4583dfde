#include "core/scene/text.h"
#include "core/scene/text_value.h"

namespace mb {
namespace {

/// Whether the record has the key; `why` is what was wrong with the value, if anything.
template <class Record> bool assignKnob(Record& record, std::string_view name, std::string_view value, std::string& why) {
    for (const Key<Record>& key : keys<Record>()) {
        if (key.name != name) continue;
        if (const text::ValueFault f = text::assign(record, key, {0, std::string(value), false})) why = f->message;
        return true;
    }
    return false;
}

template <class Record> void appendNames(std::vector<std::string_view>& names) {
    for (const Key<Record>& key : keys<Record>()) names.push_back(key.name);
}

}  // namespace

std::optional<std::string> setKnob(Scene& scene, std::string_view key_value) {
    const std::size_t equals = key_value.find('=');
    if (equals == std::string_view::npos) return fmt::format("{} has no '=', expected KEY=VALUE", text::shown(key_value));
    const std::string_view name = key_value.substr(0, equals), value = key_value.substr(equals + 1);
    std::string why;
    if (!assignKnob(scene.world, name, value, why) && !assignKnob(scene.render, name, value, why) &&
        !assignKnob(scene.physics, name, value, why)) {
        std::vector<std::string_view> names;
        appendNames<World>(names), appendNames<RenderKnobs>(names), appendNames<PhysicsKnobs>(names);
        why = fmt::format("unknown key {} of world, render or physics{}", text::shown(name), text::nearest(name, names));
    }
    return why.empty() ? std::nullopt : std::optional(why);
}

}  // namespace mb
