// What the pruner and the grid leave out never shows; a grid that follows what moves is the one made anew.
#include "core/sdf/grid.h"
#include "core/sdf/prune.h"
#include "sdf/random_scene.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <set>
#include <tuple>

using namespace mb;

namespace {

sdf::Vec3<double> of(glm::dvec3 p) { return {p.x, p.y, p.z}; }
glm::dvec3 anywhere(Draw& draw, double reach) { return {draw.uniform(-reach, reach), draw.uniform(-reach, reach), draw.uniform(-reach, reach)}; }
/// In a ball; one in three at its rim, less what double rounds away.
glm::dvec3 inBall(Draw& draw, glm::dvec3 centre, double radius) {
    glm::dvec3 d{0};
    do d = anywhere(draw, 1);
    while (glm::length(d) > 1 || glm::length(d) < 0.01);
    constexpr double kRim = 1 - 1e-9;
    return centre + radius * kRim * (draw.oneIn(3) ? glm::normalize(d) : d);
}
bool same(std::span<const Instruction> a, std::span<const Instruction> b) {
    return std::ranges::equal(a, b, [](const Instruction& x, const Instruction& y) { return x.kind == y.kind && x.index == y.index; });
}
bool same(const GridCell& a, const GridCell& b) {
    return a.kind == b.kind && a.safe == b.safe && a.first == b.first && a.count == b.count && a.tape_first == b.tape_first &&
           a.tape_count == b.tape_count && a.empty == b.empty;
}
bool same(const Grid& a, const Grid& b) {
    return a.corner() == b.corner() && a.cellSize() == b.cellSize() && a.dims() == b.dims() &&
           std::ranges::equal(a.cells(), b.cells(), [](const GridCell& x, const GridCell& y) { return same(x, y); }) &&
           std::ranges::equal(a.items(), b.items(), [](const GridItem& x, const GridItem& y) { return x.word == y.word && x.joined == y.joined; });
}

Scene randomScene(Draw& draw, int most_levels) {
    Scene scene;
    for (int top = 1 + draw.below(3); top > 0; --top) addRandom(scene, draw, {.levels = 1 + draw.below(most_levels)});
    return scene;
}

/// Many objects in a row of heaps: spheres, boxes and a carved die, between two small balls at the corners that keep the box.
Scene heaps(Draw& draw, int objects) {
    Scene scene;
    addObject(scene, "sphere", {0.1}, {-6, -6, -6});
    addObject(scene, "sphere", {0.1}, {6, 6, 6});
    const int die = addObject(scene, "subtract", {0}), body = addObject(scene, "intersect", {0}, {}, die);
    addObject(scene, "box", {1.2, 1.2, 1.2, 0.06}, {}, body);
    addObject(scene, "sphere", {0.84}, {}, body);
    for (int i = 0; i < 12; ++i) addObject(scene, "sphere", {0.12}, 0.65 * glm::normalize(anywhere(draw, 1)), die);
    for (int i = 3; i < objects; ++i) {
        addObject(scene, draw.oneIn(2) ? "sphere" : "box", {draw.uniform(0.1, 0.4), 0.3, 0.5}, anywhere(draw, 5));
        scene.objects.back().rot = {draw.uniform(0, 90), draw.uniform(0, 90), 0};
    }
    return scene;
}

}  // namespace

TEST_CASE("a pruned tape has the whole tree's value to the bit, and its leaf, anywhere in the ball") {
    Draw draw(71);
    std::size_t points = 0, differ = 0, leaves = 0, kept = 0, all = 0;
    std::set<std::string_view> operators_seen;
    for (int i = 0; i < times(400); ++i) {
        const Scene scene = randomScene(draw, 5);
        const Tree tree = makeTree(scene);
        REQUIRE(tree.fault == "");
        if (tree.program.empty()) continue;
        for (const Branch& b : tree.branches) operators_seen.insert(b.op->name);
        Pruner pruner(tree);
        for (int ball = 0; ball < 8; ++ball) {
            // Twice: what is left of a ball is cut again in one within it.
            const glm::dvec3 centre = anywhere(draw, 3);
            const double radius = draw.logUniform(1e-3, 2);
            PartList once, twice;
            const double there = pruner.prune(partsOf(tree), centre, radius, once);
            const glm::dvec3 inner = inBall(draw, centre, 0.5 * radius);
            pruner.prune(once, inner, 0.5 * radius, twice);
            CHECK(there == std::min(distance<double>(tree, of(centre)), kEmptyDistance));
            for (const auto& [list, c, r] : {std::tuple{&once, centre, radius}, std::tuple{&twice, inner, 0.5 * radius}}) {
                const Tape tape = joined(*list);
                kept += tape.size(), all += tree.program.size();
                for (int n = 0; n < 12; ++n) {
                    const glm::dvec3 p = inBall(draw, c, r);
                    const Nearest<double> whole = nearest<double>(tree, of(p)), left = nearest<double>(tree, tape, of(p));
                    ++points, differ += distance<double>(tree, of(p)) != distance<double>(tree, tape, of(p)) || whole.distance != left.distance;
                    leaves += whole.leaf != left.leaf;
                }
            }
        }
    }
    MESSAGE(points << " points, " << differ << " distances and " << leaves << " leaves differ; " << 100.0 * static_cast<double>(kept) / static_cast<double>(all) << " % kept");
    CHECK(differ == 0);
    CHECK(leaves == 0);
    CHECK(kept * 2 < all);
    CHECK(operators_seen.size() >= 6);
}

namespace {

struct Asked {
    int lists = 0, bounds = 0, wrong = 0, over = 0, solid = 0;
};
Asked ask(const Grid& grid, Draw& draw, double reach, int points) {
    Asked a;
    for (int i = 0; i < points; ++i) {
        const glm::dvec3 p = anywhere(draw, reach);
        const double is = distance<double>(grid.tree(), of(p)), told = grid.distance(p);
        const glm::dvec3 at = (p - grid.corner()) / grid.cellSize();
        const glm::dvec3 dims(grid.dims());
        const bool inside = at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < dims.x && at.y < dims.y && at.z < dims.z;
        const bool list = grid.exact() == Grid::Exact::everywhere || (inside && !grid.tapeAt(p).empty());
        (list ? a.lists : a.bounds) += 1;
        a.wrong += list && told != is;
        // Outside, what has bounds is as near as its box, which may be further than a tree that rises slowly says.
        a.over += told > (inside ? is : std::max(is, distanceTo(grid.box(), p)));
        a.solid += !list && told <= 0 && told != is;  // outside, the parts without bounds may be solid
    }
    return a;
}

/// Calls look(cell, centre, half its side) for every cell that is no brick.
template <class F> void eachCell(const Grid& grid, F look) {
    const glm::ivec3 dims = grid.dims();
    for (int i = 0; i < dims.x * dims.y * dims.z; ++i) {
        const GridCell& cell = grid.cells()[static_cast<std::size_t>(i)];
        const glm::dvec3 lo = grid.corner() + grid.cellSize() * glm::dvec3(i % dims.x, i / dims.x % dims.y, i / dims.x / dims.y);
        if (cell.kind != GridCell::Kind::brick) {
            look(cell, lo + 0.5 * grid.cellSize(), 0.5 * grid.cellSize());
            continue;
        }
        const double side = grid.cellSize() / kBrick;
        for (int k = 0; k < kBrick * kBrick * kBrick; ++k)
            look(grid.cells()[cell.first + static_cast<std::size_t>(k)],
                 lo + side * (glm::dvec3(k % kBrick, k / kBrick % kBrick, k / kBrick / kBrick) + 0.5), 0.5 * side);
    }
}

}  // namespace

TEST_CASE("a grid tells the tree's distance where it keeps a list, and never more elsewhere") {
    for (const Grid::Exact exact : {Grid::Exact::near_surfaces, Grid::Exact::everywhere}) {
        Draw draw(72);
        Asked sum;
        for (int i = 0; i < times(60); ++i) {
            const Scene scene = i == 0 ? heaps(draw, 150) : randomScene(draw, 5);
            Grid grid(exact);
            grid.follow(makeTree(scene));
            const Asked a = ask(grid, draw, i % 3 == 0 ? 8 : 3, 2'000);
            CAPTURE(i);
            CHECK(a.wrong == 0);
            CHECK(a.over == 0);
            CHECK(a.solid == 0);
            sum.lists += a.lists, sum.bounds += a.bounds;
        }
        MESSAGE(sum.lists << " points in lists, " << sum.bounds << " told a bound");
        CHECK(sum.lists > 1'000);
        CHECK((sum.bounds > 1'000) == (exact == Grid::Exact::near_surfaces));
    }
}

TEST_CASE("an empty cell is empty, and as far around its middle as it says") {
    Draw draw(73);
    std::size_t empty = 0, cells = 0, solid = 0, nearer = 0;
    for (int i = 0; i < times(40); ++i) {
        Grid grid;
        grid.follow(makeTree(i == 0 ? heaps(draw, 100) : randomScene(draw, 5)));
        eachCell(grid, [&](const GridCell& cell, glm::dvec3 centre, double half) {
            ++cells;
            if (!cell.empty) return;
            ++empty;
            for (int n = 0; n < 6; ++n) {
                const auto side = [&] { return draw.member(-half, half); };  // corners and faces too
                solid += distance<double>(grid.tree(), of(centre + glm::dvec3{side(), side(), side()})) < 0;
                solid += distance<double>(grid.tree(), of(inBall(draw, centre, static_cast<double>(cell.safe)))) < 0;
            }
            nearer += distance<double>(grid.tree(), of(centre)) < static_cast<double>(cell.safe);
        });
    }
    MESSAGE(cells << " cells, " << empty << " empty; " << solid << " solid points in those, " << nearer << " nearer than told");
    CHECK(empty > cells / 10);
    CHECK(solid == 0);
    CHECK(nearer == 0);
}

TEST_CASE("a grid that follows is the one made anew") {
    constexpr int kObjects = 300, kPoints = 20'000, kMoves = 8;
    for (const Grid::Exact exact : {Grid::Exact::near_surfaces, Grid::Exact::everywhere}) {
        Draw draw(74);
        Scene scene = heaps(draw, kObjects);
        Grid grid(exact);
        const GridWork first = grid.follow(makeTree(scene));
        CHECK(first.whole);
        std::size_t most = 0, distances = 0, tapes = 0;
        for (int move = 0; move < kMoves; ++move) {
            // The die and others, a little and far.
            const std::size_t which = move % 4 == 0 ? 2 : scene.objects.size() - 1 - static_cast<std::size_t>(draw.below(280));
            Object& o = scene.objects[which];
            REQUIRE(o.parent == kNoParent);
            o.pos = move % 2 == 0 ? o.pos + anywhere(draw, 0.05) : anywhere(draw, 5);
            o.rot.y += 5;
            const Tree tree = makeTree(scene);
            const GridWork work = grid.follow(tree);
            CHECK_FALSE(work.whole);
            CHECK(work.cells > 0);
            most = std::max(most, work.cells);
            Grid anew(exact);
            anew.follow(tree);
            REQUIRE(anew.corner() == grid.corner());
            REQUIRE(anew.dims() == grid.dims());
            for (int i = 0; i < kPoints; ++i) {
                const glm::dvec3 p = anywhere(draw, 7);
                distances += grid.distance(p) != anew.distance(p);
                tapes += !same(grid.tapeAt(p), anew.tapeAt(p));
            }
        }
        MESSAGE("at most " << most << " of " << first.cells << " cells made again; " << distances << " distances and " << tapes << " tapes differ of " << kPoints * kMoves);
        CHECK(distances == 0);
        CHECK(tapes == 0);
        if (exact == Grid::Exact::near_surfaces) CHECK(most * 4 < first.cells);
        CHECK(grid.follow(makeTree(scene)).cells == 0);  // nothing moved
    }
}

TEST_CASE("what leaves the box, or has no bounds, is laid out anew") {
    Draw draw(75);
    Scene scene = heaps(draw, 40);
    addObject(scene, "plane", {0, 1, 0, -6});
    Grid grid;
    grid.follow(makeTree(scene));
    const auto moved = [&](std::size_t i, glm::dvec3 by) {
        scene.objects[i].pos += by;
        const bool whole = grid.follow(makeTree(scene)).whole;
        const Asked a = ask(grid, draw, 25, 5'000);
        CHECK(a.wrong + a.over + a.solid == 0);
        return whole;
    };
    CHECK_FALSE(moved(20, {0.1, 0, 0}));
    CHECK(moved(20, {20, 0, 0}));
    CHECK(moved(scene.objects.size() - 1, {0, 0.1, 0}));
    addObject(scene, "sphere", {0.2});
    CHECK(moved(20, {0, 0.1, 0}));
}

TEST_CASE("a grid is the same on every run") {
    Draw draw(76);
    for (int i = 0; i < 5; ++i) {
        const Tree tree = makeTree(i == 0 ? heaps(draw, 300) : randomScene(draw, 5));
        Grid a, b;
        a.follow(tree), b.follow(tree);
        CHECK(same(a, b));
    }
    Grid a, b;
    Scene scene = heaps(draw, 100);
    a.follow(makeTree(scene));
    scene.objects.back().pos.x += 0.1;
    b.follow(makeTree(scene));
    CHECK_FALSE(same(a, b));
}

TEST_CASE("a grid of nothing, of planes, of one, of many in one place and of one far away") {
    // For those in one place every cell keeps them all: the work is the cells' number by theirs, a few times over, and no more.
    constexpr std::uint64_t kMost = 60'000'000;
    Draw draw(77);
    std::vector<std::pair<std::string, Scene>> all(5);
    all[0].first = "nothing";
    all[1].first = "planes", addObject(all[1].second, "plane", {0, 1, 0, 0}), addObject(all[1].second, "plane", {1, 1, 0, -1});
    all[2].first = "one", addObject(all[2].second, "torus", {0.7, 0.2});
    all[3].first = "2,000 in one place";
    for (int i = 0; i < 2000; ++i) addObject(all[3].second, "sphere", {0.5});
    all[4].first = "one far away", all[4].second = heaps(draw, 50), addObject(all[4].second, "sphere", {0.5}, {1e6, 0, 0});
    for (const auto& [name, scene] : all)
        for (const Grid::Exact exact : {Grid::Exact::near_surfaces, Grid::Exact::everywhere}) {
            Grid grid(exact);
            const GridWork work = grid.follow(makeTree(scene));
            MESSAGE(name << ": " << work.evaluations << " evaluations, " << grid.cells().size() << " cells, " << grid.items().size() << " items");
            CHECK(work.evaluations < kMost);
            CHECK(grid.items().size() < kMost / 2);
            const Asked a = ask(grid, draw, 2, 2'000);
            CAPTURE(name);
            CHECK(a.wrong == 0);
            CHECK(a.over == 0);
            CHECK(a.solid == 0);
        }
}

TEST_CASE("a grid's scale changes its cells and no value; it is laid out anew, and the cells stay within their most") {
    Draw draw(78);
    const Tree tree = makeTree(heaps(draw, 300));
    for (const Grid::Exact exact : {Grid::Exact::near_surfaces, Grid::Exact::everywhere}) {
        Grid one(exact), again(exact);
        one.follow(tree);
        CHECK_FALSE(one.follow(tree, 1).whole);
        std::size_t fewer = 0;
        for (const double scale : {0.1, 0.5, 2.0, 4.0}) {
            CAPTURE(scale);
            CHECK(again.follow(tree, scale).whole);
            CHECK_FALSE(again.follow(tree, scale).whole);
            const Asked a = ask(again, draw, 7, 5'000);
            CHECK(a.wrong + a.over + a.solid == 0);
            CHECK(again.cellSize() == doctest::Approx(one.cellSize() / scale).epsilon(1e-9));
            CHECK(again.cells().size() > fewer);
            fewer = again.cells().size();
        }
        again.follow(tree, 1);
        CHECK(same(one, again));
    }

    // Ten thousand choose the most cells for themselves: however fine they shall be, there are no more than twice as many.
    Scene crowd;
    for (int i = 0; i < 12'000; ++i) addObject(crowd, "sphere", {0.02}, anywhere(draw, 5));
    const Tree many = makeTree(crowd);
    Grid chosen, finest;
    chosen.follow(many);
    const GridWork work = finest.follow(many, 4);
    const auto coarse = [](const Grid& grid) { return static_cast<double>(grid.dims().x) * grid.dims().y * grid.dims().z; };
    MESSAGE(coarse(chosen) << " cells, four times finer " << coarse(finest) << ", in " << work.ms << " ms, " << finest.cells().size() * sizeof(GridCell) / 1'000'000 << " MB with bricks");
    CHECK(coarse(finest) > 1.5 * coarse(chosen));
    CHECK(coarse(finest) < 1.3 * 65'536);  // the cells around the box come on top
}
