#pragma once
// The picture behind the panels. While something changes it is drawn as large as a frame's time allows; once nothing does,
// it is drawn again with all its pixels, a few rows of tiles a frame, and then not at all.
#include "core/render/renderer.h"
#include "gui/editor.h"
#include "gui/error_view.h"
#include "gui/panels.h"

#include <memory>

namespace mb {

class Viewport {
public:
    static constexpr double kFrameMs = 45;   // what a frame's drawing may take, so that the panels stay alive
    static constexpr double kStillMs = 150;  // without a change for so long, the picture is refined

    /// Needs the window's context current. With no compiler, a new program is waited for.
    explicit Viewport(std::unique_ptr<Compiler> compiler);
    ~Viewport();

    /// Draws what there is to draw of the editor's scene and shows it on framebuffer 0, whose size in pixels is `window`,
    /// in the rectangle of that corner (from the bottom left) and size. Any size will do, none included.
    void show(const Editor& editor, glm::ivec2 window, glm::ivec2 corner, glm::ivec2 size, PictureState& state);
    /// Whether the next call would draw anything new.
    bool busy() const { return busy_; }

private:
    void drawPreview(const Scene& scene, const Camera& camera);
    void drawTile(const Scene& scene, const Camera& camera);
    void fillLedger(PictureState& state);
    void fillSweep(const Editor& editor, PictureState& state);
    void tryProgram(const Scene& scene, const Camera& camera);
    void count(const Scene& scene, const Camera& camera, PictureState& state);
    bool draw(const Scene& scene, const Camera& camera, glm::ivec2 pixels);
    void keepShown(glm::ivec2 corner, glm::ivec2 size);
    void showKept();
    void makeKept(glm::ivec2 window);

    std::unique_ptr<Renderer> renderer_;
    Sheet kept_;                       // what is on the screen, without the panels
    glm::ivec2 window_{0}, corner_{0}, size_{0};
    std::uint64_t drawn_revision_ = 0;
    double changed_at_ = 0;            // ms
    double ns_per_pixel_ = 8000;       // of the last pictures; at first, of a scene that is not light
    glm::ivec2 full_{0};               // pixels that the picture has when it is refined: the scene's `scale` of size_
    glm::ivec2 drawn_{0};              // the size of the preview
    int next_row_ = 0, shown_row_ = 0; // of the refinement, from the bottom: to be drawn, and to be shown on the screen
    int compiled_ = 0;                 // programs there were when a picture was last drawn
    bool busy_ = true, refined_ = false, begun_ = false;
    std::optional<Pricing> trial_;     // of the scene's own program against the general one
    std::set<std::string> tried_;      // texts of programs that had theirs
    bool trial_due_ = false;           // the picture has changed since a trial was thought of
    ErrorView errors_;
    bool priced_ = false;              // the renderer's picture is the ledger's or another's, not the one shown
    bool put_off_ = false;             // the picture wanted waits for its program; the last one is shown
    double ms_ = 0, refining_ms_ = 0, shown_ms_ = 0;  // of the last draw, of the rows so far, of the picture shown
    std::string why_;
};

}  // namespace mb
