// Shaders written by hand that never had an effect draw what marchbox's own do, and what a scene does not call for is not done.
#include "bench/figures.h"
#include "bench/twin.h"
#include "render/headless.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

using namespace mb;
using namespace mb::bench;

namespace {

/// The lines of the figure, by figure and scene, after the one about the run.
std::map<std::pair<std::string, std::string>, Json> linesOf(Renderer& renderer) {
    Options options;
    options.size = {64, 64}, options.quick = true;
    std::map<std::pair<std::string, std::string>, Json> lines;
    Bench bench{options, renderer, [&](const Json& line) { lines[{line["figure"], line.value("scene", "")}] = line; }, [](const std::string&) {}};
    runEffects(bench);
    return lines;
}

bool isCounted(const Effect& effect) { return !effect.ofMotion() && !effect.counts.empty(); }

}  // namespace

TEST_CASE("the twins draw marchbox's pictures to the bit, and what is left out is never used") {
    HeadlessRenderer headless;
    auto lines = linesOf(*headless.renderer);
    CHECK(lines.size() == 1 + 2 * twins().size());
    std::set<std::string> left_out;
    for (const TwinRow& row : twins()) {
        CAPTURE(row.name);
        const std::string scene(row.name);
        Json& line = lines[{"effects", scene}];
        REQUIRE(!line.contains("skipped"));
        CHECK(line["pixels_differ"] == 0);
        CHECK(line["ratio"]["median"] > 0);
        CHECK(line["limit"] == 1.02);
        for (const auto& name : line["rows_left_out"]) left_out.insert(name.get<std::string>());
        for (const auto& [effect, uses] : line["uses"].items()) CHECK_MESSAGE(uses == 0, effect);
        for (const auto& [effect, evaluations] : line["evaluations"].items()) CHECK_MESSAGE(evaluations == 0, effect);
        // Those counters can count: what is called for is used.
        for (const auto& [effect, uses] : line["uses_called"].items()) CHECK_MESSAGE(uses > 0, effect);
        CHECK(line["uses"].size() + line["uses_called"].size() == static_cast<std::size_t>(std::ranges::count_if(effects(), isCounted)));
        CHECK(lines[{"general", scene}]["pixels_differ"] == 0);
    }
    for (const Effect& effect : effects())
        if (!effect.ofMotion()) CHECK_MESSAGE(left_out.contains(std::string(effect.name)), "every twin has " << effect.name);
}

TEST_CASE("a twin draws another picture of other numbers: the equality is of pictures, not of blanks") {
    HeadlessRenderer headless;
    const glm::ivec2 size{48, 48};
    for (const TwinRow& row : twins()) {
        CAPTURE(row.name);
        Scene scene = sceneOf(row);
        scene.objects[1].pos.x += 0.5;
        Twin twin(row, scene, size);
        REQUIRE(twin.fault() == "");
        twin.draw();
        const auto differs = [&](const Scene& drawn) {
            const std::vector<glm::vec3> ours = headless.draw(drawn, drawn.cameras[0], size);
            const std::vector<float> theirs = twin.picture().read(0);
            std::size_t count = 0;
            for (std::size_t i = 0; i < ours.size(); ++i) count += ours[i] != glm::vec3{theirs[4 * i], theirs[4 * i + 1], theirs[4 * i + 2]};
            return count;
        };
        CHECK(differs(scene) == 0);
        CHECK(differs(sceneOf(row)) > 0);
    }
}
