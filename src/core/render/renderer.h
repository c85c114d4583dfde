#pragma once
// Draws a scene: the one renderer of the window, the command line and the tests. Needs a current OpenGL context for all
// its life.
#include "core/effects/plan.h"
#include "core/measure/channels.h"
#include "core/render/blocks.h"
#include "core/render/compiler.h"
#include "core/render/grid_buffers.h"
#include "core/render/program.h"
#include "core/render/targets.h"

#include <cstdint>
#include <list>
#include <set>
#include <string>
#include <vector>

namespace mb {

/// What a frame took, exact and the same on every run.
struct Counts {
    /// By what asks: shadow is of lights that are points, soft of those that have a size.
    struct ByKind {
        std::uint64_t primary = 0, normal = 0, shadow = 0, reflection = 0, soft = 0, occlusion = 0;
        std::uint64_t total() const { return primary + normal + shadow + reflection + soft + occlusion; }
    };
    ByKind evaluations;     // of the scene's distance; normal: with the look-up of the surface's object, and
                            // also where nothing shades: for the channel, the picture itself then takes none
    ByKind touched;         // primitives' distances evaluated in them
    ByKind rays;            // no normal
    ByKind undecided_rays;  // no primary: those are pixels.undecided
    struct { std::uint64_t hit = 0, miss = 0, undecided = 0; } pixels;
    std::uint64_t uses = 0; // of the row of the table of effects that was counted
};

struct Measured {
    Channels channels;
    Counts counts;
};

/// What the scene's functions say at a point; the gradient by differences.
struct GpuSample {
    float distance, found_distance;  // map()'s and nearest()'s, which must be equal
    glm::vec3 gradient;
    int leaf, object;                // −1 for none
};

/// How a scene's distance is evaluated: few primitives as straight-line code, many through a grid of pruned lists. Both give
/// the same values; `automatic` takes what is faster.
enum class Evaluation { automatic, straight, grid };

class Renderer {
public:
    /// With a compiler, a picture whose program is not compiled yet is put off until it is; without one, draw() compiles it.
    explicit Renderer(std::unique_ptr<Compiler> compiler = nullptr);
    void setEvaluation(Evaluation evaluation) { evaluation_ = evaluation; }
    /// What the programs hold against the scenes' own word, from now on.
    void choose(const Choice& choice) { choice_ = choice; }
    const Choice& choice() const { return choice_; }
    Evaluation evaluation() const { return evaluation_; }
    /// From now on the general program draws what this scene's own would: that measured slower (core/render/pricing.h).
    void preferGeneral(const Scene& scene) { slower_.insert(textOf(scene)); }
    /// Whether scenes are drawn by their own programs even where those measured slower: while they are priced.
    void insistOnOwn(bool insists) { insists_ = insists; }
    /// Another shader library than the program's own: a test's.
    void setLibrary(Texts texts) { library_ = std::move(texts), composed_.clear(); }

    /// From now on a picture shows every k-th pixel, along x and y, of one that is k times as wide and high (core/render/enlarge.h):
    /// so a large picture is measured by a part of its pixels.
    void setStride(int k) { stride_ = k; }

    /// Draws the scene into picture(), which is smaller than the size asked for where the scene's `scale` says so. Returns why it could not, or nothing. The last picture stays then, and also where this
    /// one was put off.
    std::string draw(const Scene& scene, const Camera& camera, glm::ivec2 size) { return draw(scene, camera, rasterOf(size, scene.render.scale, stride_)); }
    /// The same with just these pixels, whatever the scene's `scale` says.
    std::string draw(const Scene& scene, const Camera& camera, const Raster& raster);
    /// The picture last drawn, at the size asked for: linear RGB, the top row first.
    std::vector<glm::vec3> readPicture() const;
    /// The same as it is shown: what the scene's film makes of it, if it has one.
    std::vector<glm::vec3> readShown() const;
    const Targets& shown() const { return developed_.size() == picture_.size() ? developed_ : picture_; }
    /// How many of the pixels drawn are undecided: their own ray ran out of steps, or all but touched something.
    std::size_t countUndecided() const;
    const Targets& picture() const { return picture_; }
    /// Draws once more with counters: the other channels, at the size asked for, and what draw() takes; and how often the effect was used, if one is named.
    std::string measure(const Scene& scene, const Camera& camera, glm::ivec2 size, Measured& out, const Effect* counted = nullptr) {
        return measure(scene, camera, rasterOf(size, scene.render.scale, stride_), out, counted);
    }
    std::string measure(const Scene& scene, const Camera& camera, const Raster& raster, Measured& out, const Effect* counted = nullptr);
    /// The scene's own functions at points, in the world's coordinates.
    std::string evaluate(const Scene& scene, const std::vector<glm::vec3>& points, std::vector<GpuSample>& out);
    /// Whether the last draw() or measure() did nothing because its program is not compiled yet; and whether it still is not.
    bool putOff() const { return !awaited_.empty(); }
    bool compiling();
    /// Puts the picture on the framebuffer now bound to 0, into the rectangle of that corner and size, as sRGB.
    void present(glm::ivec2 corner, glm::ivec2 size);

    const Plan& plan() const { return plan_; }       // of the last scene drawn
    const std::string& rendererName() const { return name_; }
    const GridWork& gridWork() const { return grid_work_; }  // of the last scene drawn; nothing where it has no grid
    const Grid* grid() const { return through_grid_ ? &marched_.grid : nullptr; }  // that the last picture was drawn through; null: none
    int compiled() const { return compiled_; }       // programs compiled so far; a change of values adds none
    /// The text of the program that draw() would use.
    std::string textOf(const Scene& scene) const;
    std::size_t programs() const { return programs_.size(); }  // of them, those kept for when they are wanted again

private:
    struct Ready {
        std::string why;              // it cannot be drawn
        const Program* program = nullptr;  // null also where it is put off
        Packed packed;
        GpuFrame frame{};
        int stride = 1;
        bool grid = false;
    };
    enum class Variant { plain, counted, evaluate, develop };

    Ready prepare(const Scene& scene, const Camera& camera, const Raster& raster, Variant variant, glm::dvec3 origin);
    const Composed& compose(Variant variant, const Tree& tree, const Plan& plan, const Choice& choice, const Packed& packed, bool grid) const;
    bool usesGrid(const Tree& tree) const;
    const Program* program(Variant variant, const Composed& composed, bool grid, std::string& why);
    std::string develop(const Ready& ready);
    void keep(std::string text, Program program);
    void keepCompiled();
    std::string upload(const Ready& ready);
    template <class F> void eachPass(const Scene& scene, const Ready& ready, F pass);
    void bindFrame(const GpuFrame& frame);

    struct Cached {
        std::string text;
        Program program;
    };
    /// What was put together, and from what, so that a frame like the last does not do it again.
    struct Known {
        std::string from;
        Composed text;
    };
    mutable std::list<Known> composed_;  // the last used first
    std::list<Cached> programs_;      // the last used first
    std::unique_ptr<Compiler> compiler_;
    std::string awaited_;             // the text of the program that the last picture was put off for; empty: it was not
    int compiled_ = 0;
    Plan plan_;
    std::string name_;
    GLint block_bytes_ = 0;
    Evaluation evaluation_ = Evaluation::automatic;
    int stride_ = 1;
    glm::ivec2 size_{0};              // of the picture last drawn, enlarged
    Choice choice_;
    bool insists_ = false;
    std::set<std::string> slower_;    // texts of programs that measured slower than the general ones
    Texts library_ = shaderLibrary();
    struct GridOnGpu {
        Grid grid;
        GridBuffers buffers;
    };
    GridOnGpu marched_{Grid(), {}}, exact_{Grid(Grid::Exact::everywhere), {}};  // for pictures; for evaluate()
    GridWork grid_work_;
    bool through_grid_ = false;
    Quad quad_;
    std::vector<OwnedBuffer> blocks_;
    Targets picture_, developed_, channels_;
    Program present_;
};

/// The attachments of the picture, and of the channels (shaders/fragment.glsl).
inline constexpr int kPictureAttachments = 2, kChannelAttachments = 8;

/// The place of sample i of n in its pixel, from the pixel's centre, in (−½, ½): the R2 sequence (Roberts, "The Unreasonable
/// Effectiveness of Quasirandom Sequences", 2018), as many of its points before the centre as behind it, so that their mean is the
/// centre: else the whole picture is moved. One sample lies at the centre.
glm::dvec2 samplePlace(int i, int n);

/// Calls `pass` for every sample of a pixel and every turn of lights, the frame's block set for it.
template <class F> void Renderer::eachPass(const Scene& scene, const Ready& ready, F pass) {
    GpuFrame frame = ready.frame;
    const int samples = scene.render.samples;
    for (int i = 0; i < samples; ++i) {
        const glm::dvec2 place = samplePlace(i, samples) / static_cast<double>(ready.stride);
        frame.picture.z = static_cast<float>(place.x), frame.picture.w = static_cast<float>(place.y);
        for (const LightPass& lights : plan_.passes) {
            const bool first = lights.first == 0;
            frame.background.w = first ? 1.0f : 0.0f;
            frame.pass = {lights.first, lights.last, first, frame.pass.w};
            bindFrame(frame);
            pass();
        }
    }
}

}  // namespace mb
