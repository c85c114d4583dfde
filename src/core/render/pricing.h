#pragma once
// What something costs in a picture, and how much of the picture it is: the picture with it against the picture without it.
#include "core/render/renderer.h"

namespace mb {

/// One side of a comparison.
struct Variation {
    Scene scene;
    Choice choice = {};
    Evaluation evaluation = Evaluation::automatic;
};

struct Price {
    bool measured = false;
    std::int64_t evaluations = 0;           // of the scene's distance, in a frame: with less without
    double ms = 0, ms_least = 0, ms_most = 0;  // of a frame, with less without: the median of the rounds, the least and the most
    double frame_ms = 0;                    // with it: the median
    double mean = 0, largest = 0;           // of what changes in the picture as it is shown in 8 bits: 1 is from black to white
    std::string note;                       // why there is no price, or what follows from it

    /// ms, where every round says that it costs something; else 0.
    double sureMs() const { return ms_least > 0 ? ms : 0; }
    /// Highest where much is paid and nothing seen.
    double forEffect() const;
};

/// One comparison, a draw at a time. In each round both sides are drawn, the first one second the next time: only differences
/// within a round are figures.
class Pricing {
public:
    /// Without `counted` the prices have no evaluations, and two programs with counters need not be compiled.
    Pricing(Variation with, Variation without, const Camera& camera, glm::ivec2 size, int rounds, bool counted = true);
    /// Draws once, or waits for a program; says whether there is more to do. The renderer's own choices are put back.
    bool step(Renderer& renderer);
    double progress() const;                // 0 to 1
    const Price& price() const { return price_; }

private:
    struct Side {
        Variation variation;
        std::vector<std::uint8_t> picture;  // as it is shown
        std::uint64_t evaluations = 0;
        std::vector<double> ms;
    };
    void show(Renderer& renderer, Side& side);
    void count(Renderer& renderer, Side& side);
    void time(Renderer& renderer, Side& side);
    void conclude();

    Side with_, without_;
    Camera camera_;
    glm::ivec2 size_;
    int rounds_, before_, done_ = 0;  // draws before the rounds
    Price price_;
};

/// What leaving out saves: the general program, every row in it, against the scene's own. Their pictures are the same to the bit.
Pricing ownAgainstGeneral(const Scene& scene, const Camera& camera, glm::ivec2 size, int rounds, bool counted);
/// Whether the scene's own program is to be dropped for the general one: it was slower in every round, by more than is worth
/// speaking of.
bool ownIsSlower(const Price& saved);

}  // namespace mb
