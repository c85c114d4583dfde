// Which program draws a scene: its text, and the programs there are already.
#include "core/render/renderer.h"
#include "core/render/strip.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {
namespace {

constexpr std::size_t kMostPrograms = 32;  // alive at once

bool isTurned(const Tree& tree) {
    const auto turned = [](const auto& x) { return x.rotation != glm::dmat3(1); };
    return std::ranges::any_of(tree.leaves, turned) || std::ranges::any_of(tree.branches, turned);
}
bool isCarved(const Tree& tree) {
    return std::ranges::any_of(tree.branches, [](const Branch& b) { return b.op->first_only || b.op->intersects; });
}

}  // namespace

bool Renderer::usesGrid(const Tree& tree) const {
    if (evaluation_ == Evaluation::straight) return false;
    return evaluation_ == Evaluation::grid || tree.leaves.size() > kStraightLeaves;
}

const Composed& Renderer::compose(Variant variant, const Tree& tree, const Plan& plan, const Choice& choice, const Packed& packed, bool grid) const {
    const Sizes sizes{packed.leaves.size(), packed.branches.size(), packed.materials.size(), packed.lights.size(), !grid || isTurned(tree),
                      isCarved(tree)};
    const std::string_view story = variant == Variant::evaluate ? "evaluate.glsl" : variant == Variant::develop ? "develop.glsl" : "fragment.glsl";
    const std::string above = head(plan, sizes, variant == Variant::counted, grid);
    std::string scene;
    if (variant != Variant::develop) scene = grid ? gridGlsl(tree, choice.on) : sceneGlsl(tree);

    // Of what is above the story the switches say which effects are in it: with the scene's own text they say it all.
    std::string from = fmt::format("{}\n{}{}", story, above, scene);
    if (const auto known = std::ranges::find(composed_, from, &Known::from); known != composed_.end()) {
        composed_.splice(composed_.begin(), composed_, known);
    } else {
        Texts texts = library_;
        texts["scene.glsl"] = std::move(scene);
        putEffects(texts, plan);
        composed_.push_front({std::move(from), stripped(resolve(texts, story, above))});
        if (composed_.size() > kMostPrograms) composed_.pop_back();
    }
    return composed_.front().text;
}

std::string Renderer::textOf(const Scene& scene) const {
    const Tree tree = makeTree(scene);
    return compose(Variant::plain, tree, makePlan(scene, tree, choice_), choice_, pack(scene, tree, {}), usesGrid(tree)).text;
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

}  // namespace mb
