// The laws of fronts, over random runs and against their definitions.
#include "core/accuracy/front.h"
#include "made_runs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

using namespace mb;

namespace {

/// The definition of beats(), read from front.h.
bool beatsByDefinition(const Run& a, const Run& b, const Terms& terms) {
    if (a.failed() || b.failed() || a.aside || b.aside) return false;
    if (!(a.costs[terms.cost] <= b.costs[terms.cost])) return false;
    bool better = a.costs[terms.cost] < (1 - kSame) * b.costs[terms.cost];
    for (const Error e : terms.errors) {
        const double x = a.errors.has(e) ? std::max(a.errors[e], terms.least[e]) : terms.least[e], y = b.errors.has(e) ? std::max(b.errors[e], terms.least[e]) : terms.least[e];
        if (x > y) return false;
        better = better || x < y - std::max(kSame * y, b.off.has(e) ? b.off[e] : 0);
    }
    return better;
}

}  // namespace

TEST_CASE("front: to beat is a strict order, as defined") {
    Draw draw(streamOf("beats"));
    int pairs = 0, chains = 0;
    for (int round = 0; round < times(80); ++round) {
        const std::vector<Run> runs = drawRuns(draw, 25, 2 + round % 6);
        const Terms terms = pictureTerms(draw.oneIn(2) ? 0 : 0.02);
        for (const Run& a : runs) {
            CHECK(!beats(a, a, terms));
            for (const Run& b : runs) {
                const bool ab = beats(a, b, terms);
                CHECK(ab == beatsByDefinition(a, b, terms));
                if (!ab) continue;
                ++pairs;
                CHECK(!beats(b, a, terms));
                CHECK(!a.failed());
                for (const Run& c : runs)
                    if (beats(b, c, terms)) {
                        CHECK(beats(a, c, terms));
                        ++chains;
                    }
            }
        }
    }
    CHECK(pairs > 1000);
    CHECK(chains > 500);
}

TEST_CASE("front: less by no more than chance makes is not less") {
    Draw draw(streamOf("chance"));
    int by_chance = 0;
    for (int round = 0; round < times(300); ++round) {
        std::vector<Run> runs = drawRuns(draw, 12, 3);
        for (Run& run : runs) run.costs[Cost::evaluations] = 1;  // else the cost decides
        const std::vector<Run> sure = runs;
        for (Run& run : runs)
            for (const Error e : pictureTerms().errors)
                if (draw.oneIn(2)) run.off[e] = draw.uniform(0, 1) * (run.errors.has(e) ? run.errors[e] : 0);
        for (std::size_t a = 0; a < runs.size(); ++a)
            for (std::size_t b = 0; b < runs.size(); ++b) {
                const bool ab = beats(runs[a], runs[b], pictureTerms());
                CHECK(ab == beatsByDefinition(runs[a], runs[b], pictureTerms()));
                CHECK((!ab || beats(sure[a], sure[b], pictureTerms())));
                by_chance += !ab && beats(sure[a], sure[b], pictureTerms());
            }
    }
    CHECK(by_chance > 50);
}

TEST_CASE("front: the unbeaten are those that none beats; the distinct are of them, and close to each left out") {
    Draw draw(streamOf("unbeaten"));
    int left_out = 0;
    for (int round = 0; round < times(60); ++round) {
        const std::vector<Run> runs = drawRuns(draw, 40, 2 + round % 6);
        const Terms terms = pictureTerms();
        const std::vector<std::size_t> found = unbeaten(runs, terms);
        for (std::size_t i = 0; i < runs.size(); ++i) {
            const bool beaten = runs[i].failed() || runs[i].aside || std::ranges::any_of(runs, [&](const Run& other) { return beatsByDefinition(other, runs[i], terms); });
            CHECK((std::ranges::find(found, i) == found.end()) == beaten);
        }
        CHECK(std::ranges::is_sorted(found));
        // What is beaten is beaten by one of the unbeaten.
        for (std::size_t i = 0; i < runs.size(); ++i)
            if (!runs[i].failed() && !runs[i].aside && std::ranges::find(found, i) == found.end())
                CHECK(std::ranges::any_of(found, [&](std::size_t f) { return beats(runs[f], runs[i], terms); }));
        const std::vector<std::size_t> kept = distinct(runs, found, terms);
        for (const std::size_t i : found) {
            if (std::ranges::find(kept, i) != kept.end()) continue;
            ++left_out;
            CHECK(std::ranges::any_of(kept, [&](std::size_t k) {
                const auto close = [](double a, double b) { return a == b || std::fabs(std::log(a / b)) <= std::log1p(kSame) * (1 + 1e-9); };
                bool all = k < i && close(runs[k].costs[terms.cost], runs[i].costs[terms.cost]);
                for (const Error e : terms.errors) {
                    const auto counted = [&](const Run& r) { return r.errors.has(e) ? std::max(r.errors[e], terms.least[e]) : terms.least[e]; };
                    all = all && close(counted(runs[k]), counted(runs[i]));
                }
                return all;
            }));
        }
    }
    CHECK(left_out > 0);
}

TEST_CASE("front: the line of one error rises in cost and falls in error, and no run lies below it") {
    Draw draw(streamOf("front of"));
    for (int round = 0; round < times(60); ++round) {
        std::vector<Run> runs = drawRuns(draw, 40, 2 + round % 9);
        runs.front().costs[Cost::evaluations] = kNotMeasured;
        const std::vector<std::size_t> front = frontOf(runs, Error::color, Cost::evaluations);
        const auto error = [&](std::size_t i) { return runs[i].errors[Error::color]; };
        const auto cost = [&](std::size_t i) { return runs[i].costs[Cost::evaluations]; };
        for (std::size_t k = 0; k < front.size(); ++k) {
            CHECK(!runs[front[k]].failed());
            CHECK(!runs[front[k]].aside);
            CHECK(!std::isnan(error(front[k])));
            CHECK(!std::isnan(cost(front[k])));
            if (k > 0) CHECK((cost(front[k]) > cost(front[k - 1]) && error(front[k]) < error(front[k - 1])));
        }
        for (std::size_t i = 0; i < runs.size(); ++i) {
            if (runs[i].failed() || runs[i].aside || std::isnan(error(i)) || std::isnan(cost(i))) continue;
            CHECK(std::ranges::any_of(front, [&](std::size_t f) { return cost(f) <= cost(i) && error(f) <= error(i); }));
        }
    }
    CHECK(frontOf({}, Error::color, Cost::evaluations).empty());
}

TEST_CASE("front: the cheapest within a limit and the least wrong within one, by brute force") {
    Draw draw(streamOf("within"));
    int found = 0, none = 0;
    for (int round = 0; round < times(300); ++round) {
        const std::vector<Run> runs = drawRuns(draw, 1 + draw.below(20), 2 + round % 9);
        const double most_error = std::pow(10.0, draw.uniform(-2, 0.2)), most_cost = std::pow(1.3, draw.uniform(-1, 8));
        const auto best = [&](auto wanted, auto first, auto second) {
            std::optional<std::size_t> one;
            for (std::size_t i = 0; i < runs.size(); ++i) {
                const Run& r = runs[i];
                if (r.failed() || r.aside || std::isnan(r.errors[Error::color]) || !wanted(r)) continue;
                if (!one || first(r) < first(runs[*one]) || (first(r) == first(runs[*one]) && second(r) < second(runs[*one]))) one = i;
            }
            return one;
        };
        const auto error = [](const Run& r) { return r.errors[Error::color]; };
        const auto cost = [](const Run& r) { return r.costs[Cost::evaluations]; };
        const auto cheap = cheapestWithin(runs, Error::color, most_error, Cost::evaluations);
        CHECK(cheap == best([&](const Run& r) { return error(r) <= most_error; }, cost, error));
        CHECK(leastWrongWithin(runs, Cost::evaluations, most_cost, Error::color) == best([&](const Run& r) { return cost(r) <= most_cost; }, error, cost));
        CHECK(leastWrong(runs, Error::color, Cost::evaluations) == best([](const Run&) { return true; }, error, cost));
        CHECK(cheapest(runs, Cost::evaluations, Error::color) == best([](const Run&) { return true; }, cost, error));
        ++(cheap ? found : none);
    }
    CHECK(found > 50);
    CHECK(none > 5);
}

TEST_CASE("front: the nearest better one beats the own, and nothing that does is nearer") {
    Draw draw(streamOf("nearest better"));
    int found = 0;
    for (int round = 0; round < times(100); ++round) {
        const std::vector<Run> runs = drawRuns(draw, 30, 4);
        const Terms terms = pictureTerms();
        const auto nearest = nearestBetter(runs, kOwnRun, terms);
        const auto apart = [&](std::size_t i) {
            double sum = std::fabs(std::log(runs[i].costs[terms.cost] / runs[kOwnRun].costs[terms.cost]));
            for (const Error e : terms.errors)
                if (runs[i].errors.has(e) && runs[kOwnRun].errors.has(e)) {
                    const double floor = std::max(terms.least[e], 1e-12);
                    sum += std::fabs(std::log(std::max(runs[i].errors[e], floor) / std::max(runs[kOwnRun].errors[e], floor)));
                }
            return sum;
        };
        bool any = false;
        for (std::size_t i = 0; i < runs.size(); ++i)
            if (beats(runs[i], runs[kOwnRun], terms)) {
                any = true;
                REQUIRE(nearest);
                CHECK(apart(*nearest) <= apart(i) * (1 + 1e-12));
            }
        CHECK(nearest.has_value() == any);
        if (!nearest) continue;
        CHECK(beats(runs[*nearest], runs[kOwnRun], terms));
        ++found;
    }
    CHECK(found > 20);
}
