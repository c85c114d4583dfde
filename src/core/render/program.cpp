#include "core/render/program.h"

#include <fmt/format.h>

#include <array>
#include <iterator>

namespace mb {
namespace {

/// The log of a shader or a program, whichever `get` and `read` are for.
template <class Get, class Read> std::string infoLog(GLuint name, Get get, Read read) {
    GLint size = 0;
    get(name, GL_INFO_LOG_LENGTH, &size);
    std::string log(static_cast<std::size_t>(std::max(size, 0)), '\0');
    if (size > 0) read(name, size, nullptr, log.data());
    while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
    return log;
}

OwnedShader compile(GLenum kind, const std::string& text, std::string& log) {
    OwnedShader shader(glCreateShader(kind));
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    log = infoLog(shader, glGetShaderiv, glGetShaderInfoLog);
    return compiled ? std::move(shader) : OwnedShader();
}

}  // namespace

Program makeProgram(const Composed& fragment) {
    static const Composed vertex = resolve(shaderLibrary(), "vertex.glsl");
    Program program;
    std::string log;
    const OwnedShader v = compile(GL_VERTEX_SHADER, vertex.text, log);
    program.log = readableLog(vertex, log);
    const OwnedShader f = compile(GL_FRAGMENT_SHADER, fragment.text, log);
    if (!log.empty()) program.log += readableLog(fragment, log);
    if (!v || !f) return program;

    OwnedProgram linked(glCreateProgram());
    glAttachShader(linked, v);
    glAttachShader(linked, f);
    glLinkProgram(linked);
    GLint done = 0;
    glGetProgramiv(linked, GL_LINK_STATUS, &done);
    if (log = infoLog(linked, glGetProgramiv, glGetProgramInfoLog); !log.empty()) program.log += log + '\n';
    if (!done) return program;

    constexpr const char* kBlocks[] = {"FrameBlock", "LeafBlock", "BranchBlock", "MaterialBlock", "LightBlock"};
    static_assert(std::size(kBlocks) == static_cast<std::size_t>(BlockPoint::count));
    for (GLuint point = 0; point < std::size(kBlocks); ++point) {
        const GLuint block = glGetUniformBlockIndex(linked, kBlocks[point]);
        if (block != GL_INVALID_INDEX) glUniformBlockBinding(linked, block, point);
    }
    program.name = std::move(linked);
    return program;
}

Quad::Quad() {
    constexpr std::array<float, 12> kCorners = {-1, -1, 1, -1, -1, 1, -1, 1, 1, -1, 1, 1};
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    array_ = OwnedVertexArray(name);
    glGenBuffers(1, &name);
    corners_ = OwnedBuffer(name);
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, corners_);
    glBufferData(GL_ARRAY_BUFFER, sizeof kCorners, kCorners.data(), GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
}

void Quad::draw() const {
    glBindVertexArray(array_);
    gl.DrawArrays(GL_TRIANGLES, 0, 6);
}

}  // namespace mb
