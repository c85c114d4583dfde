#include "core/render/grid_buffers.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace mb {
namespace {

constexpr std::uint32_t kNoItems = 0xFFFFFFFFu, kWhole = 1;
constexpr std::size_t kBlock = kBrick * kBrick * kBrick;
constexpr std::size_t kLeastRoom = 6144;  // bytes
constexpr std::size_t kGap = 64;  // unchanged blocks that are sent again rather than begin a new piece

std::uint32_t ballOf(const GridCell& cell, std::uint32_t flag) { return (std::bit_cast<std::uint32_t>(cell.empty ? cell.safe : 0.0f) & ~kWhole) | flag; }
std::uint32_t listOf(const GridCell& cell) { return cell.kind == GridCell::Kind::far ? kNoItems : cell.first; }

std::size_t coarseCells(const Grid& grid) {
    return static_cast<std::size_t>(grid.dims().x) * static_cast<std::size_t>(grid.dims().y) * static_cast<std::size_t>(grid.dims().z);
}

template <class T> GLsizeiptr bytesOf(std::size_t n) { return static_cast<GLsizeiptr>(n * sizeof(T)); }

}  // namespace

/// Makes the buffer at least that large, with room to grow. Returns whether what it held is gone.
bool GridBuffers::reserve(Store& store, std::size_t bytes, GLenum texel) {
    GLuint name = 0;
    if (!store.buffer) {
        glGenBuffers(1, &name), store.buffer = OwnedBuffer(name);
        gl.GenTextures(1, &name), store.texture = OwnedTexture(name);
    }
    glBindBuffer(GL_TEXTURE_BUFFER, store.buffer);
    if (store.room >= bytes && store.room > 0) return false;
    // A multiple of three, never a power of two: software OpenGL has other code for those, and would compile anew where
    // a scene grows into one, or out of one.
    store.room = std::max(bytes + bytes / 2, kLeastRoom);
    glBufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(store.room), nullptr, GL_DYNAMIC_DRAW);
    gl.BindTexture(GL_TEXTURE_BUFFER, store.texture);
    glTexBuffer(GL_TEXTURE_BUFFER, texel, store.buffer);
    return true;
}

/// The blocks of all coarse cells, or the pieces in which some have changed.
void GridBuffers::writeCells(Grid& grid, bool whole) {
    const std::span<const GridCell> cells = grid.cells();
    const std::size_t blocks = coarseCells(grid);
    std::vector<std::uint32_t> changed = grid.takeChangedCells(), balls, lists;
    const std::size_t bytes = blocks * kBlock * sizeof balls[0];
    const bool cells_gone = reserve(cells_, bytes, GL_R32UI), lists_gone = reserve(lists_, bytes, GL_R32UI);
    const auto send = [&](std::size_t begin, std::size_t end) {
        balls.clear(), lists.clear();
        for (std::size_t i = begin; i < end; ++i) {
            const bool cut = cells[i].kind == GridCell::Kind::brick;
            for (std::size_t k = 0; k < kBlock; ++k) {
                const GridCell& cell = cut ? cells[cells[i].first + k] : cells[i];
                balls.push_back(ballOf(cell, cut ? 0 : kWhole)), lists.push_back(listOf(cell));
            }
        }
        for (const auto& [store, words] : {std::pair(&cells_, &balls), std::pair(&lists_, &lists)}) {
            glBindBuffer(GL_TEXTURE_BUFFER, store->buffer);
            glBufferSubData(GL_TEXTURE_BUFFER, bytesOf<std::uint32_t>(begin * kBlock), bytesOf<std::uint32_t>(words->size()), words->data());
        }
    };
    if (whole || cells_gone || lists_gone) return send(0, blocks);
    std::erase_if(changed, [blocks](std::uint32_t i) { return i >= blocks; });  // a brick's cells come with its coarse one
    std::ranges::sort(changed);
    for (std::size_t i = 0, next = 0; i < changed.size(); i = next) {
        for (next = i + 1; next < changed.size() && changed[next] - changed[next - 1] < kGap;) ++next;
        send(changed[i], changed[next - 1] + 1);
    }
}

std::string GridBuffers::upload(Grid& grid, const Packed& packed) {
    const std::size_t records = packed.leaves.size() * sizeof(GpuNode) + packed.branches.size() * sizeof(GpuNode) + packed.materials.size() * sizeof(GpuMaterial);
    const std::size_t cells = kBlock * coarseCells(grid);
    GLint most = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    if (std::max({cells, grid.items().size(), records / sizeof(glm::vec4)}) > static_cast<std::size_t>(most))
        return fmt::format("the scene needs {} cells, {} items and {} numbers; this driver's buffer textures hold {}", cells,
                           grid.items().size(), records / sizeof(float), most);

    const bool whole = generation_ != grid.generation();
    generation_ = grid.generation();
    writeCells(grid, whole);

    // The items: those that came since.
    const std::span<const GridItem> items = grid.items();
    if (reserve(items_, items.size_bytes(), GL_RG32UI) || whole) items_sent_ = 0;
    if (items_sent_ < items.size())
        glBufferSubData(GL_TEXTURE_BUFFER, bytesOf<GridItem>(items_sent_), bytesOf<GridItem>(items.size() - items_sent_), items.data() + items_sent_);
    items_sent_ = items.size();

    reserve(records_, records, GL_RGBA32F);
    GLintptr at = 0;
    const auto put = [&at](const auto& source) {
        const auto bytes = bytesOf<typename std::decay_t<decltype(source)>::value_type>(source.size());
        if (bytes > 0) glBufferSubData(GL_TEXTURE_BUFFER, at, bytes, source.data());
        at += bytes;
    };
    put(packed.leaves), put(packed.branches), put(packed.materials);
    return {};
}

GridBuffers::Settler::Settler()
    : program(makeProgram(resolve({{"settle.glsl", "#version 330 core\nuniform sampler2D picture;\nout vec4 color;\n"
                                                   "void main() { color = texelFetch(picture, ivec2(0), 0); }\n"}}, "settle.glsl"))) {}

void GridBuffers::Settler::draw() const {
    picture.bind();
    glUseProgram(program.name);
    glActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, picture.texture(0));
    gl.Enable(GL_RASTERIZER_DISCARD);
    quad.draw();
    gl.Disable(GL_RASTERIZER_DISCARD);
}

void GridBuffers::bind(const Program& program) {
    if (!settler_) settler_.emplace();
    settler_->draw();
    glUseProgram(program.name);
    const std::pair<const char*, const Store*> kSamplers[] = {{"grid_cells", &cells_}, {"grid_lists", &lists_}, {"grid_items", &items_}, {"records", &records_}};
    GLenum unit = 1;  // 0 is for what a pass reads of its own
    for (const auto& [name, store] : kSamplers) {
        glActiveTexture(GL_TEXTURE0 + unit);
        gl.BindTexture(GL_TEXTURE_BUFFER, store->texture);
        glUniform1i(program.uniform(name), static_cast<GLint>(unit++));
    }
    glActiveTexture(GL_TEXTURE0);
}

void placeGrid(const Grid& grid, glm::dvec3 origin, GpuFrame& frame) {
    const auto relative = [&](const std::array<double, 3>& p) { return glm::vec4(glm::vec3(glm::dvec3(p[0], p[1], p[2]) - origin), 0); };
    const bool any = grid.dims().x > 0 && grid.exact() == Grid::Exact::near_surfaces;
    frame.grid_corner = glm::vec4(glm::vec3(grid.corner() - origin), static_cast<float>(grid.cellSize()));
    frame.box_lo = any ? relative(grid.box().lo) : glm::vec4(static_cast<float>(kEmptyDistance));
    frame.box_hi = any ? relative(grid.box().hi) : glm::vec4(static_cast<float>(kEmptyDistance));
    frame.box_lo.w = static_cast<float>(kBrick / grid.cellSize());
    frame.grid_size = {grid.dims(), static_cast<int>(grid.outer().count)};
}

}  // namespace mb
