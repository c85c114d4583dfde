// A moved body is followed: no turn lays the grid out anew, and few of its cells are made again.
#include "bench/figures.h"
#include "render/headless.h"

using namespace mb;
using namespace mb::bench;

TEST_CASE("the figure `moved` has a line a move, with the rebuild's share of a frame") {
    HeadlessRenderer headless;
    Options options;
    options.quick = true, options.size = {64, 64}, options.only = {"moved"};
    std::vector<Json> lines;
    Bench bench{options, *headless.renderer, [&](const Json& line) { lines.push_back(line); }, [](const std::string&) {}};
    run(bench);
    REQUIRE(lines.size() == 3);
    for (const std::size_t i : {1u, 2u}) {
        const Json& line = lines[i];
        CAPTURE(line.dump());
        CHECK(line["figure"] == "moved");
        CHECK(line["move"] == (i == 1 ? "step" : "jump"));
        CHECK(line["rounds"] == options.rounds);
        CHECK(line["ratio_of"] == "rebuild/frame");
        CHECK(line["whole"] == 0);
        CHECK(line["cells"] > 0);
        CHECK(line["ms"]["rebuild"] > 0);
        CHECK(line["ms"]["rebuild"] < line["ms"]["frame"]);
        CHECK(line["ratio"]["min"] <= line["ratio"]["median"]);
        CHECK(line["ratio"]["max"] < 1);
    }
    CHECK(lines[1]["cells"] < lines[2]["cells"]);  // a jump leaves one place and comes to another
}
