#include "gui/editor.h"

#include "core/scene/keys.h"
#include "core/scene/text.h"
#include "core/sdf/raycast.h"
#include "physics/statics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mb {
namespace {

Object startingPoint(const ShapeType& type) {
    Object o;
    o.type = &type, o.numbers = initialNumbers(type), o.name = type.name;
    return o;
}

/// The children an operator must have, as shapes to start from: a box, a ball beside it, and more balls.
std::vector<Object> firstChildren(const Operator& op) {
    std::vector<Object> children;
    for (int i = 0, n = std::max(op.min_children, std::min(op.max_children, 2)); i < n; ++i) {
        Object child = startingPoint(*findShapeType(i == 0 ? "box" : "sphere"));
        child.name.clear();
        child.pos = {0.4 * i, 0.4 * i, 0.4 * i};
        children.push_back(std::move(child));
    }
    return children;
}

int levelOf(const Scene& scene, int index) {
    int level = 0;
    for (; index != kNoParent; index = scene.objects[static_cast<std::size_t>(index)].parent) ++level;
    return level;
}
int childrenOf(const Scene& scene, std::size_t index) {
    int n = 0;
    for (std::size_t i = index + 1; i < subtreeEnd(scene, index); i = subtreeEnd(scene, i)) ++n;
    return n;
}

/// Forgets whatever makes an object a body: a child is none.
void unbody(Object& o) {
    const Object plain;
    for (const Key<Object>& key : keys<Object>())
        if (key.body) std::visit([&](auto member) { valueAt(o, member) = valueAt(plain, member); }, key.member);
}

/// Whether the two differ in nothing that a body could feel.
bool onlyLooks(Object a, const Object& b) {
    a.name = b.name, a.material = b.material;
    Scene with_a, with_b;
    with_a.objects.push_back(std::move(a)), with_b.objects.push_back(b);
    return sameScene(with_a, with_b);
}

}  // namespace

std::size_t topLevel(const Scene& scene, std::size_t index) {
    while (scene.objects[index].parent != kNoParent) index = static_cast<std::size_t>(scene.objects[index].parent);
    return index;
}

template <class Record> std::string freeName(const std::vector<Record>& records, const std::string& wanted, std::size_t self) {
    const auto taken = [&](const std::string& name) {
        for (std::size_t i = 0; i < records.size(); ++i)
            if (i != self && records[i].name == name) return true;
        return false;
    };
    if (wanted.empty() || !taken(wanted)) return wanted;
    std::string stem = wanted;
    while (!stem.empty() && stem.back() >= '0' && stem.back() <= '9') stem.pop_back();
    for (std::size_t i = 2;; ++i)
        if (std::string name = fmt::format("{}{}", stem, i); !taken(name)) return name;
}
template std::string freeName(const std::vector<Object>&, const std::string&, std::size_t);
template std::string freeName(const std::vector<Material>&, const std::string&, std::size_t);
template std::string freeName(const std::vector<Light>&, const std::string&, std::size_t);

Editor::Editor() {
    scene_.world.background = {0.30, 0.45, 0.65};
    scene_.cameras.push_back({.name = "", .eye = {3, 2.5, 5}, .target = {0, 0.7, 0}, .fov = 45});
    scene_.lights.push_back({.name = "sun", .pos = {4, 8, 5}});
    scene_.materials.push_back({.name = "tile", .color = glm::dvec3{0.8}, .color2 = glm::dvec3{0.35}, .pattern = Pattern::checker});
    scene_.materials.push_back({.name = "clay", .color = {0.75, 0.3, 0.2}});
    Object floor = startingPoint(*findShapeType("plane")), ball = startingPoint(*findShapeType("sphere"));
    floor.name = "floor", floor.material = 0;
    ball.name = "ball", ball.material = 1, ball.pos = {0, 1.5, 0}, ball.mass = 1;
    insertObject(floor, kNoParent), insertObject(ball, kNoParent);
    orbit_ = Orbit::around(defaultCamera(scene_));
    saved_ = scene_;
}

void Editor::edited(Change change) {
    ++edits_, ++revision_;
    if (message_.error) message_ = {};
    if (change == Change::looks) return;
    leaveFuture();
    change == Change::bodies ? simulation_.rebuild() : simulation_.changeStatics();
}

/// Of an object that is added, removed or given other values, but for its looks.
Editor::Change Editor::changeOf(std::size_t index) const {
    return scene_.objects[topLevel(scene_, index)].isBody() ? Change::bodies : Change::statics;
}

bool Editor::refuse(std::string why) {
    say(true, std::move(why));
    return false;
}

/// What the file format has against an object's values, or nothing. Asked of a scene that holds this object alone.
std::string Editor::whyInvalid(Object object) const {
    Scene alone;
    object.material = kNoMaterial, object.parent = kNoParent;
    alone.objects.push_back(object);
    if (object.type->isOperator())
        for (int i = 0; i < object.type->min_children; ++i) {
            alone.objects.push_back(startingPoint(primitives().front()));
            alone.objects.back().parent = 0, alone.objects.back().name.clear();
        }
    const ReadResult read = readScene(writeScene(alone));
    return read.ok() ? std::string{} : read.faults.front().message;
}

/// Puts an object behind the last of its parent's descendants, or at the end.
void Editor::insertObject(Object object, int parent) {
    const std::size_t at = parent == kNoParent ? scene_.objects.size() : subtreeEnd(scene_, static_cast<std::size_t>(parent));
    object.id = scene_.newId(), object.parent = parent;
    if (parent != kNoParent) unbody(object);
    scene_.objects.insert(scene_.objects.begin() + static_cast<std::ptrdiff_t>(at), std::move(object));
    for (std::size_t i = at + 1; i < scene_.objects.size(); ++i)
        if (scene_.objects[i].parent >= static_cast<int>(at)) ++scene_.objects[i].parent;
}

/// The height of the topmost surface at x, z that is no further below the point looked at than can be seen; else 0.
double Editor::surfaceBelow(double x, double z) const {
    const Tree tree = makeTree(scene_);
    const double looked_at = orbit_.target.y;
    double top = looked_at;
    for (const Leaf& leaf : tree.leaves)
        if (const double high = bounds(leaf).hi[1]; std::isfinite(high)) top = std::max(top, high);
    top += 1;
    const RayEnd end = raycast(tree, {x, top, z}, {0, -1, 0}, top - looked_at + scene_.render.max_distance);
    return end.state == RayState::hit ? top - end.t : 0;
}

glm::dvec3 Editor::standing(const Object& draft) const {
    Scene alone;
    alone.objects.push_back(draft);
    Object& o = alone.objects.front();
    o.pos = {0, 0, 0}, o.parent = kNoParent, o.material = kNoMaterial, o.hidden = false;
    if (draft.type->isOperator())
        for (Object& child : firstChildren(asOperator(*draft.type))) child.parent = 0, alone.objects.push_back(std::move(child));
    const double lowest = bounds(makeTree(alone)).lo[1];
    if (!std::isfinite(lowest)) return draft.pos;
    const auto rounded = [](double v, double per_metre) { return std::round(v * per_metre) / per_metre; };
    const double x = rounded(orbit_.target.x, 1e3), z = rounded(orbit_.target.z, 1e3);
    return {x, rounded(surfaceBelow(x, z) - lowest, 1e6), z};
}

ObjectId Editor::addObject(const ShapeType& type, ObjectId parent) {
    Object draft = startingPoint(type);
    if (!parent) draft.pos = standing(draft);
    return addObject(draft, parent);
}

ObjectId Editor::addObject(const Object& draft, ObjectId parent) {
    const std::optional<std::size_t> above = findObject(scene_, parent);
    std::vector<Object> children;
    if (draft.type->isOperator()) children = firstChildren(asOperator(*draft.type));
    if (parent && !above) return refuse("the object it was to be put under is gone"), ObjectId{};
    if (above) {
        const Object& p = scene_.objects[*above];
        if (!p.type->isOperator()) return refuse(fmt::format("a {} takes no children", p.type->name)), ObjectId{};
        if (childrenOf(scene_, *above) >= p.type->max_children)
            return refuse(fmt::format("a {} takes {} and has them", p.type->name,
                                      p.type->max_children == 1 ? "one child" : fmt::format("{} children", p.type->max_children))), ObjectId{};
    }
    const int parent_index = above ? static_cast<int>(*above) : kNoParent;
    const std::size_t levels = static_cast<std::size_t>(levelOf(scene_, parent_index)) + (children.empty() ? 1 : 2);
    if (levels > Limits::levels) return refuse(fmt::format("objects nest at most {} levels deep", Limits::levels)), ObjectId{};
    if (scene_.objects.size() + 1 + children.size() > Limits::objects)
        return refuse(fmt::format("a scene holds at most {} objects", Limits::objects)), ObjectId{};
    if (const std::string why = whyInvalid(draft); !why.empty()) return refuse(why), ObjectId{};

    Object object = draft;
    object.name.resize(std::min(object.name.size(), kLongestName));
    object.name = freeName(scene_.objects, object.name, scene_.objects.size());
    insertObject(object, parent_index);
    const ObjectId id{scene_.last_id};
    const int index = static_cast<int>(*findObject(scene_, id));
    for (Object& child : children) insertObject(child, index);
    selected_ = id;
    edited(changeOf(static_cast<std::size_t>(index)));
    return id;
}

bool Editor::remove(ObjectId id) {
    const std::optional<std::size_t> index = findObject(scene_, id);
    if (!index) return refuse("no object is selected");
    if (const int parent = scene_.objects[*index].parent; parent != kNoParent) {
        const Object& p = scene_.objects[static_cast<std::size_t>(parent)];
        if (childrenOf(scene_, static_cast<std::size_t>(parent)) <= p.type->min_children)
            return refuse(fmt::format("a {} needs {}: remove the {} itself", p.type->name,
                                      p.type->min_children == 1 ? "a child" : fmt::format("{} children", p.type->min_children), p.type->name));
    }
    // A body is taken out of the run, which goes on without it.
    if (simulation_.hasBody(id)) leaveFuture();
    const Change change = simulation_.hasBody(id) ? Change::looks : changeOf(*index);
    simulation_.remove(id);
    removeSubtree(scene_, *index);
    forget(id);
    if (!selection()) selected_ = {};
    edited(change);
    return true;
}

bool Editor::removeSelected() { return remove(selected_); }

bool Editor::removeLast() {
    const Object* last = nullptr;
    for (const Object& o : scene_.objects)
        if (o.parent == kNoParent && (!last || o.id.value > last->id.value)) last = &o;
    return last ? remove(last->id) : refuse("there is no object to remove");
}

void Editor::clear() {
    scene_.objects.clear();
    if (before_) before_->clear();
    selected_ = {};
    edited(Change::bodies);
}

bool Editor::setObject(std::size_t index, const Object& values) {
    Object& o = scene_.objects[index];
    Object wanted = values;
    wanted.type = o.type, wanted.id = o.id, wanted.parent = o.parent;
    wanted.name.resize(std::min(wanted.name.size(), kLongestName));
    wanted.name = freeName(scene_.objects, wanted.name, index);
    if (o.parent != kNoParent) unbody(wanted);
    // A mass and a density are two ways to say one thing: the one last set holds.
    if (wanted.mass > 0 && wanted.density > 0) (wanted.density != o.density ? wanted.mass : wanted.density) = 0;
    if (wanted.material >= static_cast<int>(scene_.materials.size())) wanted.material = kNoMaterial;
    if (const std::string why = whyInvalid(wanted); !why.empty()) return refuse(why);

    // What is moved by hand is where a reset puts it, too.
    if (before_)
        for (Object& b : *before_) {
            if (b.id != o.id) continue;
            for (const auto member : {&Object::pos, &Object::rot, &Object::vel, &Object::spin})
                for (int k = 0; k < 3; ++k)
                    if ((wanted.*member)[k] != (o.*member)[k]) (b.*member)[k] = (wanted.*member)[k];
        }
    const Change before = onlyLooks(o, wanted) ? Change::looks : changeOf(index);
    o = std::move(wanted);
    edited(before == Change::looks ? before : std::max(before, changeOf(index)));
    return true;
}

void Editor::keepView() {
    Camera kept = orbit_.camera();
    if (scene_.cameras.empty()) scene_.cameras.emplace_back();
    kept.name = scene_.cameras.front().name;
    scene_.cameras.front() = kept;
    edited(Change::looks);
    say(false, "The scene's camera now stands where you look from.");
}

void Editor::resetView() { orbit_ = Orbit::around(defaultCamera(scene_)), ++revision_; }

ObjectId Editor::pick(glm::ivec2 picture, glm::dvec2 point, const Grid* drawn) {
    const std::optional<SeenAt> seen = seenAt(picture, point, drawn);
    if (!seen) return {};
    const ObjectId whole = scene_.objects[topLevel(scene_, seen->index)].id, part = scene_.objects[seen->index].id;
    const std::optional<std::size_t> now = selection();
    selected_ = now && scene_.objects[topLevel(scene_, *now)].id == whole ? part : whole;
    return selected_;
}

}  // namespace mb
