// Rays with three outcomes, against fields whose answers are known. `field` chooses among them.
#include "sdf/primitives.glsl"
#include "lib/blocks.glsl"

int field = 0;
const int SPHERE = 0;      // the unit ball, 5 m ahead
const int FLOOR = 1;       // 1 m below the eye
const int GAP = 2;         // two unit balls, `gap` apart, 5 m ahead
const int WALL = 3;        // at wall_at, across the view
const int NOTHING = 4;
float gap = 0.0;
float wall_at = 0.0;

float map(vec3 p) {
    if (field == SPHERE) return sdSphere(p - vec3(0.0, 0.0, -5.0), 1.0);
    if (field == FLOOR) return sdPlane(p, vec3(0.0, 1.0, 0.0), -1.0);
    if (field == GAP) {
        float x = 1.0 + 0.5 * gap;
        return min(sdSphere(p - vec3(x, 0.0, -5.0), 1.0), sdSphere(p - vec3(-x, 0.0, -5.0), 1.0));
    }
    if (field == WALL) return sdPlane(p, vec3(0.0, 0.0, 1.0), -wall_at);
    return 1e9;
}

#define RELAXED
float enterScene(vec3 o, vec3 d) { return 0.0; }
vec3 mapAhead(vec3 p, vec3 d, out int leaf) {
    leaf = -1;
    return vec3(map(p), 0.0, 0.0);
}

#include "lib/outcome.glsl"
#include "lib/camera.glsl"
#include "lib/tolerance.glsl"
#include "lib/march.glsl"

const float FAR = 200.0;
const int BUDGET = 512;
Ray along(vec3 direction) { return Ray(vec3(0.0), normalize(direction), 0.0); }

void test_a_sphere_is_hit_where_it_is() {
    field = SPHERE;
    March march = marchRay(along(vec3(0.0, 0.0, -1.0)), FAR, BUDGET);
    CHECK(march.state == HIT);
    CHECK(near(march.t, 4.0));
    CHECK(march.side == 1.0);
    CHECK(march.evaluations < 16);
}

void test_a_sphere_is_hit_wherever_the_line_meets_it() {
    field = SPHERE;
    for (int i = 1; i < 20; ++i) {
        // The line passes the centre at b: it enters at 5 cos - sqrt(1 - b^2).
        float b = float(i) / 20.0;
        vec3 direction = vec3(b / 5.0, 0.0, -sqrt(1.0 - b * b / 25.0));
        March march = marchRay(along(direction), FAR, BUDGET);
        CHECK(march.state == HIT);
        CHECK(abs(march.t - (5.0 * -direction.z - sqrt(1.0 - b * b))) < 1e-4);
    }
}

void test_a_ray_beside_a_sphere_misses() {
    field = SPHERE;
    CHECK(marchRay(along(vec3(0.3, 0.0, -1.0)), FAR, BUDGET).state == MISS);
    CHECK(marchRay(along(vec3(0.0, 1.0, 0.0)), FAR, BUDGET).state == MISS);
    CHECK(marchRay(along(vec3(0.0, 0.0, 1.0)), FAR, BUDGET).state == MISS);
    March past = marchRay(along(vec3(1.1 / 5.0, 0.0, -1.0)), FAR, BUDGET);
    CHECK(past.state == MISS);
    CHECK(past.closest < 0.2);  // the closest it was asked at, not the closest it came
}

void test_a_ray_that_all_but_touches_is_never_a_wrong_answer() {
    field = SPHERE;
    for (int i = -20; i <= 20; ++i) {
        float b = 1.0 + 1e-5 * float(i);
        March march = marchRay(along(vec3(b / 5.0, 0.0, -sqrt(1.0 - b * b / 25.0))), FAR, BUDGET);
        if (i <= -2) CHECK(march.state != MISS);
        if (i >= 2) CHECK(march.state != HIT);
    }
}

void test_too_small_a_budget_leaves_a_ray_undecided() {
    field = SPHERE;
    March march = marchRay(along(vec3(0.0, 0.0, -1.0)), FAR, 1);
    CHECK(march.state == UNDECIDED);
    CHECK(march.evaluations == 1);
    CHECK(marchRay(along(vec3(0.0, 0.0, -1.0)), FAR, 0).state == UNDECIDED);
    field = FLOOR;
    CHECK(marchRay(along(vec3(1.0, -0.02, 0.0)), FAR, 4).state == UNDECIDED);
}

void test_a_floor_at_a_grazing_angle() {
    field = FLOOR;
    for (int i = 1; i <= 8; ++i) {
        float down = exp2(-float(i));
        vec3 direction = normalize(vec3(1.0, -down, 0.0));
        float t = -1.0 / direction.y;
        March march = marchRay(along(direction), FAR, BUDGET);
        CHECK(march.state == (t < FAR ? HIT : MISS));
        if (march.state == HIT) CHECK(abs(march.t - t) < 1e-4 * t);
    }
    CHECK(marchRay(along(vec3(1.0, 0.0, 0.0)), FAR, BUDGET).state == MISS);
    CHECK(marchRay(along(vec3(1.0, 0.01, 0.0)), FAR, BUDGET).state == MISS);
}

void test_an_eye_in_a_solid_sees_its_inside() {
    field = SPHERE;
    March march = marchRay(Ray(vec3(0.0, 0.0, -5.5), vec3(0.0, 0.0, 1.0), 0.0), FAR, BUDGET);
    CHECK(march.side == -1.0);
    CHECK(march.state == HIT);
    CHECK(abs(march.t - 1.5) < 1e-5);
    field = FLOOR;
    CHECK(marchRay(Ray(vec3(0.0, -3.0, 0.0), vec3(0.0, 1.0, 0.0), 0.0), FAR, BUDGET).t > 1.9);
}

void test_a_gap_between_two_spheres_lets_through() {
    field = GAP;
    gap = 0.1;
    CHECK(marchRay(along(vec3(0.0, 0.0, -1.0)), FAR, BUDGET).state == MISS);
    gap = 0.01;
    CHECK(marchRay(along(vec3(0.0, 0.0, -1.0)), FAR, BUDGET).state == MISS);
    gap = 1e-4;  // within what is close at 5 m: whatever is said, it is not that something was hit
    CHECK(marchRay(along(vec3(0.0, 0.0, -1.0)), FAR, BUDGET).state != HIT);
    gap = -0.01;
    CHECK(marchRay(along(vec3(0.0, 0.0, -1.0)), FAR, BUDGET).state == HIT);
}

void test_the_far_end_of_a_ray() {
    field = WALL;
    wall_at = 199.9;
    March march = marchRay(along(vec3(0.0, 0.0, -1.0)), FAR, BUDGET);
    CHECK(march.state == HIT);
    CHECK(near(march.t, 199.9));
    wall_at = 200.1;
    CHECK(marchRay(along(vec3(0.0, 0.0, -1.0)), FAR, BUDGET).state == MISS);
    field = NOTHING;
    march = marchRay(along(vec3(0.0, 0.0, -1.0)), FAR, BUDGET);
    CHECK(march.state == MISS);
    CHECK(march.evaluations == 1);
}

void test_a_ray_that_leaves_a_surface_does_not_meet_it_again() {
    field = SPHERE;
    for (int i = 0; i < 12; ++i) {
        float angle = 0.5 * float(i);
        vec3 normal = vec3(cos(angle), 0.0, sin(angle)), side = vec3(-sin(angle), 0.2, cos(angle));
        vec3 from = vec3(0.0, 0.0, -5.0) + normal * (1.0 + biasAt(5.0));
        CHECK(marchShadow(Ray(from, normalize(normal + side), 5.0), FAR, BUDGET).state == MISS);
        CHECK(marchShadow(Ray(from, normalize(side - normal), 5.0), FAR, BUDGET).state == HIT);
    }
}

void test_a_ray_that_only_touches_looks_like_the_surface() {
    March march = March(UNDECIDED, 10.0, 0.0, 1.0, 1, -1);
    march.closest = 0.5 * frame.forward.w * 10.0;
    CHECK(looksLikeSurface(march));
    march.closest = 2.0 * frame.forward.w * 10.0;
    CHECK(!looksLikeSurface(march));
}
