#include "bench/seed.h"

#include "bench/texts.h"

#include <fmt/format.h>
#include <glm/vec4.hpp>

#include <array>
#include <limits>

namespace mb::bench {
namespace {

// Behind the renderer's own blocks.
constexpr GLuint kObjectsPoint = static_cast<GLuint>(BlockPoint::count), kMaterialsPoint = kObjectsPoint + 1;

struct SeedObject {
    glm::vec4 centre, size;
};
struct SeedMaterial {
    glm::vec4 color, phong;
};

OwnedBuffer makeBlock(const Program& program, const char* name, GLuint point) {
    GLuint buffer = 0;
    glGenBuffers(1, &buffer);
    glBindBufferBase(GL_UNIFORM_BUFFER, point, buffer);
    glUniformBlockBinding(program.name, glGetUniformBlockIndex(program.name, name), point);
    return OwnedBuffer(buffer);
}

template <class Record> void fill(GLuint buffer, const std::vector<Record>& records) {
    glBindBuffer(GL_UNIFORM_BUFFER, buffer);
    glBufferData(GL_UNIFORM_BUFFER, static_cast<GLsizeiptr>(records.size() * sizeof(Record)), records.data(), GL_STREAM_DRAW);
}

void setVector(const Program& program, const char* name, glm::dvec3 v) {
    glUniform3f(program.uniform(name), static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
}

}  // namespace

std::string Seed::prepare() {
    for (const Part& part : model_.objects)
        if (part.op != Part::Op::solid || (part.solid.kind != Solid::Kind::sphere && part.solid.kind != Solid::Kind::box))
            return "the seed draws spheres and boxes";
    GLint room = 0;
    gl.GetIntegerv(GL_MAX_UNIFORM_BLOCK_SIZE, &room);
    if (model_.objects.size() * sizeof(SeedObject) > static_cast<std::size_t>(room))
        return fmt::format("the seed's uniform block would need {} bytes; this driver's hold {}",
                           model_.objects.size() * sizeof(SeedObject), room);

    Texts texts;
    for (const ShaderText& text : benchTexts()) texts[std::string(text.path)] = text.text;
    const std::string head = fmt::format("#define OBJECTS {}\n#define MATERIALS {}\n", model_.objects.size(), materials().size());
    program_ = makeProgram(resolve(texts, "seed.glsl", head));
    if (!program_.usable()) return program_.log;
    objects_ = makeBlock(program_, "Objects", kObjectsPoint);
    materials_ = makeBlock(program_, "Materials", kMaterialsPoint);
    targets_ = Targets(size_, 2);
    return {};
}

void Seed::fillBlocks() {
    std::vector<SeedObject> objects;
    for (const Part& part : model_.objects)
        objects.push_back({{part.solid.centre, part.solid.kind == Solid::Kind::box}, {part.solid.half, part.material}});
    std::vector<SeedMaterial> finishes;
    for (const Finish& finish : materials())
        finishes.push_back({{finish.color, kAmbient}, {kDiffuse, kSpecular, kReflected, kShininess}});
    fill(objects_, objects);
    fill(materials_, finishes);
}

void Seed::draw() {
    const View view = viewOf(model_.camera);
    fillBlocks();
    targets_.clear();
    glUseProgram(program_.name);
    glUniform1i(program_.uniform("objectsL"), static_cast<GLint>(model_.objects.size()));
    glUniform1i(program_.uniform("lightsL"), 1);
    setVector(program_, "lights", lightPosition(model_));
    setVector(program_, "lightCols", glm::dvec3{1});
    glUniform2f(program_.uniform("res"), static_cast<float>(size_.x), static_cast<float>(size_.y));
    setVector(program_, "eye", model_.camera.eye);
    setVector(program_, "right", view.right * view.half * (static_cast<double>(size_.x) / size_.y));
    setVector(program_, "up", view.up * view.half);
    setVector(program_, "forward", view.forward);
    glUniform1i(program_.uniform("parallel"), view.parallel);
    glUniform1f(program_.uniform("maxDist"), static_cast<float>(model_.far));
    quad_.draw();
    gl.Finish();
}

SeedPicture Seed::read() const {
    const std::vector<float> color = targets_.read(0), info = targets_.read(1);
    const std::size_t pixels = color.size() / 4;
    SeedPicture picture;
    for (std::size_t i = 0; i < pixels; ++i) {
        picture.color.push_back({color[4 * i], color[4 * i + 1], color[4 * i + 2]});
        picture.depth.push_back(info[4 * i] < 0 ? std::numeric_limits<float>::infinity() : info[4 * i]);
        picture.whole.push_back(info[4 * i + 1] > 0);
        picture.iterations.push_back(info[4 * i + 2]);
        picture.object.push_back(info[4 * i + 3]);
    }
    return picture;
}

}  // namespace mb::bench
