// What the program uploads each frame, in std140. Every member has a twin in src/core/render/blocks.h; a test asks the
// driver for each offset. Array sizes are written above the shader: they change only with the scene's topology.

// A leaf or an operator, placed in the world (relative to the eye) or in the space of the warp above it.
struct Node {
    vec4 position;  // w: a leaf's material, a fold's blend
    vec4 numbers;   // what its type's function takes
    vec4 x_axis;    // the axes of its frame; w: of a leaf, the number of its top-level object
    vec4 y_axis;    // w: its type's row
    vec4 z_axis;
};

struct Material {
    vec4 color;     // w: Ka
    vec4 color2;    // w: Kd
    vec4 phong;     // Ks, Kr, C; w: the pattern
    mat2x4 extra;   // the numbers of the keys that effects bring, as in the other records
};

struct Light {
    vec4 position;  // relative to the eye
    vec4 color;     // times the intensity
    mat2x4 extra;
};

struct Frame {
    vec4 right;       // of the picture: half its width at distance 1, or of a parallel view in metres; w: 1 for a parallel view
    vec4 up;
    vec4 forward;     // w: metres per pixel and metre of distance, or per pixel of a parallel view
    vec4 picture;     // width, height, and the sample's place in its pixel, from the centre
    vec4 reach;       // march epsilon, max distance, normal epsilon, size of the largest thing in the scene
    vec4 march;       // relaxation; bias of a ray that leaves a surface, in hit tolerances
    vec4 background;  // w: 1 in the pass that counts as a sample, 0 in one that adds further lights to it
    ivec4 limits;     // march steps, shadow steps, reflections planned; 1 to show undecided pixels
    vec4 grid_corner; // of the grid's first cell, relative to the eye; w: a coarse cell's size
    vec4 box_lo;      // of all that has bounds, relative to the eye; w: cells a metre
    vec4 box_hi;
    ivec4 grid_size;  // coarse cells; items of the list of what has no bounds
    ivec4 pass;       // the first light of this pass and the one after its last; 1 for the pass that adds the ambient light; leaves and operators in all
    mat2x4 world_extra;
    mat2x4 render_extra;
    ivec4 counted;    // the number of the row whose uses are counted
};

layout(std140) uniform FrameBlock { Frame frame; };
#ifdef GRID
// Records of thousands of objects: vec4s of one buffer texture, the leaves, the operators, then the materials.
uniform samplerBuffer records;
const int NODE_TEXELS = 5;
const int MATERIAL_TEXELS = 5;
vec4 recordTexel(int i) { return texelFetch(records, i); }
Node recordAt(int record) {
    int i = record * NODE_TEXELS;
    return Node(recordTexel(i), recordTexel(i + 1), recordTexel(i + 2), recordTexel(i + 3), recordTexel(i + 4));
}
Node leafRecord(int leaf) { return recordAt(leaf); }
Material materialRecord(int material) {
    int i = frame.pass.w * NODE_TEXELS + material * MATERIAL_TEXELS;
    return Material(recordTexel(i), recordTexel(i + 1), recordTexel(i + 2), mat2x4(recordTexel(i + 3), recordTexel(i + 4)));
}
#else
layout(std140) uniform LeafBlock { Node leaves[LEAVES]; };
layout(std140) uniform BranchBlock { Node branches[BRANCHES]; };
layout(std140) uniform MaterialBlock { Material materials[MATERIALS]; };
Node leafRecord(int leaf) { return leaves[leaf]; }
Material materialRecord(int material) { return materials[material]; }
#endif
#ifdef EFFECT_LIGHT
layout(std140) uniform LightBlock { Light lights[LIGHTS]; };
#endif

// A point in a record's frame; a direction in it; and a direction of it. Where nothing in the scene is turned, the axes are
// not even read.
#ifdef TURNED
vec3 turnedTo(vec3 d, Node node) { return vec3(dot(node.x_axis.xyz, d), dot(node.y_axis.xyz, d), dot(node.z_axis.xyz, d)); }
vec3 turnedBack(vec3 d, Node node) { return node.x_axis.xyz * d.x + node.y_axis.xyz * d.y + node.z_axis.xyz * d.z; }
#else
vec3 turnedTo(vec3 d, Node node) { return d; }
vec3 turnedBack(vec3 d, Node node) { return d; }
#endif
vec3 local(vec3 p, Node node) { return turnedTo(p - node.position.xyz, node); }

int marchSteps() { return frame.limits.x; }
int shadowSteps() { return frame.limits.y; }
bool showsUndecided() { return frame.limits.w != 0; }
// Whether this pass adds what is not the lights' own. Only of many lights is there more than one pass.
#ifdef MANY_PASSES
bool isFirstPass() { return frame.pass.z != 0; }
#else
bool isFirstPass() { return true; }
#endif
vec3 background() { return isFirstPass() ? frame.background.rgb : vec3(0.0); }
#ifdef EFFECT_REFLECTION
int reflections() { return frame.limits.z; }
#endif
