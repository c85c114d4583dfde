#include "core/render/loader.h"

#include "core/render/gl.h"

#include <fmt/format.h>

#include <cstring>

namespace mb {

Gl11 gl;

namespace {
GetFunction g_get = nullptr;
constexpr GLenum kNoGlx = 3;  // GLEW's answer where there is no GLX: of no interest, if the functions are there
}  // namespace

std::string loadOpenGl(GetFunction get) {
    g_get = get;
    const char* missing = nullptr;
#define MB_LOAD(name)                                                          \
    gl.name = reinterpret_cast<decltype(gl.name)>(get("gl" #name));            \
    if (!gl.name) missing = "gl" #name;
    MB_GL11(MB_LOAD)
#undef MB_LOAD
    if (missing) return fmt::format("the OpenGL library lacks {}", missing);
    glewExperimental = GL_TRUE;
    const GLenum answer = glewInit();
    if (answer != GLEW_OK && !(answer == kNoGlx && glCreateShader)) {
        return fmt::format("GLEW: {}", reinterpret_cast<const char*>(glewGetErrorString(answer)));
    }
    while (gl.GetError() != GL_NO_ERROR) {}  // GLEW asks for extensions in a way that a core context counts as an error
    GLint major = 0, minor = 0;
    gl.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl.GetIntegerv(GL_MINOR_VERSION, &minor);
    if (major * 10 + minor < 33) return fmt::format("OpenGL {}.{} is older than the 3.3 this program needs", major, minor);
    return {};
}

}  // namespace mb

// GLX's own functions stay hidden: GLEW would call them with no display, and EGL's loader finds them where there is none.
extern "C" __attribute__((visibility("default"))) mb::AnyFunction glXGetProcAddressARB(const unsigned char* name) {
    const char* text = reinterpret_cast<const char*>(name);
    const bool of_glx = std::strncmp(text, "glX", 3) == 0;
    return mb::g_get && !of_glx ? mb::g_get(text) : nullptr;
}
