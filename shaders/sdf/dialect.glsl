// What the GPU needs to compile the files that C++ compiles too; C++ has its own in src/core/sdf/.
#define real float
float pick(float s, float a, float b) { return s < 0.0 ? a : b; }
float square(float a) { return a * a; }
float nearestWhole(float a) { return floor(a + 0.5); }
// Before a variable: the driver must not regroup what it is made of, where it can be told so.
#ifdef GL_ARB_gpu_shader5
#define AS_WRITTEN precise
#else
#define AS_WRITTEN
#endif
