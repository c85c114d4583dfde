#version 330 core
// The fragment shader that marchbox began from, as its own text gives it ("OpenGL Real-Time Raymarching Coursework", 2024):
// every object at every step, in a loop over a uniform block. The names of its functions and its numbers are kept. Where
// the text shows no number (rayMarch is a diagram there), that of isInShadow, which it says is alike, stands here.
//
// Left out, because the benchmark's scenes have none: the floor and its checkers, rotations of objects. The camera is the
// benchmark's, so that both see the same. Added: what became of the pixel, in out_info.
//
// Software OpenGL ends a shader at 65,535 loop iterations in all, without a word. Then some loop ended before its time, and
// out_info says so: finish() is asked after every loop.

struct Object {
    vec4 centre;  // w: 0 for a sphere, 1 for a box
    vec4 size;    // the radius, or the halves; w: the material
};
struct Material {
    vec4 color;   // w: Ka
    vec4 phong;   // Kd, Ks, Kr, C
};
layout(std140) uniform Objects { Object objects[OBJECTS]; };
layout(std140) uniform Materials { Material materials[MATERIALS]; };
uniform int objectsL, lightsL;
uniform vec3 lights[1], lightCols[1];
uniform vec2 res;
uniform vec3 eye, right, up, forward;  // right and up: half the picture, as in lib/blocks.glsl
uniform bool parallel;
uniform float maxDist;

layout(location = 0) out vec4 fragColor;
layout(location = 1) out vec4 out_info;  // depth, or -1 for a miss; 1 if every loop ran to its end; loop iterations; the object

bool whole = true;
int iterations = 0;
void finish(bool in_time) { whole = whole && in_time; }

struct SDF {
    float dist;
    int material;
    int object;
};

float sphereSDF(vec3 p, vec3 c, float r) { return length(c - p) - r; }
float boxSDF(vec3 p, vec3 b) {
    vec3 q = abs(p) - b;
    return length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);
}
vec3 translateSDF(vec3 p, vec3 t) { return p - t; }
SDF unionSDF(SDF a, SDF b) {
    if (a.dist < b.dist) return a;
    return b;
}

SDF finalSDF(vec3 p) {
    SDF result = SDF(1e9, -1, -1);
    int i = 0;
    for (; i < objectsL; i++) {
        Object object = objects[i];
        float dist = 1e9;
        switch (int(object.centre.w)) {
        case 0: dist = sphereSDF(p, object.centre.xyz, object.size.x); break;
        case 1: dist = boxSDF(translateSDF(p, object.centre.xyz), object.size.xyz); break;
        }
        result = unionSDF(result, SDF(dist, int(object.size.w), i));
    }
    finish(i == objectsL);
    iterations += i + 1;
    return result;
}

float dynamicStepSize(float dist, float minStep, float maxStep) { return clamp(dist, minStep, maxStep); }

vec3 rayMarch(vec3 ro, vec3 rd, float maxDistance) {  // the distance, the material and the object, or -1
    float t = 0.0;
    vec3 found = vec3(maxDistance, -1.0, -1.0);
    bool in_time = false;
    int i = 0;
    for (; i < 100; i++) {
        SDF nearest = finalSDF(ro + t * rd);
        if (nearest.dist < 0.001) {
            found = vec3(t, float(nearest.material), float(nearest.object));
            in_time = true;
            break;
        }
        t += dynamicStepSize(nearest.dist, 0.001, maxDistance);
        if (t >= maxDistance) { in_time = true; break; }
    }
    finish(in_time || i == 100);
    iterations += i + 1;
    return found;
}

vec3 calculateNormal(vec3 p) {
    const float h = 0.001;
    float d = finalSDF(p).dist;
    return normalize(vec3(finalSDF(p + vec3(h, 0.0, 0.0)).dist - d, finalSDF(p + vec3(0.0, h, 0.0)).dist - d,
                          finalSDF(p + vec3(0.0, 0.0, h)).dist - d));
}

bool isInShadow(vec3 p, vec3 rd, float dist) {
    float t = 0.01;
    bool shadowed = false, in_time = false;
    int i = 0;
    for (; i < 100; i++) {
        SDF nearest = finalSDF(p + t * rd);
        if (nearest.dist < 0.001) { shadowed = true; in_time = true; break; }
        t += nearest.dist;
        if (t >= dist) { in_time = true; break; }
    }
    finish(in_time || i == 100);
    iterations += i + 1;
    return shadowed;
}

vec3 getCol(vec3 Ia, Material m, vec3 n, vec3 v, vec3 p) {
    vec3 a = Ia * m.color.w * m.color.rgb, d = vec3(0.0), s = vec3(0.0);
    for (int i = 0; i < lightsL; i++) {
        vec3 light = normalize(lights[i] - p);
        if (!isInShadow(p, light, length(lights[i] - p))) {
            vec3 r = reflect(-light, n);
            d += max(dot(n, light), 0.0) * m.phong.x * lightCols[i] * m.color.rgb;
            s += m.phong.y * pow(max(dot(r, normalize(v)), 0.0), m.phong.w) * lightCols[i];
        }
    }
    return a + d + s;
}

vec3 sortCol(vec3 ro, vec3 rd) {
    vec3 c = vec3(0.0);
    float Rf = 1.0;
    for (int depth = 0; depth < 3; depth++) {
        vec3 t = rayMarch(ro, rd, maxDist);
        if (depth == 0) out_info = vec4(t.y < 0.0 ? -1.0 : t.x, 0.0, 0.0, t.z);
        if (t.x >= maxDist || t.y < 0.0) break;
        vec3 pos = ro + t.x * rd;
        vec3 n = calculateNormal(pos);
        c += Rf * getCol(vec3(1.0), materials[int(t.y)], n, normalize(ro - pos), pos);
        Rf *= materials[int(t.y)].phong.z;
        rd = reflect(rd, n);
        ro = pos + n * 0.01;
    }
    return c;
}

void main() {
    vec2 uv = gl_FragCoord.xy / res * 2.0 - 1.0;
    vec3 across = right * uv.x + up * uv.y;
    fragColor = vec4(parallel ? sortCol(eye + across, forward) : sortCol(eye, normalize(forward + across)), 1.0);
    out_info.yz = vec2(whole ? 1.0 : 0.0, float(iterations));
}
