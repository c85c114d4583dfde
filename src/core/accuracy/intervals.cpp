#include "core/accuracy/intervals.h"

namespace mb::accuracy {
namespace {

/// Walks the ends of a list in order; even ones enter.
struct Walk {
    const Intervals& list;
    std::size_t at = 0;
    bool isDone() const { return at == 2 * list.size(); }
    bool enters() const { return at % 2 == 0; }
    const End& end() const { return enters() ? list[at / 2].enter : list[at / 2].leave; }
    double t() const { return isDone() ? kInfinity : end().t; }
    bool isInside() const { return at % 2 == 1; }
};

bool holds(SetOperation operation, bool a, bool b) {
    switch (operation) {
    case SetOperation::unite: return a || b;
    case SetOperation::intersect: return a && b;
    case SetOperation::subtract: return a && !b;
    }
    return false;
}

}  // namespace

void combine(SetOperation operation, const Intervals& a, const Intervals& b, double reach, Intervals& result) {
    result.clear();
    Walk in_a{a}, in_b{b};
    bool inside = false;
    Interval open;
    while (!in_a.isDone() || !in_b.isDone()) {
        // Pass all ends that are one surface; remember the first of each direction.
        const double t = std::min(in_a.t(), in_b.t()), last = t + tieAt(t, reach);
        bool found[2] = {false, false};
        End ends[2];
        const auto pass = [&](Walk& walk, bool turned) {
            for (; !walk.isDone() && walk.t() <= last; ++walk.at) {
                const std::size_t enters = walk.enters() != turned ? 1 : 0;
                if (found[enters]) continue;
                found[enters] = true, ends[enters] = walk.end();
                if (turned) ends[enters].normal = -ends[enters].normal;
            }
        };
        pass(in_a, false);
        pass(in_b, operation == SetOperation::subtract);

        const bool now = holds(operation, in_a.isInside(), in_b.isInside());
        if (now == inside) continue;
        inside = now;
        if (now) open.enter = ends[1];
        else open.leave = ends[0], result.push_back(open);
    }
}

}  // namespace mb::accuracy
