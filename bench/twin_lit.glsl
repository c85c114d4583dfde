#version 330 core
#extension GL_ARB_gpu_shader5 : enable
// The scene of twin_lit.txt, written by hand: a floor, a ball and a turned box, in the diffuse light of one lamp, with hard
// shadows. This text never had a highlight, a lamp with a size, a pattern, a seam, an operator, a mirror or a second pass. It
// marches as marchbox does, through the same library, and reads the same numbers from the same places.

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
    vec4 diffuse;   // w: Kd
    vec4 unread[3];
};
struct Frame {
    vec4 right, up, forward, picture, reach, march, background;
    ivec4 limits;   // march steps, shadow steps; w: 1 to show undecided pixels
};
layout(std140) uniform FrameBlock { Frame frame; };
layout(std140) uniform LeafBlock { Node leaves[3]; };
layout(std140) uniform MaterialBlock { Material materials[16]; };
layout(std140) uniform LightBlock { vec4 lamp, lamp_color; };
int marchSteps() { return frame.limits.x; }

#include "lib/outcome.glsl"
#include "lib/ahead.glsl"
#include "lib/camera.glsl"
#include "lib/tolerance.glsl"

// The scene.
Node ground, ball, box;
void readScene() {
    ground = leaves[0];
    ball = leaves[1];
    box = leaves[2];
}
vec3 turned(vec3 d, Node node) { return vec3(dot(node.x_axis.xyz, d), dot(node.y_axis.xyz, d), dot(node.z_axis.xyz, d)); }

float groundAt(vec3 p) { return sdPlane(turned(p - ground.position.xyz, ground), ground.numbers.xyz, ground.numbers.w); }
float ballAt(vec3 p) { return sdSphere(p - ball.position.xyz, ball.numbers.x); }
float boxAt(vec3 p) { return sdBox(turned(p - box.position.xyz, box), box.numbers.xyz, box.numbers.w); }

float enterScene(vec3 o, vec3 d) { return 0.0; }
float map(vec3 p) { return min(min(groundAt(p), ballAt(p)), boxAt(p)); }

vec3 mapAhead(vec3 p, vec3 d, out int leaf) {
    leaf = -1;
    vec2 under = spanPlane(turned(p - ground.position.xyz, ground), turned(d, ground), ground.numbers.xyz, ground.numbers.w);
    vec2 span = spanEither(aheadOnly(under), aheadOnly(spanSphere(p - ball.position.xyz, d, ball.numbers.x)));
    vec2 boxed = spanBox(turned(p - box.position.xyz, box), turned(d, box), box.numbers.xyz, box.numbers.w);
    return vec3(map(p), min(spanEither(span, aheadOnly(boxed)).x, EMPTY), 1.0);
}

#include "lib/march.glsl"
#include "lib/normal.glsl"

// Whose surface it is. Of values that differ by no more than rounding the first counts.
Material materialAt(vec3 p, float tie) {
    int leaf = 0;
    float nearest = groundAt(p), other = ballAt(p);
    if (other < nearest - tie) leaf = 1;
    nearest = min(nearest, other);
    if (boxAt(p) < nearest - tie) leaf = 2;
    return materials[int(leaves[leaf].position.w)];
}

// The lamp's share of a surface's light, if nothing stands in its way.
float lampAt(vec3 p, vec3 normal, float travelled) {
    vec3 way = lamp.xyz - p;
    float far = length(way), facing = dot(normal, far > 0.0 ? way / far : normal);
    if (facing > 0.0) {
        vec3 from = p + normal * biasAt(travelled);
        way = lamp.xyz - from;
        far = length(way);
        if (far > 0.0) {
            March march = marchShadow(Ray(from, way / far, travelled), far, frame.limits.y);
            if (march.state == HIT || march.side < 0.0) facing = 0.0;
        }
    }
    return max(facing, 0.0);
}

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_undecided;

void main() {
    readScene();
    spare_steps = RETRY * marchSteps();
    Ray ray = cameraRay(gl_FragCoord.xy);
    March march = marchRay(ray, frame.reach.y, marchSteps());
    vec3 color = frame.background.rgb;
    if (march.state == HIT || (march.state == UNDECIDED && looksLikeSurface(march))) {
        vec3 p = ray.origin + ray.direction * march.t;
        float travelled = ray.travelled + march.t;
        vec3 normal = normalAt(p, travelled, march.side, ray.direction);
        Material material = materialAt(p, noiseAt(travelled));
        vec3 around = material.color.w * material.color.rgb;
        color = around + lamp_color.rgb * (material.diffuse.w * lampAt(p, normal, travelled) * material.color.rgb);
    }
    bool undecided = march.state == UNDECIDED || cut_short;
    if (undecided && frame.limits.w != 0) color = UNDECIDED_TINT;
    out_color = vec4(color, 1.0);
    gl_FragDepth = depthOf(march.state == HIT ? march.t : INFINITY);
    out_undecided = vec4(undecided ? 1.0 : 0.0);
}
