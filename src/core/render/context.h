#pragma once
// An OpenGL 3.3 core context to draw in: with no window through OSMesa or EGL, or a window's own.
#include <memory>
#include <string>
#include <string_view>

namespace mb {

class Context {
public:
    virtual ~Context() = default;
    /// Makes it the one that OpenGL's functions act on. Returns what is wrong, or nothing.
    virtual std::string makeCurrent() = 0;
    /// Leaves this thread without a context, so that it may become another's.
    virtual void release() = 0;
    /// A context for another thread that shares this one's textures, buffers and programs. Call it where this one is current,
    /// which it stays; the new one is not current anywhere, and its makeCurrent() finds OpenGL's functions loaded. Null with
    /// the reason in `why`. It must go before this one does.
    virtual std::unique_ptr<Context> makeShared(std::string& why) = 0;
    virtual std::string_view name() const = 0;  // "OSMesa", "EGL", "window"
};

enum class Headless { any, osmesa, egl };

/// A current context with no window: OSMesa, or EGL surfaceless where that is missing. Null with the reason in `why`,
/// one for each that was tried.
std::unique_ptr<Context> makeHeadless(Headless which, std::string& why);

// The two kinds; each is null with a reason where the library is missing.
std::unique_ptr<Context> makeOsmesa(std::string& why);
std::unique_ptr<Context> makeEgl(std::string& why);

}  // namespace mb
