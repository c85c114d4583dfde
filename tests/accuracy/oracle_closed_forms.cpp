// The oracle against closed forms that are none of its code: the lists of tests/hard/oracle.h, a quadratic in long double, and a dense
// scan of the torus's equation.
//
// A ray is left out as grazing where two ends that any solid of the scene has on it lie within 1e-6 of one another: there one rounding
// more makes a hit a miss. No more than one ray in two hundred may be left out.
#include "hard/oracle.h"
#include "rays.h"
#include "sdf/random_scene.h"

#include <algorithm>

using namespace mb;
using namespace mb::hard;

namespace {

/// x² + z² = r² in long double, cut by the caps.
Span cylinderSpan(const DoubleRay& ray, double radius, double height) {
    using Real = long double;
    const Real a = Real(ray.direction.x) * ray.direction.x + Real(ray.direction.z) * ray.direction.z;
    const Real b = Real(ray.origin.x) * ray.direction.x + Real(ray.origin.z) * ray.direction.z;
    const Real c = Real(ray.origin.x) * ray.origin.x + Real(ray.origin.z) * ray.origin.z - Real(radius) * radius;
    if (b * b - a * c <= 0) return {};
    const Real root = std::sqrt(b * b - a * c);
    const auto at = [&](Real t) {
        const glm::dvec3 p = ray.origin + static_cast<double>(t) * ray.direction;
        return glm::normalize(glm::dvec3(p.x, 0, p.z));
    };
    const Real enter = (-b - root) / a, leave = (-b + root) / a;
    const Span side{static_cast<double>(enter), static_cast<double>(leave), at(enter), at(leave)};
    return both(side, both(halfSpaceSpan(ray, {0, 1, 0}, height / 2), halfSpaceSpan(ray, {0, -1, 0}, height / 2)));
}

/// What a primitive of a parent's frame has on a ray of it, and all the ends on the way.
struct Truthful {
    const Scene& scene;
    std::vector<double> ends;

    Inside inside(std::size_t i, const DoubleRay& parent) {
        const Object& o = scene.objects[i];
        const glm::dmat4 back = glm::inverse(placed(o));
        DoubleRay ray{glm::dvec3(back * glm::dvec4(parent.origin, 1)), glm::dvec3(back * glm::dvec4(parent.direction, 0))};
        ray.direction = glm::normalize(ray.direction);
        Inside list = o.type->isOperator() ? folded(i, ray) : insideOf(span(o, ray));
        const glm::dmat3 turn = glm::dmat3(placed(o)) / o.scale;
        for (Span& s : list) {
            s.enter *= o.scale, s.leave *= o.scale, s.enter_normal = turn * s.enter_normal, s.leave_normal = turn * s.leave_normal;
            if (!o.type->isOperator()) ends.push_back(s.enter), ends.push_back(s.leave);
        }
        return list;
    }
    Inside folded(std::size_t i, const DoubleRay& ray) {
        std::optional<Inside> sum;
        for (std::size_t c = i + 1; c < subtreeEnd(scene, i); c = subtreeEnd(scene, c)) {
            const Inside next = inside(c, ray);
            const std::string_view op = scene.objects[i].type->name;
            sum = !sum ? next : op == "union" ? joined(*sum, next) : op == "intersect" ? common(*sum, next) : less(*sum, next);
        }
        return *sum;
    }
    static Span span(const Object& o, const DoubleRay& ray) {
        const Numbers& k = o.numbers;
        if (o.type->name == "sphere") return sphereSpan(ray, {0, 0, 0}, k[0]);
        if (o.type->name == "box") return boxSpan(ray, {0, 0, 0}, {k[0], k[1], k[2]});
        if (o.type->name == "cylinder") return cylinderSpan(ray, k[0], k[1]);
        const double length = glm::length(glm::dvec3(k[0], k[1], k[2]));
        return halfSpaceSpan(ray, glm::dvec3(k[0], k[1], k[2]) / length, k[3] / length);
    }
    bool grazes() {
        std::ranges::sort(ends);
        for (std::size_t i = 1; i < ends.size(); ++i)
            if (ends[i] - ends[i - 1] < 1e-6) return true;
        return std::ranges::any_of(ends, [](double t) { return std::fabs(t) < 1e-6; });
    }
};

void addDrawn(Scene& scene, Draw& draw, std::string_view type, std::initializer_list<double> numbers, int parent) {
    Object& o = scene.objects[static_cast<std::size_t>(addObject(scene, type, numbers, drawPoint(draw, 0.5), parent))];
    o.rot = drawPoint(draw, 180), o.scale = draw.uniform(0.5, 2);
}
void addPrimitive(Scene& scene, Draw& draw, int parent) {
    const auto length = [&] { return draw.uniform(0.3, 1.2); };
    switch (draw.below(7)) {
    case 0: case 1: return addDrawn(scene, draw, "sphere", {length()}, parent);
    case 2: case 3: return addDrawn(scene, draw, "box", {length(), length(), length(), 0}, parent);
    case 4: case 5: return addDrawn(scene, draw, "cylinder", {length(), length(), 0}, parent);
    default: return addDrawn(scene, draw, "plane", {draw.uniform(-1, 1), draw.uniform(-1, 1), 1, draw.uniform(-0.5, 0.5)}, parent);
    }
}
void addSolid(Scene& scene, Draw& draw, int levels, int parent = kNoParent) {
    if (levels == 0 || (parent != kNoParent && draw.oneIn(2))) return addPrimitive(scene, draw, parent);
    constexpr std::string_view kFolds[] = {"union", "intersect", "subtract"};
    const int self = static_cast<int>(scene.objects.size());
    addDrawn(scene, draw, kFolds[draw.below(3)], {0}, parent);
    for (int i = 2 + draw.below(2); i > 0; --i) addSolid(scene, draw, levels - 1, self);
}

struct Held {
    int rays = 0, hits = 0, from_inside = 0, grazing = 0, wrong = 0;
    double worst = 0, worst_normal = 0;
    void add(const Oracle& oracle, const Scene& scene, const Ray& ray) {
        constexpr double kFar = 40;
        ++rays;
        const DoubleRay straight{ray.origin, ray.direction};
        Truthful truthful{scene, {}};
        const Inside solid = truthful.inside(0, straight);
        if (truthful.grazes()) return void(++grazing);
        const std::optional<Hit> wanted = firstAhead(solid, kFar);
        const std::optional<TrueHit> found = oracle.firstHit(ray, kFar);
        if (wanted.has_value() != found.has_value()) return void(++wrong);
        if (!wanted) return;
        ++hits, from_inside += std::ranges::any_of(solid, [](const Span& s) { return s.enter < 0 && s.leave > 0; });
        worst = std::max(worst, std::fabs(found->t - wanted->t));
        worst_normal = std::max(worst_normal, glm::length(found->normal - wanted->normal));
    }
};

}  // namespace

TEST_CASE("closed forms: primitives placed, turned and scaled, alone and under operators") {
    for (const int levels : {0, 1, 3}) {
        Draw draw(streamOf("closed forms") + static_cast<std::uint64_t>(levels));
        Held held;
        for (int trial = 0; trial < times(400); ++trial) {
            Scene scene;
            addSolid(scene, draw, levels);
            const Oracle oracle(scene);
            REQUIRE(oracle.isExact());
            CHECK(oracle.resolution() == 0);
            for (int i = 0; i < 40; ++i) held.add(oracle, scene, drawRay(draw, 1.2));
        }
        MESSAGE(levels << " levels: " << held.rays << " rays, " << held.hits << " hits, " << held.from_inside << " from inside, " << held.grazing << " grazing; worst "
                       << held.worst << " m, normal " << held.worst_normal);
        CHECK(held.hits > held.rays / 10);
        CHECK(held.from_inside > held.rays / 100);
        CHECK(held.grazing <= held.rays / 200);
        CHECK(held.wrong == 0);
        CHECK(held.worst < 1e-9);
        CHECK(held.worst_normal < 1e-6);
    }
}

TEST_CASE("closed forms: a torus's first surface satisfies its equation, and no point before does otherwise") {
    using Real = long double;
    Draw draw(streamOf("torus"));
    int hits = 0, misses = 0, grazing = 0;
    Real worst = 0;
    for (int trial = 0; trial < times(1000); ++trial) {
        const double major = draw.uniform(0.1, 1), minor = draw.uniform(0.05, 0.6);  // some tubes wider than their ring
        Scene scene;
        addObject(scene, "torus", {major, minor});
        const Ray ray = drawRay(draw, 1);
        const auto value = [&](Real t) {
            const Real x = ray.origin.x + t * ray.direction.x, y = ray.origin.y + t * ray.direction.y, z = ray.origin.z + t * ray.direction.z;
            const Real across = std::sqrt(x * x + z * z) - Real(major);
            return across * across + y * y - Real(minor) * minor;
        };
        const std::optional<TrueHit> hit = Oracle(scene).firstHit(ray, 12);
        ++(hit ? hits : misses);
        if (hit) worst = std::max(worst, std::fabs(value(hit->t)));
        // From the other side of the start on there may be no change of sign before the hit, or before the end.
        const bool inside = value(0) < 0;
        const Real end = hit ? Real(hit->t) - 1e-9 : Real(12);
        bool changed = false, close = false;
        for (int i = 0; i < 4000; ++i) {
            const Real v = value(end * i / 4000);
            changed = changed || (v < 0) != inside, close = close || std::fabs(v) < 1e-9;
        }
        grazing += close;
        CHECK(!changed);
        if (hit) CHECK((value(Real(hit->t) + 1e-7) < 0) != inside);
    }
    MESSAGE(hits << " hits, " << misses << " misses, worst " << static_cast<double>(worst) << " m²");
    CHECK(hits > 300);
    CHECK(misses > 200);
    CHECK(grazing <= 2);
    CHECK(worst < 1e-12);
}

TEST_CASE("closed forms: of surfaces in one plane the first leaf's is met, and what is cut flush leaves no skin") {
    Scene scene;
    const int cut = addObject(scene, "subtract", {0});
    addObject(scene, "box", {2, 1, 2, 0}, {0, 0, 0}, cut);
    addObject(scene, "box", {1, 0.3, 1, 0}, {0, 0.35, 0}, cut);  // its top is the other's
    addObject(scene, "box", {4, 0.2, 4, 0}, {0, -0.6, 0});       // touches it from below
    const Oracle oracle(scene);
    const std::optional<TrueHit> floor = oracle.firstHit({{0.1, 3, 0.2}, {0, -1, 0}}, 10);
    REQUIRE(floor);
    CHECK(floor->t == doctest::Approx(2.8).epsilon(1e-12));
    CHECK(floor->leaf == 1);
    CHECK(floor->object == 0);
    CHECK(floor->normal.y == doctest::Approx(1));
    // From within, through the faces that touch, to the other's far side.
    const std::optional<TrueHit> out = oracle.firstHit({{0.9, 0, 0.9}, {0, -1, 0}}, 10);
    REQUIRE(out);
    CHECK(out->t == doctest::Approx(0.7).epsilon(1e-12));
    CHECK(out->object == 1);
    CHECK(out->normal.y == doctest::Approx(1));

    Scene twins;
    addObject(twins, "box", {1, 1, 1, 0}, {0.3, 0, 0});
    addObject(twins, "box", {1, 1, 1, 0}, {-0.3, 0, 0});
    for (const double x : {-0.1, 0.0, 0.1}) CHECK(Oracle(twins).firstHit({{x, 0.1, 3}, {0, 0, -1}}, 10)->leaf == 0);
    CHECK(Oracle(twins).firstHit({{-0.5, 0.1, 3}, {0, 0, -1}}, 10)->leaf == 1);
}
