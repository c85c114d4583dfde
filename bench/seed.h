#pragma once
// The shader marchbox began from (bench/seed.glsl), drawing a model. Needs a current OpenGL context for all its life.
#include "bench/scenes.h"
#include "core/render/program.h"
#include "core/render/targets.h"

#include <string>
#include <vector>

namespace mb::bench {

/// What its pixels are, the top row first.
struct SeedPicture {
    std::vector<glm::vec3> color;
    std::vector<float> depth;      // m; +inf for a miss
    std::vector<float> object;     // its number, −1 for none
    std::vector<bool> whole;       // false: the driver ended the shader before its time, and the rest is rubbish
    std::vector<float> iterations; // of all its loops
};

class Seed {
public:
    /// The model must live as long.
    Seed(const Model& model, glm::ivec2 size) : model_(model), size_(size) {}
    /// Compiles the shader for the model. Returns why it cannot draw it, or nothing: it draws spheres and boxes.
    std::string prepare();
    /// Draws a frame, its blocks filled anew as the seed does, to the last pixel.
    void draw();
    SeedPicture read() const;

private:
    void fillBlocks();

    const Model& model_;
    glm::ivec2 size_;
    Program program_;
    Quad quad_;
    OwnedBuffer objects_, materials_;
    Targets targets_;
};

}  // namespace mb::bench
