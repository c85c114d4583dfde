// How close is close: the order of the tolerances, at any distance.
#include "lib/blocks.glsl"
#include "lib/tolerance.glsl"

void test_a_bias_is_more_than_close_is_more_than_noise() {
    float t = 0.0;
    for (int i = 0; i < 40; ++i) {
        CHECK(noiseAt(t) > 0.0);
        CHECK(closeAt(t) > 2.0 * noiseAt(t));
        CHECK(biasAt(t) > 1.5 * closeAt(t));
        t = t * 2.0 + 1e-6;
    }
}

void test_they_grow_with_the_distance() {
    CHECK(near(closeAt(100.0), 100.0 * frame.reach.x));
    CHECK(noiseAt(100.0) > 50.0 * noiseAt(1.0));
}

void test_noise_is_above_the_grid_of_floats() {
    // A float of about 100 has steps of 2^-17.
    CHECK(noiseAt(100.0) > 2.0 * exp2(-17.0));
    CHECK(100.0 + noiseAt(100.0) > 100.0);
}
