#version 330 core
#extension GL_ARB_gpu_shader5 : enable
// The scene of twin_mirror.txt, written by hand: a floor of fields, a mirror ball and a turned box, in the diffuse light and the
// highlights of one lamp. This text never had a shadow, a lamp with a size, a seam, an operator or a second pass. It marches
// as marchbox does, through the same library, and reads the same numbers from the same places.

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
    vec4 color2;    // w: Kd
    vec4 phong;     // Ks, Kr, C; w: 1 for fields
    vec4 unread[2];
};
struct Frame {
    vec4 right, up, forward, picture, reach, march, background;
    ivec4 limits;   // march steps; z: reflections; w: 1 to show undecided pixels
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

// What the surface is made of, its fields looked up. Of values that differ by no more than rounding the first is nearer.
const float FIELD_INSET = 1e-3;
Material materialAt(vec3 p, float tie) {
    int leaf = 0;
    vec3 at = turned(p - ground.position.xyz, ground);
    float nearest = groundAt(p), other = ballAt(p);
    if (other < nearest - tie) { leaf = 1; at = turned(p - ball.position.xyz, ball); }
    nearest = min(nearest, other);
    if (boxAt(p) < nearest - tie) { leaf = 2; at = turned(p - box.position.xyz, box); }

    Material material = materials[int(leaves[leaf].position.w)];
    vec3 field = floor(at - FIELD_INSET);
    if (material.phong.w != 0.0 && mod(field.x + field.y + field.z, 2.0) != 0.0) material.color.rgb = material.color2.rgb;
    return material;
}

// A surface's own light along a ray: ambient, and the lamp's, diffuse and mirrored.
vec3 shade(vec3 p, vec3 normal, vec3 direction, Material material) {
    vec3 color = material.color.w * material.color.rgb;
    vec3 way = lamp.xyz - p;
    float far = length(way);
    vec3 to_lamp = far > 0.0 ? way / far : normal;
    float facing = dot(normal, to_lamp);
    if (facing > 0.0) {
        float mirrored = dot(reflect(-to_lamp, normal), -direction);
        float highlight = mirrored > 0.0 ? material.phong.x * pow(mirrored, material.phong.z) : 0.0;
        color += lamp_color.rgb * (material.color2.w * facing * material.color.rgb + highlight);
    }
    return color;
}

// The mirrored ray, which starts on its own line a bias away from the surface.
Ray onward(Ray ray, vec3 p, vec3 normal, float travelled) {
    vec3 direction = normalize(reflect(ray.direction, normal));
    float bias = biasAt(travelled), rise = dot(direction, normal), along = bias / max(rise, 0.25);
    return Ray(p + direction * along + normal * (bias - along * rise), direction, travelled + along);
}

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_undecided;

void main() {
    readScene();
    spare_steps = RETRY * marchSteps();
    Ray ray = cameraRay(gl_FragCoord.xy);
    vec3 color = vec3(0.0);
    float weight = 1.0, depth = INFINITY;
    bool undecided = false;
    for (int bounce = 0; bounce <= frame.limits.z; ++bounce) {
        March march = marchRay(ray, frame.reach.y, marchSteps());
        if (bounce == 0) {
            undecided = march.state == UNDECIDED;
            depth = march.state == HIT ? march.t : INFINITY;
        }
        bool seen = march.state == HIT || (march.state == UNDECIDED && looksLikeSurface(march));
        if (seen) {
            vec3 p = ray.origin + ray.direction * march.t;
            float travelled = ray.travelled + march.t;
            vec3 normal = normalAt(p, travelled, march.side, ray.direction);
            Material material = materialAt(p, noiseAt(travelled));
            color += weight * shade(p, normal, ray.direction, material);
            weight *= material.phong.y;
            ray = onward(ray, p, normal, travelled);
        } else {
            color += weight * frame.background.rgb;
        }
        if (!seen || weight < 1.0 / 255.0) break;
    }
    undecided = undecided || cut_short;
    if (undecided && frame.limits.w != 0) color = UNDECIDED_TINT;
    out_color = vec4(color, 1.0);
    gl_FragDepth = depthOf(depth);
    out_undecided = vec4(undecided ? 1.0 : 0.0);
}
