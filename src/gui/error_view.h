#pragma once
// The error view: in the picture's place a map of how far the picture is from the true one (core/accuracy/error_map.h).
#include "gui/panels.h"

namespace mb {

/// Whether it is wanted and what it has to say is in PictureState. Needs the window's context current.
class ErrorView {
public:
    /// Sees whether what it was asked for is still what is open: it goes off where the view is another or an object has changed, and
    /// the map is made again where the knobs alone have.
    void follow(const Editor& editor, glm::ivec2 picture, PictureState& io_state);
    /// Works at the map, for a slice or a draw of a small picture; says whether it did.
    bool work(const Editor& editor, Renderer& renderer, PictureState& io_state);
    /// Puts the map on framebuffer 0, into the rectangle of that corner and size.
    void show(glm::ivec2 corner, glm::ivec2 size, const PictureState& state) const;

private:
    const TruePictureWork* truthOf(const Editor& editor, PictureState& io_state);
    void draw(const Editor& editor, const TruePictureWork& truth, Renderer& renderer, PictureState& io_state);
    void upload(std::span<const glm::vec3> map, glm::ivec2 size);

    bool begun_ = false;
    Scene scene_;                            // that it was asked for
    Camera camera_;
    glm::ivec2 picture_{0};
    std::uint64_t revision_ = 0;             // last seen
    std::optional<TruePictureWork> truth_;   // where no sweep has it
    std::optional<Setting> setting_;         // that the map is of
    Sheet map_;
    glm::ivec2 size_{0};                     // of the map; 0: there is none
};

}  // namespace mb
