#pragma once
// A scene is plain data: a tree of objects, materials, lights, cameras, the world and the quality knobs. Metres, seconds,
// kilograms; angles in degrees, as in files (R = Rz·Ry·Rx); y is up; colours are linear RGB. Every record's keys, with
// their defaults and ranges, stand once in keys.cpp.
#include "core/sdf/shape.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mb {

/// Names one object for as long as its scene lives, whatever is added or removed beside it. 0 names none.
struct ObjectId {
    std::uint32_t value = 0;
    explicit operator bool() const { return value != 0; }
    friend bool operator==(ObjectId, ObjectId) = default;
};

/// The numbers of the keys that rows of the table of effects bring to a record (core/effects/effect.h), in the table's order.
using Extra = std::array<double, 8>;
enum class Carrier { world, render, light, material };
/// Those numbers where a file says nothing.
Extra initialExtra(Carrier carrier);

struct World {
    double gravity = 9.81;       // m/s², along `down`
    glm::dvec3 down{0, -1, 0};   // of any length but 0
    double restitution = 0.6;    // of bodies that state none of their own
    double friction = 0.4;
    double rolling = 0, spinning = 0;  // m: levers of the resistance to rolling and to spinning on the spot
    glm::dvec3 background{0};
    double bounds = 50;          // m: a body further than this from the origin is removed
    Extra extra = initialExtra(Carrier::world);

    /// What falls freely is accelerated by this, m/s².
    glm::dvec3 fall() const;
};

struct Camera {
    std::string name;
    glm::dvec3 eye{0, 2, 6}, target{0, 1, 0};
    double fov = 60;             // vertical, degrees
    double ortho = 0;            // height of a parallel view, m; 0: perspective
};

struct Light {
    std::string name;
    glm::dvec3 pos{0}, color{1};
    double intensity = 1;
    Extra extra = initialExtra(Carrier::light);
};

enum class Pattern { none, checker };

struct Material {
    std::string name;
    glm::dvec3 color{0.8}, color2{0.2};
    Pattern pattern = Pattern::none;
    double ka = 0.1, kd = 0.7, ks = 0.2, kr = 0, c = 32;
    Extra extra = initialExtra(Carrier::material);
};

/// The quality of the picture. Limits that hold between them are effects/plan.h's to check.
struct RenderKnobs {
    int march_steps = 512;       // evaluations a primary or reflected ray may make
    double march_epsilon = 1e-4; // of the distance travelled: closer than this a ray looks for a change of sign
    double max_distance = 200;   // m from the eye; nothing further is seen
    double relaxation = 1;       // of the lengthening of steps where nothing looks ahead: 0 plain sphere tracing, 1 the whole of it
    double normal_epsilon = 1e-4;  // of the distance travelled: the reach of the normal's differences
    int normal_taps = 6;         // evaluations a normal takes: 6 central differences; fewer: the 4 of a tetrahedron, less exact
    double bias = 2;             // hit tolerances: so far from a surface starts a ray that leaves it; too near, it meets that again
    int shadow_steps = 256;      // evaluations a shadow ray may make
    int reflections = 4;         // bounces at most
    int samples = 1;             // a pixel
    double scale = 1;            // of the picture's width and height: drawn so much smaller, and enlarged
    double grid_scale = 1;       // of the grid's cells along a side, a multiple of what is chosen by itself: finer takes longer to build
    bool show_undecided = false; // tints the pixels whose rays ran out of steps
    Extra extra = initialExtra(Carrier::render);
};

struct PhysicsKnobs {
    double dt = 1.0 / 120;       // s
    int substeps = 2;
    int iterations = 8;
    double push_out = 0.2;       // the share of an overlap undone in a part; less leaves bodies in one another for longer
    double sleep_speed = 0.03;   // m/s, of a surface: slower than this for half a second, and touching, a body sleeps; 0: never
};

inline constexpr int kNoParent = -1, kNoMaterial = -1;

struct Object {
    ObjectId id;
    const ShapeType* type = nullptr;
    Numbers numbers{};           // the type's own keys, in the order of its row
    std::string name;
    int parent = kNoParent;      // index of the operator it is a child of
    int material = kNoMaterial;  // index; none: its parent's, or the default material
    glm::dvec3 pos{0}, rot{0};   // degrees
    double scale = 1;
    bool hidden = false;         // neither seen nor touched, nor are its children
    // A body, where one of the first two is positive; top-level objects only, and not both.
    double mass = 0;             // kg
    double density = 0;          // kg/m³
    glm::dvec3 vel{0}, spin{0};  // m/s, rad/s
    std::optional<double> restitution, friction, rolling, spinning;

    bool isBody() const { return mass > 0 || density > 0; }
};

struct Scene {
    std::string comment;             // the comment at the file's head: lines that begin with '#', each with its line end
    World world;
    RenderKnobs render;
    PhysicsKnobs physics;
    std::vector<Camera> cameras;     // the first is the one looked through; with none, Camera{}
    std::vector<Light> lights;
    std::vector<Material> materials;
    std::vector<Object> objects;     // in the order of the file: each before its children, which follow it
    std::uint32_t last_id = 0;

    ObjectId newId() { return {++last_id}; }
};

/// Every value equal to the bit, names and order included; ids are not compared.
bool sameScene(const Scene& a, const Scene& b);

/// The index one past the last descendant of object i: its subtree is [i, subtreeEnd).
std::size_t subtreeEnd(const Scene& scene, std::size_t i);
/// The index of the object of that id, or nothing.
std::optional<std::size_t> findObject(const Scene& scene, ObjectId id);
/// What to call an object in a message: its name, or its type and number ("sphere 3").
std::string label(const Scene& scene, std::size_t object);
/// Takes an object and its descendants out of the scene.
void removeSubtree(Scene& scene, std::size_t object);
/// The camera looked through where none is named.
Camera defaultCamera(const Scene& scene);
/// The material an object shows: its own, else its nearest ancestor's, else the default one (kNoMaterial).
int effectiveMaterial(const Scene& scene, std::size_t object);
/// The material of that number; kNoMaterial is the default one.
const Material& materialOf(const Scene& scene, int material);

/// The rotation of Euler angles in degrees, R = Rz·Ry·Rx, and one such triple for a rotation.
glm::dmat3 rotationFromDegrees(glm::dvec3 degrees);
glm::dvec3 degreesFromRotation(const glm::dmat3& rotation);

}  // namespace mb
