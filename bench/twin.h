#pragma once
// A scene drawn by a shader written by hand for it alone (bench/twin_*.glsl), which never had what the scene does not call for:
// what marchbox's own, put together for the scene, is measured against. Needs a current OpenGL context for all its life.
#include "core/render/blocks.h"
#include "core/render/program.h"
#include "core/render/targets.h"
#include "core/scene/scene.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mb::bench {

/// The scene and its shader are bench/NAME.txt and bench/NAME.glsl.
struct TwinRow {
    std::string_view name, what;
};
std::span<const TwinRow> twins();
/// The scene as marchbox draws it, from the first of its cameras.
Scene sceneOf(const TwinRow& row);

class Twin {
public:
    /// Compiles the shader and packs its numbers, which are the renderer's own, in the same blocks.
    Twin(const TwinRow& row, const Scene& scene, glm::ivec2 size);
    /// Why it cannot draw, or nothing.
    std::string fault() const { return program_.usable() ? std::string() : program_.log; }
    /// Draws a frame, its blocks filled anew, to the last pixel. There is one pass, and nothing is added up.
    void draw();
    const Targets& picture() const { return targets_; }

private:
    template <class Record> void fill(BlockPoint point, std::span<const Record> records);

    Program program_;
    GpuFrame frame_{};
    Packed packed_;
    Quad quad_;
    std::array<OwnedBuffer, static_cast<std::size_t>(BlockPoint::count)> blocks_;
    Targets targets_;
};

}  // namespace mb::bench
