#pragma once
// What light truly comes back along a ray: Phong's model, shadows, mirrors and the other effects in double over the oracle's
// surfaces. None of the GLSL takes part, nor any of its tolerances: no bias, no budget of steps.
#include "core/accuracy/oracle.h"

namespace mb {

/// What is true of a light or a sky that rays sample: how many the truth sends, and how they are turned.
struct TrueRays {
    int rays = 16;
    double turn = 0;          // of their spiral, of a whole turn: another for every ray of a pixel
};

class Radiance {
public:
    /// Both must outlive it. What the scene does not call for is not there: with reflections:0 nothing mirrors, with
    /// shadow_steps:0 nothing is shadowed.
    Radiance(const Oracle& oracle, const Scene& scene);

    struct Seen {
        glm::dvec3 color{0};            // linear, before the film
        std::optional<TrueHit> hit;     // of the ray itself
    };
    /// Followed from mirror to mirror until what is left of a color is below kLeastWeight, or for kMostBounces.
    Seen along(const Ray& ray, TrueRays rays = {}) const;
    /// The picture's color of light: what the scene's film makes of it, as sRGB from 0 to 1 (IEC 61966-2-1, 1999).
    glm::dvec3 shown(glm::dvec3 light) const;

    static constexpr double kLeastWeight = 1e-4;  // a fortieth of a step of an 8-bit picture
    static constexpr int kMostBounces = 64;

private:
    struct Look {
        glm::dvec3 color{0};
        double ka = 0, kd = 0, ks = 0, kr = 0, c = 0, emission = 0;
    };
    struct Point {
        glm::dvec3 position, normal, direction;  // the direction of the ray that came
        Look look;
    };
    Look lookAt(const TrueHit& hit, glm::dvec3 at) const;
    glm::dvec3 sentBack(const Point& p, TrueRays rays) const;
    glm::dvec3 fromLight(const Light& light, const Point& p, TrueRays rays) const;
    double openness(const Point& p, TrueRays rays) const;
    double visible(const Light& light, double size, const Point& p, TrueRays rays) const;

    const Oracle& oracle_;
    const Scene& scene_;
    double fog_ = 0, ao_ = 0, exposure_ = 0;
    std::size_t emission_ = 0, light_size_ = 0;  // where a record's extra numbers have them
    bool shadows_ = false, mirrors_ = false;
};

}  // namespace mb
