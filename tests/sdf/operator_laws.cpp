#include "sdf/operator_laws.h"

#include <fmt/format.h>

namespace mb {
namespace {

using sdf::Dual;
using sdf::Interval;

constexpr int kDraws = 4000;

/// A distance; two drawn in turn are often equal, opposite or nearly so, which is where operators are hard.
double drawDistance(Draw& draw, double other = 0) {
    switch (draw.below(6)) {
        case 0: return other;
        case 1: return -other;
        case 2: return other + draw.uniform(-1e-6, 1e-6);
        case 3: return draw.oneIn(2) ? 0.0 : -0.0;
        default: return draw.uniform(-1, 1) * draw.logUniform(1e-3, 1e3);
    }
}
/// A blend that matters for such distances; now and then a very small one.
double drawBlend(Draw& draw) { return draw.oneIn(8) ? draw.logUniform(1e-20, 1e-3) : draw.logUniform(1e-3, 1e3); }

/// A third of the time none.
double drawNumber(const Operator& op, Draw& draw) { return draw.oneIn(3) ? 0 : op.blends ? drawBlend(draw) : draw.uniform(0, 1); }

std::string describe(const Operator& op, double a, double b, double k) { return fmt::format("{}({}, {}, {})", op.name, a, b, k); }

/// What it must be without a blend, by its claims alone: an intersection, a difference, or else a union.
template <class T> T plainly(const Operator& op, T a, T b) {
    using sdf::max, sdf::min;
    return op.intersects ? max(a, b) : op.first_only ? max(a, -b) : min(a, b);
}

template <class R> bool same(R a, R b) { return a == b; }
bool same(Dual a, Dual b) { return a.v == b.v && a.dx == b.dx && a.dy == b.dy && a.dz == b.dz; }

std::string notPlain(const Operator& op, Draw& draw) {
    for (int i = 0; i < kDraws; ++i) {
        const double a = drawDistance(draw), b = drawDistance(draw, a);
        const float af = static_cast<float>(a), bf = static_cast<float>(b);
        const Dual ad(a, 1, 2, 3), bd(b, 4, 5, 6);
        if (!same(op.fold<double>(a, b, 0), plainly(op, a, b)) || !same(op.fold<float>(af, bf, 0), plainly(op, af, bf)))
            return describe(op, a, b, 0) + " is not the plain operator's";
        if (!same(op.fold<Dual>(ad, bd, 0), plainly(op, ad, bd))) return describe(op, a, b, 0) + " has another gradient than the plain operator's";
        // An interval moves outwards at every operation: by an ulp or two here.
        const Interval r = op.fold<Interval>({a, a + 1}, {b, b + 1}, 0), want = plainly(op, Interval(a, a + 1), Interval(b, b + 1));
        const double slack = 4 * 0x1p-52 * (std::fabs(a) + std::fabs(b) + 1);
        if (!(r.lo <= want.lo && want.hi <= r.hi && r.lo >= want.lo - slack && r.hi <= want.hi + slack))
            return describe(op, a, b, 0) + " has another interval than the plain operator's";
    }
    return {};
}

/// A blend rounds a seam by at most k/4, only where the values differ by less than k, and to one side: a union grows, what
/// takes away takes away more.
std::string strayBlend(const Operator& op, Draw& draw) {
    for (int i = 0; i < kDraws; ++i) {
        const double a = drawDistance(draw), b = drawDistance(draw, a), k = drawBlend(draw);
        const double plain = op.fold<double>(a, b, 0), moved = op.fold<double>(a, b, k) - plain;
        const double grown = op.intersects || op.first_only ? -moved : moved, rounding = 4 * 0x1p-52 * (std::fabs(plain) + k);
        if (!(grown <= rounding && grown >= -k / 4 - rounding)) return describe(op, a, b, k) + fmt::format(" moves the plain value by {}", moved);
        const double apart = std::fabs(a - (op.first_only ? -b : b));
        if (apart >= k && moved != 0) return describe(op, a, b, k) + " blends what is further apart than the blend";
        if (apart == 0 && std::fabs(std::fabs(moved) - k / 4) > rounding)
            return describe(op, a, b, k) + fmt::format(" moves the middle of the seam by {}", moved);
    }
    return {};
}

std::string steeperThanOne(const Operator& op, Draw& draw) {
    for (int i = 0; i < kDraws; ++i) {
        const double a = drawDistance(draw), b = drawDistance(draw, a), k = drawNumber(op, draw);
        const double a2 = a + draw.uniform(-1, 1) * draw.logUniform(1e-6, 10), b2 = b + draw.uniform(-1, 1) * draw.logUniform(1e-6, 10);
        const double rise = std::fabs(op.fold<double>(a2, b2, k) - op.fold<double>(a, b, k)), step = std::max(std::fabs(a2 - a), std::fabs(b2 - b));
        if (!(rise <= step + 8 * 0x1p-52 * (std::fabs(a) + std::fabs(b) + k + 20)))
            return describe(op, a, b, k) + " rises faster than its children";
    }
    return {};
}

/// Commutative rows are, to the bit; and a row that does not claim it is not.
std::string wrongOrder(const Operator& op, Draw& draw) {
    bool differs = false;
    for (int i = 0; i < kDraws; ++i) {
        const double a = drawDistance(draw), b = drawDistance(draw, a), k = drawNumber(op, draw);
        const bool equal = op.fold<double>(a, b, k) == op.fold<double>(b, a, k);
        if (op.commutative && !equal) return describe(op, a, b, k) + " depends on the order";
        differs = differs || !equal;
    }
    return op.commutative || differs ? std::string() : fmt::format("{} does not claim to be commutative, but is", op.name);
}

/// A result that lies within the first child, or in all, is never inside where they are not.
std::string outsideItsChildren(const Operator& op, Draw& draw) {
    for (int i = 0; i < kDraws; ++i) {
        const double a = drawDistance(draw), b = drawDistance(draw, a), k = drawNumber(op, draw), r = op.fold<double>(a, b, k);
        const double slack = 4 * 0x1p-52 * (std::fabs(a) + std::fabs(b));
        const bool first = r >= a - slack, both = first && r >= b - slack;
        if ((op.first_only && !first) || (op.intersects && !both)) return describe(op, a, b, k) + fmt::format(" = {} is outside its children", r);
        if (!op.first_only && !op.intersects && !(r <= std::min(a, b) + slack))
            return describe(op, a, b, k) + fmt::format(" = {} does not hold its children", r);
    }
    return {};
}

/// How much of the second shows is how the value follows it; where all or nothing does, the value is one child's to the bit,
/// and without a blend it always is, the first's of equals.
std::string wrongShare(const Operator& op, Draw& draw) {
    constexpr double h = 1e-7;
    for (int i = 0; i < kDraws; ++i) {
        const double a = drawDistance(draw), b = drawDistance(draw, a), k = drawNumber(op, draw);
        const double r = op.fold<double>(a, b, k), share = op.shareOfSecond<double>(a, b, k), second = op.first_only ? -b : b;
        if (!(share >= 0 && share <= 1)) return describe(op, a, b, k) + fmt::format(": a share of {}", share);
        if (share == 0 && r != a) return describe(op, a, b, k) + " is not the first's, though all of it shows";
        if (share == 1 && r != second) return describe(op, a, b, k) + " is not the second's, though all of it shows";
        if (op.blends && k == 0 && (share > 0.5) != (r != a)) return describe(op, a, b, k) + " shows the other one's surface";
        const Interval range = op.shareOfSecond<Interval>({a, a + 0.1}, {b, b + 0.1}, k);
        if (!(range.lo <= share && share <= range.hi)) return describe(op, a, b, k) + ": the share is not in its interval";

        const double x = draw.uniform(-1, 1), y = draw.uniform(-1, 1), seam = op.blends ? draw.uniform(0.1, 2) : k;
        const double rise = (op.fold<double>(x, y + h, seam) - op.fold<double>(x, y - h, seam)) / (2 * h);
        if (!(std::fabs(std::fabs(rise) - op.shareOfSecond<double>(x, y, seam)) < 1e-5))
            return describe(op, x, y, seam) + fmt::format(" follows the second by {}, its share is {}", rise, op.shareOfSecond<double>(x, y, seam));
    }
    return {};
}

std::string scalarsDisagree(const Operator& op, Draw& draw) {
    for (int i = 0; i < kDraws; ++i) {
        const double a = drawDistance(draw), b = drawDistance(draw, a), k = drawNumber(op, draw), r = op.fold<double>(a, b, k);
        if (op.fold<Dual>(Dual(a), Dual(b), k).v != r) return describe(op, a, b, k) + ": the dual's value differs from the double's";
        // A dozen roundings, with the numbers' own, of terms no larger than these; and the square of a
        // very small blend is lost in float.
        const float f = op.fold<float>(static_cast<float>(a), static_cast<float>(b), k);
        if (!(std::fabs(static_cast<double>(f) - r) <= 8 * 0x1p-23 * (std::fabs(a) + std::fabs(b) + k) + 1e-18))
            return describe(op, a, b, k) + fmt::format(": float says {}", f);

        const double width = draw.oneIn(3) ? 0 : draw.logUniform(1e-9, 10);
        const Interval x(a - width, a + width), y(b - width, b + width), bound = op.fold<Interval>(x, y, k);
        for (int j = 0; j < 8; ++j) {
            const double m = op.fold<double>(draw.member(x.lo, x.hi), draw.member(y.lo, y.hi), k);
            if (!(bound.lo <= m && m <= bound.hi)) return describe(op, a, b, k) + fmt::format(": {} is not in [{}, {}]", m, bound.lo, bound.hi);
        }
    }
    return {};
}

/// Away from the seam's ends, where its second derivative jumps, the gradient is that by differences.
std::string wrongGradient(const Operator& op, Draw& draw) {
    constexpr double h = 1e-6;
    for (int i = 0; i < kDraws; ++i) {
        const double a = draw.uniform(-1, 1), b = draw.uniform(-1, 1), k = op.blends ? draw.uniform(0.1, 2) : draw.uniform(0, 1);
        const Dual r = op.fold<Dual>(Dual(a, 1, 0, 0), Dual(b, 0, 1, 0), k);
        const auto by_differences = [&](double da, double db) {
            return (op.fold<double>(a + da, b + db, k) - op.fold<double>(a - da, b - db, k)) / (2 * h);
        };
        // The value's second derivative is at most 1/(2k) = 5, and a crease would be a jump by 1.
        if (!(std::fabs(r.dx - by_differences(h, 0)) < 1e-5 && std::fabs(r.dy - by_differences(0, h)) < 1e-5))
            return describe(op, a, b, k) + fmt::format(": gradient ({}, {}), by differences ({}, {})", r.dx, r.dy, by_differences(h, 0),
                                                       by_differences(0, h));
    }
    return {};
}

}  // namespace

std::span<const OperatorLaw> operatorLaws() {
    static constexpr OperatorLaw kLaws[] = {
        {"without a blend it is the plain operator, to the bit", notPlain, true},
        {"a blend moves the surface by at most a quarter of it", strayBlend, true},
        {"it is no steeper than its children", steeperThanOne},
        {"it is commutative if it says so", wrongOrder},
        {"its result lies where its row says", outsideItsChildren, true},
        {"the share is the value's derivative by the second", wrongShare},
        {"all scalars agree", scalarsDisagree},
        {"gradients match differences", wrongGradient},
    };
    return kLaws;
}

}  // namespace mb
