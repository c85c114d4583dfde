// What bodies weigh, and how they resist being turned: closed forms, the integral, and the laws both obey.
#include "physics/cut_cell.h"
#include "physics/hash.h"
#include "physics/mass_properties.h"
#include "scenes.h"
#include "sdf/draw.h"
#include "sdf/random_scene.h"

#include <doctest/doctest.h>

#include <functional>

using namespace mb;
using namespace mb::test;

namespace {

double trace(const glm::dmat3& m) { return m[0][0] + m[1][1] + m[2][2]; }
double largest(const glm::dmat3& m) {
    double most = 0;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) most = std::max(most, std::fabs(m[i][k]));
    return most;
}
/// The inertia of the same seen from elsewhere: a point mass at the centre is added (Steiner's theorem of parallel axes).
glm::dmat3 about(const MassProperties& m, glm::dvec3 point) {
    const glm::dvec3 r = m.centre - point;
    return m.inertia + m.volume * (glm::dmat3(glm::dot(r, r)) - glm::outerProduct(r, r));
}
/// b added to (or with −1 taken from) a.
MassProperties sum(const MassProperties& a, const MassProperties& b, double sign = 1) {
    MassProperties all;
    all.volume = a.volume + sign * b.volume;
    all.centre = (a.volume * a.centre + sign * b.volume * b.centre) / all.volume;
    all.inertia = about(a, all.centre) + sign * about(b, all.centre);
    return all;
}

struct Error {
    double volume, inertia, centre;  // of the volume, the mean moment, the radius of gyration
};
Error errorOf(const MassProperties& m, const MassProperties& truth) {
    return {std::fabs(m.volume / truth.volume - 1), largest(m.inertia - truth.inertia) / (trace(truth.inertia) / 3),
            glm::length(m.centre - truth.centre) / std::sqrt(trace(truth.inertia) / 2 / truth.volume)};
}
void checkNear(const MassProperties& m, const MassProperties& truth, double tolerance) {
    const Error e = errorOf(m, truth);
    CHECK(e.volume <= tolerance);
    CHECK(e.inertia <= 2 * tolerance);
    CHECK(e.centre <= 2 * tolerance);
    if (m.uncertain > 0) CHECK(std::fabs(m.volume - truth.volume) <= m.uncertain);
}

MassProperties of(std::string_view type, glm::dvec3 pos, std::initializer_list<double> numbers) {
    Scene s;
    add(s, type, pos, numbers);
    return massProperties(makeTree(s));
}
/// An operator's result, its children drawn by `fill` with the operator's index.
Tree treeOf(std::string_view type, std::initializer_list<double> numbers, const std::function<void(Scene&)>& fill, glm::dvec3 pos = {},
            glm::dvec3 rot = {}) {
    Scene s;
    add(s, type, pos, numbers).rot = rot;
    fill(s);
    return makeTree(s);
}

/// What is wrong with a tensor as one of inertia, or nothing. For matter lies at the places x that it is made from, and the mean
/// of x·xᵀ, trace/2 − inertia, has no negative value along any direction (the triangle inequality of the principal moments).
std::string inertiaViolation(const glm::dmat3& inertia) {
    const double size = trace(inertia) / 3;
    if (!(size > 0)) return "no positive trace";
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < i; ++k)
            if (inertia[i][k] != inertia[k][i]) return "not symmetric";
    const glm::dmat3 lies = (glm::dmat3(trace(inertia) / 2) - inertia) / size;
    constexpr double kRounding = -1e-9;
    // By its minors (Sylvester).
    for (int i = 0; i < 3; ++i) {
        const int k = (i + 1) % 3;
        if (lies[i][i] < kRounding) return "the triangle inequality does not hold";
        if (lies[i][i] * lies[k][k] - lies[i][k] * lies[k][i] < kRounding) return "the triangle inequality does not hold between axes";
    }
    return glm::determinant(lies) < kRounding ? "the triangle inequality does not hold along some direction" : "";
}

}  // namespace

TEST_CASE("the part of a cell behind a plane is that of its points, and opposite planes share the cell") {
    Draw draw(streamOf("cut cell"));
    for (int i = 0; i < times(200); ++i) {
        glm::dvec3 slope{draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)};
        for (int axis = 0; axis < 3; ++axis)
            if (draw.oneIn(4)) slope[axis] = draw.member(0, 1e-3);
        if (slope == glm::dvec3{0}) continue;
        const double level = draw.uniform(-1.1, 1.1) * (std::fabs(slope.x) + std::fabs(slope.y) + std::fabs(slope.z));
        const Cut cut = behindPlane(slope, level), rest = behindPlane(-slope, -level);
        CHECK(cut.part + rest.part == doctest::Approx(1));
        CHECK(glm::length(cut.first + rest.first) <= 1e-9);
        constexpr int kAlong = 40;
        Cut counted;
        for (int n = 0; n < kAlong * kAlong * kAlong; ++n) {
            const glm::dvec3 at{n % kAlong, n / kAlong % kAlong, n / kAlong / kAlong}, place = at * (2.0 / kAlong) - (1 - 1.0 / kAlong);
            if (glm::dot(slope, place) < level) counted += Cut{1, place};
        }
        constexpr double kAll = kAlong * kAlong * kAlong;
        CHECK(cut.part == doctest::Approx(counted.part / kAll).epsilon(0.03));
        CHECK(glm::length(cut.first - counted.first / kAll) <= 0.03);
    }
    CHECK(behindPlane({0, 2, 0}, 1).part == 0.75);
    CHECK(behindPlane({0, 2, 0}, 1).first.y == doctest::Approx(-0.1875));
    CHECK(behindPlane({1, 1, 1}, 0).part == doctest::Approx(0.5));
    CHECK(behindPlane({1, 1, 1}, -2).part == doctest::Approx(1.0 / 48));  // a corner's pyramid, its centroid a quarter from its faces
    CHECK(behindPlane({1, 1, 1}, -2).first.x * 48 == doctest::Approx(-0.75));
}

TEST_CASE("every primitive's closed form and the integral agree") {
    Error worst{};
    int forms = 0;
    for (const Primitive& row : primitives()) {
        CAPTURE(row.name);
        const Box box = row.extent(*cooked(row, initialNumbers(row)));
        if (!row.matter) continue;
        ++forms;
        CHECK(isFinite(box));
        Draw draw(streamOf(row.name));
        for (int i = 0; i < times(5); ++i) {
            Scene s;
            Object& o = add(s, row.name, {draw.uniform(-2, 2), draw.uniform(-2, 2), 0}, {});
            o.numbers = drawNumbers(draw, row, 0.5, 2), o.scale = draw.uniform(0.5, 2);
            if (!draw.oneIn(3)) o.rot = {draw.uniform(-180, 180), draw.uniform(-180, 180), draw.uniform(-180, 180)};
            const Tree tree = makeTree(s);
            const MassProperties exact = massProperties(tree), integral = integrateMass(tree);
            if (exact.evaluations > 0) continue;  // a torus that meets itself
            for (const double x : o.numbers) CAPTURE(x);
            CHECK(exact.uncertain == 0);
            CHECK(inertiaViolation(exact.inertia) == "");
            checkNear(integral, exact, 1e-3);
            const Error e = errorOf(integral, exact);
            worst = {std::max(worst.volume, e.volume), std::max(worst.inertia, e.inertia), std::max(worst.centre, e.centre)};
        }
    }
    CHECK(forms >= 9);
    MESSAGE("worst of the primitives: volume ", worst.volume, ", inertia ", worst.inertia, ", centre ", worst.centre);
}

TEST_CASE("a smooth solid's integral is within 1e-4, and errs ever less with more cells") {
    for (const std::string_view type : {"sphere", "torus", "capsule", "ellipsoid"}) {
        CAPTURE(type);
        Scene s;
        add(s, type, {1, 2, 3}, {0.5, 0.3}).rot = {10, 20, 30};
        const Tree tree = makeTree(s);
        const MassProperties exact = massProperties(tree);
        checkNear(integrateMass(tree), exact, 1e-4);
        checkNear(integrateMass(tree, 1000), exact, 0.02);
        CHECK(integrateMass(tree, 1000).evaluations < 10'000);
        CHECK(errorOf(integrateMass(tree, 100'000), exact).volume < 0.2 * errorOf(integrateMass(tree, 1500), exact).volume);
    }
}

TEST_CASE("closed forms are those of the textbooks") {
    const double ball = 4.0 / 3 * kPi * 0.125;
    CHECK(of("sphere", {}, {0.5}).volume == doctest::Approx(ball));
    CHECK(of("sphere", {}, {0.5}).inertia == glm::dmat3(of("sphere", {}, {0.5}).inertia[0][0]));
    CHECK(of("sphere", {}, {0.5}).inertia[0][0] == doctest::Approx(0.4 * ball * 0.25));
    CHECK(of("box", {1, 2, 3}, {1, 2, 3, 0}).volume == 6);
    CHECK(of("box", {1, 2, 3}, {1, 2, 3, 0}).inertia[0][0] == doctest::Approx(6 * (4 + 9) / 12.0));
    CHECK(of("box", {1, 2, 3}, {1, 2, 3, 0}).centre == glm::dvec3{1, 2, 3});
    CHECK(of("cylinder", {}, {0.4, 1.5, 0}).inertia[0][0] == doctest::Approx(kPi * 0.16 * 1.5 * (3 * 0.16 + 2.25) / 12));
    CHECK(of("cone", {}, {0.5, 0, 1}).centre.y == doctest::Approx(-0.25));
    CHECK(of("cone", {}, {0.5, 0, 1}).inertia[1][1] == doctest::Approx(0.3 * kPi * 0.25 / 3 * 0.25));
    CHECK(of("torus", {}, {1, 0.25}).inertia[1][1] == doctest::Approx(2 * kPi * kPi * 0.0625 * (1 + 0.75 * 0.0625)));
    CHECK(of("prism", {}, {6, 0.5, 1}).volume == doctest::Approx(1.5 * std::sqrt(3.0) * 0.25));
    CHECK(of("octahedron", {}, {0.6}).inertia[2][2] == doctest::Approx(4.0 / 3 * 0.216 * 0.2 * 0.36));
    // One shape as another row makes it: rounded until nothing flat is left, or with equal radii.
    const auto same = [](const MassProperties& a, const MassProperties& b) { checkNear(a, b, 1e-12); };
    same(of("box", {}, {1, 1, 1, 5}), of("sphere", {}, {0.5}));
    same(of("cylinder", {}, {0.5, 1, 5}), of("sphere", {}, {0.5}));
    same(of("cylinder", {}, {0.3, 1.2, 0.3}), of("capsule", {}, {0.3, 0.6}));
    same(of("box", {}, {0.6, 1.2, 0.6, 0.3}), of("capsule", {}, {0.3, 0.6}));
    same(of("cone", {}, {0.4, 0.4, 1.5}), of("cylinder", {}, {0.4, 1.5, 0}));
    same(of("ellipsoid", {}, {0.5, 0.5, 0.5}), of("sphere", {}, {0.5}));
    Scene s;
    add(s, "prism", {}, {4, std::sqrt(0.5), 2}).rot = {0, 45, 0};
    same(massProperties(makeTree(s)), of("box", {}, {1, 2, 1, 0}));
}

TEST_CASE("what is cut from solids, and joined, weighs what its closed form says") {
    const MassProperties block = of("box", {}, {1, 1.2, 0.8, 0});
    SUBCASE("a box less a box") {
        const Tree t = treeOf("subtract", {0}, [](Scene& s) {
            add(s, "box", {}, {1, 1.2, 0.8, 0}, 0), add(s, "box", {0.3, 0.4, 0}, {0.4, 0.4, 3, 0}, 0);
        });
        checkNear(massProperties(t), sum(block, of("box", {0.3, 0.4, 0}, {0.4, 0.4, 0.8, 0}), -1), 5e-4);
    }
    SUBCASE("a box less a ball in its middle") {
        const Tree t = treeOf("subtract", {0}, [](Scene& s) {
            add(s, "box", {}, {1, 1.2, 0.8, 0}, 0), add(s, "sphere", {}, {0.35}, 0);
        });
        checkNear(massProperties(t), sum(block, of("sphere", {}, {0.35}), -1), 5e-4);
    }
    SUBCASE("two balls apart") {
        const Tree t = treeOf("union", {0}, [](Scene& s) {
            add(s, "sphere", {-1, 0, 0}, {0.4}, 0), add(s, "sphere", {0.5, 1, 0}, {0.2}, 0);
        });
        checkNear(massProperties(t), sum(of("sphere", {-1, 0, 0}, {0.4}), of("sphere", {0.5, 1, 0}, {0.2})), 5e-4);
    }
    SUBCASE("half a ball") {
        const Tree t = treeOf("intersect", {0}, [](Scene& s) { add(s, "sphere", {}, {1}, 0), add(s, "plane", {}, {0, 1, 0, 0}, 0); });
        const MassProperties m = massProperties(t);
        CHECK(m.volume == doctest::Approx(2 * kPi / 3).epsilon(5e-4));
        CHECK(m.centre.x == 0);
        CHECK(m.centre.y == doctest::Approx(-3.0 / 8).epsilon(1e-3));
        CHECK(m.inertia[1][1] == doctest::Approx(m.volume * 2 / 5).epsilon(1e-3));
        CHECK(m.inertia[0][0] == doctest::Approx(m.volume * 83 / 320).epsilon(1e-3));
    }
    SUBCASE("a ball less a ball around a point of its surface: the lens of two unit balls is 5π/12") {
        const Tree t = treeOf("subtract", {0}, [](Scene& s) { add(s, "sphere", {}, {1}, 0), add(s, "sphere", {1, 0, 0}, {1}, 0); });
        CHECK(massProperties(t).volume == doctest::Approx(4.0 / 3 * kPi - 5 * kPi / 12).epsilon(5e-4));
    }
    SUBCASE("a shell, however thin") {
        for (const double thickness : {0.1, 0.01, 0.001}) {
            CAPTURE(thickness);
            const Tree t = treeOf("shell", {thickness}, [](Scene& s) { add(s, "sphere", {}, {0.5}, 0); });
            checkNear(massProperties(t), sum(of("sphere", {}, {0.5}), of("sphere", {}, {0.5 - thickness}), -1), 5e-4);
        }
    }
    SUBCASE("a block cut through by a gap of a millimetre") {
        const auto cut = [](Scene& s) { add(s, "box", {}, {1, 1.2, 0.8, 0}, 0), add(s, "box", {}, {2, 0.001, 2, 0}, 0); };
        const Tree t = treeOf("subtract", {0}, cut, {}, {10, 20, 30});
        CHECK(massProperties(t).volume == doctest::Approx(0.96 - 0.0008).epsilon(5e-4));
    }
}

TEST_CASE("a shape moved, turned or scaled has its inertia moved, turned and scaled") {
    const auto chair = [](Scene& s) {
        add(s, "box", {}, {1, 0.2, 0.8, 0.05}, 0);
        add(s, "cylinder", {0.3, -0.4, 0.1}, {0.1, 0.8, 0}, 0);
        add(s, "sphere", {-0.5, 0.2, 0}, {0.3}, 0);
    };
    const MassProperties here = massProperties(treeOf("union", {0.1}, chair));
    const MassProperties there = massProperties(treeOf("union", {0.1}, chair, {7, -3, 11}));
    MassProperties expected = here;
    expected.centre += glm::dvec3{7, -3, 11};
    checkNear(there, expected, 5e-5);  // rounding decides which side of a crease a cell's centre is on

    const glm::dmat3 turn = rotationFromDegrees({25, -40, 70});
    expected.centre = turn * here.centre, expected.inertia = turn * here.inertia * glm::transpose(turn);
    checkNear(massProperties(treeOf("union", {0.1}, chair, {}, {25, -40, 70})), expected, 5e-4);

    Scene s;
    add(s, "union", {}, {0.1}).scale = 2;
    chair(s);
    const MassProperties twice = massProperties(makeTree(s));
    CHECK(twice.volume == doctest::Approx(8 * here.volume).epsilon(1e-9));
    CHECK(twice.inertia[0][1] == doctest::Approx(32 * here.inertia[0][1]).epsilon(1e-9));

    // A turned child: the tensor of a box turned, about an axis beside it.
    Scene box;
    add(box, "box", {0.3, 0, 0.2}, {1, 0.5, 0.3, 0}).rot = {25, -40, 70};
    const MassProperties turned = massProperties(makeTree(box)), straight = of("box", {}, {1, 0.5, 0.3, 0});
    CHECK(largest(turned.inertia - turn * straight.inertia * glm::transpose(turn)) <= 1e-15);
    CHECK(turned.centre == glm::dvec3{0.3, 0, 0.2});
}

TEST_CASE("what is symmetric has a symmetric answer, and nearly symmetric moments are equal") {
    const MassProperties m = massProperties(treeOf("subtract", {0.02}, [](Scene& s) {
        add(s, "box", {}, {1, 1, 1, 0}, 0);
        for (const glm::dvec3 rot : {glm::dvec3{0}, {90, 0, 0}, {0, 0, 90}}) add(s, "cylinder", {}, {0.3, 2, 0}, 0).rot = rot;
    }));
    CHECK(m.centre == glm::dvec3{0});
    CHECK(m.inertia == glm::dmat3(m.inertia[0][0]));
    const MassProperties top = massProperties(treeOf("union", {0}, [](Scene& s) {
        add(s, "cone", {}, {0.5, 0.1, 0.7}, 0), add(s, "torus", {0, 0.1, 0}, {0.5, 0.1}, 0);
    }, {5, 0, 0}));
    CHECK(top.centre.x == 5);
    CHECK(top.centre.z == 0);
    CHECK(top.inertia[0][0] == top.inertia[2][2]);
    CHECK(top.inertia[0][0] < 0.9 * top.inertia[1][1]);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < i; ++k) CHECK(top.inertia[i][k] == 0);
}

TEST_CASE("an inertia could be one: of shapes drawn at random, and no mutant's is") {
    Draw draw(streamOf("inertia"));
    int held = 0;
    for (int i = 0; i < times(40); ++i) {
        Scene s;
        SceneKind kind;
        kind.levels = 3, kind.bounded = true;
        addRandom(s, draw, kind);
        const Tree tree = makeTree(s);
        const MassProperties m = massProperties(tree, 4000), finer = massProperties(tree, 16'000);
        if (!(m.volume > 0) || !isFinite(bounds(tree))) continue;
        ++held;
        CHECK(inertiaViolation(m.inertia) == "");
        CHECK(std::fabs(m.volume - finer.volume) <= m.uncertain + finer.uncertain);
        const Box box = bounds(tree);
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(m.centre[axis] >= box.lo[static_cast<std::size_t>(axis)]);
            CHECK(m.centre[axis] <= box.hi[static_cast<std::size_t>(axis)]);
        }
    }
    CHECK(held > times(25));

    const glm::dmat3 plate(1, 0, 0, 0, 1, 0, 0, 0, 2);  // as thin as there may be
    CHECK(inertiaViolation(plate) == "");
    CHECK(inertiaViolation(glm::dmat3(1, 0, 0, 0, 1, 0, 0, 0, 2.01)) != "");
    CHECK(inertiaViolation(glm::dmat3(1, 0, 0, 0, -1, 0, 0, 0, 1)) != "");
    CHECK(inertiaViolation(glm::dmat3(1, 0.1, 0, 0, 1, 0, 0, 0, 1)) != "");
    Scene bar;
    add(bar, "box", {}, {2, 0.1, 0.1, 0}).rot = {0, 30, 45};
    const glm::dmat3 leaning = massProperties(makeTree(bar)).inertia;
    CHECK(inertiaViolation(leaning) == "");
    glm::dmat3 mutant = leaning;  // a product with the wrong sign
    mutant[0][1] = mutant[1][0] = -mutant[0][1];
    CHECK(inertiaViolation(mutant) != "");
    CHECK(inertiaViolation(-leaning) != "");
}

TEST_CASE("nothing has no mass, and what has no end an infinite one") {
    const MassProperties none = massProperties(Tree{});
    CHECK(none.volume == 0);
    CHECK(none.inertia == glm::dmat3(0));
    CHECK(none.centre == glm::dvec3{0});
    CHECK(std::isinf(of("plane", {}, {0, 1, 0, 0}).volume));
    const auto balls_apart = [](Scene& s) { add(s, "sphere", {}, {1}, 0), add(s, "sphere", {3, 0, 0}, {1}, 0); };
    CHECK(massProperties(treeOf("intersect", {0}, balls_apart)).volume == 0);
    const auto ball_in_ball = [](Scene& s) { add(s, "sphere", {}, {1}, 0), add(s, "sphere", {}, {1.5}, 0); };
    CHECK(massProperties(treeOf("subtract", {0}, ball_in_ball)).volume == 0);
    CHECK(of("torus", {}, {0.3, 0.4}).evaluations > 0);  // it meets itself: integrated
    CHECK(inertiaViolation(of("torus", {}, {0.3, 0.4}).inertia) == "");
}

TEST_CASE("the mass of a body is the same on every compiler, to the bit") {
    const auto bits = [](const MassProperties& m) {
        StateHash hash;
        hash.add(m.volume), hash.add(m.centre), hash.add(m.inertia[0]), hash.add(m.inertia[1]), hash.add(m.inertia[2]);
        return hash.value();
    };
    const Tree t = treeOf("subtract", {0.05}, [](Scene& s) {
        add(s, "box", {}, {1, 0.7, 0.5, 0.1}, 0), add(s, "sphere", {0.3, 0.3, 0.1}, {0.35}, 0);
    });
    CHECK(bits(massProperties(t)) == 0xb27a6f633ed70b79u);
    StateHash all;
    for (const Primitive& row : primitives())
        if (!row.cook) all.add(bits(of(row.name, {1, 2, 3}, {})));  // a prism's apothem is the C library's cosine
    CHECK(all.value() == 0xd7b64357334e8384u);
}
