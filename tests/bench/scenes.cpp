// The benchmarks' scenes are the ones they say: their check values, and three descriptions of a scene that agree.
#include "bench/cover.h"
#include "bench/truth.h"

#include "core/accuracy/oracle.h"
#include "core/scene/text.h"
#include "core/sdf/raycast.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace mb;
using namespace mb::bench;

namespace {

struct Seen {
    double hits = 0, mean_z = 0;  // the share of pixels in %, and where along the view they were hit
};

/// By closed forms.
Seen closedForm(const Model& model, int stride) {
    const TruthPicture truth = truthOf(model, {512, 512}, stride);
    Seen seen;
    for (const auto& hit : truth.hits)
        if (hit) seen.hits += 1, seen.mean_z += 1.8 - hit->t;
    seen.mean_z /= seen.hits;
    seen.hits *= 100 / static_cast<double>(truth.hits.size());
    return seen;
}

/// By plain sphere tracing to a millimetre, which takes what passes that near for a hit.
Seen marched(const Model& model, int stride) {
    const Tree tree = makeTree(sceneOf(model));
    Seen seen;
    double rays = 0;
    for (int y = 0; y < 512; y += stride)
        for (int x = 0; x < 512; x += stride) {
            const Ray ray = cameraRay(model.camera, {512, 512}, {x + 0.5, y + 0.5});
            const auto along = [&](double t) {
                const glm::dvec3 p = ray.origin + t * ray.direction;
                return distance<double>(tree, {p.x, p.y, p.z});
            };
            const March march = sphereTrace(along, 0, model.far, [](double) { return 1e-3; });
            rays += 1;
            if (march.hit) seen.hits += 1, seen.mean_z += 1.8 - march.end;
        }
    seen.mean_z /= seen.hits;
    seen.hits *= 100 / rays;
    return seen;
}

}  // namespace

TEST_CASE("the union's check values: the pixels and the depth that plain sphere tracing to a millimetre finds") {
    struct Row {
        int n, stride;
        double hits, mean_z, within;  // % of pixels
    };
    for (const Row& row : {Row{10, 1, 53.56, 0.3184, 0.006}, Row{100, 2, 63.86, 0.3356, 0.1}, Row{1000, 16, 80.22, 0.3484, 1}}) {
        CAPTURE(row.n);
        const Model model = makeModel("union", row.n, kSeed);
        const Seen march = marched(model, row.stride), closed = closedForm(model, row.stride);
        CHECK(std::fabs(march.hits - row.hits) < row.within);
        CHECK(std::fabs(march.mean_z - row.mean_z) < 0.01);
        // What a march takes for a hit and is none lies along the silhouettes: less than 1 % of the picture.
        CHECK(closed.hits < march.hits);
        CHECK(closed.hits > march.hits - 1);
    }
}

TEST_CASE("every family has the primitives asked for, reads back from its text, and is another with another seed") {
    for (const Family& family : families()) {
        CAPTURE(family.name);
        const Model model = makeModel(family.name, 100, kSeed);
        const Scene scene = sceneOf(model);
        const std::size_t ground = family.name == "ground" ? 1 : 0;
        CHECK(makeTree(scene).leaves.size() == 100 + ground);
        CHECK(sameScene(scene, sceneOf(makeModel(family.name, 100, kSeed))));
        CHECK(!sameScene(scene, sceneOf(makeModel(family.name, 100, kSeed + 1))));
    }
}

TEST_CASE("intervals and distances describe the same solids") {
    for (const Family& family : families()) {
        const Model model = makeModel(family.name, 40, kSeed);
        if (model.blends) continue;
        const Tree tree = makeTree(sceneOf(model));
        const Oracle oracle(sceneOf(model));
        REQUIRE(oracle.isExact());
        int undecided = 0;
        for (int i = 0; i < 2000; ++i) {
            CAPTURE(family.name);
            CAPTURE(i);
            const Ray ray = cameraRay(model.camera, {2000, 2000}, {37.5 + 613.0 * i - 2000 * std::floor(613.0 * i / 2000), i + 0.5});
            const std::optional<TrueHit> hit = oracle.firstHit(ray, model.far);
            const RayEnd end = raycast(tree, ray.origin, ray.direction, model.far);
            if (end.state == RayState::undecided) {
                ++undecided;
                continue;
            }
            REQUIRE(hit.has_value() == (end.state == RayState::hit));
            if (!hit) continue;
            CHECK(std::fabs(hit->t - end.t) < 1e-9);
            CHECK(hit->object == tree.leaves[static_cast<std::size_t>(end.leaf)].object);
        }
        CHECK(undecided < 10);
    }
}
