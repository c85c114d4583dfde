#version 330 core
#extension GL_ARB_gpu_shader5 : enable
// One pixel of the picture: send a ray, march it, shade what it meets, follow its reflection.
//
// The program writes above this text what the scene calls for (EFFECT_… definitions and array sizes), and in place of
// "scene.glsl" the scene's own map() and nearest(). All positions are relative to the eye, so that a scene far from the
// world's origin loses nothing; lengths are metres.

#include "sdf/dialect.glsl"
#include "sdf/domains.glsl"
#include "sdf/operators.glsl"
#include "sdf/primitives.glsl"
#include "lib/blocks.glsl"
#include "lib/outcome.glsl"
#include "lib/found.glsl"
#include "scene.glsl"
#include "lib/camera.glsl"
#include "lib/tolerance.glsl"
#include "lib/march.glsl"
#include "lib/normal.glsl"
#include "lib/material.glsl"
#include "lib/shadow.glsl"
#include "lib/phong.glsl"

layout(location = 0) out vec4 out_color;
#ifdef COUNTED
layout(location = 1) out vec4 out_surface;      // normal, depth
layout(location = 2) out vec4 out_ray;          // object, steps, state
layout(location = 3) out vec4 out_evaluations;  // primary, normal, shadow, reflection
layout(location = 4) out vec4 out_rays;         // shadow, reflection; undecided ones of each
layout(location = 5) out vec4 out_touched;      // primitives, in turn as evaluations
#else
layout(location = 1) out vec4 out_undecided;    // 1 for a pixel whose own ray is
#endif

void main() {
    readScene();
    spare_steps = RETRY * marchSteps();
    Ray ray = cameraRay(gl_FragCoord.xy);
    vec3 color = vec3(0.0);
    float weight = 1.0;
    for (int bounce = 0; bounce <= reflections(); ++bounce) {
        March march = marchRay(ray, frame.reach.y, marchSteps());
        countMarch(bounce, march);
        bool seen = march.state == HIT || (march.state == UNDECIDED && looksLikeSurface(march));
        Surface surface;
        if (seen) {
            surface = surfaceAt(ray, march);
            seen = hasInside(surface, march, ray.direction);
        }
        if (!seen) {
            if (bounce == 0) keepPrimary(march, vec3(0.0), -1.0);
            color += weight * background();
            break;
        }

        if (bounce == 0) keepPrimary(march, surface.normal, surface.object);
        color += weight * phong(surface, ray.direction);
        weight *= surface.reflectance;
        if (weight < LEAST_WEIGHT) break;
        ray = reflectRay(ray, surface);
    }

    if (cut_short) outcome.state = UNDECIDED;
    if (outcome.state == UNDECIDED && showsUndecided()) color = frame.pass.z != 0 ? UNDECIDED_TINT : vec3(0.0);
    out_color = vec4(color, frame.background.w);
    gl_FragDepth = depthOf(outcome.depth);
#ifdef COUNTED
    out_surface = vec4(outcome.normal, outcome.depth);
    out_ray = vec4(outcome.object, outcome.steps, float(outcome.state), 0.0);
    out_evaluations = vec4(outcome.evaluations);
    out_rays = vec4(outcome.rays);
    out_touched = vec4(outcome.touched);
#else
    out_undecided = vec4(outcome.state == UNDECIDED ? 1.0 : 0.0);
#endif
}
