#pragma once
// Small scenes for the tests of the physics.
#include "physics/world.h"

#include <chrono>
#include <cmath>
#include <string_view>

namespace mb::test {

inline constexpr double kPi = 3.14159265358979323846, kG = 9.81;

inline Object& add(Scene& scene, std::string_view type, glm::dvec3 pos, std::initializer_list<double> numbers, int parent = kNoParent) {
    Object o;
    o.id = scene.newId(), o.type = findShapeType(type), o.pos = pos, o.parent = parent;
    o.numbers = initialNumbers(*o.type);
    std::size_t at = 0;
    for (const double x : numbers) o.numbers[at++] = x;
    scene.objects.push_back(o);
    return scene.objects.back();
}
inline Object& ball(Scene& scene, glm::dvec3 pos, double radius, glm::dvec3 vel = {}, double mass = 1) {
    Object& o = add(scene, "sphere", pos, {radius});
    o.mass = mass, o.vel = vel;
    return o;
}
/// A body that is a box, its edges sharp; density in kg/m³.
inline Object& block(Scene& scene, glm::dvec3 pos, glm::dvec3 size, double density = 1000) {
    Object& o = add(scene, "box", pos, {size.x, size.y, size.z, 0});
    o.density = density;
    return o;
}
inline constexpr std::string_view kKinds[] = {"ball", "box", "capsule", "die"};
/// A body of about that size from side to side, 1000 kg/m³: a ball, a cube, an upright capsule of twice the size, or a cube cut
/// by a ball, less pips. Its index.
inline std::size_t bodyOf(Scene& scene, std::string_view kind, glm::dvec3 pos, double size) {
    const std::size_t at = scene.objects.size();
    const int own = static_cast<int>(at);
    if (kind == "ball") add(scene, "sphere", pos, {0.5 * size});
    else if (kind == "box") add(scene, "box", pos, {size, size, size, 0});
    else if (kind == "capsule") add(scene, "capsule", pos, {0.5 * size, size});
    else {
        add(scene, "subtract", pos, {0});
        add(scene, "intersect", {}, {0}, own);
        add(scene, "box", {}, {size, size, size, 0}, own + 1);
        add(scene, "sphere", {}, {0.7 * size}, own + 1);
        const auto pip = [&](glm::dvec3 p) { add(scene, "sphere", 0.55 * size * p, {0.1 * size}, own); };
        pip({0, 1, 0});
        for (const double x : {-0.45, 0.45}) {
            pip({x, 0.45, 1}), pip({1, 0.45, x}), pip({-1, x, x}), pip({x, -1, -0.45}), pip({x, -1, 0}), pip({x, -1, 0.45});
        }
    }
    scene.objects[at].density = 1000;
    return at;
}
inline Object& floor(Scene& scene) { return add(scene, "plane", {}, {0, 1, 0, 0}); }

/// dt, restitution, friction; gravity as on earth.
inline Scene scene(double dt, double restitution, double friction, double gravity = kG) {
    Scene s;
    s.physics.dt = dt, s.physics.substeps = 1, s.physics.iterations = 10;  // a step is one part
    s.world.restitution = restitution, s.world.friction = friction, s.world.gravity = gravity;
    return s;
}
/// An intersection of two unit balls whose centres are ±0.9 from the origin along x: a lens with a rim in the plane x = 0.
inline void lens(Scene& s) {
    add(s, "intersect", {}, {0});
    const int parent = static_cast<int>(s.objects.size()) - 1;
    add(s, "sphere", {-0.9, 0, 0}, {1}, parent);
    add(s, "sphere", {0.9, 0, 0}, {1}, parent);
}
/// A block with a spherical hollow of radius R around the origin, open at the top.
inline void bowl(Scene& s, double R) {
    add(s, "subtract", {}, {0});
    const int parent = static_cast<int>(s.objects.size()) - 1;
    add(s, "box", {0, -0.6 * R, 0}, {2.6 * R, 1.2 * R, 2.6 * R}, parent);
    add(s, "sphere", {}, {R}, parent);
}
/// A groove of full opening angle `degrees` along z whose bottom is the origin: a box less two half-spaces.
inline void groove(Scene& s, double degrees) {
    const double a = degrees / 2 * kPi / 180;
    add(s, "plane", {}, {std::cos(a), std::sin(a), 0, 0});
    add(s, "plane", {}, {-std::cos(a), std::sin(a), 0, 0});
}
/// A closed room of that inner width around the origin, its walls a tenth as thick.
inline void room(Scene& s, double width) {
    add(s, "subtract", {}, {0});
    const int parent = static_cast<int>(s.objects.size()) - 1;
    add(s, "box", {}, {1.1 * width, 1.1 * width, 1.1 * width, 0}, parent);
    add(s, "box", {}, {width, width, width, 0}, parent);
}
/// An upright tube of inner radius 0.101 m, its bottom at 0.1 m: for balls of 0.1 m.
inline void tube(Scene& s, double height) {
    add(s, "subtract", {}, {0});
    const int parent = static_cast<int>(s.objects.size()) - 1;
    add(s, "cylinder", {0, 0.5 * height, 0}, {0.5, height, 0}, parent);
    add(s, "cylinder", {0, 0.1 + 0.5 * height, 0}, {0.101, height, 0}, parent);
}
inline void run(PhysicsWorld& world, double seconds) {
    for (const double end = world.time_s() + seconds - 0.5 * world.dt_s(); world.time_s() < end;) world.step();
}

/// The wall time that so many steps take.
inline double secondsFor(PhysicsWorld& io_world, int steps) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < steps; ++i) io_world.step();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace mb::test
