// Normals, the checkerboard, and what is kept of a pixel.
#include "sdf/primitives.glsl"
#include "lib/blocks.glsl"

#include "lib/outcome.glsl"
#include "lib/found.glsl"

int field = 0;
float map(vec3 p) { return field == 0 ? sdSphere(p, 2.0) : field == 1 ? sdBox(p, vec3(2.0), 0.0) : 1e9; }
Nearest nearest(vec3 p) { return foundLeaf(map(p), 0, p); }
float enterScene(vec3 o, vec3 d) { return 0.0; }
vec3 mapAhead(vec3 p, vec3 d, out int leaf) {
    leaf = -1;
    return vec3(map(p), 0.0, 0.0);
}

#include "lib/camera.glsl"
#include "lib/tolerance.glsl"
#include "lib/march.glsl"
#include "lib/normal.glsl"
#include "lib/material.glsl"

void test_a_normal_of_a_sphere_points_from_its_centre() {
    for (int i = 0; i < 20; ++i) {
        float a = 0.37 * float(i), b = 0.21 * float(i);
        vec3 out_of = vec3(cos(a) * cos(b), sin(b), sin(a) * cos(b));
        vec3 normal = normalAt(2.0 * out_of, 10.0, 1.0, -out_of);
        CHECK(near(length(normal), 1.0));
        CHECK(distance(normal, out_of) < 1e-3);
    }
}

void test_a_normal_is_never_turned_away_from_the_ray() {
    for (int i = 0; i < 20; ++i) {
        float a = 0.37 * float(i);
        vec3 out_of = vec3(cos(a), sin(a), 0.0), ray = normalize(vec3(0.3, 1.0, -0.2));
        vec3 normal = normalAt(2.0 * out_of, 10.0, 1.0, ray);
        CHECK(near(length(normal), 1.0));
        CHECK(dot(normal, ray) < 1e-6);
        if (dot(out_of, ray) < 0.0) CHECK(distance(normal, out_of) < 1e-3);
    }
}

void test_a_normal_seen_from_inside_points_inwards() {
    vec3 normal = normalAt(vec3(0.0, 2.0, 0.0), 2.0, -1.0, vec3(0.0, 1.0, 0.0));
    CHECK(distance(normal, vec3(0.0, -1.0, 0.0)) < 1e-3);
}

void test_a_normal_on_a_flat_face_is_exact() {
    field = 1;
    CHECK(near(normalAt(vec3(0.2, 1.0, -0.3), 10.0, 1.0, vec3(0.0, -1.0, 0.0)), vec3(0.0, 1.0, 0.0)));
}

void test_without_a_slope_a_normal_faces_the_ray() {
    field = 2;
    vec3 normal = normalAt(vec3(0.0), 10.0, 1.0, vec3(0.6, 0.0, -0.8));
    CHECK(near(normal, vec3(-0.6, 0.0, 0.8)));
    field = 0;  // at its centre a ball has none either
    CHECK(near(length(normalAt(vec3(0.0), 10.0, 1.0, vec3(0.0, 0.0, -1.0))), 1.0));
}

void test_the_reach_of_a_difference_is_a_power_of_two_above_the_noise() {
    for (int i = 0; i < 20; ++i) {
        float t = 0.013 * exp2(float(i)), h = normalReach(t);
        CHECK(h == exp2(round(log2(h))));
        CHECK(h >= 32.0 * noiseAt(t));
        CHECK(h <= max(frame.reach.z * t, 64.0 * noiseAt(t)));
    }
}

void test_a_normal_costs_six_evaluations() {
    int before = counts[NORMAL].x;
    normalAt(vec3(2.0, 0.0, 0.0), 10.0, 1.0, vec3(-1.0, 0.0, 0.0));
    CHECK(counts[NORMAL].x - before == 6);
}

void test_the_checkerboard_alternates_along_every_axis() {
    CHECK(!isDarkField(vec3(0.5)));
    CHECK(isDarkField(vec3(1.5, 0.5, 0.5)));
    CHECK(isDarkField(vec3(0.5, 1.5, 0.5)));
    CHECK(isDarkField(vec3(0.5, 0.5, -0.5)));
    CHECK(!isDarkField(vec3(1.5, -0.5, 0.5)));
    CHECK(!isDarkField(vec3(-0.5, -0.5, 0.5)));
    CHECK(isDarkField(vec3(-0.5, -0.5, -0.5)));
}

void test_a_floor_on_a_border_of_two_fields_is_of_one() {
    for (int i = 0; i < 9; ++i) {
        vec3 p = vec3(0.5, 1e-6 * float(i - 4), 0.5);
        CHECK(isDarkField(p));
    }
}

void test_a_pixel_is_a_miss_until_something_is_kept() {
    CHECK(outcome.state == MISS);
    CHECK(isinf(outcome.depth));
    CHECK(outcome.object == -1.0);
    keepPrimary(March(UNDECIDED, 3.0, 0.1, 1.0, 7, -1), vec3(0.0, 1.0, 0.0), 2.0);
    CHECK(outcome.state == UNDECIDED);
    CHECK(outcome.steps == 7.0);
    CHECK(isinf(outcome.depth));  // what was not hit has no depth, even if it is painted as a surface
    keepPrimary(March(HIT, 3.0, 0.0, 1.0, 9, -1), vec3(0.0, 1.0, 0.0), 2.0);
    CHECK(outcome.depth == 3.0);
    CHECK(outcome.object == 2.0);
    CHECK(outcome.normal.y == 1.0);
}

void test_evaluations_are_counted_for_what_asked() {
    countMarch(0, March(HIT, 1.0, 0.0, 1.0, 5, -1));
    CHECK(counts[PRIMARY] == ivec4(5, 0, 1, 0));
    CHECK(counts[REFLECTION].z == 0);
    countMarch(1, March(UNDECIDED, 1.0, 0.0, 1.0, 3, -1));
    CHECK(counts[REFLECTION] == ivec4(3, 0, 1, 1));
}

void test_primitives_touched_are_counted_once() {
    ivec4 before = counts[SHADOW];
    touch(7);
    count(SHADOW, 1);
    count(SHADOW, 1);
    CHECK(counts[SHADOW] == before + ivec4(2, 7, 0, 0));
}
