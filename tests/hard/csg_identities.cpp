// Cases 24 to 27: empty results, boolean identities to the bit, and the limits of a blend.
#include "hard/oracle.h"

#include "sdf/random_scene.h"

#include <cstring>

using namespace mb;
using namespace mb::hard;

namespace {

constexpr glm::ivec2 kSize{160, 120};

/// Appends a copy of the scene's only tree below `parent` of another scene.
void graft(Scene& onto, const Scene& tree, int parent) {
    const int first = static_cast<int>(onto.objects.size());
    for (Object o : tree.objects) {
        o.id = onto.newId();
        o.parent = o.parent == kNoParent ? parent : o.parent + first;
        onto.objects.push_back(o);
    }
}

/// Written as in algebra: `of("union", {a, b})` is one tree.
Scene of(std::string_view op, std::initializer_list<const Scene*> children) {
    Scene s;
    const int o = addObject(s, op, {0});
    for (const Scene* child : children) graft(s, *child, o);
    return s;
}

struct Identity {
    const char* name;
    Scene left, right;
};
std::vector<Identity> identities(const Scene& a, const Scene& b, const Scene& c) {
    const auto uni = [](const Scene& x, const Scene& y) { return of("union", {&x, &y}); };
    const auto cut = [](const Scene& x, const Scene& y) { return of("intersect", {&x, &y}); };
    const auto sub = [](const Scene& x, const Scene& y) { return of("subtract", {&x, &y}); };
    return {{"A or A is A", uni(a, a), a},
            {"A and A is A", cut(a, a), a},
            {"A or B is B or A", uni(a, b), uni(b, a)},
            {"A and B is B and A", cut(a, b), cut(b, a)},
            {"or is associative", uni(uni(a, b), c), uni(a, uni(b, c))},
            {"and is associative", cut(cut(a, b), c), cut(a, cut(b, c))},
            {"a list is a nest", of("union", {&a, &b, &c}), uni(a, uni(b, c))},
            {"and distributes over or", cut(a, uni(b, c)), uni(cut(a, b), cut(a, c))},
            {"or distributes over and", uni(a, cut(b, c)), cut(uni(a, b), uni(a, c))},
            {"A or (A and B) is A", uni(a, cut(a, b)), a},
            {"A and (A or B) is A", cut(a, uni(a, b)), a},
            {"De Morgan: less both is less each in turn", sub(a, uni(b, c)), cut(sub(a, b), sub(a, c))},
            {"De Morgan: less what both share is less one or less the other", sub(a, cut(b, c)), uni(sub(a, b), sub(a, c))},
            {"less a list is less its union", of("subtract", {&a, &b, &c}), sub(a, uni(b, c))},
            {"less one, shared with another", cut(sub(a, b), c), sub(cut(a, c), b)}};
}

Scene randomTree(Draw& draw) {
    Scene s;
    addRandom(s, draw, {.levels = 3, .children = 3});
    return s;
}

std::uint64_t bits(double x) {
    std::uint64_t b = 0;
    x += 0.0;  // −0 and 0 are one distance
    std::memcpy(&b, &x, sizeof b);
    return b;
}

}  // namespace

TEST_CASE("case 24: a ball less itself, or less one a micrometre larger, is hit by no ray") {
    HeadlessRenderer headless;
    for (const double more : {0.0, 1e-6}) {
        Scene s;
        const int o = addObject(s, "subtract", {});
        addObject(s, "sphere", {1}, {}, o), addObject(s, "sphere", {1 + more}, {}, o);
        for (const glm::dvec3 eye : {glm::dvec3{0.3, 0.5, 3}, glm::dvec3{20, 3, 1}, glm::dvec3{0.1, 0.2, 0.1}}) {
            const auto pixels = headless.measure(s, cameraAt(eye, {0, 0, 0}, 60), kSize).counts.pixels;
            MESSAGE("less a ball larger by " << more << " m: " << pixels.hit << " hits, " << pixels.undecided << " undecided of " << kSize.x * kSize.y);
            CHECK(pixels.hit == 0);
        }
    }
}

TEST_CASE("case 24: what is less itself is not painted either; a thin wall is") {
    HeadlessRenderer headless;
    const auto add = [](Scene& s, bool ball, double radius, int parent) {
        if (ball) addObject(s, "sphere", {radius}, {}, parent);
        else addObject(s, "box", {2 * radius, 2 * radius, 2 * radius, 0}, {}, parent);
        s.objects.back().rot = {20, 30, 0};
    };
    const auto paintedBy = [&](const Scene& s, glm::dvec3 eye) {
        std::size_t painted = 0;
        for (const glm::vec3& c : headless.draw(s, cameraAt(eye, {0, 0, 0}, 60), kSize)) painted += c.x > 0;
        return painted;
    };
    for (const Evaluation way : {Evaluation::straight, Evaluation::grid})
        for (const bool ball : {true, false})
            for (const double wall : {0.0, -1e-6, 2e-5, 1e-4}) {  // twice the rounding error of 20 m, or none
                headless.renderer->setEvaluation(way);
                Scene whole, hollow;
                const int o = addObject(hollow, "subtract", {});
                add(whole, ball, 1, kNoParent), add(hollow, ball, 1, o), add(hollow, ball, 1 - wall, o);
                paint(whole, plain({1, 1, 1})), paint(hollow, plain({1, 1, 1}));
                std::size_t seen = 0, undecided = 0, solid = 0;
                for (const glm::dvec3 eye : {glm::dvec3{0.3, 0.5, 3}, glm::dvec3{20, 3, 1}, glm::dvec3{0.1, 0.2, 0.1}})
                    seen += paintedBy(hollow, eye), undecided += headless.renderer->countUndecided(), solid += paintedBy(whole, eye);
                MESSAGE(std::string(way == Evaluation::grid ? "through the grid, " : "") << std::string(ball ? "a ball" : "a box") << " with a wall of " << wall
                        << " m: " << seen << " pixels painted, " << solid << " of the whole, " << undecided << " undecided");
                CHECK(seen == (wall > 0 ? solid : 0));
            }
}

TEST_CASE("case 25: what two distant balls share is nothing, and soon known") {
    HeadlessRenderer headless;
    Scene s;
    s.world.background = {0.5, 0.25, 0.125};
    const int o = addObject(s, "intersect", {});
    for (const double x : {-5.0, 5.0}) addObject(s, "sphere", {1}, {x, 0, 0}, o);
    for (const glm::dvec3 eye : {glm::dvec3{0, 1, 12}, glm::dvec3{14, 0.3, 0.2}, glm::dvec3{0, 0, 0.1}, glm::dvec3{5, 0, 0}}) {
        const Camera camera = cameraAt(eye, {0, 0, 0}, 70);
        const Measured m = headless.measure(s, camera, kSize);
        float most = 0;
        for (const float steps : m.channels.steps) most = std::max(most, steps);
        MESSAGE("at most " << most << " evaluations a ray");
        CHECK(most <= 40);
        CHECK(m.counts.pixels.miss == static_cast<std::uint64_t>(kSize.x * kSize.y));
        for (const glm::vec3& c : headless.draw(s, camera, kSize)) REQUIRE(c == glm::vec3{0.5f, 0.25f, 0.125f});
    }
}

TEST_CASE("case 26: boolean identities hold to the bit, in double and in float") {
    Draw draw(26);
    int compared = 0;
    for (int round = 0; round < times(40); ++round) {
        const Scene a = randomTree(draw), b = randomTree(draw), c = randomTree(draw);
        for (const Identity& identity : identities(a, b, c)) {
            const Tree left = makeTree(identity.left), right = makeTree(identity.right);
            int unequal = 0;
            for (int i = 0; i < 150; ++i, ++compared) {
                const glm::dvec3 p{draw.uniform(-3, 3), draw.uniform(-3, 3), draw.uniform(-3, 3)};
                const sdf::Vec3<float> q{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
                unequal += bits(distance<double>(left, vec(p))) != bits(distance<double>(right, vec(p)));
                unequal += bits(static_cast<double>(distance<float>(left, q))) != bits(static_cast<double>(distance<float>(right, q)));
            }
            CHECK_MESSAGE(unequal == 0, identity.name << ": " << unequal << " of 300 values differ");
        }
    }
    MESSAGE(compared << " points: 0 units in the last place apart");
}

TEST_CASE("case 26: what is not an identity is told apart") {
    Draw draw(261);
    const Scene a = randomTree(draw), b = randomTree(draw);
    const Tree left = makeTree(of("subtract", {&a, &b})), right = makeTree(of("subtract", {&b, &a}));
    int unequal = 0;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 p{draw.uniform(-3, 3), draw.uniform(-3, 3), draw.uniform(-3, 3)};
        unequal += bits(distance<double>(left, vec(p))) != bits(distance<double>(right, vec(p)));
    }
    CHECK(unequal > 100);
}

TEST_CASE("case 27: a blend moves a seam by at most a quarter of it, and without one the operator is hard") {
    const Operator& join = asOperator(*findShapeType("union"));
    const double nan = std::nan("");
    Draw draw(27);
    for (const double k : {0.0, 1e-9, 1e-3, 1.0, -1.0, nan})
        for (int i = 0; i < times(20'000); ++i) {
            const double a = draw.uniform(-2, 2), b = draw.oneIn(3) ? a + draw.uniform(-1, 1) * 1e-3 : draw.uniform(-2, 2);
            const double moved = std::min(a, b) - join.fold<double>(a, b, k);
            REQUIRE(std::isfinite(moved));
            REQUIRE(moved >= 0);
            if (k > 0) REQUIRE(moved <= k / 4 + 4 * 0x1p-52 * (std::fabs(a) + std::fabs(b)));
            else REQUIRE(moved == 0);
            const float af = static_cast<float>(a), bf = static_cast<float>(b), moved_float = std::min(af, bf) - join.fold<float>(af, bf, k);
            REQUIRE(moved_float >= 0);
            if (!(k > 0)) REQUIRE(moved_float == 0);
        }
    for (const char* k : {"-1", "nan", "inf", "1e7"})
        CHECK(firstFault(std::string("marchbox 1\nobject type:union blend:") + k + "\n  object type:sphere radius:1\n").starts_with("2:"));
}

TEST_CASE("case 27: the GPU's blends are the CPU's at their limits") {
    HeadlessRenderer headless;
    Draw draw(271);
    std::vector<glm::vec3> points;
    for (int i = 0; i < 2000; ++i) points.emplace_back(draw.uniform(-2, 2), draw.uniform(-2, 2), draw.uniform(-2, 2));
    for (const double k : {0.0, 1e-9, 1e-3, 1.0, -1.0, std::nan("")}) {
        Scene s;
        const int o = addObject(s, "union", {k});
        addObject(s, "sphere", {1}, {-0.6, 0, 0}, o), addObject(s, "sphere", {0.8}, {0.6, 0.1, 0}, o);
        std::vector<GpuSample> gpu;
        REQUIRE(headless.renderer->evaluate(s, points, gpu) == "");
        double worst = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            REQUIRE(std::isfinite(gpu[i].distance));
            const glm::dvec3 p(points[i]);
            const double a = glm::distance(p, {-0.6, 0, 0}) - 1, b = glm::distance(p, {0.6, 0.1, 0}) - 0.8, h = std::max(k - std::fabs(a - b), 0.0);
            worst = std::max(worst, std::fabs(static_cast<double>(gpu[i].distance) - (std::min(a, b) - (k > 0 ? h * h / (4 * k) : 0))));
        }
        MESSAGE("blend " << k << ": the GPU is off by at most " << worst << " m");
        CHECK(worst <= 2e-6);  // 8 ulps of the coordinates' 2 m
    }
}
