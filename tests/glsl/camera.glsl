// The ray of a pixel, in a picture of 64 x 48 seen along -z with a vertical angle of 90 degrees.
#include "lib/blocks.glsl"
#include "lib/camera.glsl"

void test_the_middle_of_the_picture_looks_ahead() {
    Ray ray = cameraRay(vec2(32.0, 24.0));
    CHECK(near(ray.direction, vec3(0.0, 0.0, -1.0)));
    CHECK(near(ray.origin, vec3(0.0)));
    CHECK(ray.travelled == 0.0);
}

void test_half_the_angle_is_at_the_edge() {
    CHECK(near(cameraRay(vec2(32.0, 48.0)).direction, normalize(vec3(0.0, 1.0, -1.0))));
    CHECK(near(cameraRay(vec2(32.0, 0.0)).direction, normalize(vec3(0.0, -1.0, -1.0))));
    CHECK(near(cameraRay(vec2(64.0, 24.0)).direction, normalize(vec3(64.0 / 48.0, 0.0, -1.0))));
}

void test_a_pixel_that_is_half_a_pixel_from_the_middle() {
    CHECK(near(cameraRay(vec2(32.5, 24.5)).direction, normalize(vec3(1.0 / 48.0, 1.0 / 48.0, -1.0))));
}

void test_directions_are_of_unit_length() {
    for (int i = 0; i < 64; ++i) CHECK(near(length(cameraRay(vec2(float(i) + 0.5, 0.75 * float(i))).direction), 1.0));
}

void test_a_pixel_covers_a_share_of_the_distance() {
    CHECK(near(frame.forward.w, 2.0 / 48.0));
}

void test_depth_goes_from_the_eye_to_the_furthest_seen() {
    CHECK(depthOf(0.0) == 0.0);
    CHECK(near(depthOf(frame.reach.y / 4.0), 0.25));
    CHECK(depthOf(uintBitsToFloat(0x7F800000u)) == 1.0);
}
