#include "gui/error_view.h"

#include "core/render/budget.h"
#include "core/render/picture.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {
namespace {

constexpr double kSliceMs = 15;
constexpr glm::ivec2 kAffordable{160, 90};  // pixels that are compared, where no sweep says how many

}  // namespace

void ErrorView::follow(const Editor& editor, glm::ivec2 picture, PictureState& io_state) {
    const bool begins = io_state.errors_wanted && !begun_;
    if (begun_ && !io_state.errors_wanted) io_state.errors_note.clear();
    begun_ = io_state.errors_wanted;
    if (begins) {
        scene_ = editor.scene(), camera_ = editor.camera(), picture_ = picture, revision_ = editor.revision();
        truth_.reset(), setting_.reset(), size_ = {0, 0};
        io_state.errors_shown = false, io_state.errors_note.clear();
    }
    if (!begun_) io_state.errors_shown = false;
    if (!begun_ || (revision_ == editor.revision() && picture_ == picture)) return;
    revision_ = editor.revision();
    if (picture_ != picture || !editor.stillShows(scene_, camera_)) {
        begun_ = io_state.errors_wanted = io_state.errors_shown = false;
        io_state.errors_note = "The error view went off: what is seen is no longer what it was of.";
    } else if (setting_ && !sameKnobs(*setting_, settingOf(editor.scene()), false)) {
        io_state.errors_shown = false;
    }
}

/// The sweep's, where it is of the same picture, or its own; null while there is none yet.
const TruePictureWork* ErrorView::truthOf(const Editor& editor, PictureState& io_state) {
    double done = 0;
    const PictureSweep* sweep = io_state.sweep ? &*io_state.sweep : nullptr;
    if (sweep && sweep->frame().size == picture_ / sweep->frame().stride && editor.stillShows(sweep->scene(), sweep->frame().camera)) {
        done = sweep->truth().progress();
        if (done >= 1) return &sweep->truth();
    }
    if (!io_state.sweeping) {
        if (!truth_) truth_.emplace(scene_, frameOf(camera_, picture_, kAffordable));
        if (!truth_->step(kSliceMs)) return &*truth_;
        done = truth_->progress();
    }
    io_state.errors_note = fmt::format("The true picture is being computed: {:.0f} %.", 100 * done);
    return nullptr;
}

bool ErrorView::work(const Editor& editor, Renderer& renderer, PictureState& io_state) {
    if (!begun_ || io_state.errors_shown) return false;
    if (const TruePictureWork* truth = truthOf(editor, io_state)) draw(editor, *truth, renderer, io_state);
    else if (io_state.sweeping) return false;  // the sweep is at it
    return true;
}

void ErrorView::draw(const Editor& editor, const TruePictureWork& truth, Renderer& renderer, PictureState& io_state) {
    Scene scene = editor.scene();
    scene.render.show_undecided = false;
    const Frame& frame = truth.picture().frame;
    DrawnPicture picture;
    Values<Cost> costs;
    if (const std::string why = drawn(renderer, scene, frame, picture, costs); !why.empty()) {
        begun_ = io_state.errors_wanted = false, io_state.errors_note = why;
        return;
    }
    if (renderer.putOff()) {
        io_state.errors_note = "Waiting for the program that counts.";
        return;
    }
    upload(errorMap(picture, truth.picture()), frame.size);
    setting_ = settingOf(scene), io_state.errors_shown = true;
    const Values<Error> errors = errorsOf(picture, truth.picture());
    const auto undecided = std::ranges::count(picture.channels.state, 2.0f);
    const std::string part = frame.stride == 1 ? "" : fmt::format(", each for {0} by {0} of the picture's", frame.stride);
    io_state.errors_note = fmt::format("Color error {:.2g} (1 is from black to white); {:.2g} % of the pixels show another surface; {} undecided. {} by {} pixels{}.", errors[Error::color],
                                       100 * errors[Error::state], undecided, frame.size.x, frame.size.y, part);
}

void ErrorView::upload(std::span<const glm::vec3> map, glm::ivec2 size) {
    map_ = makeSheet(size, encodeSrgb(map).data());
    size_ = size;
}

void ErrorView::show(glm::ivec2 corner, glm::ivec2 size, const PictureState& state) const {
    if (!state.errors_wanted || !begun_ || size_.x < 1) return;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, map_.framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    // The map's first row is its top.
    glBlitFramebuffer(0, size_.y, size_.x, 0, corner.x, corner.y, corner.x + size.x, corner.y + size.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace mb
