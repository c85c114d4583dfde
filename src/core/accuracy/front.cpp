#include "core/accuracy/front.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace mb {
namespace {

constexpr Error kPicture[] = {Error::color, Error::shade, Error::state, Error::depth, Error::normal};
constexpr Error kMotion[] = {Error::position, Error::energy, Error::penetration, Error::restitution};

Terms termsOf(std::span<const Error> errors, Cost cost, std::initializer_list<std::pair<Error, double>> noise) {
    Terms terms{errors, cost, {}};
    for (const Error e : errors) terms.least[e] = rowOf(e).least;
    for (const auto& [error, off] : noise) terms.least[error] = std::max(terms.least[error], off);
    return terms;
}

/// A run's cost, then its errors, none below what counts; the least there is where nothing was measured. And what each must be less
/// by to be better.
struct Compared {
    std::vector<double> values, margins;
};
Compared comparedOf(const Run& run, const Terms& terms) {
    const double cost = run.costs[terms.cost];
    Compared c{{cost}, {kSame * cost}};
    for (const Error e : terms.errors) {
        const double value = run.errors.has(e) ? std::max(run.errors[e], terms.least[e]) : terms.least[e];
        c.values.push_back(value);
        c.margins.push_back(std::max(kSame * value, run.off.has(e) ? run.off[e] : 0));
    }
    return c;
}
bool beats(const Compared& a, const Compared& b) {
    bool better = false;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        if (!(a.values[i] <= b.values[i])) return false;
        better = better || a.values[i] < b.values[i] - b.margins[i];
    }
    return better;
}

/// The run that is less in `first`, of equals that in `second`, of those that satisfy `wanted`.
template <class First, class Second, class Wanted>
std::optional<std::size_t> least(std::span<const Run> runs, First first, Second second, Wanted wanted) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (runs[i].failed() || runs[i].aside || std::isnan(first(runs[i])) || std::isnan(second(runs[i])) || !wanted(runs[i])) continue;
        if (!best || std::pair{first(runs[i]), second(runs[i])} < std::pair{first(runs[*best]), second(runs[*best])}) best = i;
    }
    return best;
}

/// How far two values are apart, as a ratio's logarithm; what is smaller than `floor` counts as that.
double apart(double a, double b, double floor) { return std::fabs(std::log(std::max(a, floor) / std::max(b, floor))); }

}  // namespace

Terms pictureTerms(double color) { return termsOf(kPicture, Cost::evaluations, {{Error::color, color}}); }
Terms motionTerms(double place, double energy) { return termsOf(kMotion, Cost::visits, {{Error::position, place}, {Error::energy, energy}}); }

bool beats(const Run& a, const Run& b, const Terms& terms) {
    return !a.failed() && !b.failed() && !a.aside && !b.aside && beats(comparedOf(a, terms), comparedOf(b, terms));
}

std::vector<std::size_t> unbeaten(std::span<const Run> runs, const Terms& terms) {
    std::vector<Compared> values;
    for (const Run& run : runs) values.push_back(comparedOf(run, terms));
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        bool beaten = runs[i].failed() || runs[i].aside;
        for (std::size_t k = 0; k < runs.size() && !beaten; ++k) beaten = !runs[k].failed() && !runs[k].aside && beats(values[k], values[i]);
        if (!beaten) found.push_back(i);
    }
    return found;
}

std::vector<std::size_t> distinct(std::span<const Run> runs, std::span<const std::size_t> of, const Terms& terms) {
    std::set<std::vector<long>> seen;
    std::vector<std::size_t> first;
    for (const std::size_t i : of) {
        std::vector<long> classes;  // of values a kSame wide
        for (const double v : comparedOf(runs[i], terms).values) classes.push_back(v > 0 ? std::lround(std::log(v) / std::log1p(kSame)) : std::numeric_limits<long>::min());
        if (seen.insert(classes).second) first.push_back(i);
    }
    return first;
}

std::vector<std::size_t> frontOf(std::span<const Run> runs, Error error, Cost cost) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < runs.size(); ++i)
        if (!runs[i].failed() && !runs[i].aside && runs[i].errors.has(error) && runs[i].costs.has(cost)) order.push_back(i);
    std::ranges::sort(order, {}, [&](std::size_t i) { return std::tuple{runs[i].costs[cost], runs[i].errors[error], i}; });
    std::vector<std::size_t> front;
    for (const std::size_t i : order)
        if (front.empty() || runs[i].errors[error] < runs[front.back()].errors[error]) front.push_back(i);
    return front;
}

double surely(const Run& run, Error error, bool sampled) { return run.errors[error] + (sampled && run.off.has(error) ? 2 * run.off[error] : 0); }

std::optional<std::size_t> cheapestWithin(std::span<const Run> runs, Error error, double most, Cost cost) {
    return least(runs, [&](const Run& r) { return r.costs[cost]; }, [&](const Run& r) { return r.errors[error]; },
                 [&](const Run& r) { return r.errors[error] <= most; });
}
std::optional<std::size_t> leastWrongWithin(std::span<const Run> runs, Cost cost, double most, Error error) {
    return least(runs, [&](const Run& r) { return r.errors[error]; }, [&](const Run& r) { return r.costs[cost]; },
                 [&](const Run& r) { return r.costs[cost] <= most; });
}
std::optional<std::size_t> leastWrong(std::span<const Run> runs, Error error, Cost cost) {
    return leastWrongWithin(runs, cost, std::numeric_limits<double>::infinity(), error);
}
std::optional<std::size_t> cheapest(std::span<const Run> runs, Cost cost, Error error) {
    return cheapestWithin(runs, error, std::numeric_limits<double>::infinity(), cost);
}

std::optional<std::size_t> nearestBetter(std::span<const Run> runs, std::size_t own, const Terms& terms) {
    std::optional<std::size_t> best;
    double least_apart = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (!beats(runs[i], runs[own], terms)) continue;
        double sum = apart(runs[i].costs[terms.cost], runs[own].costs[terms.cost], 1e-12);
        for (const Error e : terms.errors)
            if (runs[i].errors.has(e) && runs[own].errors.has(e)) sum += apart(runs[i].errors[e], runs[own].errors[e], std::max(terms.least[e], 1e-12));
        if (sum < least_apart) least_apart = sum, best = i;
    }
    return best;
}

}  // namespace mb
