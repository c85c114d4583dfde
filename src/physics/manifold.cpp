#include "physics/manifold.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <optional>

namespace mb {
namespace {

constexpr double kAlike = 0.97;             // of two unit normals' product: the same face
constexpr double kSame = 0.02;              // of the spacing: places nearer than this are one
constexpr double kAlone = 1.5;              // of the spacing: the lowest point within it is looked at
constexpr std::array kInwards{0.02, 0.08, 0.3, 0.8, 2.0};  // of the spacing: how far inside a sharp point its partner's face is read
constexpr double kLevel = 1e-4;             // a slope that is none
constexpr double kWorth = 1e-5;             // of the spacing: a step that brings less is not made
constexpr int kDrops = 4;                   // steps from beside a surface onto it
constexpr double kSloping = 0.02;           // one that may be a flat face's
constexpr double kBeside = 0.01;            // of the spacing
constexpr double kTurning = 0.6;            // the same, of a point that is yet to move along its surface
constexpr double kCone = 0.1;               // by which a contact's normal may leave the cone of the surface's own
constexpr double kRounded = 0.25;           // the same, of a round: whether its surface is there is asked
constexpr std::uint64_t kOfOther = std::uint64_t{1} << 63;

/// A surface point of one solid near the other.
struct Candidate {
    glm::dvec3 at{0};                       // in the world
    double gap = 0;
    std::uint64_t feature = 0;
    std::size_t other = 0;
    bool of_a = true;
    const SurfacePoint* from = nullptr;
    double inwards = 0;                     // where the other's field is read, m behind the point
    glm::dvec3 normal{0};                   // towards a
};

class Search {
public:
    Search(const Placed& a, std::span<const Placed> others, double margin, std::uint64_t& io_evaluations)
        : a_(a), others_(others), margin_(margin), evaluations_(io_evaluations) {}

    Manifold run() {
        collectOfA();
        for (std::size_t o = 0; o < others_.size(); ++o) collectOfOther(o);
        Manifold found{{}, margin_};
        if (candidates_.empty()) return found.room = std::max(margin_, room_), found;
        for (const std::vector<Candidate>& group : outermost(touching())) {
            Candidate deepest = group[0];
            for (const Candidate& c : group) {
                Candidate lower = c;
                if (!isSharp(c)) refine(lower);
                if (!faces(lower, coneOf(c))) lower = c;
                addApart(lower, found.points);
                if (lower.gap < deepest.gap) deepest = lower;
            }
            addLowest(deepest, found.points);
        }
        for (Candidate c : lowest()) {
            c.at = owner(c).pose.toWorld(c.from->onSurface());
            c.inwards = isSharp(c) ? kInwards[0] * fineness(c) : 0;
            setTo(c, otherAt(c, c.at, c.inwards));
            if (!faces(c, kTurning)) continue;
            refine(c);
            if (c.gap <= margin_ && faces(c, coneOf(c))) addApart(c, found.points);
        }
        return found;
    }

private:
    const Placed& asked(const Candidate& c) const { return c.of_a ? others_[c.other] : a_; }
    const Placed& owner(const Candidate& c) const { return c.of_a ? a_ : others_[c.other]; }
    static bool isSharp(const Candidate& c) { return c.from->sharp; }
    static double coneOf(const Candidate& c) { return c.from->round > 0 ? kRounded : kCone; }
    double spacingOf(const Candidate& c) const { return owner(c).solid->points.spacing(); }
    /// The finer of the two spacings, which small lengths are shares of: a die is small at a tray's rim.
    double fineness(const Candidate& c) const { return std::min(spacingOf(c), asked(c).solid->points.empty() ? INFINITY : asked(c).solid->points.spacing()); }

    double fieldOf(const Placed& p, glm::dvec3 at) const { return ++evaluations_, p.solid->at(p.pose.fromWorld(at)); }
    Slope slopeOf(const Placed& p, glm::dvec3 at) const {
        ++evaluations_;
        Slope s = p.solid->slopeAt(p.pose.fromWorld(at));
        s.gradient = p.pose.rotation * s.gradient;
        return s;
    }
    /// Whether some point within `radius` of a place may be nearer to the solid than `reach`; if not, how far all are.
    bool near(const Placed& p, glm::dvec3 at, double radius, double between, double reach) const {
        double bound = distanceTo(p.solid->box, p.pose.fromWorld(at)) - radius;
        if (bound <= reach) bound = fieldOf(p, at) - radius;
        if (bound <= reach) return true;
        room_ = std::min(room_, bound - between);
        return false;
    }

    void collectOfA() {
        const double between = 0.5 * a_.solid->points.spacing(), reach = margin_ + between;
        const auto may = [&](glm::dvec3 centre, double radius) {
            const glm::dvec3 at = a_.pose.toWorld(centre);
            bool any = false;
            for (const Placed& o : others_) any = near(o, at, radius, between, reach) || any;
            return any;
        };
        a_.solid->points.search(may, [&](std::uint32_t i, const SurfacePoint& point) {
            const glm::dvec3 at = a_.pose.toWorld(point.place);
            Candidate best{at, reach, i, 0, true, &point, 0, {}};
            bool found = false;
            for (std::size_t o = 0; o < others_.size(); ++o) {
                if (distanceTo(others_[o].solid->box, others_[o].pose.fromWorld(at)) - point.round > best.gap) continue;
                const double f = fieldOf(others_[o], at) - point.round;
                if (f < best.gap || (!found && f <= best.gap)) best.gap = f, best.other = o, found = true;
            }
            if (found) candidates_.push_back(best);
            else room_ = margin_;  // it is not known how much more
        });
    }

    void collectOfOther(std::size_t o) {
        const Placed& other = others_[o];
        const double between = 0.5 * other.solid->points.spacing(), reach = margin_ + between;
        const auto may = [&](glm::dvec3 centre, double radius) { return near(a_, other.pose.toWorld(centre), radius, between, reach); };
        other.solid->points.search(may, [&](std::uint32_t i, const SurfacePoint& point) {
            const glm::dvec3 at = other.pose.toWorld(point.place);
            const double f = fieldOf(a_, at) - point.round;
            if (f > reach) room_ = std::min(room_, f - between);
            else candidates_.push_back({at, f, kOfOther | (std::uint64_t{other.number} << 32) | i, o, false, &point, 0, {}});
        });
    }

    /// The other's field at a candidate's place, read `inwards` metres inside and continued from there.
    Slope otherAt(const Candidate& c, glm::dvec3 at, double inwards) const {
        if (inwards == 0) return slopeOf(asked(c), at);
        const glm::dvec3 out = inwards * (owner(c).pose.rotation * c.from->normal);
        Slope s = slopeOf(asked(c), at - out);
        s.distance += glm::dot(s.gradient, out);
        return s;
    }

    /// Sets the candidate's gap, normal and place; says whether it is a contact. At the other's edges the field has no one slope, and
    /// deep inside or beside them it has the wrong one: of a box just on the rim of another, or sunk into it there. So that of a
    /// sharp point is read ever further inside until the surfaces face one another.
    bool settle(Candidate& io_c) const {
        if (io_c.from->round > 0) {
            if (const auto contact = settleRound(io_c)) return *contact;
            io_c.at = owner(io_c).pose.toWorld(io_c.from->onSurface());
        }
        for (const double share : kInwards) {
            io_c.inwards = isSharp(io_c) ? share * fineness(io_c) : 0;
            setTo(io_c, otherAt(io_c, io_c.at, io_c.inwards));
            if (faces(io_c, kCone) && (!isSharp(io_c) || hasFoot(io_c))) return io_c.gap <= margin_;
            if (!isSharp(io_c)) break;
        }
        return false;
    }

    /// The contact of a round is where its middle is nearest to the other: if the other's distance there is one to its surface and no
    /// mere bound, the place so found has the gap so found. Beside where two edges cross that place lies off the own surface, and the
    /// contact is further along it. Nothing: it is not known.
    std::optional<bool> settleRound(Candidate& io_c) const {
        const double round = io_c.from->round, beside = kBeside * round;
        Candidate c = io_c;
        setTo(c, slopeOf(asked(c), c.at));
        c.gap -= round;
        if (c.gap > margin_ || !faces(c, coneOf(c))) return false;
        c.at += (c.of_a ? -round : round) * c.normal;
        if (std::fabs(fieldOf(owner(c), c.at)) > beside) {
            if (!drop(c)) return false;
            refine(c);
            io_c = c;
            return c.gap <= margin_ && faces(c, coneOf(c));
        }
        if (std::fabs(fieldOf(asked(c), c.at) - c.gap) > beside) return std::nullopt;
        io_c = c;
        return true;
    }

    /// Whether the other has a surface where a normal that was read elsewhere says so; its gap is then measured along that normal.
    bool hasFoot(Candidate& io_c) const {
        const glm::dvec3 out = io_c.of_a ? io_c.normal : -io_c.normal;
        for (int i = 0; i < 3; ++i) {
            const Slope s = slopeOf(asked(io_c), io_c.at - io_c.gap * out);
            const double along = glm::dot(s.gradient, out);
            if (std::fabs(s.distance) <= kWorth * fineness(io_c)) return true;
            if (along < kAlike * glm::length(s.gradient)) return std::fabs(s.distance) <= kBeside * fineness(io_c);
            io_c.gap += s.distance / along;
        }
        return true;
    }

    void setTo(Candidate& io_c, const Slope& s) const {
        const double l = glm::length(s.gradient);
        io_c.gap = s.distance;
        io_c.normal = l > 1e-6 ? (io_c.of_a ? 1 / l : -1 / l) * s.gradient : glm::dvec3{0};
    }

    /// Whether the two surfaces face one another there: the corner of a box beside another box is near its side, and yet what it
    /// stands on is below.
    bool faces(const Candidate& c, double but) const {
        const double facing = glm::dot(owner(c).pose.rotation * c.from->normal, c.normal);
        return (c.of_a ? -facing : facing) >= c.from->cosine - but;
    }

    /// Those within the margin as they are, with their normals. A corner that juts out over the other's rim by a little counts as
    /// on it: the rim's own corner may do so the other way.
    std::vector<Candidate> touching() const {
        std::vector<Candidate> found;
        for (Candidate c : candidates_)
            if (c.gap <= margin_ + (isSharp(c) ? kBeside * fineness(c) : 0) && settle(c)) found.push_back(c);
        return found;
    }

    /// Of a curve, or where two edges cross, the points on either side may be beyond the margin though the curve is within it: of
    /// those the lowest around.
    std::vector<Candidate> lowest() const {
        std::vector<Candidate> found;
        for (const Candidate& c : candidates_) {
            if (c.gap <= margin_) continue;
            const double around = kAlone * spacingOf(c);
            const bool beaten = std::ranges::any_of(candidates_, [&](const Candidate& d) {
                return d.of_a == c.of_a && d.other == c.other && (d.gap < c.gap || (d.gap == c.gap && d.feature < c.feature)) &&
                       glm::length(d.at - c.at) < around;
            });
            if (!beaten) found.push_back(c);
        }
        return found;
    }

    /// Of each group of like normals the outermost in eight directions, and the deepest if it is deeper than all of those.
    /// The directions lie in a's frame, off its axes: they choose the same points while a rests.
    std::vector<std::vector<Candidate>> outermost(const std::vector<Candidate>& all) const {
        std::vector<std::vector<Candidate>> chosen;
        std::vector<char> grouped(all.size(), 0);
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (grouped[i]) continue;
            std::vector<std::size_t> group;
            for (std::size_t k = i; k < all.size(); ++k)
                if (!grouped[k] && glm::dot(all[i].normal, all[k].normal) > kAlike) grouped[k] = 1, group.push_back(k);
            chooseOf(all, group, chosen.emplace_back());
        }
        return chosen;
    }

    void chooseOf(const std::vector<Candidate>& all, const std::vector<std::size_t>& group, std::vector<Candidate>& out) const {
        const std::size_t deepest = *std::ranges::min_element(group, {}, [&](std::size_t k) { return all[k].gap; });
        const glm::dvec3 n = all[group[0]].normal;
        const glm::dvec3 in_a = n * a_.pose.rotation, size = glm::abs(in_a);
        const int axis = size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2;
        const glm::dvec3 u = glm::normalize(glm::cross(n, a_.pose.rotation[axis])), v = glm::cross(n, u);
        constexpr std::array<std::array<double, 2>, 8> kWays{{{0.92, 0.39}, {0.37, 0.93}, {-0.41, 0.91}, {-0.94, 0.35},
                                                              {-0.91, -0.42}, {-0.36, -0.93}, {0.4, -0.92}, {0.93, -0.38}}};
        std::vector<std::size_t> picked;
        for (const auto& [x, y] : kWays) {
            const glm::dvec3 way = x * u + y * v;
            const std::size_t far = *std::ranges::max_element(group, {}, [&](std::size_t k) { return glm::dot(way, all[k].at - a_.pose.position); });
            if (std::ranges::find(picked, far) == picked.end()) picked.push_back(far);
        }
        const bool beneath = std::ranges::all_of(picked, [&](std::size_t k) { return all[deepest].gap < all[k].gap - 0.1 * std::fabs(margin_); });
        if (beneath) picked.push_back(deepest);
        for (const std::size_t k : picked) out.push_back(all[k]);
    }

    /// The way down: from a place on its own solid along the surface to where the other's field is less; its length is the
    /// sine of the angle between the surfaces.
    glm::dvec3 downhill(const Candidate& c, const Slope& there) const {
        const Slope here = slopeOf(owner(c), c.at);
        const double l2 = glm::dot(here.gradient, here.gradient);
        return l2 > 1e-6 ? (glm::dot(there.gradient, here.gradient) / l2) * here.gradient - there.gradient : glm::dvec3{0};
    }

    /// Brings a candidate onto its own solid's surface. Says whether it got there: past a rim there may be none to get to.
    bool drop(Candidate& io_c) const {
        for (int round = 0; round < kDrops; ++round) {
            const Slope s = slopeOf(owner(io_c), io_c.at);
            const double n2 = glm::dot(s.gradient, s.gradient);
            if (std::fabs(s.distance) <= kWorth * fineness(io_c)) return true;
            if (!(n2 > 1e-6)) return false;
            io_c.at -= (s.distance / n2) * s.gradient;
        }
        return false;
    }

    /// Moves the point along its own solid's surface to where the other's field is least. A corner stays; and so does a point on
    /// the rim of a flat place that hardly slopes: what it stands on is that rim, not the far side.
    void refine(Candidate& io_c, bool stays_on_rims = true) const {
        Slope there = otherAt(io_c, io_c.at, io_c.inwards);
        glm::dvec3 along = downhill(io_c, there);
        double stride = 0.25 * spacingOf(io_c);
        for (int i = 0; i < 12; ++i) {
            const double slant = glm::length(along);
            if (slant < kLevel || slant * stride < kWorth * spacingOf(io_c)) break;
            Candidate next = io_c;
            next.at += (stride / slant) * along;
            const bool on_surface = drop(next);
            const Slope lower = on_surface ? otherAt(next, next.at, next.inwards) : there;
            if (lower.distance < there.distance - 1e-9 * stride) {
                const glm::dvec3 on = downhill(next, lower);
                if (stays_on_rims && slant < kSloping && glm::length(on) > 0.9 * slant) break;
                io_c = next, there = lower, along = on;
            } else {
                stride *= 0.25;
            }
        }
        setTo(io_c, there);
    }

    /// Of a face's points none may be the lowest where two rims cross between points: that place too, from the deepest on.
    void addLowest(Candidate c, std::vector<ManifoldPoint>& io_points) const {
        if (isSharp(c)) return;
        const double before = c.gap;
        refine(c, false);
        if (c.gap < before - kWorth * fineness(c) && faces(c, coneOf(c))) addApart(c, io_points);
    }

    /// Adds it unless there is one at its place already; of two the deeper stays.
    void addApart(const Candidate& c, std::vector<ManifoldPoint>& io_points) const {
        const ManifoldPoint point{c.at, c.normal, c.gap, c.feature, c.other};
        const double same = kSame * fineness(c);
        for (ManifoldPoint& p : io_points) {
            if (p.other != c.other || glm::length(p.point - c.at) > same || glm::dot(p.normal, c.normal) < kAlike) continue;
            if (c.gap < p.gap - 1e-9) p = point;
            return;
        }
        io_points.push_back(point);
    }

    const Placed& a_;
    std::span<const Placed> others_;
    double margin_;
    std::uint64_t& evaluations_;
    std::vector<Candidate> candidates_;
    mutable double room_ = INFINITY;        // of what was not looked at closely
};

}  // namespace

Manifold manifold(const Placed& a, std::span<const Placed> others, double margin, std::uint64_t& io_evaluations) {
    return Search(a, others, margin, io_evaluations).run();
}

}  // namespace mb
