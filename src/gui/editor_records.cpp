// The editor's materials, lights, world and knobs.
#include "core/scene/keys.h"
#include "gui/editor.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {

std::size_t Editor::addMaterial(Material draft) {
    if (scene_.materials.size() >= Limits::materials)
        return refuse(fmt::format("a scene holds at most {} materials", Limits::materials)), scene_.materials.size() - 1;
    draft.name.resize(std::min(draft.name.size(), kLongestName));
    if (draft.name.empty()) draft.name = "material";
    draft.name = freeName(scene_.materials, draft.name, scene_.materials.size());
    scene_.materials.push_back(std::move(draft));
    edited(Change::looks);
    return scene_.materials.size() - 1;
}

void Editor::setMaterial(std::size_t index, Material values) {
    if (values.name.empty()) values.name = scene_.materials[index].name;
    values.name.resize(std::min(values.name.size(), kLongestName));
    values.name = freeName(scene_.materials, values.name, index);
    scene_.materials[index] = std::move(values);
    edited(Change::looks);
}

std::size_t Editor::addLight(Light draft) {
    if (scene_.lights.size() >= Limits::lights)
        return refuse(fmt::format("a scene holds at most {} lights", Limits::lights)), scene_.lights.size() - 1;
    draft.name.resize(std::min(draft.name.size(), kLongestName));
    draft.name = freeName(scene_.lights, draft.name, scene_.lights.size());
    scene_.lights.push_back(std::move(draft));
    edited(Change::looks);
    return scene_.lights.size() - 1;
}

void Editor::setLight(std::size_t index, Light values) {
    values.name.resize(std::min(values.name.size(), kLongestName));
    values.name = freeName(scene_.lights, values.name, index);
    scene_.lights[index] = std::move(values);
    edited(Change::looks);
}

void Editor::removeLight(std::size_t index) {
    scene_.lights.erase(scene_.lights.begin() + static_cast<std::ptrdiff_t>(index));
    edited(Change::looks);
}

void Editor::setWorld(const World& values) {
    if (values.down == glm::dvec3{0}) return say(true, "'down' has no length, expected a direction");
    const bool felt = !feelsAlike(scene_.world, values);
    scene_.world = values, edited(felt ? Change::statics : Change::looks);
}
void Editor::setRender(const RenderKnobs& values) { scene_.render = values, edited(Change::looks); }
void Editor::setPhysics(const PhysicsKnobs& values) { scene_.physics = values, edited(Change::statics); }

}  // namespace mb
