#pragma once
// Compiled and linked shader programs, and the OpenGL objects that live as long as their owner. All need a current context.
#include "core/render/compose.h"
#include "core/render/gl.h"

#include <memory>
#include <string>
#include <utility>

namespace mb {

/// A name of OpenGL's that is deleted with its owner.
template <void (*Delete)(GLuint)> class Owned {
public:
    Owned() = default;
    explicit Owned(GLuint name) : name_(name) {}
    Owned(Owned&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Owned& operator=(Owned&& other) noexcept {
        if (this != &other) reset(), name_ = std::exchange(other.name_, 0);
        return *this;
    }
    ~Owned() { reset(); }
    operator GLuint() const { return name_; }

private:
    void reset() {
        if (name_) Delete(name_);
        name_ = 0;
    }
    GLuint name_ = 0;
};
inline void deleteTexture(GLuint n) { gl.DeleteTextures(1, &n); }
inline void deleteBuffer(GLuint n) { glDeleteBuffers(1, &n); }
inline void deleteFramebuffer(GLuint n) { glDeleteFramebuffers(1, &n); }
inline void deleteVertexArray(GLuint n) { glDeleteVertexArrays(1, &n); }
inline void deleteShader(GLuint n) { glDeleteShader(n); }
inline void deleteProgram(GLuint n) { glDeleteProgram(n); }
using OwnedTexture = Owned<deleteTexture>;
using OwnedBuffer = Owned<deleteBuffer>;
using OwnedFramebuffer = Owned<deleteFramebuffer>;
using OwnedVertexArray = Owned<deleteVertexArray>;
using OwnedShader = Owned<deleteShader>;
using OwnedProgram = Owned<deleteProgram>;

struct Program {
    OwnedProgram name;
    std::string log;          // what the compiler said, in names of files; empty where it said nothing
    bool usable() const { return name != 0; }
    GLint uniform(const char* uniform) const { return glGetUniformLocation(name, uniform); }
};

/// Compiles the quad's vertex shader and this fragment shader, and binds the blocks of lib/blocks.glsl to their points. On
/// failure the program is not usable and the log says why.
Program makeProgram(const Composed& fragment);

/// Where the blocks of lib/blocks.glsl are bound.
enum class BlockPoint : GLuint { frame, leaves, branches, materials, lights, count };

/// The quad over the whole viewport that every pass draws.
class Quad {
public:
    Quad();
    void draw() const;

private:
    OwnedVertexArray array_;
    OwnedBuffer corners_;
};

}  // namespace mb
