#include "bench/truth.h"

#include "core/sdf/raycast.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mb::bench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Span kNowhere{kInfinity, -kInfinity};

Span both(Span a, Span b) { return {std::max(a.enter, b.enter), std::min(a.leave, b.leave)}; }

/// Where |origin + t·direction| <= half along one axis.
Span slab(double origin, double direction, double half) {
    if (direction == 0) return std::fabs(origin) <= half ? Span{-kInfinity, kInfinity} : kNowhere;
    const double a = (-half - origin) / direction, b = (half - origin) / direction;
    return {std::min(a, b), std::max(a, b)};
}

/// Where |m + t·d| <= radius. Kahan's form of the quadratic: the centre's distance from the ray, with no difference of near
/// equals.
template <class Vector> Span round(Vector m, Vector d, double radius) {
    const double dd = glm::dot(d, d);
    if (dd == 0) return glm::dot(m, m) <= radius * radius ? Span{-kInfinity, kInfinity} : kNowhere;
    const double middle = -glm::dot(m, d) / dd;
    const Vector nearest = m + middle * d;
    const double rest = radius * radius - glm::dot(nearest, nearest);
    if (rest <= 0) return kNowhere;
    const double half = std::sqrt(rest / dd);
    return {middle - half, middle + half};
}

Span spanOf(const Solid& solid, const Ray& ray) {
    const glm::dvec3 m = ray.origin - solid.centre, d = ray.direction;
    switch (solid.kind) {
    case Solid::Kind::sphere: return round(m, d, solid.half.x);
    case Solid::Kind::box:
        return both(slab(m.x, d.x, solid.half.x), both(slab(m.y, d.y, solid.half.y), slab(m.z, d.z, solid.half.z)));
    case Solid::Kind::cylinder:
        return both(round(glm::dvec2{m.x, m.z}, glm::dvec2{d.x, d.z}, solid.half.x), slab(m.y, d.y, solid.half.y));
    default:
        if (d.y == 0) return m.y <= 0 ? Span{-kInfinity, kInfinity} : kNowhere;
        return d.y < 0 ? Span{-m.y / d.y, kInfinity} : Span{-kInfinity, -m.y / d.y};
    }
}

/// The same hits by marching the distance in double.
std::optional<Hit> marchedHit(const Model& model, const Tree& tree, const Ray& ray) {
    const RayEnd end = raycast(tree, ray.origin, ray.direction, model.far);
    if (end.state != RayState::hit || end.leaf < 0) return std::nullopt;
    return Hit{end.t, tree.leaves[static_cast<std::size_t>(end.leaf)].object};
}

}  // namespace

Spans unite(Spans a, const Spans& b) {
    a.insert(a.end(), b.begin(), b.end());
    std::ranges::sort(a, {}, &Span::enter);
    Spans joined;
    for (const Span& s : a) {
        if (!joined.empty() && s.enter <= joined.back().leave) joined.back().leave = std::max(joined.back().leave, s.leave);
        else joined.push_back(s);
    }
    return joined;
}

Spans subtract(const Spans& a, const Spans& b) {
    Spans rest;
    for (Span s : a) {
        for (const Span& hole : b) {
            if (hole.leave <= s.enter || hole.enter >= s.leave) continue;
            if (hole.enter > s.enter) rest.push_back({s.enter, hole.enter});
            s.enter = hole.leave;
        }
        if (s.enter < s.leave) rest.push_back(s);
    }
    return rest;
}

Spans spansOf(const Part& part, const Ray& ray) {
    if (part.op == Part::Op::solid) {
        const Span span = spanOf(part.solid, ray);
        return span.enter < span.leave ? Spans{span} : Spans{};
    }
    if (part.op == Part::Op::unite) {
        Spans all;
        for (const Part& child : part.parts) {
            const Spans spans = spansOf(child, ray);
            all.insert(all.end(), spans.begin(), spans.end());
        }
        return unite(std::move(all), {});
    }
    Spans left = spansOf(part.parts[0], ray);
    for (std::size_t i = 1; i < part.parts.size() && !left.empty(); ++i) left = subtract(left, spansOf(part.parts[i], ray));
    return left;
}

std::optional<Hit> firstHit(const Model& model, const Ray& ray) {
    std::optional<Hit> first;
    const auto take = [&](double t, int object) {
        if (t >= 0 && t <= model.far && (!first || t < first->t)) first = Hit{t, object};
    };
    for (std::size_t i = 0; i < model.objects.size(); ++i) {
        const Part& part = model.objects[i];
        const auto met = [&](const Span& s) { take(s.enter >= 0 ? s.enter : s.leave, static_cast<int>(i)); };
        if (part.op == Part::Op::solid) {
            if (const Span s = spanOf(part.solid, ray); s.enter < s.leave) met(s);
        } else {
            for (const Span& s : spansOf(part, ray)) met(s);
        }
    }
    return first;
}

TruthPicture truthOf(const Model& model, glm::ivec2 size) {
    const double spans = model.blends ? 4e6 : 2e8;  // a marched ray takes some ten times as long
    const double asked = static_cast<double>(size.x) * size.y * model.n;
    return truthOf(model, size, std::max(1, static_cast<int>(std::ceil(std::sqrt(asked / spans)))));
}

TruthPicture truthOf(const Model& model, glm::ivec2 size, int stride) {
    TruthPicture truth{size, stride, {}};
    const Tree tree = model.blends ? makeTree(sceneOf(model)) : Tree{};
    if (model.blends) truth.reference = "the distance marched in double";
    for (int y = 0; y < size.y; y += stride)
        for (int x = 0; x < size.x; x += stride) {
            const Ray ray = cameraRay(model.camera, size, {x + 0.5, y + 0.5});
            truth.hits.push_back(model.blends ? marchedHit(model, tree, ray) : firstHit(model, ray));
        }
    return truth;
}

}  // namespace mb::bench
