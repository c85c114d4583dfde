// The operators on plain numbers, and the dialect they are written in.
#include "sdf/operators.glsl"

void test_pick_and_square() {
    CHECK(pick(-1.0, 2.0, 3.0) == 2.0);
    CHECK(pick(0.0, 2.0, 3.0) == 3.0);
    CHECK(pick(-0.0, 2.0, 3.0) == 3.0);
    CHECK(square(-3.0) == 9.0);
}

void test_without_a_blend_they_are_the_plain_ones() {
    CHECK(opUnion(0.3, -0.2, 0.0) == -0.2);
    CHECK(opIntersect(0.3, -0.2, 0.0) == 0.3);
    CHECK(opSubtract(0.3, -0.2, 0.0) == 0.3);
    CHECK(opSubtract(-0.3, -0.2, 0.0) == 0.2);
    CHECK(opSubtract(-0.3, 0.2, 0.0) == -0.2);
}

void test_a_blend_is_a_quarter_in_the_middle_of_the_seam() {
    CHECK(near(opUnion(0.5, 0.5, 0.4), 0.4));
    CHECK(near(opIntersect(0.5, 0.5, 0.4), 0.6));
    CHECK(near(opSubtract(0.5, -0.5, 0.4), 0.6));
}

void test_a_blend_ends_where_the_values_are_that_far_apart() {
    CHECK(opUnion(0.5, 1.0, 0.5) == 0.5);
    CHECK(opUnion(0.5, 0.75, 0.5) < 0.5);
    CHECK(opIntersect(0.5, 1.0, 0.5) == 1.0);
    CHECK(opSubtract(0.5, 1.0, 0.5) == 0.5);
}

void test_a_blend_as_small_as_a_float_can_hold_is_none() {
    CHECK(opUnion(0.25, 0.25, 1e-37) == 0.25);
    CHECK(opUnion(0.25, 0.25, -1.0) == 0.25);
}
