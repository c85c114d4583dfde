// What one moved body costs: the part of a frame that brings the grid up to date, among thousands of bodies that stay. A body
// that makes a small step and one that jumps across the scene take turns, each with a renderer of its own.
#include "bench/figures.h"
#include "core/render/gl.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb::bench {
namespace {

constexpr double kStep = 0.01;   // m, along x, back and forth
constexpr double kCorner = 0.7;  // m: the jump is from one corner of the scene's cube to the opposite one

/// What each turn took, the one that does not count among them.
struct Rebuilds {
    std::vector<double> ms, cells;
    int whole = 0;  // turns that laid all of the grid out anew
};

/// A scene whose middle body moves before each frame.
class Mover {
public:
    Mover(const Model& model, bool jumps) : scene_(sceneOf(model)), body_(model.objects.size() / 2), from_(scene_.objects[body_].pos), jumps_(jumps) {}

    /// Draws a frame, to the last pixel, and keeps what the renderer says its grid took.
    double frame(glm::ivec2 size) {
        there_ = !there_;
        scene_.objects[body_].pos = jumps_ ? glm::dvec3(there_ ? kCorner : -kCorner) : from_ + glm::dvec3{there_ ? kStep : 0, 0, 0};
        const double ms = timeOf([&] {
            why_ = renderer_.draw(scene_, scene_.cameras[0], size);
            gl.Finish();
        });
        const GridWork& work = renderer_.gridWork();
        rebuilds_.whole += work.whole;
        rebuilds_.ms.push_back(work.ms), rebuilds_.cells.push_back(static_cast<double>(work.cells));
        return ms;
    }
    const std::string& why() const { return why_; }
    const Rebuilds& rebuilds() const { return rebuilds_; }

private:
    Renderer renderer_;
    Scene scene_;
    std::size_t body_;
    glm::dvec3 from_;
    bool jumps_, there_ = false;
    std::string why_;
    Rebuilds rebuilds_;
};

}  // namespace

void movedFigure(Bench& bench) {
    const int n = bench.options.quick ? 100 : 10'000;
    bench.say(fmt::format("moved: one of {} primitives", n));
    const Model model = makeModel("union", n, bench.options.seed);
    Mover movers[] = {{model, false}, {model, true}};
    const Contender contenders[] = {[&] { return movers[0].frame(bench.options.size); }, [&] { return movers[1].frame(bench.options.size); }};
    Turns turns = takeTurns(contenders, bench.options.rounds);

    for (std::size_t i = 0; i < std::size(movers); ++i) {
        Json line = lineOf(bench, "moved", model);
        line["move"] = i == 0 ? "step" : "jump";
        if (const std::string& why = movers[i].why(); !why.empty()) {
            skip(bench, line, why);
            continue;
        }
        const Rebuilds& rebuilds = movers[i].rebuilds();
        turns.ms.emplace_back(rebuilds.ms.begin() + 1, rebuilds.ms.end());
        addRatio(line, turns, "rebuild/frame", turns.ms.size() - 1, i);
        line["ms"] = {{"rebuild", rounded(median(turns.ms.back()))}, {"frame", rounded(median(turns.ms[i]))}};
        line["cells"] = static_cast<long>(median({rebuilds.cells.begin() + 1, rebuilds.cells.end()}));
        line["whole"] = rebuilds.whole - 1;
        bench.print(line);
    }
}

}  // namespace mb::bench
