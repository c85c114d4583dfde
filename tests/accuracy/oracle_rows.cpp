// Every row of primitives(), and the leaves' own distances, against the program's double field: two routes that share only the tree.
#include "core/accuracy/implicit.h"
#include "rays.h"

using namespace mb;

namespace {

/// One object with random numbers of about a metre, placed, turned and scaled.
Scene sceneOfRow(Draw& draw, const Primitive& row) {
    Scene scene;
    Object o;
    o.id = scene.newId(), o.type = &row;
    do o.numbers = drawNumbers(draw, row, 0.6, 3);
    while (!cooked(row, o.numbers));
    o.pos = drawPoint(draw, 1), o.rot = drawPoint(draw, 180), o.scale = draw.uniform(0.5, 2);
    scene.objects.push_back(o);
    return scene;
}

}  // namespace

TEST_CASE("rows: every primitive has a solid of its own, and the first surface is where the field changes its sign") {
    for (const Primitive& row : primitives()) {
        CAPTURE(row.name);
        Draw draw(streamOf(row.name));
        Tally tally;
        for (int specimen = 0; specimen < times(150); ++specimen) {
            const Oracle oracle(sceneOfRow(draw, row));
            CHECK(oracle.isExact());
            CHECK(oracle.notes().empty());
            for (int i = 0; i < 40; ++i) tally.add(oracle, drawRay(draw, 1.5), 50, 1);
        }
        MESSAGE(row.name << ": " << tally.rays << " rays, " << tally.hits << " hits, worst " << tally.worst << " m, undecided " << tally.undecided);
        CHECK(tally.hits > tally.rays / 20);
        CHECK(tally.undecided < tally.rays / 20);
        CHECK(tally.wrong == 0);
        CHECK(tally.off == 0);
    }
}

TEST_CASE("rows: the normal is the field's slope, towards the ray's start") {
    for (const Primitive& row : primitives()) {
        CAPTURE(row.name);
        Draw draw(streamOf(row.name) + 1);
        int hits = 0, off = 0, turned = 0;
        for (int specimen = 0; specimen < times(100); ++specimen) {
            const Oracle oracle(sceneOfRow(draw, row));
            for (int i = 0; i < 20; ++i) {
                const Ray ray = drawRay(draw, 1.5);
                const std::optional<TrueHit> hit = oracle.firstHit(ray, 50);
                if (!hit) continue;
                ++hits;
                CHECK(glm::length(hit->normal) == doctest::Approx(1).epsilon(1e-12));
                turned += glm::dot(hit->normal, ray.direction) > 0;
                const glm::dvec3 gradient = slope(oracle.tree(), ray.origin + hit->t * ray.direction).gradient;
                off += std::fabs(glm::dot(glm::normalize(gradient), hit->normal)) < 1 - 1e-9;
            }
        }
        CHECK(hits > 100);
        CHECK(turned == 0);
        CHECK(off == 0);
    }
}

TEST_CASE("rows: distances of own formulas are the program's") {
    for (const Primitive& row : primitives()) {
        CAPTURE(row.name);
        Draw draw(streamOf(row.name) + 2);
        const accuracy::Solid* solid = accuracy::findSolid(row.name);
        REQUIRE(solid);
        double worst = 0;
        for (int specimen = 0; specimen < times(200); ++specimen) {
            const std::optional<LeafNumbers> k = cooked(row, drawNumbers(draw, row, 1, 4));
            if (!k) continue;
            for (int i = 0; i < 100; ++i) {
                const glm::dvec3 p = drawPoint(draw, 5);
                worst = std::max(worst, std::fabs(solid->distance(p, *k) - row.distance<double>({p.x, p.y, p.z}, *k)));
            }
        }
        CHECK(worst < 1e-12);
        MESSAGE(row.name << ": worst " << worst << " m");
    }
}

TEST_CASE("rows: a primitive without a solid is marched by the program's distance, and named") {
    Primitive stranger = asPrimitive(*findShapeType("sphere"));
    stranger.name = "stranger";
    Scene scene;
    addObject(scene, "sphere", {0.5});
    scene.objects[0].type = &stranger;
    const Oracle oracle(scene);
    CHECK(!oracle.isExact());
    REQUIRE(oracle.notes().size() == 1);
    CHECK(oracle.notes()[0].find("'stranger'") != std::string::npos);
    const std::optional<TrueHit> hit = oracle.firstHit({{0, 0, 3}, {0, 0, -1}}, 10);
    REQUIRE(hit);
    CHECK(std::fabs(hit->t - 2.5) <= oracle.rootError());
}
