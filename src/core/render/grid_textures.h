#pragma once
// A grid and the records its items name, as the textures that shaders/lib/grid.glsl reads.
#include "core/render/blocks.h"
#include "core/render/program.h"
#include "core/sdf/grid.h"

namespace mb {

class GridTextures {
public:
    /// Uploads what has changed since the last call, and the records, which change with the eye. Returns why it cannot.
    std::string upload(Grid& grid, const Packed& packed);
    /// Binds the textures to the units that the program's samplers then name.
    void bind(const Program& program) const;

private:
    /// A texture of rows of 2,048 texels, as high as it needs to be.
    struct Rows {
        OwnedTexture texture;
        int rows = 0;
    };
    void write(Rows& rows, const std::vector<std::uint32_t>& words, std::size_t first_row, std::size_t last_row);

    Rows cells_, items_, records_;
    std::uint64_t generation_ = 0;
    std::size_t items_sent_ = 0;
    std::vector<std::uint32_t> cell_words_, item_words_;
};

/// The frame's members that say where the grid lies, relative to `origin`.
void placeGrid(const Grid& grid, glm::dvec3 origin, GpuFrame& frame);

}  // namespace mb
