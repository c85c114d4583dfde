// What became of this pixel, and what it cost.

const int MISS = 0;
const int HIT = 1;
const int UNDECIDED = 2;

const vec3 UNDECIDED_TINT = vec3(1.0, 0.0, 1.0);
const float INFINITY = uintBitsToFloat(0x7F800000u);

struct Outcome {
    int state;         // of the primary ray
    float depth;       // metres along it; infinite where nothing was hit
    vec3 normal;
    float object;      // the top-level object's number; -1 for none
    float steps;
};
Outcome outcome = Outcome(MISS, INFINITY, vec3(0.0), -1.0, 0.0);

// What asks for the scene's distance.
const int PRIMARY = 0;
const int NORMAL = 1;
const int SHADOW = 2;      // of a light that is a point
const int REFLECTION = 3;
const int SOFT = 4;        // shadow of a light that has a size
const int OCCLUSION = 5;

const float EMPTY = 1e9;  // the distance of nothing: finite, so that no difference of two is NaN
bool cut_short = false;   // a loop ended before its time: software OpenGL stops all loops of a shader at 65,535 rounds

#ifdef COUNTED
int touches = 0;  // primitives, by the evaluations since the last count
// For each kind: evaluations, primitives touched, rays, undecided ones of these.
ivec4 counts[6] = ivec4[6](ivec4(0), ivec4(0), ivec4(0), ivec4(0), ivec4(0), ivec4(0));
int row_uses = 0;  // of the counted row of the table of effects

void touch(int primitives) { touches += primitives; }
void count(int kind, int evaluations) {
    counts[kind] += ivec4(evaluations, touches, 0, 0);
    touches = 0;
}
void countRay(int kind, int evaluations, int state) {
    count(kind, evaluations);
    counts[kind] += ivec4(0, 0, 1, state == UNDECIDED ? 1 : 0);
}
void uses(int row, int times) { row_uses += row == frame.counted.x ? times : 0; }
#else
void touch(int primitives) {}
void count(int kind, int evaluations) {}
void countRay(int kind, int evaluations, int state) {}
void uses(int row, int times) {}
#endif
