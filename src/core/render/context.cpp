#include "core/render/context.h"

#include <cstdlib>

namespace mb {

std::unique_ptr<Context> makeHeadless(Headless which, std::string& why) {
    std::string osmesa, egl;
    if (which != Headless::egl)
        if (auto context = makeOsmesa(osmesa)) return context;
    if (which != Headless::osmesa)
        if (auto context = makeEgl(egl)) return context;
    why = osmesa + (osmesa.empty() || egl.empty() ? "" : "; ") + egl;
    return nullptr;
}

}  // namespace mb
