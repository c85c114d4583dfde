// Random trees with every operator, against the program's double field.
#include "core/accuracy/implicit.h"
#include "rays.h"
#include "sdf/random_scene.h"

#include <map>
#include <thread>

using namespace mb;

namespace {

Scene drawScene(Draw& draw, bool blends) {
    SceneKind kind;
    kind.levels = 2 + draw.below(3), kind.blends = blends, kind.hidden = 0.05;
    Scene scene;
    for (int i = 1 + draw.below(2); i > 0; --i) addRandom(scene, draw, kind);
    return scene;
}

}  // namespace

TEST_CASE("trees: own values are the program's, whatever the operators") {
    Draw draw(streamOf("own values"));
    std::map<std::string_view, int> seen;
    double worst = 0;
    int values = 0;
    for (int trial = 0; trial < times(600); ++trial) {
        const accuracy::KnownTree known(makeTree(drawScene(draw, true)));
        CHECK(known.notes.empty());
        for (const Branch& b : known.tree.branches) ++seen[b.op->name];
        for (const Tree::Part& part : known.tree.parts) {
            const std::span<const Instruction> tape = std::span(known.tree.program).subspan(part.begin, part.end - part.begin);
            const accuracy::Implicit own(known, tape);
            for (int i = 0; i < 40; ++i, ++values) {
                const glm::dvec3 p = drawPoint(draw, 3);
                const double theirs = distance<double>(known.tree, tape, {p.x, p.y, p.z});
                worst = std::max(worst, std::fabs(own.value(p) - theirs) / (1 + std::fabs(theirs)));
            }
        }
    }
    MESSAGE(values << " values, worst " << worst);
    for (const Operator& op : operators())
        if (op.kind != Operator::Kind::copies) CHECK_MESSAGE(seen[op.name] > 20, op.name);
    CHECK(worst < 1e-9);
}

TEST_CASE("trees: the first surface is where the field changes its sign") {
    for (const bool blends : {false, true}) {
        Draw draw(streamOf(blends ? "blended trees" : "plain trees"));
        Tally tally;
        int exact = 0;
        for (int trial = 0; trial < times(250); ++trial) {
            const Oracle oracle(drawScene(draw, blends));
            exact += oracle.isExact();
            for (int i = 0; i < 30; ++i) tally.add(oracle, drawRay(draw, 1.5), 30, 1);
        }
        MESSAGE(exact << " exact; " << tally.rays << " rays, " << tally.hits << " hits, worst " << tally.worst << " m, undecided " << tally.undecided);
        CHECK(tally.hits > tally.rays / 6);
        CHECK(tally.undecided < tally.rays / 20);
        CHECK(tally.wrong == 0);
        CHECK(tally.off == 0);
    }
}

TEST_CASE("trees: shares at a hit are positive and add up to 1, and the leaf named shows most") {
    Draw draw(streamOf("shares"));
    int hits = 0, mixed = 0;
    for (int trial = 0; trial < times(300); ++trial) {
        const Oracle oracle(drawScene(draw, true));
        for (int i = 0; i < 20; ++i) {
            const Ray ray = drawRay(draw, 1.5);
            const std::optional<TrueHit> hit = oracle.firstHit(ray, 30);
            if (!hit) continue;
            ++hits;
            const std::vector<LeafShare> shares = oracle.sharesAt(*hit, ray.origin + hit->t * ray.direction);
            double sum = 0, most = 0, named = 0;
            for (const LeafShare& s : shares) {
                CHECK(s.share > 0);
                sum += s.share, most = std::max(most, s.share);
                if (s.leaf == hit->leaf) named = s.share;
            }
            CHECK(std::fabs(sum - 1) < 1e-12);
            CHECK(named >= most - 1e-6);
            CHECK(hit->object == oracle.tree().leaves[static_cast<std::size_t>(hit->leaf)].object);
            mixed += shares.size() > 1;
        }
    }
    CHECK(hits > 1000);
    CHECK(mixed > 30);
}

TEST_CASE("trees: a ray that starts on the surface it has found does not meet it again") {
    Draw draw(streamOf("starts"));
    int starts = 0, again = 0;
    for (int trial = 0; trial < times(200); ++trial) {
        const Oracle oracle(drawScene(draw, true));
        for (int i = 0; i < 20; ++i) {
            const Ray ray = drawRay(draw, 1.5);
            const std::optional<TrueHit> hit = oracle.firstHit(ray, 30);
            // Grazing ways stay within rounding of the surface for long.
            if (!hit || std::fabs(glm::dot(hit->normal, ray.direction)) < 0.01) continue;
            const glm::dvec3 at = ray.origin + hit->t * ray.direction, away = glm::reflect(ray.direction, hit->normal);
            ++starts;
            for (const glm::dvec3 direction : {away, ray.direction})
                if (const std::optional<TrueHit> next = oracle.firstHit({at, direction}, 30)) again += next->t < 1e-7;
        }
    }
    CHECK(starts > 500);
    CHECK(again <= starts / 1000);
    MESSAGE(again << " of " << starts);
}

TEST_CASE("trees: what blocks a ray is what it meets, or starts in") {
    Draw draw(streamOf("blocked"));
    int blocked = 0, free = 0;
    for (int trial = 0; trial < times(200); ++trial) {
        const Oracle oracle(drawScene(draw, true));
        for (int i = 0; i < 20; ++i) {
            const Ray ray = drawRay(draw, 1.5);
            const double far = draw.uniform(0.5, 8);
            const bool inside = distance<double>(oracle.tree(), {ray.origin.x, ray.origin.y, ray.origin.z}) < 0;
            const bool expected = inside || oracle.firstHit(ray, far);
            CHECK(oracle.isBlocked(ray, far) == expected);
            ++(expected ? blocked : free);
        }
    }
    CHECK(blocked > 300);
    CHECK(free > 300);
}

TEST_CASE("trees: a marched root is as near to the change of sign as it is said to be") {
    Draw draw(streamOf("roots of trees"));
    int checked = 0, off = 0;
    for (int trial = 0; trial < times(300); ++trial) {
        const Scene scene = drawScene(draw, true);
        const Oracle oracle(scene);
        const accuracy::KnownTree known(makeTree(scene));
        const accuracy::Implicit own(known, known.tree.program);
        if (oracle.isExact()) {
            CHECK(oracle.rootError() == 0);
            continue;
        }
        CHECK(oracle.resolution() > 0);
        for (int i = 0; i < 20; ++i) {
            const Ray ray = drawRay(draw, 1.5);
            const std::optional<TrueHit> hit = oracle.firstHit(ray, 30);
            if (!hit) continue;
            const auto along = [&](double t) { return own.value(ray.origin + t * ray.direction); };
            const double rate = std::fabs(along(hit->t + 1e-6) - along(hit->t - 1e-6)) / 2e-6;
            if (rate < 1e-3) continue;
            const double error = oracle.rootError() / rate;
            ++checked, off += (along(hit->t - error) < 0) == (along(hit->t + error) < 0);
        }
    }
    CHECK(checked > 500);
    CHECK(off <= checked / 500);  // within a root error of an edge the rate is another
    MESSAGE(off << " of " << checked);
}

TEST_CASE("trees: threads that ask at once get what one gets") {
    Draw draw(streamOf("threads"));
    for (int trial = 0; trial < times(10); ++trial) {
        const Oracle oracle(drawScene(draw, true));
        std::vector<Ray> rays;
        for (int i = 0; i < 200; ++i) rays.push_back(drawRay(draw, 1.5));
        const auto ask = [&](std::vector<double>& found) {
            for (const Ray& ray : rays) {
                const std::optional<TrueHit> hit = oracle.firstHit(ray, 30);
                found.push_back(hit ? hit->t : -1);
            }
        };
        std::vector<double> alone, first, second;
        ask(alone);
        std::thread other([&] { ask(first); });
        ask(second);
        other.join();
        CHECK(first == alone);
        CHECK(second == alone);
    }
}
