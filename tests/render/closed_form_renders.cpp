// Marched pictures against closed forms in double: state, depth, normal and object of every pixel.
#include "closed_forms.h"
#include "headless.h"
#include "scenes.h"

#include <functional>

using namespace mb;

namespace {

constexpr double kLens = 0.9;  // two unit balls at ±0.9 along y share a lens

struct Case {
    std::string name;
    Scene scene;
    Camera camera;
    std::function<std::optional<Hit>(const DoubleRay&, double reach)> truth;
    /// At least how far a hit is from where another surface is as near, in metres: within a difference's reach of there the
    /// normal is smeared over the crease, and not compared.
    std::function<double(glm::dvec3)> to_crease;
};

std::vector<Case> cases() {
    const auto far_from_all = [](glm::dvec3) { return 1e9; };
    std::vector<Case> all;
    {
        Case c{"sphere", {}, cameraAt({0.4, 0.7, 4}, {0, 0, 0}), {}, far_from_all};
        addObject(c.scene, "sphere", {1});
        c.truth = [](const DoubleRay& r, double reach) { return firstOf(sphereSpan(r, {}, 1), reach); };
        all.push_back(std::move(c));
    }
    {
        Case c{"plane", {}, cameraAt({0, 2, 6}, {0, 1, 0}, 60), {}, far_from_all};
        addObject(c.scene, "plane", {0, 1, 0, 0});
        c.truth = [](const DoubleRay& r, double reach) { return firstOf(halfSpaceSpan(r, {0, 1, 0}, 0), reach); };
        all.push_back(std::move(c));
    }
    {
        const glm::dvec3 size{1.6, 1, 1.2}, at{0.1, 0.2, -0.3};
        Case c{"box", {}, cameraAt({2, 1.7, 3}, {0, 0, 0}), {}, {}};
        addObject(c.scene, "box", {size.x, size.y, size.z, 0}, at);
        c.truth = [=](const DoubleRay& r, double reach) { return firstOf(boxSpan(r, at, size), reach); };
        c.to_crease = [=](glm::dvec3 p) {  // of the three distances to the faces' planes, the second least
            glm::dvec3 d = glm::abs(glm::abs(p - at) - size / 2.0);
            if (d.x > d.y) std::swap(d.x, d.y);
            if (d.y > d.z) std::swap(d.y, d.z);
            if (d.x > d.y) std::swap(d.x, d.y);
            return d.y;
        };
        all.push_back(std::move(c));
    }
    {
        Case c{"lens", {}, cameraAt({0.6, 0.8, 2.2}, {0, 0, 0}), {}, {}};
        const int lens = addObject(c.scene, "intersect", {});
        addObject(c.scene, "sphere", {1}, {0, kLens, 0}, lens);
        addObject(c.scene, "sphere", {1}, {0, -kLens, 0}, lens);
        c.truth = [](const DoubleRay& r, double reach) {
            return firstOf(both(sphereSpan(r, {0, kLens, 0}, 1), sphereSpan(r, {0, -kLens, 0}, 1)), reach);
        };
        c.to_crease = [](glm::dvec3 p) { return std::fabs(p.y); };
        all.push_back(std::move(c));
    }
    {
        Case c{"ball on a floor", {}, cameraAt({0, 2, 6}, {0, 1, 0}, 60), {}, {}};
        addObject(c.scene, "plane", {0, 1, 0, 0});
        addObject(c.scene, "sphere", {1}, {0.5, 1, 0});
        c.truth = [](const DoubleRay& r, double reach) {
            const auto floor = firstOf(halfSpaceSpan(r, {0, 1, 0}, 0), reach, 0), ball = firstOf(sphereSpan(r, {0.5, 1, 0}, 1), reach, 1);
            return !floor || (ball && ball->t < floor->t) ? ball : floor;
        };
        c.to_crease = [](glm::dvec3 p) { return std::hypot(std::hypot(p.x - 0.5, p.z), p.y); };
        all.push_back(std::move(c));
    }
    return all;
}

struct Errors {
    std::size_t wrong_state = 0, wrong_object = 0, undecided = 0, hits = 0, deep = 0, normals = 0, bent = 0;
    double worst_depth = 0, worst_normal_deg = 0;
};

Errors compare(const Case& c, const Measured& m) {
    Errors e;
    const glm::ivec2 size = m.channels.size;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const std::size_t i = static_cast<std::size_t>(y * size.x + x);
            const DoubleRay ray = pixelRay(c.camera, size, x, y);
            const std::optional<Hit> truth = c.truth(ray, c.scene.render.max_distance);
            if (m.channels.state[i] == 2) {
                ++e.undecided;
                continue;
            }
            if ((m.channels.state[i] == 1) != truth.has_value()) {
                ++e.wrong_state;
                continue;
            }
            if (!truth) continue;
            ++e.hits;
            e.wrong_object += static_cast<int>(m.channels.object[i]) != truth->object;
            const double depth = std::fabs(static_cast<double>(m.channels.depth[i]) - truth->t) / truth->t;
            e.worst_depth = std::max(e.worst_depth, depth);
            e.deep += depth > 1e-3;
                // A difference reaches at most normal_epsilon of the distance to each side.
            if (c.to_crease(ray.origin + truth->t * ray.direction) < 2 * std::max(c.scene.render.normal_epsilon * truth->t, 1e-4)) continue;
            ++e.normals;
            const double cosine = glm::dot(glm::dvec3(m.channels.normal[i]), truth->normal);
            const double angle = glm::degrees(std::acos(std::min(cosine, 1.0)));
            e.worst_normal_deg = std::max(e.worst_normal_deg, angle);
            e.bent += angle > 0.1;
        }
    return e;
}

}  // namespace

TEST_CASE("pictures agree with closed forms in double") {
    HeadlessRenderer headless;
    for (const glm::ivec2 size : {glm::ivec2{320, 240}, glm::ivec2{640, 360}}) {
        for (const Case& c : cases()) {
            CAPTURE(c.name);
            CAPTURE(size.x);
            const Errors e = compare(c, headless.measure(c.scene, c.camera, size));
            const double pixels = static_cast<double>(size.x) * size.y;
            MESSAGE(c.name << " at " << size.x << "x" << size.y << ": hits " << e.hits << ", wrong state " << e.wrong_state << ", undecided "
                           << 100 * static_cast<double>(e.undecided) / pixels << " %, worst depth " << e.worst_depth << ", deeper than 1e-3 "
                           << e.deep << ", worst normal " << e.worst_normal_deg << " degrees of " << e.normals);
            CHECK(e.hits > 1000);
            CHECK(e.wrong_state == 0);
            CHECK(e.wrong_object == 0);
            CHECK(static_cast<double>(e.undecided) <= 0.005 * pixels);
            CHECK(static_cast<double>(e.deep) <= 0.001 * static_cast<double>(e.hits));
            CHECK(e.bent == 0);
        }
    }
}
