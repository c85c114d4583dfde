#include "core/render/renderer.h"

#include "core/render/strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

namespace mb {
namespace {

constexpr std::size_t kMostPrograms = 32;  // alive at once
constexpr int kPictureAttachments = 2, kChannelAttachments = 8;

bool isTurned(const Tree& tree) {
    const auto turned = [](const auto& x) { return x.rotation != glm::dmat3(1); };
    return std::ranges::any_of(tree.leaves, turned) || std::ranges::any_of(tree.branches, turned);
}
bool isCarved(const Tree& tree) {
    return std::ranges::any_of(tree.branches, [](const Branch& b) { return b.op->first_only || b.op->intersects; });
}

}  // namespace

glm::dvec2 samplePlace(int i, int n) {
    if (n == 1) return {0, 0};
    constexpr double kPlastic = 1.32471795724474602596;
    const glm::dvec2 at = 0.5 + glm::dvec2{1 / kPlastic, 1 / (kPlastic * kPlastic)} * static_cast<double>(i);
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

std::string Renderer::draw(const Scene& scene, const Camera& camera, glm::ivec2 size) {
    const Ready ready = prepare(scene, camera, size, Variant::plain, camera.eye);
    if (!ready.program) return ready.why;
    if (picture_.size() != size) picture_ = Targets(size, kPictureAttachments);
    picture_.clear();
    {
        const AddingUp adding;
        eachPass(scene, ready.frame, [&] { quad_.draw(); });
    }
    return develop(ready);
}

/// Where the scene has a film, the picture is drawn once more through it; else there is nothing to do.
std::string Renderer::develop(const Ready& ready) {
    if (!plan_.has("tone mapping")) {
        if (developed_.size().x > 0) developed_ = {};
        return {};
    }
    std::string why;
    const Program* film = program(Variant::develop, compose(Variant::develop, {}, plan_, ready.packed, ready.grid), ready.grid, why);
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

std::vector<glm::vec3> Renderer::readPicture() const { return dividedByWeight(picture_.read(0)); }
std::vector<glm::vec3> Renderer::readShown() const { return dividedByWeight(shown().read(0)); }

std::size_t Renderer::countUndecided() const {
    const std::vector<float> pixels = picture_.read(1);
    std::size_t count = 0;
    for (std::size_t i = 0; i < pixels.size(); i += 4) count += pixels[i] > 0;
    return count;
}

namespace {

/// Adds what the counters of one pass say (shaders/fragment.glsl).
void addCounts(const Targets& channels, Counts& c) {
    const auto sums = [&](int attachment) {
        std::array<std::uint64_t, 4> sum{};
        const std::vector<float> texels = channels.read(attachment);
        for (std::size_t i = 0; i < texels.size(); ++i) sum[i % 4] += static_cast<std::uint64_t>(texels[i]);
        return sum;
    };
    const auto primary = sums(3);
    c.evaluations.primary += primary[0], c.touched.primary += primary[1], c.evaluations.normal += primary[2], c.touched.normal += primary[3];
    constexpr std::pair<int, std::uint64_t Counts::ByKind::*> kRays[] = {{4, &Counts::ByKind::shadow}, {5, &Counts::ByKind::reflection},
                                                                        {6, &Counts::ByKind::soft}, {7, &Counts::ByKind::occlusion}};
    for (const auto& [attachment, kind] : kRays) {
        const auto ray = sums(attachment);
        c.evaluations.*kind += ray[0], c.touched.*kind += ray[1], c.rays.*kind += ray[2], c.undecided_rays.*kind += ray[3];
    }
    const glm::ivec2 size = channels.size();
    c.rays.primary += static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
    const std::vector<float> ray = channels.read(2);
    for (std::size_t i = 3; i < ray.size(); i += 4) c.uses += static_cast<std::uint64_t>(ray[i]);
}

}  // namespace

std::string Renderer::measure(const Scene& scene, const Camera& camera, glm::ivec2 size, Measured& out, const Effect* counted) {
    Ready ready = prepare(scene, camera, size, Variant::counted, camera.eye);
    if (!ready.program) return ready.why;
    if (counted) ready.frame.counted.x = static_cast<int>(numberOf(*counted));
    channels_ = Targets(size, kChannelAttachments);
    out = {};
    const std::size_t pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);

    // The counters of every pass that a picture takes.
    eachPass(scene, ready.frame, [&] {
        channels_.clear();
        quad_.draw();
        addCounts(channels_, out.counts);
    });

    // The channels of the pixels' centres.
    GpuFrame centre = ready.frame;
    centre.pass = {0, 0, 1, centre.pass.w};
    bindFrame(centre);
    channels_.clear();
    quad_.draw();
    const std::vector<float> surface = channels_.read(1), ray = channels_.read(2);
    Channels& c = out.channels;
    c.size = size;
    c.depth.resize(pixels), c.normal.resize(pixels), c.object.resize(pixels), c.steps.resize(pixels), c.state.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        c.normal[i] = {surface[4 * i], surface[4 * i + 1], surface[4 * i + 2]};
        c.depth[i] = surface[4 * i + 3];
        c.object[i] = ray[4 * i], c.steps[i] = ray[4 * i + 1], c.state[i] = ray[4 * i + 2];
        out.counts.pixels.hit += c.state[i] == 1, out.counts.pixels.miss += c.state[i] == 0, out.counts.pixels.undecided += c.state[i] == 2;
    }
    return {};
}

std::string Renderer::evaluate(const Scene& scene, const std::vector<glm::vec3>& points, std::vector<GpuSample>& out) {
    constexpr int kWidth = 1024;
    const glm::ivec2 size{kWidth, static_cast<int>((points.size() + kWidth - 1) / kWidth)};
    out.clear();
    if (points.empty()) return {};
    const Ready ready = prepare(scene, {}, size, Variant::evaluate, {});
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
    glUniform1i(present_.uniform("picture"), 0);
    glUniform2f(present_.uniform("corner"), static_cast<float>(corner.x), static_cast<float>(corner.y));
    glUniform2f(present_.uniform("size"), static_cast<float>(size.x), static_cast<float>(size.y));
    quad_.draw();
}

Renderer::Ready Renderer::prepare(const Scene& scene, const Camera& camera, glm::ivec2 size, Variant variant, glm::dvec3 origin) {
    Ready ready;
    awaited_.clear();
    const int most = maxTargetSize();
    if (size.x < 1 || size.y < 1 || size.x > most || size.y > most) {
        ready.why = fmt::format("a picture of {}x{} pixels: each side must be between 1 and {}", size.x, size.y, most);
        return ready;
    }
    const Tree tree = makeTree(scene);
    if (ready.why = tree.fault; !ready.why.empty()) return ready;
    plan_ = makePlan(scene, tree, choice_);
    if (ready.why = plan_.refused; !ready.why.empty()) return ready;
    ready.packed = pack(scene, tree, origin);
    ready.frame = packFrame(scene, camera, size, plan_.bounces);
    ready.frame.reach.w = ready.packed.reach;
    ready.frame.pass.w = static_cast<int>(tree.leaves.size() + tree.branches.size());
    ready.grid = usesGrid(tree);
    GridOnGpu& grid = variant == Variant::evaluate ? exact_ : marched_;
    grid_work_ = {};
    if (variant != Variant::evaluate) through_grid_ = ready.grid;
    if (ready.grid) {
        grid_work_ = grid.grid.follow(tree);
        placeGrid(grid.grid, origin, ready.frame);
        if (ready.why = grid.buffers.upload(grid.grid, ready.packed); !ready.why.empty()) return ready;
    }
    if (ready.why = upload(ready); !ready.why.empty()) return ready;
    ready.program = program(variant, compose(variant, tree, plan_, ready.packed, ready.grid), ready.grid, ready.why);
    if (!ready.program) return ready;
    glUseProgram(ready.program->name);
    if (ready.grid) grid.buffers.bind(*ready.program);
    return ready;
}

bool Renderer::usesGrid(const Tree& tree) const {
    const auto grid = numberOf(effectNamed("grid"));
    if (evaluation_ == Evaluation::straight || choice_.off[grid]) return false;
    return evaluation_ == Evaluation::grid || tree.leaves.size() > kStraightLeaves;
}

Composed Renderer::compose(Variant variant, const Tree& tree, const Plan& plan, const Packed& packed, bool grid) const {
    const Sizes sizes{packed.leaves.size(), packed.branches.size(), packed.materials.size(), packed.lights.size(), !grid || isTurned(tree),
                      isCarved(tree)};
    Texts texts = library_;
    if (variant != Variant::develop) texts["scene.glsl"] = grid ? gridGlsl(tree, choice_.on) : sceneGlsl(tree);
    putEffects(texts, plan);
    const std::string_view story = variant == Variant::evaluate ? "evaluate.glsl" : variant == Variant::develop ? "develop.glsl" : "fragment.glsl";
    Composed whole = resolve(texts, story, head(plan, sizes, variant == Variant::counted, grid));
    if (const auto known = std::ranges::find(stripped_, whole.text, &Stripped::from); known != stripped_.end()) {
        stripped_.splice(stripped_.begin(), stripped_, known);
    } else {
        Composed to = stripped(whole);
        stripped_.push_front({std::move(whole.text), std::move(to)});
        if (stripped_.size() > kMostPrograms) stripped_.pop_back();
    }
    return stripped_.front().to;
}

std::string Renderer::textOf(const Scene& scene) const {
    const Tree tree = makeTree(scene);
    return compose(Variant::plain, tree, makePlan(scene, tree, choice_), pack(scene, tree, {}), usesGrid(tree)).text;
}

const Program* Renderer::program(Variant variant, const Composed& composed, bool grid, std::string& why) {
    keepCompiled();
    const auto known = std::ranges::find(programs_, composed.text, &Cached::text);
    if (known != programs_.end()) {
        programs_.splice(programs_.begin(), programs_, known);
    } else if (compiler_ && (variant == Variant::plain || variant == Variant::counted)) {
        const bool adds = variant == Variant::plain;
        compiler_->want({composed, adds ? kPictureAttachments : kChannelAttachments, adds, grid});
        awaited_ = composed.text;
        return nullptr;
    } else {
        keep(composed.text, makeProgram(composed));
    }
    const Program& program = programs_.front().program;
    if (program.usable()) return &program;
    why = "the shader does not compile:\n" + program.log;
    return nullptr;
}

void Renderer::keep(std::string text, Program program) {
    if (programs_.size() >= kMostPrograms - (compiler_ ? Compiler::kHeld : 0)) programs_.pop_back();
    programs_.push_front({std::move(text), std::move(program)});
    ++compiled_;
}

void Renderer::keepCompiled() {
    if (!compiler_) return;
    if (auto done = compiler_->take()) keep(std::move(done->text), std::move(done->program));
}

bool Renderer::compiling() {
    keepCompiled();
    return putOff() && std::ranges::find(programs_, awaited_, &Cached::text) == programs_.end();
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

/// Calls `pass` for every sample of a pixel and every turn of lights, the frame's block set for it.
template <class F> void Renderer::eachPass(const Scene& scene, GpuFrame frame, F pass) {
    const int samples = scene.render.samples;
    for (int i = 0; i < samples; ++i) {
        const glm::dvec2 place = samplePlace(i, samples);
        frame.picture.z = static_cast<float>(place.x), frame.picture.w = static_cast<float>(place.y);
        for (const LightPass& lights : plan_.passes) {
            const bool first = lights.first == 0;
            frame.background.w = first ? 1.0f : 0.0f;
            frame.pass = {lights.first, lights.last, first, frame.pass.w};
            bindFrame(frame);
            pass();
        }
    }
}

}  // namespace mb
