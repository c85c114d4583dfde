#pragma once
// The true picture: for each pixel what its middle ray meets, and the mean color of its whole area.
#include "core/accuracy/radiance.h"

#include <glm/vec2.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace mb {

/// A picture of `size` pixels whose pixel (i, j) is the one at ((i + ½)·stride, (j + ½)·stride) of a picture of size·stride:
/// a large picture, known by a part of its pixels.
struct Frame {
    Camera camera;
    glm::ivec2 size{0};
    int stride = 1;
};

/// size.x · size.y of each, the top row first.
struct TruePicture {
    Frame frame;
    std::vector<double> depth;          // m along the middle ray; +inf for a miss
    std::vector<glm::dvec3> normal;     // towards the eye; 0 for a miss
    std::vector<int> object;            // the top-level object's number; −1 for a miss
    std::vector<char> smooth;           // 1: the pixel shows one smooth surface: see isSmooth()
    std::vector<glm::dvec3> color;      // the mean light of its area, as it is shown: sRGB of what the film makes of it, 0 to 1
    std::vector<glm::dvec3> middle;     // the light at its middle alone, the same way
    double noise = 0;                   // root mean square of what the color's own sampling may be off by, of the same unit
    std::size_t pixels() const { return depth.size(); }
};

/// Made row by row: in slices for an editor, or on all cores at once. The same picture either way.
class TruePictureWork {
public:
    TruePictureWork(Scene scene, const Frame& frame);
    TruePictureWork(const TruePictureWork&) = delete;
    TruePictureWork& operator=(const TruePictureWork&) = delete;
    /// Works for about that long; says whether there is more to do.
    bool step(double ms);
    /// Does the rest on as many threads as the machine has; `show` is told the share done.
    void finish(const std::function<void(double)>& show = {});
    double progress() const;            // 0 to 1
    const TruePicture& picture() const { return picture_; }
    const Oracle& oracle() const { return oracle_; }
    /// Whether a ray so near the pixel's middle ray that single precision cannot tell them apart may end otherwise: on another
    /// surface, or on none. No float picture can decide such a pixel.
    bool isTooCloseToTell(std::size_t pixel) const;

    static constexpr int kFew = 4, kMany = 8, kMost = 16;  // samples along a pixel's side: of every pixel, and where they differ
    static constexpr double kDiffer = 1.0 / 255;

private:
    void row(int y, double& io_noise);
    void pixel(int x, int y, double& io_noise);
    /// Whether the rays through the pixel's corners and the middles of its sides meet the middle ray's object, their normals within 15°
    /// of its. No straight edge crosses a pixel without cutting off a corner, however little of it.
    bool isSmooth(int x, int y, const TrueHit& middle) const;
    void conclude();

    Scene scene_;
    Oracle oracle_;
    Radiance radiance_;
    TruePicture picture_;
    std::vector<double> noise_;         // of each row: squares
    double largest_ = 0;                // m: of the scene's bounded shapes, from their own origins
    int next_row_ = 0;
};

}  // namespace mb
