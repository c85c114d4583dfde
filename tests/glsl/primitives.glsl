// Values of the primitives that can be worked out by hand.
#include "sdf/primitives.glsl"

void test_sphere() {
    CHECK(near(sdSphere(vec3(0.0), 0.5), -0.5));
    CHECK(near(sdSphere(vec3(0.0, 3.0, 4.0), 1.0), 4.0));
}

void test_box() {
    vec3 size = vec3(2.0, 4.0, 6.0);
    CHECK(near(sdBox(vec3(0.0), size, 0.0), -1.0));
    CHECK(near(sdBox(vec3(2.0, 0.0, 0.0), size, 0.0), 1.0));
    CHECK(near(sdBox(vec3(4.0, 6.0, 0.0), size, 0.0), 5.0));       // 3 and 4 beyond an edge
    CHECK(near(sdBox(vec3(2.0, 4.0, 5.0), size, 0.0), 3.0));       // 1, 2 and 2 beyond a corner
    CHECK(near(sdBox(vec3(1.0, 2.0, 3.0), size, 0.5), 0.5 * (sqrt(3.0) - 1.0)));
    CHECK(near(sdBox(vec3(2.0, 0.0, 0.0), size, 0.5), 1.0));       // rounding leaves the faces where they are
    CHECK(near(sdBox(vec3(2.0, 0.0, 0.0), vec3(2.0), 9.0), 1.0));  // no rounder than a ball
}

void test_plane_is_solid_below_its_offset() {
    CHECK(near(sdPlane(vec3(7.0, 3.0, -2.0), vec3(0.0, 1.0, 0.0), 1.0), 2.0));
    CHECK(near(sdPlane(vec3(7.0, 0.0, -2.0), vec3(0.0, 1.0, 0.0), 1.0), -1.0));
}

void test_torus_lies_around_y() {
    CHECK(near(sdTorus(vec3(0.0), 2.0, 0.5), 1.5));
    CHECK(near(sdTorus(vec3(0.0, 0.0, 2.0), 2.0, 0.5), -0.5));
    CHECK(near(sdTorus(vec3(5.0, 4.0, 0.0), 2.0, 0.5), 4.5));
    CHECK(near(sdTorus(vec3(0.0, 2.0, 0.0), 2.0, 0.5), sqrt(8.0) - 0.5));
}

void test_cylinder() {
    CHECK(near(sdCylinder(vec3(0.0), 1.0, 6.0, 0.0), -1.0));
    CHECK(near(sdCylinder(vec3(0.0, 5.0, 0.0), 1.0, 6.0, 0.0), 2.0));
    CHECK(near(sdCylinder(vec3(0.0, 7.0, 4.0), 1.0, 6.0, 0.0), 5.0));
    CHECK(near(sdCylinder(vec3(0.0, 5.0, 0.0), 1.0, 6.0, 0.25), 2.0));
    CHECK(near(sdCylinder(vec3(1.0, 3.0, 0.0), 1.0, 6.0, 0.5), 0.5 * (sqrt(2.0) - 1.0)));
}

void test_capsule_is_as_high_as_its_centres_are_apart_and_two_radii() {
    CHECK(near(sdCapsule(vec3(0.0, 3.0, 0.0), 0.5, 4.0), 0.5));
    CHECK(near(sdCapsule(vec3(0.0, -3.0, 0.0), 0.5, 4.0), 0.5));
    CHECK(near(sdCapsule(vec3(0.0, 1.0, 2.0), 0.5, 4.0), 1.5));
    CHECK(near(sdCapsule(vec3(3.0, 6.0, 0.0), 0.5, 4.0), 4.5));
}

void test_cone_stands_on_its_base() {
    CHECK(near(sdCone(vec3(0.0, -2.0, 0.0), 1.0, 0.0, 2.0), 1.0));
    CHECK(near(sdCone(vec3(0.0, 2.0, 0.0), 1.0, 0.0, 2.0), 1.0));
    CHECK(near(sdCone(vec3(2.0, -1.0, 0.0), 1.0, 0.0, 2.0), 1.0));
    CHECK(near(sdCone(vec3(0.5, 0.0, 0.0), 1.0, 0.0, 2.0), 0.0));
    CHECK(near(sdCone(vec3(2.5, 0.0, 0.0), 1.0, 1.0, 2.0), 1.5));   // two equal radii are a cylinder
    CHECK(near(sdCone(vec3(0.0), 2.0, 2.0, 1.0), -0.5));
}

void test_ellipsoid_is_a_bound() {
    vec3 radii = vec3(1.0, 2.0, 4.0);
    CHECK(near(sdEllipsoid(vec3(0.0, 2.0, 0.0), radii), 0.0));
    CHECK(near(sdEllipsoid(vec3(3.0, 0.0, 0.0), radii), 2.0));
    CHECK(near(sdEllipsoid(vec3(0.0, 0.0, 8.0), radii), 1.0));      // 4 in truth
    CHECK(near(sdEllipsoid(vec3(0.0), radii), -1.0));
}

void test_octahedron() {
    CHECK(near(sdOctahedron(vec3(0.0), 3.0), -sqrt(3.0)));
    CHECK(near(sdOctahedron(vec3(0.0, -5.0, 0.0), 3.0), 2.0));
    CHECK(near(sdOctahedron(vec3(2.0, 2.0, 2.0), 3.0), sqrt(3.0)));
    CHECK(near(sdOctahedron(vec3(3.0, 3.0, 0.0), 3.0), 1.5 * sqrt(2.0)));
}

void test_prism_has_a_side_facing_x() {
    float apothem = 2.0 * cos(acos(-1.0) / 4.0);
    CHECK(near(sdPrism(vec3(5.0, 0.0, 0.0), 4.0, 2.0, 6.0, apothem), 5.0 - apothem));
    CHECK(near(sdPrism(vec3(0.0, 0.0, -5.0), 4.0, 2.0, 6.0, apothem), 5.0 - apothem));
    CHECK(near(sdPrism(vec3(0.0, 4.0, 0.0), 4.0, 2.0, 6.0, apothem), 1.0));
    CHECK(near(sdPrism(vec3(3.0, 0.0, 3.0), 4.0, 2.0, 6.0, apothem), sqrt(18.0) - 2.0));
    CHECK(near(sdPrism(vec3(0.0), 12.0, 2.0, 6.0, 2.0 * cos(acos(-1.0) / 12.0)), -2.0 * cos(acos(-1.0) / 12.0)));
    CHECK(near(sdPrism(vec3(-3.0, 0.0, 0.0), 3.0, 2.0, 6.0, 1.0), 1.0));
}
