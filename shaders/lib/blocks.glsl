// What the program uploads each frame, in std140. Every member has a twin in src/core/render/blocks.h; a test asks the
// driver for each offset. Array sizes are written above the shader: they change only with the scene's topology.

struct Leaf {
    vec4 position;  // of its centre, relative to the eye; w: the material's number
    vec4 x_axis;    // the leaf's axes in the world; w: the first three numbers of its primitive
    vec4 y_axis;
    vec4 z_axis;
    vec4 extra;     // the fourth number; the number of its top-level object
};

struct Material {
    vec4 color;     // w: Ka
    vec4 color2;    // w: Kd
    vec4 phong;     // Ks, Kr, C; w: the pattern
};

struct Light {
    vec4 position;  // relative to the eye
    vec4 color;     // times the intensity
};

struct Frame {
    vec4 right;       // of the picture: half its width at distance 1, or of a parallel view in metres; w: 1 for a parallel view
    vec4 up;
    vec4 forward;     // w: metres per pixel and metre of distance, or per pixel of a parallel view
    vec4 picture;     // width, height, and the sample's place in its pixel, from the centre
    vec4 reach;       // march epsilon, max distance, normal epsilon, size of the largest thing in the scene
    vec4 background;  // w: 1 in the pass that counts as a sample, 0 in one that adds further lights to it
    ivec4 limits;     // march steps, shadow steps, reflections; 1 to show undecided pixels
    ivec4 pass;       // the first light of this pass and the one after its last; 1 for the pass that adds the ambient light
};

layout(std140) uniform FrameBlock { Frame frame; };
layout(std140) uniform LeafBlock { Leaf leaves[LEAVES]; };
layout(std140) uniform BranchBlock { vec4 branches[BRANCHES]; };  // x: the blend
layout(std140) uniform MaterialBlock { Material materials[MATERIALS]; };
layout(std140) uniform LightBlock { Light lights[LIGHTS]; };

// A point in a leaf's frame.
vec3 local(vec3 p, Leaf leaf) {
    vec3 q = p - leaf.position.xyz;
    return vec3(dot(leaf.x_axis.xyz, q), dot(leaf.y_axis.xyz, q), dot(leaf.z_axis.xyz, q));
}

// What the scene's own text finds at a point: the distance, and the leaf whose surface it is (-1: none).
struct Nearest {
    float distance;
    int leaf;
};
Nearest nearer(Nearest a, Nearest b) { return Nearest(min(a.distance, b.distance), b.distance < a.distance ? b.leaf : a.leaf); }

int marchSteps() { return frame.limits.x; }
int shadowSteps() { return frame.limits.y; }
bool showsUndecided() { return frame.limits.w != 0; }
vec3 background() { return frame.pass.z != 0 ? frame.background.rgb : vec3(0.0); }
#ifdef EFFECT_REFLECTION
int reflections() { return frame.limits.z; }
#else
int reflections() { return 0; }
#endif
