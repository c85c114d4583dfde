#include "gui/viewport.h"

#include "core/render/budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace mb {
namespace {

constexpr int kSmallestSide = 48;  // pixels of a preview
constexpr double kTrialMs = 1500;  // without a change for so long, the program is tried
constexpr int kWidestStep = 8;     // a preview has at least an eighth of the full width

double nowMs() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The size of a picture of the same shape with about that many pixels, in steps so that it does not change at every frame.
glm::ivec2 sizeWithin(glm::ivec2 full, double pixels) {
    const double scale = std::sqrt(pixels / (static_cast<double>(full.x) * full.y));
    constexpr double kSteps[] = {1, 0.75, 0.5, 0.375, 0.25, 0.1875, 1.0 / kWidestStep};
    double chosen = kSteps[std::size(kSteps) - 1];
    for (const double step : kSteps)
        if (step <= scale) {
            chosen = step;
            break;
        }
    const auto side = [&](int whole) { return std::clamp(static_cast<int>(whole * chosen), std::min(whole, kSmallestSide), whole); };
    return {side(full.x), side(full.y)};
}

}  // namespace

Viewport::Viewport(std::unique_ptr<Compiler> compiler) : renderer_(std::make_unique<Renderer>(std::move(compiler))) {}
Viewport::~Viewport() = default;

/// What is shown is kept in a picture of the window's size, so that a frame where nothing changed only copies it.
void Viewport::makeKept(glm::ivec2 window) {
    kept_ = makeSheet(window);
    glBindFramebuffer(GL_FRAMEBUFFER, kept_.framebuffer);
    gl.ClearColor(0.1f, 0.1f, 0.12f, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    window_ = window;
}

void Viewport::keepShown(glm::ivec2 corner, glm::ivec2 size) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, kept_.framebuffer);
    const glm::ivec2 end = corner + size;
    glBlitFramebuffer(corner.x, corner.y, end.x, end.y, corner.x, corner.y, end.x, end.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Viewport::showKept() {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, kept_.framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, window_.x, window_.y, 0, 0, window_.x, window_.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

/// Draws the picture into the renderer's, with so many pixels, and measures; says whether it could.
bool Viewport::draw(const Scene& scene, const Camera& camera, glm::ivec2 pixels) {
    priced_ = false;
    const double start = nowMs();
    why_ = renderer_->draw(scene, camera, Raster{size_, pixels});
    put_off_ = renderer_->putOff();
    if (!why_.empty() || put_off_) return false;
    gl.Finish();
    ms_ = nowMs() - start;
    return true;
}

void Viewport::drawPreview(const Scene& scene, const Camera& camera) {
    const glm::ivec2 size = sizeWithin(full_, kFrameMs * 1e6 / ns_per_pixel_);
    if (!draw(scene, camera, size)) return;
    // A program's first frame says nothing of the next one's time.
    const bool typical = std::exchange(compiled_, renderer_->compiled()) == renderer_->compiled();
    const double ns = ms_ * 1e6 / (static_cast<double>(size.x) * size.y);
    if (typical) ns_per_pixel_ = std::clamp(0.5 * (ns_per_pixel_ + ns), 1.0, 1e7);
    renderer_->present(corner_, size_);
    keepShown(corner_, size_);
    drawn_ = size, next_row_ = shown_row_ = 0, refined_ = false, shown_ms_ = ms_, refining_ms_ = 0;
    // With everything in it there is nothing to refine.
    if (size == full_ && scene.render.samples == 1) refined_ = true;
}

/// Draws the next rows of the full picture, as many as a frame's time allows, and shows over the preview what of it they and
/// those below them decide: where it is enlarged, a row of the screen lies between two of it.
void Viewport::drawTile(const Scene& scene, const Camera& camera) {
    const double pixels = kFrameMs * 1e6 / (ns_per_pixel_ * scene.render.samples);
    const int rows = std::clamp(static_cast<int>(pixels / full_.x), 1, full_.y - next_row_);
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(0, next_row_, full_.x, rows);
    const bool drawn = draw(scene, camera, full_);
    const int end = next_row_ + rows;
    const int shown = (end == full_.y ? size_.y : static_cast<int>((end - 0.5) * size_.y / full_.y + 0.5)) - shown_row_;
    if (drawn) {
        gl.Scissor(corner_.x, corner_.y + shown_row_, size_.x, shown);
        renderer_->present(corner_, size_);
    }
    gl.Disable(GL_SCISSOR_TEST);
    if (!drawn) {
        refined_ = !why_.empty();
        return;
    }
    keepShown(corner_ + glm::ivec2{0, shown_row_}, {size_.x, shown});
    // The rows differ in what they cost: the estimate follows quickly.
    const double ns = ms_ * 1e6 / (static_cast<double>(full_.x) * rows * scene.render.samples);
    ns_per_pixel_ = std::clamp(0.5 * (ns_per_pixel_ + ns), 1.0, 1e7);
    next_row_ = end, shown_row_ += shown, refining_ms_ += ms_;
    if (next_row_ >= full_.y) refined_ = true, drawn_ = full_, shown_ms_ = refining_ms_;
}

/// Answers what a picture takes, counted at a size that a frame has time for, once the program that counts is there.
void Viewport::count(const Scene& scene, const Camera& camera, PictureState& state) {
    if (put_off_ || renderer_->compiling()) return;
    const glm::ivec2 size = sizeWithin(full_, kFrameMs * 1e6 / ns_per_pixel_);
    Measured measured;
    state.counts = renderer_->measure(scene, camera, Raster{size_, size}, measured);
    state.count_wanted = renderer_->putOff();
    if (state.count_wanted || !state.counts.empty()) return;
    const Counts& c = measured.counts;
    const double pixels = static_cast<double>(size.x) * size.y;
    const auto each = [&](std::uint64_t n) { return static_cast<double>(n) / pixels; };
    std::string asked, undecided;
    const auto add = [&](const char* kind, std::uint64_t Counts::ByKind::*of) {
        if (c.evaluations.*of > 0) asked += fmt::format(", {:.1f} {}", each(c.evaluations.*of), kind);
        if (c.rays.*of > 0) undecided += fmt::format(", {} of {} {} rays", c.undecided_rays.*of, c.rays.*of, kind);
    };
    add("shadow", &Counts::ByKind::shadow), add("soft shadow", &Counts::ByKind::soft);
    add("ambient", &Counts::ByKind::occlusion), add("reflected", &Counts::ByKind::reflection);
    state.counts = fmt::format("at {}x{}, evaluations a pixel: {:.1f} primary, {:.1f} normal{}; undecided: {} of {} pixels{}", size.x, size.y,
                               each(c.evaluations.primary), each(c.evaluations.normal), asked, c.pixels.undecided, size.x * size.y, undecided);
}

/// Some draws of the ledger, whole ones but small, while the picture is at rest.
void Viewport::fillLedger(PictureState& state) {
    if (!state.pricing || !state.ledger || !refined_ || put_off_) return;
    const double start = nowMs();
    priced_ = true;
    do state.pricing = state.ledger->step(*renderer_);
    while (state.pricing && !renderer_->putOff() && nowMs() - start < kFrameMs / 2);
    showKept();
}

/// The same of the sweep, which is made first: how large, a draw that counts says.
void Viewport::fillSweep(const Editor& editor, PictureState& state) {
    if (!(state.sweep_wanted || (state.sweeping && state.sweep)) || !refined_ || put_off_) return;
    const double start = nowMs();
    priced_ = true;
    if (state.sweep_wanted) {
        const PictureSweep::Affordable affordable = PictureSweep::affordable(editor.scene(), editor.camera(), size_, *renderer_);
        if (!affordable.put_off) {
            state.sweep_wanted = false, state.sweep_why = affordable.why, state.sweeping = affordable.why.empty();
            if (state.sweeping) state.sweep.emplace(editor.scene(), frameOf(editor.camera(), size_, affordable.size), affordable.plan);
        }
    } else {
        do state.sweeping = state.sweep->step(*renderer_);
        while (state.sweeping && !renderer_->putOff() && nowMs() - start < kFrameMs / 2);
    }
    showKept();
}

/// Each program is tried against the general one once, when nothing else is to be done, and dropped if it is the slower one.
void Viewport::tryProgram(const Scene& scene, const Camera& camera) {
    constexpr glm::ivec2 kTrialSize{160, 90};
    constexpr int kTrialRounds = 5;
    if (!trial_) {
        trial_due_ = false;
        if (!why_.empty() || tried_.contains(renderer_->textOf(scene))) return;
        trial_ = ownAgainstGeneral(scene, camera, kTrialSize, kTrialRounds, false);
    }
    priced_ = true;
    if (!trial_->step(*renderer_)) {
        if (ownIsSlower(trial_->price())) renderer_->preferGeneral(scene);
        tried_.insert(renderer_->textOf(scene));
        trial_.reset();
    }
    showKept();
}

void Viewport::show(const Editor& editor, glm::ivec2 window, glm::ivec2 corner, glm::ivec2 size, PictureState& state) {
    state.renderer = renderer_->rendererName();
    busy_ = false;
    if (window.x < 1 || window.y < 1) return;
    const bool moved = window != window_ || corner != corner_ || size != size_;
    if (window != window_) makeKept(window);
    corner_ = corner, size_ = size;
    gl.Viewport(0, 0, window.x, window.y);
    if (size.x < 1 || size.y < 1) return showKept();
    if (!std::exchange(begun_, true)) {
        busy_ = state.compiling = true;  // the panels come up before the first picture, which takes longer
        return showKept();
    }

    const Scene& scene = editor.scene();
    full_ = rasterOf(size, scene.render.scale).drawn;
    const double now = nowMs();
    const bool changed = moved || editor.revision() != drawn_revision_, compiled = put_off_ && !renderer_->compiling();
    showKept();
    errors_.follow(editor, size_, state);
    // Not between two tiles, which are of one picture.
    const bool mapped = !changed && !compiled && !put_off_ && why_.empty() && (refined_ || next_row_ == 0) && now - changed_at_ > kStillMs &&
                        errors_.work(editor, *renderer_, state);
    if (changed) drawn_revision_ = editor.revision(), changed_at_ = now;
    if (changed || compiled) {
        if (scene.render.samples == 1) {
            drawPreview(scene, editor.camera());
        } else {
            Scene quick = scene;
            quick.render.samples = 1;
            drawPreview(quick, editor.camera());
            refined_ = false;
        }
        if (!why_.empty()) refined_ = true;
    } else if (mapped) {
        priced_ = true;
        showKept();
    } else if (!refined_ && !put_off_ && now - changed_at_ > kStillMs) {
        drawTile(scene, editor.camera());
    }
    const bool last_stays = !why_.empty() || put_off_;
    if (last_stays && moved && !priced_) renderer_->present(corner_, size_), keepShown(corner_, size_);
    else if (last_stays) showKept();
    if (state.count_wanted) count(scene, editor.camera(), state);
    if (!mapped) fillLedger(state);
    if (!mapped && !state.pricing) fillSweep(editor, state);
    const bool measuring = state.pricing || state.sweep_wanted || state.sweeping, mapping = state.errors_wanted && !state.errors_shown && why_.empty();
    if (changed) trial_.reset(), trial_due_ = true;
    if ((trial_ || trial_due_) && refined_ && !put_off_ && !measuring && !mapping && now - changed_at_ > kTrialMs) tryProgram(scene, editor.camera());
    errors_.show(corner_, size_, state);
    state.compiling = put_off_ || state.count_wanted;
    busy_ = !refined_ || state.compiling || measuring || mapping || trial_ || trial_due_;
    state.drawn = drawn_, state.full = size_, state.ms = shown_ms_, state.why = why_;
    state.grid = renderer_->grid();
    state.refining = !refined_ && next_row_ > 0;
}

}  // namespace mb
