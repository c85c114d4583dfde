#include "physics/candidate.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <optional>

namespace mb {
namespace {

constexpr std::array kInwards{0.02, 0.08, 0.3, 0.8, 2.0};  // of the spacing: how far inside a sharp point its partner's face is read
constexpr double kLevel = 1e-4;             // a slope that is none
constexpr double kWorth = 1e-5;             // of the spacing: a step that brings less is not made
constexpr int kMoves = 24;                  // along a surface to where it is lowest
constexpr int kDrops = 4;                   // steps from beside a surface onto it
constexpr double kSloping = 0.02;           // a slope that may be a flat face's
constexpr double kBeside = 0.01;            // of the spacing, or a round's radius
constexpr double kLying = 2e-4;             // of a round's radius: less is off the surface where the round slopes by kSloping
constexpr double kTurning = 0.6;            // by which a normal may leave the cone of the surface's own, of a point that is yet to move
constexpr double kCone = 0.1;               // the same, of a contact
constexpr double kStray = 1.0;              // of the spacing: how far from its place a point's cone says anything
constexpr double kRounded = 0.25;           // the same, of a round: whether its surface is there is asked
constexpr std::array kAcross{0.001, 0.1, 0.01, 0.001};  // of the spacing: how far to either side of an edge its faces are looked for

double coneOf(const Candidate& c) { return c.from->round > 0 ? kRounded : kCone; }

}  // namespace

Slope Settler::slopeOf(const Placed& p, glm::dvec3 at) const {
    ++evaluations_;
    Slope s = p.solid->slopeAt(p.pose.fromWorld(at));
    s.gradient = p.pose.rotation * s.gradient;
    return s;
}

/// The other's field at a candidate's place, read `inwards` metres inside and continued from there.
Slope Settler::otherAt(const Candidate& c, glm::dvec3 at) const {
    if (c.inwards == 0) return slopeOf(*c.asked, at);
    const glm::dvec3 out = c.inwards * (c.owner->pose.rotation * c.from->normal);
    Slope s = slopeOf(*c.asked, at - out);
    s.distance += glm::dot(s.gradient, out);
    return s;
}

void Settler::setTo(Candidate& io_c, const Slope& s) {
    const double l = glm::length(s.gradient);
    io_c.gap = s.distance;
    io_c.normal = l > 1e-6 ? (io_c.of_a ? 1 / l : -1 / l) * s.gradient : glm::dvec3{0};
}

/// Whether the two surfaces face one another there: the corner of a box beside another box is near its side, and yet what it
/// stands on is below.
bool Settler::faces(const Candidate& c, double but) {
    const double facing = glm::dot(c.owner->pose.rotation * c.from->normal, c.normal);
    return (c.of_a ? -facing : facing) >= c.from->cosine - but;
}

/// What moved along a curve may have left the cone of the point it came from, or got far from where that is its surface's; and what moved
/// along an edge, by a field that is read further inside, may have left the other.
bool Settler::isContact(const Candidate& c) const {
    if (c.gap > margin_) return false;
    const bool opposed = glm::dot(c.own, c.of_a ? -c.normal : c.normal) >= 1 - kCone;
    const auto strayed = [&] { return c.own != glm::dvec3{0} && glm::length(c.at - c.owner->pose.toWorld(c.from->onSurface())) > kStray * c.spacing(); };
    if (!opposed && (!faces(c, coneOf(c)) || strayed())) return false;
    return c.inwards == 0 || fieldOf(*c.asked, c.at) <= margin_ + kBeside * c.fineness();
}

/// At the other's edges the field has no one slope, and deep inside or beside them it has the wrong one: of a box just on the rim of
/// another, or sunk into it there. So that of a sharp point is read ever further inside until the surfaces face one another.
bool Settler::settle(Candidate& io_c) const {
    if (io_c.from->round > 0) {
        if (const auto contact = settleRound(io_c)) return *contact;
        io_c.at = io_c.owner->pose.toWorld(io_c.from->onSurface());
    }
    // A corner that juts out over the other's rim by a little counts as on it: the rim's own corner may do so the other way.
    if (io_c.gap > margin_ + (io_c.from->sharp ? kBeside * io_c.fineness() : 0)) return false;
    for (const double share : kInwards) {
        io_c.inwards = io_c.from->sharp ? share * io_c.fineness() : 0;
        setTo(io_c, otherAt(io_c, io_c.at));
        if (faces(io_c, coneOf(io_c)) && (!io_c.from->sharp || hasFoot(io_c))) return io_c.gap <= margin_;
        if (!io_c.from->sharp) break;
    }
    return false;
}

/// The contact of a round is where its middle is nearest to the other: if the other's distance there is one to its surface and no
/// mere bound, the place so found has the gap so found. Beside where two edges cross that place lies off the own surface, and the
/// contact is further along it. Nothing: it is not known.
std::optional<bool> Settler::settleRound(Candidate& io_c) const {
    const double round = io_c.from->round;
    if (io_c.gap > margin_) return false;
    Candidate c = io_c;
    setTo(c, slopeOf(*c.asked, c.at));
    c.gap -= round;
    if (!faces(c, coneOf(c))) return false;
    c.at += (c.of_a ? -round : round) * c.normal;
    if (std::fabs(fieldOf(*c.owner, c.at)) > kLying * round) {
        Footing footing;
        if (!stand(c, footing)) return false;
        setTo(c, slopeOf(*c.asked, c.at));
        if (!faces(c, kTurning)) return false;
    } else {
        if (std::fabs(fieldOf(*c.asked, c.at) - c.gap) > kBeside * round) return std::nullopt;
        c.lowest = true;
    }
    io_c = c;
    return true;
}

/// Whether the other has a surface where a normal that was read elsewhere says so; its gap is then measured along that normal.
bool Settler::hasFoot(Candidate& io_c) const {
    const glm::dvec3 out = io_c.of_a ? io_c.normal : -io_c.normal;
    for (int i = 0; i < 3; ++i) {
        const Slope s = slopeOf(*io_c.asked, io_c.at - io_c.gap * out);
        const double along = glm::dot(s.gradient, out);
        if (std::fabs(s.distance) <= kWorth * io_c.fineness()) return true;
        if (along < kAlike * glm::length(s.gradient)) return std::fabs(s.distance) <= kBeside * io_c.fineness();
        io_c.gap += s.distance / along;
    }
    return true;
}

bool Settler::settleLower(Candidate& io_c) const {
    io_c.at = io_c.owner->pose.toWorld(io_c.from->onSurface());
    io_c.inwards = io_c.from->sharp ? kInwards[0] * io_c.fineness() : 0;
    setTo(io_c, otherAt(io_c, io_c.at));
    if (!faces(io_c, kTurning)) return false;
    refine(io_c, Until::rim, margin_);
    return isContact(io_c);
}

Settler::Footing Settler::footingOf(const Candidate& c) const {
    Footing footing;
    const glm::dmat3& turn = c.owner->pose.rotation;
    if (!c.from->sharp) {
        footing.own = slopeOf(*c.owner, c.at);
        glm::dmat3 wide = turn, narrow = turn;
        for (int k = 0; k < 3; ++k) wide[k] *= c.owner->solid->points.stretch()[k], narrow[k] /= c.owner->solid->points.stretch()[k];
        footing.stretch = wide * glm::transpose(turn), footing.shrink = narrow * glm::transpose(turn);
        return footing;
    }
    const double sine = std::sqrt(std::max(1 - c.from->cosine * c.from->cosine, 0.0));
    const glm::dvec3 middle = c.from->cosine * c.from->normal, across = sine * glm::cross(c.from->normal, c.from->along);
    footing.along = turn * c.from->along, footing.first = turn * (middle + across), footing.second = turn * (middle - across);
    return footing;
}

/// The way down: from a place on its own solid along the surface, or the edge, to where the other's field is less. Along a surface it is
/// the steepest where the cells are cubes: of a needle's side, towards the tip rather than round it.
Settler::Way Settler::downhill(const Footing& footing, const Slope& there) {
    Way down;
    if (footing.along != glm::dvec3{0}) {
        down.way = -glm::dot(there.gradient, footing.along) * footing.along;
        down.steep = down.slope = glm::length(down.way);
        return down;
    }
    const glm::dvec3 own = footing.own.gradient, stretched = footing.stretch * own;
    const double l2 = glm::dot(own, own);
    if (!(l2 > 1e-6)) return down;
    down.slope = glm::length((glm::dot(there.gradient, own) / l2) * own - there.gradient);
    const glm::dvec3 fall = (glm::dot(there.gradient, stretched) / glm::dot(own, stretched)) * own - there.gradient;
    down.way = footing.stretch * fall, down.steep = std::sqrt(glm::dot(fall, down.way));
    return down;
}

/// Brings a candidate onto its own solid's surface, or edge. Says whether it got there: past a rim there may be none to get to.
bool Settler::stand(Candidate& io_c, Footing& io_footing) const {
    if (io_footing.along != glm::dvec3{0}) return standOnEdge(io_c, io_footing);
    for (int round = 0; round < kDrops; ++round) {
        const Slope own = io_footing.own = slopeOf(*io_c.owner, io_c.at);
        if (!(glm::dot(own.gradient, own.gradient) > 1e-6)) return false;
        const glm::dvec3 way = io_footing.stretch * own.gradient;
        io_c.at -= (own.distance / glm::dot(way, own.gradient)) * way;  // the last one too: gaps must not jump by what is near enough
        if (std::fabs(own.distance) <= kWorth * io_c.fineness()) return true;
    }
    return false;
}

/// By Newton's steps onto the two faces, each read a little to its side of the edge. (On a face beside a rim the own field is 0 too; and
/// past the edge's end, where the two planes go on without the shape, it is not.)
bool Settler::standOnEdge(Candidate& io_c, Footing& io_footing) const {
    const double on = kWorth * io_c.fineness();
    for (const double share : kAcross) {
        const double aside = share * io_c.fineness();
        const auto read = [&](glm::dvec3 face, glm::dvec3 other) {
            const glm::dvec3 across = glm::dot(other, face) * face - other;
            const glm::dvec3 off = (aside / std::max(glm::length(across), 1e-6)) * across;
            Slope s = slopeOf(*io_c.owner, io_c.at + off);
            s.distance -= glm::dot(s.gradient, off);
            return s;
        };
        const Slope s = read(io_footing.first, io_footing.second), t = read(io_footing.second, io_footing.first);
        const double ss = glm::dot(s.gradient, s.gradient), st = glm::dot(s.gradient, t.gradient), tt = glm::dot(t.gradient, t.gradient);
        const double det = ss * tt - st * st;
        if (!(det > 1e-3 * ss * tt)) continue;  // both are on one face
        io_c.at -= ((s.distance * tt - t.distance * st) / det) * s.gradient + ((t.distance * ss - s.distance * st) / det) * t.gradient;
        if (std::fabs(s.distance) <= on && std::fabs(t.distance) <= on) break;
        const glm::dvec3 along = glm::normalize(glm::cross(s.gradient, t.gradient));
        io_footing.along = glm::dot(along, io_footing.along) < 0 ? -along : along;
        io_footing.first = s.gradient / std::sqrt(ss), io_footing.second = t.gradient / std::sqrt(tt);
    }
    return std::fabs(fieldOf(*io_c.owner, io_c.at)) <= 10 * on;
}

/// Strides follow the last two slopes (Barzilai, Borwein, "Two-Point Step Size Gradient Methods", 1988).
void Settler::refine(Candidate& io_c, Until until, double most) const {
    Slope there = otherAt(io_c, io_c.at);
    Footing footing = footingOf(io_c);
    Way down = downhill(footing, there);
    const double longest = 0.25 * io_c.spacing();
    double stride = longest;
    if (io_c.isCorner() || there.distance - down.slope * io_c.spacing() > most) return;
    for (int i = 0; i < kMoves; ++i) {
        if (down.slope < kLevel || down.steep * stride < kWorth * io_c.spacing()) break;
        Candidate next = io_c;
        Footing next_footing = footing;
        next.at += (stride / down.steep) * down.way;
        const Slope lower = stand(next, next_footing) ? otherAt(next, next.at) : there;
        if (lower.distance < there.distance - 1e-9 * stride) {
            const Way on = downhill(next_footing, lower);
            if (until == Until::rim && down.slope < kSloping && on.slope > 0.9 * down.slope) break;
            const glm::dvec3 moved = next.at - io_c.at, metred = footing.shrink * moved;
            const double curve = glm::dot(metred, down.way - on.way) / glm::dot(metred, moved);
            stride = curve * longest > on.steep ? on.steep / curve : longest;
            io_c = next, footing = next_footing, there = lower, down = on;
        } else {
            stride *= 0.25;
        }
    }
    setTo(io_c, there);
    if (!io_c.from->sharp) io_c.own = glm::normalize(footing.own.gradient);
}

}  // namespace mb
