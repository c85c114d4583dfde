#pragma once
// A context with no window and a renderer in it, for tests. One of a process at a time.
#include "core/render/context.h"
#include "core/render/renderer.h"

#include <doctest/doctest.h>

namespace mb {

struct HeadlessRenderer {
    explicit HeadlessRenderer(Headless which = Headless::any) : context(makeHeadless(which, why)) {
        REQUIRE_MESSAGE(context, why);
        renderer.emplace();
    }
    ~HeadlessRenderer() {
        CHECK(gl.GetError() == GL_NO_ERROR);
        renderer.reset();
    }
    Measured measure(const Scene& scene, const Camera& camera, glm::ivec2 size) {
        Measured measured;
        const std::string refused = renderer->measure(scene, camera, size, measured);
        REQUIRE_MESSAGE(refused.empty(), refused);
        return measured;
    }
    std::vector<glm::vec3> draw(const Scene& scene, const Camera& camera, glm::ivec2 size) {
        const std::string refused = renderer->draw(scene, camera, size);
        REQUIRE_MESSAGE(refused.empty(), refused);
        return renderer->readPicture();
    }

    std::string why;
    std::unique_ptr<Context> context;
    std::optional<Renderer> renderer;
};

}  // namespace mb
