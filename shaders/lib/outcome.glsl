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
    ivec4 evaluations; // of the scene's distance, by what asked: primary, normal, shadow, reflection
    ivec4 touched;     // primitives evaluated in them
    ivec4 rays;        // shadow, reflection; undecided ones of each
};
Outcome outcome = Outcome(MISS, INFINITY, vec3(0.0), -1.0, 0.0, ivec4(0), ivec4(0), ivec4(0));

const int PRIMARY = 0;
const int NORMAL = 1;
const int SHADOW = 2;
const int REFLECTION = 3;

int touches = 0;  // by the evaluations since the last count
void count(int kind, int evaluations) {
    outcome.evaluations[kind] += evaluations;
    outcome.touched[kind] += touches;
    touches = 0;
}
