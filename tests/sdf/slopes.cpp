// No value of any tree is steeper than 1, and none much less steep than it may be; what breaks the first is named.
#include "core/sdf/steepness.h"
#include "sdf/random_scene.h"

#include <doctest/doctest.h>

#include <map>

using namespace mb;

namespace {

/// One object of each type, of about a metre; operators over a box or two.
std::vector<Scene> standardSet() {
    std::vector<Scene> all;
    for (const Primitive& row : primitives()) {
        Object o;
        o.type = &row, o.numbers = initialNumbers(row);
        all.emplace_back().objects.push_back(o);
    }
    for (const Operator& row : operators()) {
        Scene& scene = all.emplace_back();
        Object o;
        o.type = &row, o.numbers = initialNumbers(row), o.rot = {10, 20, 30};
        if (row.blends) o.numbers[0] = 0.3;
        scene.objects.push_back(o);
        addObject(scene, "box", {1, 1.4, 0.6, 0.1}, {0.1, 0, 0}, 0);
        if (row.max_children > 1) addObject(scene, "box", {0.5, 1, 1, 0}, {0.3, 0.3, 0}, 0);
    }
    return all;
}

constexpr double kRounding = 1e-9;

}  // namespace

TEST_CASE("no node of the standard set is steeper than 1, nor its bound more than 1.5 times what is found") {
    std::map<std::string, double> found;
    for (const Scene& scene : standardSet()) {
        const Tree tree = makeTree(scene);
        REQUIRE(tree.fault == "");
        for (const Steepest& s : steepest(tree, static_cast<std::size_t>(times(1'000'000)) / tree.program.size(), testSeed())) {
            CAPTURE(s.type);
            CHECK(s.slope <= 1 + kRounding);
            double& most = found[std::string(scene.objects[0].type->name)];
            most = std::max(s.object == 0 ? s.slope : 0, most);
        }
    }
    for (const auto& [type, slope] : found) {
        MESSAGE(type << ": the steepest of what was found is " << slope);
        if (asOperator(*findShapeType(type)).kind != Operator::Kind::copies || !findShapeType(type)->isOperator()) CHECK_MESSAGE(slope * 1.5 >= 1, type);
    }
}

TEST_CASE("a warp's steepness is at most 1.5 times what its space is stretched") {
    // Everywhere, the far field included, slopes of 1 are found; the bound is for what lies within the warp's reach.
    const glm::dvec3 size{1, 1.4, 0.6};
    for (const Operator& row : operators()) {
        if (!row.warp_by) continue;
        for (const double strength : {0.3, 1.0, 2.0}) {
            Scene scene;
            const int warp = addObject(scene, row.name, {initialNumbers(row)[0] * strength});
            addObject(scene, "box", {size.x, size.y, size.z, 0.1}, {0.1, 0, 0}, warp);
            const Tree tree = makeTree(scene);
            const LeafNumbers& k = tree.branches[0].numbers;
            Draw draw(52);
            double steepest_here = 0;
            for (int i = 0; i < times(300'000); ++i) {
                const glm::dvec3 p{draw.uniform(-k[1], k[1]), draw.uniform(-k[1], k[1]), draw.uniform(-k[1], k[1])};
                if (row.wrap<double>(0, {p.x, p.y, p.z}, k) > 0) continue;  // beyond its reach
                steepest_here = std::max(steepest_here, glm::length(slope(tree, p).gradient));
            }
            MESSAGE(row.name << " x" << strength << ": stretches by at most " << row.steepness(k) << ", found " << steepest_here * row.steepness(k));
            CHECK(steepest_here <= 1 + kRounding);
            CHECK(steepest_here * 1.5 >= 1);
        }
    }
}

TEST_CASE("no node of a random tree is steeper than 1") {
    Draw draw(51);
    for (int i = 0; i < times(60); ++i) {
        Scene scene;
        addRandom(scene, draw, {.levels = 1 + draw.below(8)});
        const Tree tree = makeTree(scene);
        if (tree.program.empty()) continue;
        for (const Steepest& s : steepest(tree, 20'000 / tree.program.size() + 100, static_cast<std::uint64_t>(i))) {
            CAPTURE(i);
            CHECK_MESSAGE(s.slope <= 1 + kRounding, s.type << " of object " << s.object << " at " << s.p.x << "," << s.p.y << "," << s.p.z);
        }
    }
}

TEST_CASE("a node that is too steep is named") {
    Scene scene;
    const int u = addObject(scene, "union", {0.2}), twist = addObject(scene, "twist", {0.5}, {}, u);
    addObject(scene, "box", {1, 2, 1, 0}, {}, twist);
    addObject(scene, "sphere", {0.5}, {1, 0, 0}, u);
    Tree tree = makeTree(scene);
    // The first in the order of the tape: what lies above it is steep because it is.
    const auto guilty = [&] {
        for (const Steepest& s : steepest(tree, 50'000, 1))
            if (s.slope > 1 + kRounding) return s;
        return Steepest{};
    };
    CHECK(guilty().type == "");
    for (Branch& b : tree.branches)
        if (b.op->warp_by) b.numbers[2] *= 2;
    CHECK(guilty().type == "twist");
    CHECK(guilty().object == static_cast<std::size_t>(twist));
}

TEST_CASE("a metre above a warp is a metre, and beside one too") {
    const auto surfaceAlong = [](const Scene& s, glm::dvec3 from, glm::dvec3 way) {
        const Tree tree = makeTree(s);
        double lo = 0, hi = 10;
        for (int i = 0; i < 60; ++i) {
            const glm::dvec3 p = from + 0.5 * (lo + hi) * way;
            (distance<double>(tree, {p.x, p.y, p.z}) < 0 ? lo : hi) = 0.5 * (lo + hi);
        }
        return lo;
    };
    // A ball in a union with something twisted, and a box that something twisted bites: they swell by the radius.
    Scene beside;
    const int swollen = addObject(beside, "round", {0.3}), both = addObject(beside, "union", {0}, {}, swollen);
    addObject(beside, "sphere", {0.5}, {5, 0, 0}, both);
    addObject(beside, "box", {1, 1, 1, 0}, {}, addObject(beside, "twist", {0.5}, {}, both));
    CHECK(surfaceAlong(beside, {5, 0, 0}, {1, 0, 0}) == doctest::Approx(0.8).epsilon(1e-9));
    Scene bitten;
    const int larger = addObject(bitten, "round", {0.3}), less = addObject(bitten, "subtract", {0}, {}, larger);
    addObject(bitten, "box", {2, 2, 2, 0}, {}, less);
    addObject(bitten, "box", {0.5, 0.5, 0.5, 0}, {}, addObject(bitten, "twist", {0.5}, {0, 1, 0}, less));
    CHECK(surfaceAlong(bitten, {0, -0.5, 0}, {1, 0, 0}) == doctest::Approx(1.3).epsilon(1e-9));
    // A blend moves no surface by more than a quarter of it.
    Scene blended;
    const int seam = addObject(blended, "union", {0.4});
    for (int i = 0; i < 2; ++i) addObject(blended, "box", {1, 1, 1, 0}, {}, addObject(blended, "twist", {0.5}, {}, seam));
    CHECK(surfaceAlong(blended, {0, 0, 0}, {0, 1, 0}) == doctest::Approx(0.6).epsilon(1e-9));

    // Along y from the middle of a slowly bent or twisted bar nothing is warped, though the whole value is eased.
    for (const std::string_view warp : {"twist", "bend"})
        for (const std::string_view wrap : {"round", "shell", "displace"}) {
            CAPTURE(warp);
            CAPTURE(wrap);
            Scene s;
            const int outer = addObject(s, wrap, wrap == "displace" ? std::initializer_list<double>{0.1, 0.25} : std::initializer_list<double>{0.1});
            const int inner = addObject(s, warp, {warp == "twist" ? 0.2 : 40}, {}, outer);
            addObject(s, "box", {2, 1, 0.6, 0}, {}, inner);
            const Tree tree = makeTree(s);
            const auto at = [&](double x, double y, double z) { return distance<double>(tree, {x, y, z}); };
            const auto crossing = [&](double lo, double hi, double x = 0, double z = 0) {
                for (int i = 0; i < 60; ++i) (at(x, 0.5 * (lo + hi), z) < 0 ? lo : hi) = 0.5 * (lo + hi);
                return lo;
            };
            if (wrap == "round") CHECK(crossing(0.2, 1) == doctest::Approx(0.6).epsilon(1e-9));
            if (wrap == "shell") {
                CHECK(crossing(0.45, 1) == doctest::Approx(0.5).epsilon(1e-9));
                CHECK(at(0, 0.41, 0) < 0);
                CHECK(at(0, 0.39, 0) > 0);
            }
            // Where sin x sin y sin z is largest the surface has sunk by most of the amplitude.
            if (wrap == "displace") {
                const double sunk = 0.5 - crossing(0.2, 1, 0.02, 0.02), wave = std::sin(0.5 * 3.14159265358979 * 0.02) * std::sin(0.5 * 3.14159265358979 * 0.02);
                CHECK(sunk == doctest::Approx(0.1 * wave * std::sin(0.5 * 3.14159265358979 * 0.5)).epsilon(0.05));
            }
        }
}
