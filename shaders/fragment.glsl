#version 330 core
#extension GL_ARB_gpu_shader5 : enable
// One pixel of the picture: send a ray, march it, shade what it meets, follow its reflection.
//
// The program writes above this text what the scene calls for (EFFECT_… definitions and array sizes), in place of "scene.glsl"
// the scene's own map() and nearest(), and where "#effects" stands what the effects called for do there. All positions are
// relative to the eye, so that a scene far from the world's origin loses nothing; lengths are metres.

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
#include "lib/spread.glsl"
#effects files
#include "lib/phong.glsl"

layout(location = 0) out vec4 out_color;
#ifdef COUNTED
layout(location = 1) out vec4 out_surface;      // normal, depth
layout(location = 2) out vec4 out_ray;          // object, steps, state; uses of the counted row
layout(location = 3) out vec4 out_primary;      // evaluations, primitives touched
layout(location = 4) out vec4 out_shadow;       // evaluations, primitives touched, rays, undecided ones
layout(location = 5) out vec4 out_reflection;
layout(location = 6) out vec4 out_soft;
layout(location = 7) out vec4 out_occlusion;
#else
layout(location = 1) out vec4 out_undecided;    // 1 for a pixel whose own ray is
#endif

// One stretch of the ray: adds what it brings to the color, and says whether another one follows it, from mirror to mirror.
bool follow(int bounce, inout Ray ray, inout vec3 color, inout float weight) {
    March march = marchRay(ray, frame.reach.y, marchSteps());
    countMarch(bounce, march);
    bool seen = march.state == HIT || (march.state == UNDECIDED && looksLikeSurface(march)), goes_on = false;
    Surface surface;
    if (seen) {
        surface = surfaceAt(ray, march);
        seen = hasInside(surface, march, ray.direction);
        if (seen) {
            if (bounce == 0) keepPrimary(march, surface.normal, surface.object);
#effects air
            color += weight * phong(surface, ray.direction);
#effects onward
        }
    }
    if (!seen) {
        if (bounce == 0) keepPrimary(march, vec3(0.0), -1.0);
        color += weight * background();
    }
    return goes_on;
}

void main() {
    readScene();
    spare_steps = RETRY * marchSteps();
    Ray ray = cameraRay(gl_FragCoord.xy);
    vec3 color = vec3(0.0);
    float weight = 1.0;
#ifdef EFFECT_REFLECTION
    for (int bounce = 0; bounce <= reflections(); ++bounce)
        if (!follow(bounce, ray, color, weight)) break;
#else
    follow(0, ray, color, weight);  // no loop of one turn: software OpenGL keeps it, at a quarter of the time
#endif

    if (cut_short) outcome.state = UNDECIDED;
    if (outcome.state == UNDECIDED && showsUndecided()) color = isFirstPass() ? UNDECIDED_TINT : vec3(0.0);
    out_color = vec4(color, frame.background.w);
    gl_FragDepth = depthOf(outcome.depth);
#ifdef COUNTED
    out_surface = vec4(outcome.normal, outcome.depth);
    out_ray = vec4(outcome.object, outcome.steps, float(outcome.state), float(row_uses));
    out_primary = vec4(counts[PRIMARY].xy, counts[NORMAL].xy);
    out_shadow = vec4(counts[SHADOW]);
    out_reflection = vec4(counts[REFLECTION]);
    out_soft = vec4(counts[SOFT]);
    out_occlusion = vec4(counts[OCCLUSION]);
#else
    out_undecided = vec4(outcome.state == UNDECIDED ? 1.0 : 0.0);
#endif
}
