#version 330 core
#extension GL_ARB_gpu_shader5 : enable
// The scene's own functions at points read from a texture: what `marchbox eval --on gpu` and the tests ask.

#include "sdf/dialect.glsl"
#include "sdf/domains.glsl"
#include "sdf/operators.glsl"
#include "sdf/primitives.glsl"
#include "lib/blocks.glsl"
#include "lib/outcome.glsl"
#include "lib/found.glsl"
#include "scene.glsl"
#include "lib/tolerance.glsl"
#include "lib/normal.glsl"

uniform sampler2D points;
layout(location = 0) out vec4 out_value;  // distance, gradient
layout(location = 1) out vec4 out_leaf;   // the leaf's number, its object's; -1 for none

void main() {
    readScene();
    vec3 p = texelFetch(points, ivec2(gl_FragCoord.xy), 0).xyz;
    out_value = vec4(map(p), gradientAt(p, normalReach(length(p))));
    Nearest found = nearest(p);
    out_leaf = vec4(float(found.leaf), found.leaf < 0 ? -1.0 : leafRecord(found.leaf).x_axis.w, found.distance, 0.0);
}
