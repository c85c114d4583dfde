#pragma once
// A grid and the records its items name, as the buffer textures that shaders/lib/grid.glsl reads.
#include "core/render/blocks.h"
#include "core/render/program.h"
#include "core/render/targets.h"
#include "core/sdf/grid.h"

#include <optional>

namespace mb {

class GridBuffers {
public:
    /// Uploads what has changed since the last call, and the records, which change with the eye. Returns why it cannot.
    std::string upload(Grid& grid, const Packed& packed);
    /// Makes the program the one in use and binds the textures to the units that its samplers then name. What is
    /// drawn into is another picture afterwards.
    void bind(const Program& program);

private:
    /// A buffer that grows, and the texture through which a shader reads it.
    struct Store {
        OwnedBuffer buffer;
        OwnedTexture texture;
        std::size_t room = 0;  // bytes
    };
    /// Draws nothing, with a program that reads a picture. Software OpenGL's code depends on how the picture before was read, which
    /// a buffer texture in its place leaves as it was: so it is always this one.
    struct Settler {
        Settler();
        void draw() const;
        Program program;
        Targets picture{{1, 1}, 1};
        Quad quad;
    };
    bool reserve(Store& store, std::size_t bytes, GLenum texel);
    void writeCells(Grid& grid, bool whole);

    Store cells_, lists_, items_, records_;
    std::optional<Settler> settler_;
    std::uint64_t generation_ = 0;
    std::size_t items_sent_ = 0;
};

/// The frame's members that say where the grid lies, relative to `origin`.
void placeGrid(const Grid& grid, glm::dvec3 origin, GpuFrame& frame);

}  // namespace mb
