#include "core/render/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace mb {

glm::dvec2 samplePlace(int i, int n) {
    constexpr double kPlastic = 1.32471795724474602596;
    const glm::dvec2 at = 0.5 + glm::dvec2{1 / kPlastic, 1 / (kPlastic * kPlastic)} * (i - 0.5 * (n - 1));
    return at - glm::floor(at) - 0.5;
}

Renderer::Renderer(std::unique_ptr<Compiler> compiler) : compiler_(std::move(compiler)) {
    name_ = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
    gl.GetIntegerv(GL_MAX_UNIFORM_BLOCK_SIZE, &block_bytes_);
    for (GLuint point = 0; point < static_cast<GLuint>(BlockPoint::count); ++point) {
        GLuint name = 0;
        glGenBuffers(1, &name);
        blocks_.emplace_back(name);
    }
}

std::string Renderer::draw(const Scene& scene, const Camera& camera, const Raster& raster) {
    const Ready ready = prepare(scene, camera, raster, Variant::plain, camera.eye);
    if (!ready.program) return ready.why;
    if (picture_.size() != raster.drawn) picture_ = Targets(raster.drawn, kPictureAttachments);
    size_ = raster.size;
    picture_.clear();
    {
        const AddingUp adding;
        eachPass(scene, ready, [&] { quad_.draw(); });
    }
    return develop(ready);
}

/// Where the scene has a film, the picture is drawn once more through it; else there is nothing to do.
std::string Renderer::develop(const Ready& ready) {
    if (std::ranges::none_of(plan_.called, [](const Plan::Called& c) { return c.effect->at == "film"; })) {
        if (developed_.size().x > 0) developed_ = {};
        return {};
    }
    std::string why;
    const Program* film = program(Variant::develop, compose(Variant::develop, {}, plan_, choice_, ready.packed, ready.grid), ready.grid, why);
    if (!film) return why;
    if (developed_.size() != picture_.size()) developed_ = Targets(picture_.size(), 1);
    developed_.bind();
    glUseProgram(film->name);
    glActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, picture_.texture(0));
    glUniform1i(film->uniform("picture"), 0);
    quad_.draw();
    return {};
}

namespace {
std::vector<glm::vec3> dividedByWeight(const std::vector<float>& pixels) {
    std::vector<glm::vec3> picture(pixels.size() / 4);
    for (std::size_t i = 0; i < picture.size(); ++i)
        picture[i] = glm::vec3{pixels[4 * i], pixels[4 * i + 1], pixels[4 * i + 2]} / pixels[4 * i + 3];
    return picture;
}
}  // namespace

std::vector<glm::vec3> Renderer::readPicture() const { return enlarged(dividedByWeight(picture_.read(0)), picture_.size(), size_); }
std::vector<glm::vec3> Renderer::readShown() const { return enlarged(dividedByWeight(shown().read(0)), picture_.size(), size_); }

std::size_t Renderer::countUndecided() const {
    const std::vector<float> pixels = picture_.read(1);
    std::size_t count = 0;
    for (std::size_t i = 0; i < pixels.size(); i += 4) count += pixels[i] > 0;
    return count;
}

std::string Renderer::evaluate(const Scene& scene, const std::vector<glm::vec3>& points, std::vector<GpuSample>& out) {
    constexpr int kWidth = 1024;
    const glm::ivec2 size{kWidth, static_cast<int>((points.size() + kWidth - 1) / kWidth)};
    out.clear();
    if (points.empty()) return {};
    const Ready ready = prepare(scene, {}, rasterOf(size), Variant::evaluate, {});
    if (!ready.why.empty()) return ready.why;

    std::vector<glm::vec4> texels(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), glm::vec4{0});
    for (std::size_t i = 0; i < points.size(); ++i) texels[i] = {points[i], 0};
    const Targets input(size, 1), output(size, 2);
    gl.BindTexture(GL_TEXTURE_2D, input.texture(0));
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.x, size.y, GL_RGBA, GL_FLOAT, texels.data());
    output.clear();
    bindFrame(ready.frame);
    quad_.draw();

    // The texture's rows count from the bottom, the reading from the top.
    const std::vector<float> value = output.read(0), leaf = output.read(1);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t x = i % kWidth, y = static_cast<std::size_t>(size.y) - 1 - i / kWidth, at = 4 * (y * kWidth + x);
        out.push_back({value[at], leaf[at + 2], {value[at + 1], value[at + 2], value[at + 3]}, static_cast<int>(leaf[at]),
                       static_cast<int>(leaf[at + 1])});
    }
    return {};
}

void Renderer::present(glm::ivec2 corner, glm::ivec2 size) {
    if (picture_.size().x == 0) return;
    if (!present_.usable()) present_ = makeProgram(resolve(shaderLibrary(), "present.glsl"));
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.Viewport(corner.x, corner.y, size.x, size.y);
    glUseProgram(present_.name);
    glActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, shown().texture(0));
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, shown().size() == size ? GL_NEAREST : GL_LINEAR);
    glUniform1i(present_.uniform("picture"), 0);
    glUniform2f(present_.uniform("corner"), static_cast<float>(corner.x), static_cast<float>(corner.y));
    glUniform2f(present_.uniform("size"), static_cast<float>(size.x), static_cast<float>(size.y));
    quad_.draw();
}

Renderer::Ready Renderer::prepare(const Scene& scene, const Camera& camera, const Raster& raster, Variant variant, glm::dvec3 origin) {
    Ready ready;
    ready.stride = raster.stride;
    awaited_.clear();
    const int most = maxTargetSize();
    if (const glm::ivec2 size = raster.drawn; size.x < 1 || size.y < 1 || size.x > most || size.y > most) {
        ready.why = fmt::format("a picture of {}x{} pixels: each side must be between 1 and {}", size.x, size.y, most);
        return ready;
    }
    const Tree tree = makeTree(scene);
    if (ready.why = tree.fault; !ready.why.empty()) return ready;
    plan_ = makePlan(scene, tree, choice_);
    if (ready.why = plan_.refused; !ready.why.empty()) return ready;
    ready.packed = pack(scene, tree, origin);
    ready.frame = packFrame(scene, camera, raster, plan_.bounces);
    ready.frame.reach.w = ready.packed.reach;
    ready.frame.pass.w = static_cast<int>(tree.leaves.size() + tree.branches.size());
    ready.grid = usesGrid(tree);
    GridOnGpu& grid = variant == Variant::evaluate ? exact_ : marched_;
    grid_work_ = {};
    if (variant != Variant::evaluate) through_grid_ = ready.grid;
    if (ready.grid) {
        grid_work_ = grid.grid.follow(tree, scene.render.grid_scale);
        placeGrid(grid.grid, origin, ready.frame);
        if (ready.why = grid.buffers.upload(grid.grid, ready.packed); !ready.why.empty()) return ready;
    }
    if (ready.why = upload(ready); !ready.why.empty()) return ready;
    const Composed* text = &compose(variant, tree, plan_, choice_, ready.packed, ready.grid);
    if (variant == Variant::plain && !insists_ && slower_.contains(text->text)) {
        const Choice general{everyEffect(), {}};
        plan_ = makePlan(scene, tree, general);
        text = &compose(variant, tree, plan_, general, ready.packed, ready.grid);
    }
    ready.program = program(variant, *text, ready.grid, ready.why);
    if (!ready.program) return ready;
    glUseProgram(ready.program->name);
    if (ready.grid) grid.buffers.bind(*ready.program);
    return ready;
}

std::string Renderer::upload(const Ready& ready) {
    // Of several renderers in one context, the one that draws has its own blocks bound.
    for (GLuint point = 0; point < static_cast<GLuint>(BlockPoint::count); ++point)
        glBindBufferBase(GL_UNIFORM_BUFFER, point, blocks_[point]);
    const Packed& packed = ready.packed;
    const auto fill = [&](BlockPoint point, const auto& records, std::size_t room, const char* what) -> std::string {
        using Record = typename std::decay_t<decltype(records)>::value_type;
        const std::size_t limit = static_cast<std::size_t>(block_bytes_);
        if (room * sizeof(Record) > limit)
            return fmt::format("the scene has {} {}; this driver's uniform blocks hold {}", records.size(), what, limit / sizeof(Record));
        glBindBuffer(GL_UNIFORM_BUFFER, blocks_[static_cast<std::size_t>(point)]);
        glBufferData(GL_UNIFORM_BUFFER, static_cast<GLsizeiptr>(std::max<std::size_t>(room, 1) * sizeof(Record)), nullptr, GL_STREAM_DRAW);
        if (!records.empty())
            glBufferSubData(GL_UNIFORM_BUFFER, 0, static_cast<GLsizeiptr>(records.size() * sizeof(Record)), records.data());
        return {};
    };
    if (std::string why = fill(BlockPoint::lights, packed.lights, packed.lights.size(), "lights"); !why.empty()) return why;
    bindFrame(ready.frame);
    if (ready.grid) return {};
    if (std::string why = fill(BlockPoint::leaves, packed.leaves, packed.leaves.size(), "primitives"); !why.empty()) return why;
    if (std::string why = fill(BlockPoint::branches, packed.branches, packed.branches.size(), "operators"); !why.empty()) return why;
    return fill(BlockPoint::materials, packed.materials, packed.materials.size(), "materials");
}

void Renderer::bindFrame(const GpuFrame& frame) {
    glBindBuffer(GL_UNIFORM_BUFFER, blocks_[static_cast<std::size_t>(BlockPoint::frame)]);
    glBufferData(GL_UNIFORM_BUFFER, sizeof frame, &frame, GL_STREAM_DRAW);
}

}  // namespace mb
