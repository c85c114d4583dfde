#version 330 core
// Shows a linear picture on a screen: divides by the weight it was summed with, and encodes sRGB (IEC 61966-2-1, 1999).

uniform sampler2D picture;
uniform vec2 corner, size;  // of the viewport, in pixels
layout(location = 0) out vec4 out_color;

vec3 encoded(vec3 c) {
    c = clamp(c, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(max(c, 1e-6), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

void main() {
    vec2 at = (gl_FragCoord.xy - corner) / size;
    vec4 sum = texture(picture, at);
    out_color = vec4(encoded(sum.rgb / max(sum.w, 1e-6)), 1.0);
}
