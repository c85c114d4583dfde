// Rendering with no window and no display server through EGL's surfaceless platform (Mesa). The library is looked for
// when the program runs; only its header is needed to build.
#include "core/render/context.h"
#include "core/render/library.h"
#include "core/render/loader.h"

#if __has_include(<EGL/egl.h>)
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#endif

namespace mb {
#if __has_include(<EGL/egl.h>)
namespace {

struct EglLibrary : Library {
    decltype(&eglGetProcAddress) get;
    decltype(&eglGetPlatformDisplay) display;
    decltype(&eglInitialize) initialize;
    decltype(&eglBindAPI) bind;
    decltype(&eglChooseConfig) choose;
    decltype(&eglCreateContext) create;
    decltype(&eglDestroyContext) destroy;
    decltype(&eglMakeCurrent) make_current;

    EglLibrary() : Library("EGL", {"libEGL.so.1"}) {
        find(get, "eglGetProcAddress");
        find(display, "eglGetPlatformDisplay");
        find(initialize, "eglInitialize");
        find(bind, "eglBindAPI");
        find(choose, "eglChooseConfig");
        find(create, "eglCreateContext");
        find(destroy, "eglDestroyContext");
        find(make_current, "eglMakeCurrent");
    }
};

const EglLibrary& library() {
    static const EglLibrary loaded;
    return loaded;
}

class Egl final : public Context {
public:
    Egl(EGLDisplay display, EGLConfig config, EGLContext context, bool first)
        : display_(display), config_(config), context_(context), first_(first) {}
    ~Egl() override {
        if (first_) release();  // another's thread has left a shared one already
        library().destroy(display_, context_);
    }
    Egl(const Egl&) = delete;
    Egl& operator=(const Egl&) = delete;

    std::string makeCurrent() override {
        library().bind(EGL_OPENGL_API);
        if (!library().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) return "EGL: it cannot be made current";
        return first_ ? loadOpenGl(library().get) : std::string{};
    }
    void release() override { library().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
    std::unique_ptr<Context> makeShared(std::string& why) override { return make(display_, config_, context_, why); }
    std::string_view name() const override { return "EGL"; }

    static std::unique_ptr<Context> make(EGLDisplay display, EGLConfig config, EGLContext share, std::string& why) {
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        const EGLContext made = library().create(display, config, share, attributes);
        if (made != EGL_NO_CONTEXT) return std::make_unique<Egl>(display, config, made, share == EGL_NO_CONTEXT);
        why = "EGL: it offers no OpenGL 3.3 core context";
        return nullptr;
    }

private:
    EGLDisplay display_;
    EGLConfig config_;
    EGLContext context_;
    bool first_;  // of those that share: it loads the functions
};

}  // namespace

std::unique_ptr<Context> makeEgl(std::string& why) {
    const EglLibrary& egl = library();
    why = egl.why();
    if (!why.empty()) return nullptr;
    const EGLDisplay display = egl.display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || !egl.initialize(display, nullptr, nullptr) || !egl.bind(EGL_OPENGL_API)) {
        why = "EGL: it offers no surfaceless display";
        return nullptr;
    }
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!egl.choose(display, wanted, &config, 1, &count) || count < 1) {
        why = "EGL: it offers no configuration for OpenGL";
        return nullptr;
    }
    auto context = Egl::make(display, config, EGL_NO_CONTEXT, why);
    if (!context) return nullptr;
    why = context->makeCurrent();
    if (!why.empty()) return nullptr;
    return context;
}
#else
std::unique_ptr<Context> makeEgl(std::string& why) {
    why = "EGL: this build has none";
    return nullptr;
}
#endif

}  // namespace mb
