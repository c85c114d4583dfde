#include "core/render/grid_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace mb {
namespace {

constexpr std::size_t kRow = 2048;
constexpr std::uint32_t kNoItems = 0xFFFFFFFFu, kBrickCell = 0xFFFFFFFFu;

std::size_t rowsFor(std::size_t texels) { return std::max<std::size_t>((texels + kRow - 1) / kRow, 1); }

OwnedTexture makeRows(std::size_t rows, GLint kind, GLenum format, GLenum type) {
    GLuint name = 0;
    gl.GenTextures(1, &name);
    OwnedTexture texture(name);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, kind, static_cast<GLsizei>(kRow), static_cast<GLsizei>(rows), 0, format, type, nullptr);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

void packCell(const GridCell& cell, std::uint32_t* out) {
    out[0] = cell.kind == GridCell::Kind::far ? kNoItems : cell.first;
    out[1] = cell.kind == GridCell::Kind::brick ? kBrickCell : std::bit_cast<std::uint32_t>(cell.empty ? cell.safe : 0.0f);
}

}  // namespace

/// The rows of a texture of two 32-bit numbers a texel, made anew where it has become too low.
void GridTextures::write(Rows& rows, const std::vector<std::uint32_t>& words, std::size_t first_row, std::size_t last_row) {
    const std::size_t wanted = words.size() / (2 * kRow);
    if (static_cast<std::size_t>(rows.rows) < wanted) {
        const std::size_t room = std::min<std::size_t>(wanted + wanted / 2, 16'384);
        rows.texture = makeRows(room, GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT);
        rows.rows = static_cast<int>(room);
        first_row = 0, last_row = wanted;
    }
    gl.BindTexture(GL_TEXTURE_2D, rows.texture);
    if (first_row < last_row)
        gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, static_cast<GLint>(first_row), static_cast<GLsizei>(kRow), static_cast<GLsizei>(last_row - first_row),
                         GL_RG_INTEGER, GL_UNSIGNED_INT, words.data() + first_row * 2 * kRow);
}

std::string GridTextures::upload(Grid& grid, const Packed& packed) {
    glActiveTexture(GL_TEXTURE0);
    const std::size_t cell_rows = rowsFor(grid.cells().size()), item_rows = rowsFor(grid.items().size());
    const std::size_t texels = (packed.leaves.size() + packed.branches.size()) * (sizeof(GpuNode) / sizeof(glm::vec4)) +
                               packed.materials.size() * (sizeof(GpuMaterial) / sizeof(glm::vec4));
    GLint most = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (std::max({cell_rows, item_rows, rowsFor(texels)}) > static_cast<std::size_t>(std::min(most, 16'384)))
        return fmt::format("the scene needs {} cells and {} items; this driver's textures hold {}", grid.cells().size(), grid.items().size(),
                           static_cast<std::size_t>(std::min(most, 16'384)) * kRow);

    // The cells: all of them, or the rows in which one has changed.
    std::vector<std::uint32_t> changed = grid.takeChangedCells();
    const bool whole = generation_ != grid.generation();
    generation_ = grid.generation();
    cell_words_.resize(cell_rows * 2 * kRow);
    if (whole) {
        for (std::size_t i = 0; i < grid.cells().size(); ++i) packCell(grid.cells()[i], &cell_words_[2 * i]);
        write(cells_, cell_words_, 0, cell_rows);
        items_sent_ = 0;
    } else if (!changed.empty()) {
        std::ranges::sort(changed);
        std::size_t row = changed.front() / kRow;
        for (const std::uint32_t i : changed) packCell(grid.cells()[i], &cell_words_[2 * i]);
        for (const std::uint32_t i : changed) {
            if (i / kRow == row) continue;
            write(cells_, cell_words_, row, row + 1);
            row = i / kRow;
        }
        write(cells_, cell_words_, row, row + 1);
    }

    // The items: those that came since.
    item_words_.resize(item_rows * 2 * kRow);
    for (std::size_t i = items_sent_; i < grid.items().size(); ++i) item_words_[2 * i] = grid.items()[i].word, item_words_[2 * i + 1] = grid.items()[i].joined;
    if (whole || items_sent_ < grid.items().size()) write(items_, item_words_, items_sent_ / kRow, item_rows);
    items_sent_ = grid.items().size();

    const std::size_t record_rows = rowsFor(texels);
    std::vector<glm::vec4> records(record_rows * kRow);
    auto put = [at = records.data()](const auto& source) mutable {
        std::memcpy(at, source.data(), source.size() * sizeof source[0]);
        at += source.size() * sizeof source[0] / sizeof(glm::vec4);
    };
    put(packed.leaves), put(packed.branches), put(packed.materials);
    if (static_cast<std::size_t>(records_.rows) < record_rows) {
        records_.texture = makeRows(record_rows, GL_RGBA32F, GL_RGBA, GL_FLOAT);
        records_.rows = static_cast<int>(record_rows);
    }
    gl.BindTexture(GL_TEXTURE_2D, records_.texture);
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, static_cast<GLsizei>(kRow), static_cast<GLsizei>(record_rows), GL_RGBA, GL_FLOAT, records.data());
    return {};
}

void GridTextures::bind(const Program& program) const {
    const std::pair<const char*, const Rows*> kSamplers[] = {{"grid_cells", &cells_}, {"grid_items", &items_}, {"records", &records_}};
    GLenum unit = 1;  // 0 is for what a pass reads of its own
    for (const auto& [name, rows] : kSamplers) {
        glActiveTexture(GL_TEXTURE0 + unit);
        gl.BindTexture(GL_TEXTURE_2D, rows->texture);
        glUniform1i(program.uniform(name), static_cast<GLint>(unit++));
    }
    glActiveTexture(GL_TEXTURE0);
}

void placeGrid(const Grid& grid, glm::dvec3 origin, GpuFrame& frame) {
    const auto relative = [&](const std::array<double, 3>& p) { return glm::vec4(glm::vec3(glm::dvec3(p[0], p[1], p[2]) - origin), 0); };
    const bool any = grid.dims().x > 0 && grid.exact() == Grid::Exact::near_surfaces;
    // Of a grid without cells every point lies outside.
    frame.grid_corner = grid.dims().x > 0 ? glm::vec4(glm::vec3(grid.corner() - origin), static_cast<float>(grid.cellSize()))
                                          : glm::vec4(glm::vec3(static_cast<float>(kEmptyDistance)), 1);
    frame.box_lo = any ? relative(grid.box().lo) : glm::vec4(static_cast<float>(kEmptyDistance));
    frame.box_hi = any ? relative(grid.box().hi) : glm::vec4(static_cast<float>(kEmptyDistance));
    frame.grid_size = {grid.dims(), static_cast<int>(grid.outer().count)};
}

}  // namespace mb
