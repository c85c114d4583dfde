#pragma once
// OpenGL 3.3 core, whoever provides it: OSMesa, EGL or a window. Functions newer than OpenGL 1.1 come from GLEW; those of
// 1.1, which GLEW leaves to the linker, from the table `gl`, filled by the same loader (loader.h says why).
#include <GL/glew.h>

namespace mb {

#define MB_GL11(X)                                                                                                     \
    X(BindTexture) X(BlendFunc) X(Clear) X(ClearColor) X(ColorMask) X(DeleteTextures) X(DepthFunc) X(DepthMask)        \
    X(Disable) X(DrawArrays) X(DrawBuffer) X(Enable) X(Finish) X(GenTextures) X(GetError) X(GetIntegerv) X(GetString)  \
    X(PixelStorei) X(ReadBuffer) X(ReadPixels) X(Scissor) X(TexImage2D) X(TexParameteri) X(TexSubImage2D) X(Viewport)

struct Gl11 {
#define MB_DECLARE(name) decltype(&::gl##name) name = nullptr;
    MB_GL11(MB_DECLARE)
#undef MB_DECLARE
};
extern Gl11 gl;

}  // namespace mb
