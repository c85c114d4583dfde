#include "core/render/picture_sweep.h"

#include "core/measure/timing.h"
#include "core/render/gl.h"

#include <algorithm>
#include <cmath>

namespace mb {
namespace {

constexpr double kTruthSliceMs = 15;

/// What follows draws sparse pictures, by the scene's own program.
class Sparse {
public:
    Sparse(Renderer& renderer, int stride) : renderer_(renderer) { renderer.setStride(stride); }
    ~Sparse() { renderer_.setStride(1); }
    Sparse(const Sparse&) = delete;
    Sparse& operator=(const Sparse&) = delete;

private:
    Renderer& renderer_;
};

double pixelsOf(glm::ivec2 size) { return static_cast<double>(size.x) * size.y; }

/// The scene with one sample a pixel, at its middle.
Scene oneSampleOf(Scene scene) {
    scene.render.samples = 1;
    return scene;
}

/// A size of that shape with about so many pixels.
glm::ivec2 sizeOf(glm::ivec2 shape, double pixels) {
    const double by = std::sqrt(pixels / pixelsOf(shape));
    return glm::max(glm::ivec2(glm::round(glm::dvec2(shape) * by)), glm::ivec2(1));
}

}  // namespace

PictureSweep::Affordable PictureSweep::affordable(const Scene& scene, const Camera& camera, glm::ivec2 shape, Renderer& renderer, double most) {
    constexpr double kSeconds = 55, kProbePixels = 96.0 * 54, kCounting = 1.3;  // of a timed draw
    constexpr double kStraightNs = 5, kGridNs = 65, kLeastNs = 150;         // a primitive touched; a pixel at least
    Measured measured;
    Affordable best;
    best.why = renderer.measure(oneSampleOf(scene), camera, sizeOf(shape, std::min(kProbePixels, pixelsOf(shape))), measured);
    best.put_off = renderer.putOff();
    if (!best.why.empty() || best.put_off) return best;
    const double touched = static_cast<double>(measured.counts.touched.total()) / pixelsOf(measured.channels.size);
    const double ns = std::max(kLeastNs, touched * (renderer.grid() ? kGridNs : kStraightNs));
    const double alone = 9.0 * static_cast<double>(knobsOf(scene, false).size());

    struct Step {
        double share;  // of the pixels
        int timings;
        std::size_t together;
    };
    constexpr Step kSteps[] = {{1, 3, 240}, {1, 2, 200}, {0.64, 2, 160}, {0.36, 2, 140}, {0.36, 1, 120}, {0.16, 1, 100}, {0.16, 1, 60}, {0.09, 1, 60}};
    const double pixels = std::min(most, pixelsOf(shape));
    for (const Step& s : kSteps) {
        constexpr double kJointSamples = 4;
        const double draws = alone * scene.render.samples + static_cast<double>(s.together) * kJointSamples;
        best.plan = {true, s.together, s.timings}, best.size = sizeOf(shape, s.share * pixels);
        if (draws * (s.timings + kCounting) * pixelsOf(best.size) * ns <= kSeconds * 1e9) break;
    }
    return best;
}

PictureSweep::PictureSweep(const Scene& scene, const Frame& frame, Plan plan)
    : scene_(scene), plan_(plan), truth_(scene, frame), knobs_(knobsOf(scene, false)),
      search_(settingOf(scene), defaultsOf(settingOf(scene), false), {knobs_, pictureTerms(), plan.together, Search::Plan{}.dearest, plan.aim}) {
    const Setting own = settingOf(scene);
    wanted_ = {runOf(own), runOf(defaultsOf(own, false))};
    if (!plan.alone) return;
    for (const Knob* knob : knobs_)
        for (const double value : valuesWith(*knob, {valueOf(own, *knob)})) {
            wanted_.push_back(runOf(turned(own, *knob, value), knob->key, value));
            wanted_.back().aside = knob->cost != pictureTerms().cost;
        }
}

double PictureSweep::progress() const {
    constexpr double kTruthShare = 0.2;
    const double all = static_cast<double>(wanted_.size() + search_.most());
    return kTruthShare * truth_.progress() + (1 - kTruthShare) * static_cast<double>(runs_.size()) / std::max(all, 1.0);
}

/// Takes up the next run; says whether there is one.
bool PictureSweep::begin() {
    if (runs_.size() < wanted_.size()) {
        run_ = wanted_[runs_.size()];
    } else if (const std::optional<Setting> next = search_.next(runs_)) {
        run_ = runOf(*next);
    } else {
        return false;
    }
    set_ = withSetting(scene_, run_->setting);
    set_.render.show_undecided = false;
    draws_ = 0, counted_ = complete_ = false;
    return true;
}

bool PictureSweep::step(Renderer& renderer) {
    if (truth_.progress() < 1) return truth_.step(kTruthSliceMs), true;
    if (!run_ && !begin()) return false;
    const Sparse sparse(renderer, frame().stride);
    if (draws_ < plan_.timings) draw(renderer);
    else if (!counted_) count(renderer);
    else drawMiddle(renderer);
    if (run_->failed() || complete_) conclude();
    return true;
}

void PictureSweep::draw(Renderer& renderer) {
    const double ms = timeOf([&] {
        run_->failure = renderer.draw(set_, frame().camera, frame().size);
        gl.Finish();
    });
    if (run_->failed() || renderer.putOff()) return;
    if (draws_ == 0) drawn_.shown = renderer.readShown();
    if (std::exchange(compiled_, renderer.compiled()) != renderer.compiled()) return;  // a new program's first draw is no figure
    run_->costs[Cost::ms] = draws_ == 0 ? ms : std::min(ms, run_->costs[Cost::ms]);
    ++draws_;
}

void PictureSweep::count(Renderer& renderer) {
    Measured measured;
    run_->failure = renderer.measure(set_, frame().camera, frame().size, measured);
    compiled_ = renderer.compiled();
    if (run_->failed() || renderer.putOff()) return;
    run_->costs[Cost::evaluations] = static_cast<double>(measured.counts.evaluations.total()) / pixelsOf(frame().size);
    run_->undecided = static_cast<double>(measured.counts.pixels.undecided) / pixelsOf(frame().size);
    drawn_.channels = std::move(measured.channels);
    counted_ = true;
    complete_ = set_.render.samples == 1;
    if (complete_) drawn_.middle = drawn_.shown;
}

void PictureSweep::drawMiddle(Renderer& renderer) {
    run_->failure = renderer.draw(oneSampleOf(set_), frame().camera, frame().size);
    if (run_->failed() || renderer.putOff()) return;
    drawn_.middle = renderer.readShown();
    complete_ = true;
}

void PictureSweep::conclude() {
    if (!run_->failed()) {
        run_->errors = errorsOf(drawn_, truth_.picture(), &run_->off);
        run_->failure = failureOf(drawn_, truth_);
        if (runs_.size() == kOwnRun) own_ = drawn_;
        if (!run_->knob.empty()) {
            const bool of_area = knobNamed(run_->knob).moves.front() == Error::color;
            shots_.push_back({runs_.size(), drawn_.shown, errorMap(drawn_, truth_.picture(), of_area ? Error::color : Error::shade)});
        }
    }
    runs_.push_back(std::move(*run_));
    run_.reset();
}

std::string drawn(Renderer& renderer, const Scene& scene, const Frame& frame, DrawnPicture& out, Values<Cost>& costs) {
    const Sparse sparse(renderer, frame.stride);
    Measured measured;
    if (std::string why = renderer.measure(scene, frame.camera, frame.size, measured); !why.empty() || renderer.putOff()) return why;
    if (std::string why = renderer.draw(scene, frame.camera, frame.size); !why.empty() || renderer.putOff()) return why;
    out.shown = renderer.readShown();
    if (std::string why = renderer.draw(oneSampleOf(scene), frame.camera, frame.size); !why.empty() || renderer.putOff()) return why;
    out.middle = renderer.readShown();
    costs[Cost::evaluations] = static_cast<double>(measured.counts.evaluations.total()) / pixelsOf(frame.size);
    out.channels = std::move(measured.channels);
    return {};
}

}  // namespace mb
