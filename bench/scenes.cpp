#include "bench/scenes.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace mb::bench {
namespace {

constexpr Finish kMaterials[] = {
    {{0.80, 0.25, 0.20}}, {{0.25, 0.55, 0.80}}, {{0.85, 0.70, 0.25}}, {{0.35, 0.65, 0.35}},
    {{0.65, 0.40, 0.70}}, {{0.90, 0.55, 0.30}}, {{0.55, 0.55, 0.60}}, {{0.30, 0.65, 0.65}},
};

/// The frame of the parallel view: turned by 30° about y after 25° about x.
glm::dmat3 turned() { return rotationFromDegrees({0, 30, 0}) * rotationFromDegrees({25, 0, 0}); }

Camera parallelCamera() {
    Camera camera;
    camera.eye = turned() * glm::dvec3{0, 0, 1.8};
    camera.target = glm::dvec3{0};
    camera.ortho = 2;
    return camera;
}

/// The next solid's place and size: n of them fill about the same part of the cube whatever n is.
struct Draw {
    Lcg random;
    double scale;
    Draw(int n, std::uint32_t seed) : random(seed), scale(0.55 / std::cbrt(static_cast<double>(n))) {}

    glm::dvec3 centre() {
        glm::dvec3 c;
        for (int axis = 0; axis < 3; ++axis) c[axis] = (2 * random() - 1) * 0.8;
        return c;
    }
    double radius() { return scale * (0.6 + 0.8 * random()); }
    glm::dvec3 halves(double r) {
        glm::dvec3 h;
        for (int axis = 0; axis < 3; ++axis) h[axis] = r * (0.5 + 0.6 * random());
        return h;
    }
    Solid sphere() {
        const glm::dvec3 c = centre();
        return {Solid::Kind::sphere, c, glm::dvec3{radius()}};
    }
    Solid box() {
        const glm::dvec3 c = centre();
        return {Solid::Kind::box, c, halves(radius())};
    }
    Solid cylinder() { return cylinder(centre()); }
    Solid cylinder(glm::dvec3 c) {
        const glm::dvec3 h = halves(radius());
        return {Solid::Kind::cylinder, c, {h.x, h.y, h.x}};
    }
};

Part leaf(const Solid& solid, int material = 0) { return {Part::Op::solid, solid, 0, material}; }
int materialOf(int i) { return i % static_cast<int>(std::size(kMaterials)); }

Model makeUnion(int n, std::uint32_t seed) {
    Model model{"union", n, {}, parallelCamera()};
    Draw draw(n, seed);
    for (int i = 0; i < n; ++i) model.objects.push_back(leaf(i % 2 == 0 ? draw.sphere() : draw.box(), materialOf(i)));
    return model;
}

Model makeGround(int n, std::uint32_t seed) {
    Model model = makeUnion(n, seed);
    model.family = "ground";
    model.objects.push_back(leaf({Solid::Kind::plane, {0, -1, 0}, {}}, 6));
    model.camera = Camera{.name = "", .eye = {0, 0.5, 2.5}, .target = {0, -0.1, 0}, .fov = 60};
    model.far = 40;
    return model;
}

Model makeBlended(int n, std::uint32_t seed) {
    Model model{"blended", n, {}, parallelCamera(), 4, true};
    Draw draw(n, seed);
    for (int i = 0; i < n / 2; ++i) {
        const Solid box = draw.box();
        const glm::dvec3 beside = box.centre + glm::dvec3{box.half.x, 0, 0};
        Part both{Part::Op::unite, {}, 0.5 * draw.scale, materialOf(i)};
        both.parts = {leaf(box), leaf(draw.cylinder(beside))};
        model.objects.push_back(both);
    }
    return model;
}

Model makeCarved(int n, std::uint32_t seed) {
    Model model{"carved", n, {}, parallelCamera()};
    Draw draw(n, seed);
    for (int i = 0; i < n / 2; ++i) {
        const Solid box = draw.box();
        const glm::dvec3 corner = box.centre + turned() * glm::dvec3{0, 0, std::max({box.half.x, box.half.y, box.half.z})};
        Part carved{Part::Op::subtract, {}, 0, materialOf(i)};
        carved.parts = {leaf(box), leaf({Solid::Kind::sphere, corner, glm::dvec3{draw.radius()}})};
        model.objects.push_back(carved);
    }
    return model;
}

Model makeTreeModel(int n, std::uint32_t seed) {
    Model model{"tree", n, {}, parallelCamera()};
    Draw draw(n, seed);
    Part kept{Part::Op::unite}, taken{Part::Op::unite}, tree{Part::Op::subtract};
    for (int i = 0; i < n; ++i) {
        Part part = i % 4 == 1 ? leaf(draw.cylinder()) : leaf(i % 2 == 0 ? draw.box() : draw.sphere());
        (i < n / 2 ? kept : taken).parts.push_back(part);
    }
    tree.parts = {kept, taken};
    model.objects.push_back(tree);
    return model;
}

constexpr Family kFamilies[] = {
    {"union", "spheres and boxes in turn, seen in parallel", makeUnion},
    {"ground", "the same above a plane, in perspective, with a horizon", makeGround},
    {"blended", "pairs of a box and a cylinder with a rounded seam", makeBlended},
    {"carved", "boxes less spheres", makeCarved},
    {"tree", "one subtraction: a union of one half of the solids less a union of the other", makeTreeModel},
};

Numbers numbersOf(const Solid& s) {
    switch (s.kind) {
    case Solid::Kind::sphere: return {s.half.x};
    case Solid::Kind::box: return {2 * s.half.x, 2 * s.half.y, 2 * s.half.z};
    case Solid::Kind::cylinder: return {s.half.x, 2 * s.half.y};
    default: return {0, 1, 0};
    }
}

void addPart(Scene& scene, const Part& part, int parent) {
    constexpr std::string_view kSolids[] = {"sphere", "box", "cylinder", "plane"}, kOps[] = {"", "union", "subtract"};
    const bool solid = part.op == Part::Op::solid;
    Object o;
    o.id = scene.newId();
    o.type = findShapeType(solid ? kSolids[static_cast<int>(part.solid.kind)] : kOps[static_cast<int>(part.op)]);
    o.numbers = solid ? numbersOf(part.solid) : Numbers{part.blend};
    o.pos = solid ? part.solid.centre : glm::dvec3{0};
    o.parent = parent;
    if (parent == kNoParent) o.material = part.material;
    const int self = static_cast<int>(scene.objects.size());
    scene.objects.push_back(std::move(o));
    for (const Part& child : part.parts) addPart(scene, child, self);
}

}  // namespace

std::span<const Finish> materials() { return kMaterials; }
std::span<const Family> families() { return kFamilies; }

glm::dvec3 lightPosition(const Model& model) {
    const View view = viewOf(model.camera);
    return 100.0 * glm::normalize(0.5 * view.right + 0.7 * view.up - 0.6 * view.forward);
}

Model makeModel(std::string_view family, int n, std::uint32_t seed) {
    const Family* row = std::ranges::find(kFamilies, family, &Family::name);
    assert(row != std::end(kFamilies));
    return row->make(n, seed);
}

Scene sceneOf(const Model& model, int reflections) {
    Scene scene;
    scene.render.reflections = reflections;
    scene.render.max_distance = model.far;
    scene.cameras.push_back(model.camera);
    Light light;
    light.pos = lightPosition(model);
    scene.lights.push_back(light);
    for (const Finish& finish : kMaterials)
        scene.materials.push_back({"", finish.color, finish.color, Pattern::none, kAmbient, kDiffuse, kSpecular, kReflected, kShininess});
    for (const Part& part : model.objects) addPart(scene, part, kNoParent);
    return scene;
}

}  // namespace mb::bench
