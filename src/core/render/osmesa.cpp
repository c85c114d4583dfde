// Rendering into memory with Mesa's off-screen library. It left Mesa in version 25.1, so it is looked for when the program
// runs, and the few facts of its interface that are needed are stated here rather than in a header that may be missing.
#include "core/render/context.h"
#include "core/render/library.h"
#include "core/render/loader.h"

#include <array>

namespace mb {
namespace {

using OsContext = void*;

struct OsmesaLibrary : Library {
    OsContext (*create)(const int* attributes, OsContext share);
    void (*destroy)(OsContext);
    unsigned char (*make_current)(OsContext, void* buffer, unsigned type, int width, int height);
    AnyFunction (*get)(const char*);

    OsmesaLibrary() : Library("OSMesa", {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}) {
        find(create, "OSMesaCreateContextAttribs");
        find(destroy, "OSMesaDestroyContext");
        find(make_current, "OSMesaMakeCurrent");
        find(get, "OSMesaGetProcAddress");
    }
};

const OsmesaLibrary& library() {
    static const OsmesaLibrary loaded;
    return loaded;
}

class Osmesa final : public Context {
public:
    Osmesa(OsContext context, bool first) : context_(context), first_(first) {}
    ~Osmesa() override { library().destroy(context_); }
    Osmesa(const Osmesa&) = delete;
    Osmesa& operator=(const Osmesa&) = delete;

    std::string makeCurrent() override {
        constexpr unsigned kUnsignedByte = 0x1401;
        if (!library().make_current(context_, buffer_.data(), kUnsignedByte, 4, 4)) return "OSMesa: it cannot be made current";
        return first_ ? loadOpenGl(library().get) : std::string{};
    }
    void release() override { library().make_current(nullptr, nullptr, 0, 0, 0); }
    std::unique_ptr<Context> makeShared(std::string& why) override { return make(context_, why); }
    std::string_view name() const override { return "OSMesa"; }

    static std::unique_ptr<Context> make(OsContext share, std::string& why) {
        // Format RGBA, core profile, version 3.3.
        constexpr int kAttributes[] = {0x22, 0x1908, 0x33, 0x34, 0x36, 3, 0x37, 3, 0};
        const OsContext made = library().create(kAttributes, share);
        if (made) return std::make_unique<Osmesa>(made, !share);
        why = "OSMesa: it offers no OpenGL 3.3 core context";
        return nullptr;
    }

private:
    OsContext context_;
    bool first_;  // of those that share: it loads the functions
    std::array<unsigned char, 64> buffer_{};  // 4 by 4 pixels nobody draws to: pictures go to framebuffer objects
};

}  // namespace

std::unique_ptr<Context> makeOsmesa(std::string& why) {
    why = library().why();
    if (!why.empty()) return nullptr;
    auto context = Osmesa::make(nullptr, why);
    if (!context) return nullptr;
    why = context->makeCurrent();
    if (!why.empty()) return nullptr;
    return context;
}

}  // namespace mb
