#pragma once
// A grid and the records its items name, as the buffer textures that shaders/lib/grid.glsl reads.
#include "core/render/blocks.h"
#include "core/render/program.h"
#include "core/sdf/grid.h"

namespace mb {

class GridBuffers {
public:
    /// Uploads what has changed since the last call, and the records, which change with the eye. Returns why it cannot.
    std::string upload(Grid& grid, const Packed& packed);
    /// Binds the textures to the units that the program's samplers then name.
    void bind(const Program& program) const;

private:
    /// A buffer that grows, and the texture through which a shader reads it.
    struct Store {
        OwnedBuffer buffer;
        OwnedTexture texture;
        std::size_t room = 0;  // bytes
    };
    bool reserve(Store& store, std::size_t bytes, GLenum texel);
    void writeCells(Grid& grid, bool whole);

    Store cells_, lists_, items_, records_;
    std::uint64_t generation_ = 0;
    std::size_t items_sent_ = 0;
};

/// The frame's members that say where the grid lies, relative to `origin`.
void placeGrid(const Grid& grid, glm::dvec3 origin, GpuFrame& frame);

}  // namespace mb
