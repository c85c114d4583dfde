#include "core/render/targets.h"

#include <algorithm>
#include <cassert>

namespace mb {
namespace {

OwnedTexture makeTexture(glm::ivec2 size, GLint kind, GLenum format) {
    GLuint name = 0;
    gl.GenTextures(1, &name);
    OwnedTexture texture(name);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, kind, size.x, size.y, 0, format, GL_FLOAT, nullptr);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

std::vector<float> readPixels(glm::ivec2 size, GLenum format, int channels) {
    const std::size_t row = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(channels);
    std::vector<float> pixels(row * static_cast<std::size_t>(size.y));
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(0, 0, size.x, size.y, format, GL_FLOAT, pixels.data());
    for (std::size_t top = 0, bottom = static_cast<std::size_t>(size.y) - 1; top < bottom; ++top, --bottom)
        std::swap_ranges(pixels.begin() + static_cast<std::ptrdiff_t>(top * row), pixels.begin() + static_cast<std::ptrdiff_t>((top + 1) * row),
                         pixels.begin() + static_cast<std::ptrdiff_t>(bottom * row));
    return pixels;
}

}  // namespace

Targets::Targets(glm::ivec2 size, int attachments) : size_(size) {
    GLuint name = 0;
    glGenFramebuffers(1, &name);
    framebuffer_ = OwnedFramebuffer(name);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    std::vector<GLenum> drawn;
    for (int i = 0; i < attachments; ++i) {
        textures_.push_back(makeTexture(size, GL_RGBA32F, GL_RGBA));
        drawn.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
        glFramebufferTexture2D(GL_FRAMEBUFFER, drawn.back(), GL_TEXTURE_2D, textures_.back(), 0);
    }
    depth_ = makeTexture(size, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_, 0);
    glDrawBuffers(static_cast<GLsizei>(drawn.size()), drawn.data());
    assert(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

void Targets::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl.Viewport(0, 0, size_.x, size_.y);
}

void Targets::clear() const {
    bind();
    gl.ClearColor(0, 0, 0, 0);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

std::vector<float> Targets::read(int attachment) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment));
    return readPixels(size_, GL_RGBA, 4);
}

std::vector<float> Targets::readDepth() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    return readPixels(size_, GL_DEPTH_COMPONENT, 1);
}

Sheet makeSheet(glm::ivec2 size, const std::uint8_t* rgb) {
    Sheet sheet;
    GLuint name = 0;
    gl.GenTextures(1, &name);
    sheet.texture = OwnedTexture(name);
    gl.BindTexture(GL_TEXTURE_2D, name);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.x, size.y, 0, GL_RGB, GL_UNSIGNED_BYTE, rgb);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glGenFramebuffers(1, &name);
    sheet.framebuffer = OwnedFramebuffer(name);
    glBindFramebuffer(GL_FRAMEBUFFER, sheet.framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, sheet.texture, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return sheet;
}

AddingUp::AddingUp() {
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_ONE);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_ALWAYS);
}
AddingUp::~AddingUp() {
    gl.Disable(GL_BLEND);
    gl.Disable(GL_DEPTH_TEST);
}

int maxTargetSize() {
    GLint size = 0, viewport[2] = {0, 0};
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &size);
    gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    return std::min({size, viewport[0], viewport[1]});
}

}  // namespace mb
