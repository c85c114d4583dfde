#pragma once
// The same model drawn by POV-Ray, a program of its own: spheres, boxes and cylinders met by their equations.
#include "bench/scenes.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mb::bench {

/// The model in POV-Ray's language: the same camera, light, Phong, shadows and one reflection, or with `flat` each
/// object's number as an unlit colour. A model that blends has no such text.
std::string povText(const Model& model, bool flat);

/// What POV-Ray prints of a run.
struct PovTimes {
    double trace_ms = 0, cpu_ms = 0;
    std::string version;
};
/// Nothing where the output holds no times.
bool readPovTimes(const std::string& output, PovTimes& times);

class Povray {
public:
    /// Writes the model's texts to a folder of its own, gone with it. Without a povray on PATH, available() is false.
    Povray(const Model& model, glm::ivec2 size);
    ~Povray();
    Povray(const Povray&) = delete;
    Povray& operator=(const Povray&) = delete;

    static bool available();
    /// Draws the model. Returns what went wrong, or nothing.
    std::string draw(PovTimes& times);
    /// The linear colours of the last picture drawn, in [0, 1], 8 bits each; the top row first.
    std::vector<glm::vec3> picture() const;
    /// Draws the objects' numbers, −1 for none. Returns what went wrong, or nothing.
    std::string objects(std::vector<float>& numbers);

private:
    std::string run(const char* name, PovTimes& times);

    glm::ivec2 size_;
    std::filesystem::path folder_;
};

}  // namespace mb::bench
