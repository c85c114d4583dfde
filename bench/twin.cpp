#include "bench/twin.h"

#include "bench/texts.h"
#include "core/scene/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace mb::bench {
namespace {

constexpr TwinRow kTwins[] = {
    {"twin_plain", "ambient light alone"},
    {"twin_lit", "diffuse light, hard shadows"},
    {"twin_mirror", "diffuse light, highlights, fields, reflections"},
};

std::string_view textNamed(std::string_view path) {
    const auto text = std::ranges::find(benchTexts(), path, &ShaderText::path);
    assert(text != benchTexts().end());
    return text->text;
}

}  // namespace

std::span<const TwinRow> twins() { return kTwins; }

Scene sceneOf(const TwinRow& row) {
    ReadResult read = readScene(textNamed(fmt::format("{}.txt", row.name)));
    assert(read.ok());
    return std::move(read.scene);
}

Twin::Twin(const TwinRow& row, const Scene& scene, glm::ivec2 size) : targets_(size, 2) {
    const std::string path = fmt::format("{}.glsl", row.name);
    Texts texts = shaderLibrary();
    texts[path] = textNamed(path);
    program_ = makeProgram(resolve(texts, path));

    const Camera& camera = scene.cameras[0];
    const Tree tree = makeTree(scene);
    packed_ = pack(scene, tree, camera.eye);
    frame_ = packFrame(scene, camera, rasterOf(size), makePlan(scene, tree).bounces);
    frame_.reach.w = packed_.reach;
    for (OwnedBuffer& block : blocks_) {
        GLuint name = 0;
        glGenBuffers(1, &name);
        block = OwnedBuffer(name);
    }
}

template <class Record> void Twin::fill(BlockPoint point, std::span<const Record> records) {
    const GLuint buffer = blocks_[static_cast<std::size_t>(point)];
    glBindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(point), buffer);
    glBufferData(GL_UNIFORM_BUFFER, static_cast<GLsizeiptr>(records.size_bytes()), records.data(), GL_STREAM_DRAW);
}

void Twin::draw() {
    fill(BlockPoint::frame, std::span<const GpuFrame>(&frame_, 1));
    fill(BlockPoint::leaves, std::span<const GpuNode>(packed_.leaves));
    fill(BlockPoint::materials, std::span<const GpuMaterial>(packed_.materials));
    if (!packed_.lights.empty()) fill(BlockPoint::lights, std::span<const GpuLight>(packed_.lights));
    targets_.clear();
    glUseProgram(program_.name);
    gl.Enable(GL_DEPTH_TEST);  // else no depth is written
    gl.DepthFunc(GL_ALWAYS);
    quad_.draw();
    gl.Disable(GL_DEPTH_TEST);
    gl.Finish();
}

}  // namespace mb::bench
