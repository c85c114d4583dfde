// A ray against the field, held to closed forms; and the ray of a pixel, held to the formula the command line states.
#include "core/scene/camera.h"
#include "core/sdf/raycast.h"
#include "scenes.h"
#include "sdf/draw.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <random>

using namespace mb;

namespace {

Object shape(const char* type, std::initializer_list<double> numbers) {
    Object o;
    o.type = findShapeType(type), o.numbers = initialNumbers(*o.type);
    std::copy(numbers.begin(), numbers.end(), o.numbers.begin());
    return o;
}
Scene sceneOf(std::vector<Object> objects) {
    Scene scene;
    for (Object& o : objects) o.id = scene.newId(), scene.objects.push_back(std::move(o));
    return scene;
}

}  // namespace

TEST_CASE("random rays against a ball end where the quadratic says") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> real(-1, 1);
    Object ball = shape("sphere", {0.8});
    ball.pos = {0.3, -0.2, 0.5};
    const Tree tree = makeTree(sceneOf({ball}));
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 origin = 4.0 * glm::normalize(glm::dvec3{real(random), real(random), real(random)});
        const glm::dvec3 direction = glm::normalize(1.2 * glm::dvec3{real(random), real(random), real(random)} - origin);
        const glm::dvec3 oc = origin - ball.pos;
        const double b = glm::dot(oc, direction), disc = b * b - glm::dot(oc, oc) + 0.64;
        if (std::fabs(disc) < 1e-6) continue;  // too near a touch to say
        const RayEnd end = raycast(tree, origin, direction, 100);
        REQUIRE(end.state == (disc > 0 ? RayState::hit : RayState::miss));
        if (disc <= 0) continue;
        ++hits;
        CHECK(end.t == doctest::Approx(-b - std::sqrt(disc)).epsilon(1e-9));
        CHECK(end.leaf == 0);
    }
    CHECK(hits > 300);
}

TEST_CASE("a plane is met at h / sin a, however flat the ray") {
    const Tree tree = makeTree(sceneOf({shape("plane", {0, 1, 0, 0})}));
    for (const double degrees : {90.0, 45.0, 10.0, 5.0, 2.0, 1.0}) {
        const double a = degrees * std::acos(-1.0) / 180;
        const RayEnd end = raycast(tree, {0, 1, 0}, {std::cos(a), -std::sin(a), 0}, 1000);
        REQUIRE(end.state == RayState::hit);
        CHECK(end.t == doctest::Approx(1 / std::sin(a)).epsilon(1e-9));
    }
    CHECK(raycast(tree, {0, 1, 0}, {1, 0.1, 0}, 1000).state == RayState::miss);
    CHECK(raycast(tree, {0, 1, 0}, {0, -1, 0}, 0.999).state == RayState::miss);
    CHECK(raycast(tree, {0, 1, 0}, {0, -1, 0}, 1.001).state == RayState::hit);
}

TEST_CASE("the leaf and the object that are hit are named") {
    Object cut = shape("subtract", {0}), box = shape("box", {1, 1, 1, 0}), hole = shape("sphere", {0.3});
    hole.pos = {0, 0.5, 0};
    Scene scene = sceneOf({shape("plane", {0, 1, 0, -2}), cut, box, hole});
    scene.objects[2].parent = scene.objects[3].parent = 1;
    const Tree tree = makeTree(scene);
    const RayEnd in_hole = raycast(tree, {0, 3, 0}, {0, -1, 0}, 100);
    CHECK(in_hole.t == doctest::Approx(2.8));
    CHECK(in_hole.index == 3);
    const RayEnd on_box = raycast(tree, {0.45, 3, 0}, {0, -1, 0}, 100);
    CHECK(on_box.t == doctest::Approx(2.5));
    CHECK(on_box.index == 2);
    CHECK(tree.leaves[static_cast<std::size_t>(on_box.leaf)].object == 1);
    CHECK(raycast(tree, {3, 3, 0}, {0, -1, 0}, 100).index == 0);
}

TEST_CASE("a ray that starts in a solid meets its inside") {
    const Tree tree = makeTree(sceneOf({shape("sphere", {2})}));
    const RayEnd end = raycast(tree, {0, 0, 0}, {0, 0, 1}, 100);
    CHECK(end.state == RayState::hit);
    CHECK(end.t == doctest::Approx(2));
}

TEST_CASE("what cannot be decided is said, and ends") {
    const Tree tree = makeTree(sceneOf({shape("sphere", {1})}));
    CHECK(raycast(tree, {0, 1, -5}, {0, 0, 1}, 100).state == RayState::undecided);  // touches
    const double nan = std::nan("");
    CHECK(raycast(tree, {0, 0, -5}, {0, 0, 0}, 100).state == RayState::undecided);
    CHECK(raycast(tree, {nan, 0, -5}, {0, 0, 1}, 100).state == RayState::undecided);
    CHECK(raycast(tree, {0, 0, -5}, {0, 0, INFINITY}, 100).state == RayState::undecided);
    CHECK(raycast(tree, {0, 0, -5}, {0, 0, 1}, nan).state == RayState::undecided);
    CHECK(raycast(Tree{}, {0, 0, -5}, {0, 0, 1}, 100).state == RayState::miss);
}

TEST_CASE("the ray of a pixel is the command line's formula") {
    Camera camera;
    camera.eye = {3, 2.5, 5}, camera.target = {0, 0.7, 0}, camera.fov = 45;
    const glm::ivec2 size{640, 360};
    const glm::dvec3 f = glm::normalize(camera.target - camera.eye), r = glm::normalize(glm::cross(f, glm::dvec3{0, 1, 0})), up = glm::cross(r, f);
    for (const glm::ivec2 at : {glm::ivec2{0, 0}, glm::ivec2{639, 359}, glm::ivec2{17, 301}}) {
        const double u = ((at.x + 0.5) / 640 * 2 - 1) * 640 / 360 * std::tan(22.5 * std::acos(-1.0) / 180);
        const double v = (1 - (at.y + 0.5) / 360 * 2) * std::tan(22.5 * std::acos(-1.0) / 180);
        camera.ortho = 0;
        const Ray ray = cameraRay(camera, size, glm::dvec2(at) + 0.5);
        CHECK(glm::length(ray.direction - glm::normalize(f + u * r + v * up)) < 1e-14);
        CHECK(ray.origin == camera.eye);
        camera.ortho = 4;
        const Ray flat = cameraRay(camera, size, glm::dvec2(at) + 0.5);
        const glm::dvec3 origin = camera.eye + r * ((at.x + 0.5) / 640 - 0.5) * 4.0 * 640.0 / 360.0 + up * (0.5 - (at.y + 0.5) / 360) * 4.0;
        CHECK(glm::length(flat.origin - origin) < 1e-13);
        CHECK(glm::length(flat.direction - f) < 1e-14);
    }
    camera.eye = camera.target;
    CHECK(glm::length(cameraRay(camera, size, {1, 1}).direction) == doctest::Approx(1));
}

TEST_CASE("a place is seen at the point of the picture whose ray goes through it, and nowhere behind the eye") {
    for (const double ortho : {0.0, 3.0}) {
        const Camera camera{.name = "", .eye = {3, 2, 5}, .target = {0, 0.5, -1}, .fov = 50, .ortho = ortho};
        const glm::ivec2 size{640, 360};
        for (const glm::dvec2 point : {glm::dvec2{0, 0}, glm::dvec2{320, 180}, glm::dvec2{12.5, 300.25}, glm::dvec2{900, -40}}) {
            const Ray ray = cameraRay(camera, size, point);
            const auto back = pictureOf(camera, size, ray.origin + 7.0 * ray.direction);
            REQUIRE(back);
            CHECK(glm::length(*back - point) <= 1e-9);
        }
        CHECK_FALSE(pictureOf(camera, size, camera.eye + (camera.eye - camera.target)));
        CHECK_FALSE(pictureOf(camera, size, camera.eye));
    }
}

TEST_CASE("through a grid a ray finds what it finds among all, whatever is near") {
    Draw draw(61);
    Scene many;
    addObject(many, "plane", {0, 1, 0, -4});
    for (int i = 0; i < 1000; ++i)
        addObject(many, i % 2 == 0 ? "sphere" : "box", {0.05, 0.1, 0.07, 0}, {draw.uniform(-3, 3), draw.uniform(-3, 3), draw.uniform(-3, 3)});
    for (int i = 0; i < 300; ++i) {
        const int bitten = addObject(many, "subtract", {}, {draw.uniform(-3, 3), draw.uniform(-3, 3), draw.uniform(-3, 3)});
        addObject(many, "box", {0.2, 0.2, 0.2}, {}, bitten), addObject(many, "sphere", {0.1}, {0.05, 0.05, 0.1}, bitten);
    }
    const Tree tree = makeTree(many);
    Grid grid;
    grid.follow(tree);
    CHECK(grid.follows(tree));
    int hits = 0, misses = 0;
    for (int i = 0; i < times(150); ++i) {
        const glm::dvec3 from{draw.uniform(-5, 5), draw.uniform(-3, 5), draw.oneIn(4) ? 0 : 5}, way{draw.uniform(-0.4, 0.4), draw.oneIn(3) ? 0 : draw.uniform(-0.4, 0.4), -1};
        const RayEnd some = raycast(grid, from, way, 20), all = raycast(tree, from, way, 20);
        CHECK(some.state == all.state);
        misses += some.state == RayState::miss;
        if (some.state != RayState::hit) continue;
        ++hits;
        CHECK(std::fabs(some.t - all.t) < 1e-9);
        CHECK(some.index == all.index);
    }
    CHECK(hits > 10);
    CHECK(misses > 10);

    // A moved object is another tree.
    many.objects[7].pos.x += 0.1;
    CHECK_FALSE(grid.follows(makeTree(many)));
    grid.follow(makeTree(many));
    CHECK(grid.follows(makeTree(many)));
}
