#pragma once
// What is drawn into: float textures with a depth buffer, read back row by row from the top.
#include "core/render/gl.h"
#include "core/render/program.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace mb {

/// RGBA32F colour attachments and a 32-bit depth buffer, all of one size.
class Targets {
public:
    Targets() = default;
    /// The current context's limit is the caller's to respect: see maxTargetSize.
    Targets(glm::ivec2 size, int attachments);
    glm::ivec2 size() const { return size_; }
    int attachments() const { return static_cast<int>(textures_.size()); }
    void bind() const;
    void clear() const;
    GLuint texture(int attachment) const { return textures_[static_cast<std::size_t>(attachment)]; }
    /// size.x · size.y RGBA pixels, the top row first.
    std::vector<float> read(int attachment) const;
    /// The depth buffer, the top row first.
    std::vector<float> readDepth() const;

private:
    glm::ivec2 size_{0};
    std::vector<OwnedTexture> textures_;
    OwnedTexture depth_;
    OwnedFramebuffer framebuffer_;
};

/// An 8-bit texture that is shown texel by texel, and a framebuffer to draw into it or to copy it from. `rgb`: what it holds at first, its
/// rows one behind the other; null: anything.
struct Sheet {
    OwnedTexture texture;
    OwnedFramebuffer framebuffer;
};
Sheet makeSheet(glm::ivec2 size, const std::uint8_t* rgb = nullptr);

/// As long as it lives, what is drawn is added to what is there, and the depth is the last pass's.
struct AddingUp {
    AddingUp();
    ~AddingUp();
    AddingUp(const AddingUp&) = delete;
    AddingUp& operator=(const AddingUp&) = delete;
};

/// The widest and highest picture the current context can draw into.
int maxTargetSize();

}  // namespace mb
