// What the program uploads each frame, in std140. Every member has a twin in src/core/render/blocks.h; a test asks the
// driver for each offset. Array sizes are written above the shader: they change only with the scene's topology.

// A leaf or an operator, placed in the world (relative to the eye) or in the space of the warp above it.
struct Node {
    vec4 position;  // w: a leaf's material, a fold's blend
    vec4 x_axis;    // the axes of its frame; w: the first three numbers of its type
    vec4 y_axis;
    vec4 z_axis;
    vec4 extra;     // the fourth number; of a leaf, the number of its top-level object
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
layout(std140) uniform LeafBlock { Node leaves[LEAVES]; };
layout(std140) uniform BranchBlock { Node branches[BRANCHES]; };
layout(std140) uniform MaterialBlock { Material materials[MATERIALS]; };
layout(std140) uniform LightBlock { Light lights[LIGHTS]; };

Node leafRecord(int leaf) { return leaves[leaf]; }

// A point in a record's frame.
vec3 local(vec3 p, Node node) {
    vec3 q = p - node.position.xyz;
    return vec3(dot(node.x_axis.xyz, q), dot(node.y_axis.xyz, q), dot(node.z_axis.xyz, q));
}

int marchSteps() { return frame.limits.x; }
int shadowSteps() { return frame.limits.y; }
bool showsUndecided() { return frame.limits.w != 0; }
vec3 background() { return frame.pass.z != 0 ? frame.background.rgb : vec3(0.0); }
#ifdef EFFECT_REFLECTION
int reflections() { return frame.limits.z; }
#else
int reflections() { return 0; }
#endif
