#version 330 core
// What is shown of a picture: the sum of its passes divided by their weight, and what the scene's film makes of it.

#include "lib/blocks.glsl"
#effects files

uniform sampler2D picture;
layout(location = 0) out vec4 out_color;

void main() {
    vec4 sum = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
    vec3 c = sum.rgb / max(sum.w, 1e-6);
#effects film
    out_color = vec4(c, 1.0);
}
