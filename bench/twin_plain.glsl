#version 330 core
#extension GL_ARB_gpu_shader5 : enable
// The scene of twin_plain.txt, written by hand: a floor, a ball, and a turned box less a ball, in ambient light. This text never
// had a light, a shadow, a highlight, a pattern, a seam, a mirror or a second pass. It marches as marchbox does, through the
// same library, and reads the same numbers from the same places.

#include "sdf/dialect.glsl"
#include "sdf/domains.glsl"
#include "sdf/operators.glsl"
#include "sdf/primitives.glsl"

struct Node {
    vec4 position;  // w: the material
    vec4 numbers;
    vec4 x_axis, y_axis, z_axis;
};
struct Material {
    vec4 color;     // w: Ka
    vec4 unread[4];
};
struct Frame {
    vec4 right, up, forward, picture, reach, march, background;
    ivec4 limits;   // march steps; w: 1 to show undecided pixels
};
layout(std140) uniform FrameBlock { Frame frame; };
layout(std140) uniform LeafBlock { Node leaves[4]; };
layout(std140) uniform MaterialBlock { Material materials[16]; };
int marchSteps() { return frame.limits.x; }

#include "lib/outcome.glsl"
#include "lib/ahead.glsl"
#include "lib/camera.glsl"
#include "lib/tolerance.glsl"

// The scene.
Node ground, ball, box, cut;
void readScene() {
    ground = leaves[0];
    ball = leaves[1];
    box = leaves[2];
    cut = leaves[3];
}
vec3 turned(vec3 d, Node node) { return vec3(dot(node.x_axis.xyz, d), dot(node.y_axis.xyz, d), dot(node.z_axis.xyz, d)); }

float groundAt(vec3 p) { return sdPlane(turned(p - ground.position.xyz, ground), ground.numbers.xyz, ground.numbers.w); }
float ballAt(vec3 p) { return sdSphere(p - ball.position.xyz, ball.numbers.x); }
float boxAt(vec3 p) { return sdBox(turned(p - box.position.xyz, box), box.numbers.xyz, box.numbers.w); }
float cutAt(vec3 p) { return sdSphere(p - cut.position.xyz, cut.numbers.x); }

float enterScene(vec3 o, vec3 d) { return 0.0; }
float map(vec3 p) { return min(min(groundAt(p), ballAt(p)), max(boxAt(p), -cutAt(p))); }

vec3 mapAhead(vec3 p, vec3 d, out int leaf) {
    leaf = -1;
    vec2 under = spanPlane(turned(p - ground.position.xyz, ground), turned(d, ground), ground.numbers.xyz, ground.numbers.w);
    vec3 o = p - ball.position.xyz;
    Ahead a = anyAhead(onlyAhead(under, under), onlyAhead(spanSphere(o, d, ball.numbers.x), innerSphere(o, d, ball.numbers.x)));

    o = turned(p - box.position.xyz, box);
    vec3 along = turned(d, box);
    Ahead b = onlyAhead(spanBox(o, along, box.numbers.xyz, box.numbers.w), innerBox(o, along, box.numbers.xyz, box.numbers.w));
    o = p - cut.position.xyz;
    Ahead c = onlyAhead(spanSphere(o, d, cut.numbers.x), innerSphere(o, d, cut.numbers.x));
    Ahead carved = Ahead(spanSubtract(b.span, b.inner, c.span, c.inner), innerSubtract(b.span, b.inner, c.span, c.inner));
    return vec3(map(p), min(anyAhead(a, carved).span.x, EMPTY), 1.0);
}

#include "lib/march.glsl"
#include "lib/normal.glsl"

// Whose surface it is. Of values that differ by no more than rounding the first counts.
Material materialAt(vec3 p, float tie) {
    int leaf = 0;
    float nearest = groundAt(p), other = ballAt(p);
    if (other < nearest - tie) leaf = 1;
    nearest = min(nearest, other);
    float b = boxAt(p), c = cutAt(p);
    if (max(b, -c) < nearest - tie) leaf = -c - b > tie ? 3 : 2;
    return materials[int(leaves[leaf].position.w)];
}

// Whether an undecided ray came near a solid: lib/material.glsl says why and how.
const int PROBES = 8;
bool hasInside(Ray ray, March march, vec3 p) {
    float travelled = ray.travelled + march.t;
    vec3 normal = normalAt(p, travelled, march.side, ray.direction, march.state != HIT);
    float f = march.closest, depth = 0.0, rate = 1.0;
    for (int i = 0; i < 4 * PROBES; ++i) {
        if (march.state == HIT || f < 0.0) break;
        if (i % PROBES == 0) { f = march.closest; depth = 0.0; rate = 1.0; }
        float step = max(f / rate, 0.125 * noiseAt(travelled) * exp2(float(i % PROBES)));
        depth += step;
        float next = march.side * map(p + (i < 2 * PROBES ? normal : ray.direction) * ((i / PROBES) % 2 == 0 ? -depth : depth));
        rate = (f - next) / step;
        if (rate < 0.0625) rate = 1.0;
        f = next;
    }
    return march.state == HIT || f < 0.0;
}

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_undecided;

void main() {
    readScene();
    spare_steps = RETRY * marchSteps();
    Ray ray = cameraRay(gl_FragCoord.xy);
    March march = marchRay(ray, frame.reach.y, marchSteps());
    vec3 p = ray.origin + ray.direction * march.t;
    vec3 color = frame.background.rgb;
    if (march.state == HIT || (march.state == UNDECIDED && looksLikeSurface(march))) {
        if (hasInside(ray, march, p)) {
            Material material = materialAt(p, noiseAt(ray.travelled + march.t));
            color = material.color.w * material.color.rgb;
        }
    }
    bool undecided = march.state == UNDECIDED || cut_short;
    if (undecided && frame.limits.w != 0) color = UNDECIDED_TINT;
    out_color = vec4(color, 1.0);
    gl_FragDepth = depthOf(march.state == HIT ? march.t : INFINITY);
    out_undecided = vec4(undecided ? 1.0 : 0.0);
}
