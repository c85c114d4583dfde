#pragma once
// What accuracy costs in a picture: each knob turned alone, and all of them together, each setting's picture held against the true
// one, counted and timed.
#include "core/accuracy/error_map.h"
#include "core/accuracy/search.h"
#include "core/render/renderer.h"

#include <optional>

namespace mb {

/// Made a draw at a time, so that an editor may go on between two. The same runs each time, but for the milliseconds.
class PictureSweep {
public:
    struct Plan {
        bool alone = true;               // each knob by itself
        std::size_t together = 200;      // settings of the joint sweep; 0: none
        int timings = 3;                 // draws of a setting that are timed; the first of a new program is not
        std::optional<Search::Aim> aim = {};  // of the joint sweep
    };
    /// What to measure of a scene in about a minute of drawing: the plan, and the size of a picture of that shape that has no more pixels
    /// than `most`. Follows
    /// from counts, so that it is the same on every machine. Says why the scene cannot be drawn, if it cannot.
    struct Affordable {
        Plan plan;
        glm::ivec2 size{0};
        std::string why;
        bool put_off = false;            // ask again: the program that counts is not compiled yet
    };
    static Affordable affordable(const Scene& scene, const Camera& camera, glm::ivec2 shape, Renderer& renderer, double most = 160 * 90);

    PictureSweep(const Scene& scene, const Frame& frame, Plan plan);

    /// Draws once, or works at the true picture for some milliseconds, or waits for a program; says whether there is more to do.
    bool step(Renderer& renderer);
    /// Does the rest of the true picture on all cores.
    void finishTruth(const std::function<void(double)>& show = {}) { truth_.finish(show); }
    double progress() const;             // 0 to 1

    /// The own setting first, then the default one, then each knob's values, then the joint ones.
    const std::vector<Run>& runs() const { return runs_; }
    const TruePictureWork& truth() const { return truth_; }
    const std::vector<const Knob*>& knobs() const { return knobs_; }
    const Scene& scene() const { return scene_; }
    const Frame& frame() const { return truth_.picture().frame; }
    /// The own setting's picture, once it is drawn.
    const DrawnPicture& own() const { return own_; }
    /// A run's picture and where it is wrong, both as light; kept of the knobs alone.
    struct Shot {
        std::size_t run = 0;
        std::vector<glm::vec3> shown, errors;
    };
    const std::vector<Shot>& shots() const { return shots_; }

private:
    bool begin();
    void draw(Renderer& renderer);
    void count(Renderer& renderer);
    void drawMiddle(Renderer& renderer);
    void conclude();

    Scene scene_;
    Plan plan_;
    TruePictureWork truth_;
    std::vector<const Knob*> knobs_;
    std::vector<Run> wanted_;            // of the own and the default setting and the knobs alone, in order
    Search search_;
    std::vector<Run> runs_;
    std::optional<Run> run_;             // in work
    Scene set_;                          // the scene with that run's setting
    DrawnPicture drawn_, own_;
    std::vector<Shot> shots_;
    int draws_ = 0, compiled_ = -1;
    bool counted_ = false, complete_ = false;
};

/// One setting's picture and its counts, without a sweep: what a budget has reached. Says why it cannot be drawn, if it cannot. Where
/// the renderer puts it off (Renderer::putOff) nothing is drawn: ask again.
std::string drawn(Renderer& renderer, const Scene& scene, const Frame& frame, DrawnPicture& out, Values<Cost>& costs);

}  // namespace mb
