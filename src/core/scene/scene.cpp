#include "core/scene/scene.h"

#include "core/scene/keys.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace mb {
namespace {

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same(const glm::dvec3& a, const glm::dvec3& b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }
bool same(const std::optional<double>& a, const std::optional<double>& b) {
    return a.has_value() == b.has_value() && (!a || same(*a, *b));
}
template <class T> bool same(const T& a, const T& b) { return a == b; }

template <class Record> bool sameRecord(const Record& a, const Record& b) {
    for (const Key<Record>& key : keys<Record>())
        if (!std::visit([&](auto member) { return same(valueAt(a, member), valueAt(b, member)); }, key.member)) return false;
    return true;
}
bool sameRecord(const Object& a, const Object& b) {
    for (std::size_t i = 0; i < a.numbers.size(); ++i)
        if (!same(a.numbers[i], b.numbers[i])) return false;
    return a.type == b.type && a.parent == b.parent && a.material == b.material && sameRecord<Object>(a, b);
}
template <class Record> bool sameRecords(const std::vector<Record>& a, const std::vector<Record>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (!sameRecord(a[i], b[i])) return false;
    return true;
}

}  // namespace

bool sameScene(const Scene& a, const Scene& b) {
    return a.comment == b.comment && sameRecord(a.world, b.world) && sameRecord(a.render, b.render) && sameRecord(a.physics, b.physics) &&
           sameRecords(a.cameras, b.cameras) && sameRecords(a.lights, b.lights) && sameRecords(a.materials, b.materials) &&
           sameRecords(a.objects, b.objects);
}

glm::dvec3 World::fall() const {
    const double largest = std::max({std::fabs(down.x), std::fabs(down.y), std::fabs(down.z)});
    if (!(largest > 0)) return glm::dvec3{0};  // of a world made in code
    const glm::dvec3 direction = down / largest;  // whose square neither overflows nor vanishes
    return gravity * (direction / glm::length(direction));
}

std::size_t subtreeEnd(const Scene& scene, std::size_t i) {
    std::size_t end = i + 1;
    while (end < scene.objects.size() && scene.objects[end].parent >= static_cast<int>(i)) ++end;
    return end;
}

std::optional<std::size_t> findObject(const Scene& scene, ObjectId id) {
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        if (scene.objects[i].id == id) return i;
    return std::nullopt;
}

std::string label(const Scene& scene, std::size_t object) {
    const Object& o = scene.objects[object];
    return o.name.empty() ? fmt::format("{} {}", o.type->name, object) : o.name;
}

void removeSubtree(Scene& scene, std::size_t object) {
    const std::size_t end = subtreeEnd(scene, object);
    const int removed = static_cast<int>(end - object);
    scene.objects.erase(scene.objects.begin() + static_cast<std::ptrdiff_t>(object),
                        scene.objects.begin() + static_cast<std::ptrdiff_t>(end));
    for (Object& o : scene.objects)
        if (o.parent >= static_cast<int>(end)) o.parent -= removed;
}

Camera defaultCamera(const Scene& scene) { return scene.cameras.empty() ? Camera{} : scene.cameras.front(); }

int effectiveMaterial(const Scene& scene, std::size_t object) {
    for (int i = static_cast<int>(object); i != kNoParent; i = scene.objects[static_cast<std::size_t>(i)].parent)
        if (const int m = scene.objects[static_cast<std::size_t>(i)].material; m != kNoMaterial) return m;
    return kNoMaterial;
}

const Material& materialOf(const Scene& scene, int material) {
    static const Material kDefault;
    return material == kNoMaterial ? kDefault : scene.materials[static_cast<std::size_t>(material)];
}

glm::dmat3 rotationFromDegrees(glm::dvec3 degrees) {
    const glm::dvec3 c = glm::cos(glm::radians(degrees)), s = glm::sin(glm::radians(degrees));
    const glm::dmat3 x{1, 0, 0, 0, c.x, s.x, 0, -s.x, c.x};
    const glm::dmat3 y{c.y, 0, -s.y, 0, 1, 0, s.y, 0, c.y};
    const glm::dmat3 z{c.z, s.z, 0, -s.z, c.z, 0, 0, 0, 1};
    return z * y * x;
}

glm::dvec3 degreesFromRotation(const glm::dmat3& r) {
    // R = Rz·Ry·Rx has −sin y in its lower left corner; where cos y is 0, x and z turn about one axis and z is taken as 0.
    const double cos_y = std::hypot(r[0][0], r[0][1]);
    const double y = std::atan2(-r[0][2], cos_y);
    if (cos_y < 1e-9) return glm::degrees(glm::dvec3{std::atan2(-r[2][1], r[1][1]), y, 0});
    return glm::degrees(glm::dvec3{std::atan2(r[1][2], r[2][2]), y, std::atan2(r[0][1], r[0][0])});
}

}  // namespace mb
