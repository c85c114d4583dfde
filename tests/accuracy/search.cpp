// What a joint sweep asks for, on made-up problems whose front is known.
#include "core/accuracy/search.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <map>

using namespace mb;

namespace {

using Measure = std::function<void(Run&)>;
/// A search to its end: the own run, the default one, then what it asks for.
std::vector<Run> searched(Search search, const Setting& own, const Setting& usual, const Measure& measure) {
    std::vector<Run> runs;
    const auto add = [&](const Setting& setting) {
        Run run = runOf(setting);
        measure(run);
        runs.push_back(run);
    };
    add(own), add(usual);
    while (const auto next = search.next(runs)) {
        add(*next);
        REQUIRE(runs.size() < 5000);
    }
    CHECK(!search.next(runs));
    CHECK(search.asked() + 2 == runs.size());
    return runs;
}

/// Two knobs that work alike: samples of a pixel divide the color error, steps the other; each is paid for.
void twoKnobs(Run& run) {
    const double samples = run.setting.render.samples, steps = run.setting.render.march_steps;
    run.errors[Error::color] = 0.1 / samples + 0.4 / steps;
    run.errors[Error::shade] = 0.3 / steps, run.errors[Error::state] = 0.2 / steps, run.errors[Error::depth] = 0.01 / steps, run.errors[Error::normal] = 1;
    run.costs[Cost::evaluations] = samples * (20 + steps);
}
std::vector<const Knob*> named(std::initializer_list<const char*> names) {
    std::vector<const Knob*> list;
    for (const char* n : names) list.push_back(&knobNamed(n));
    return list;
}
Setting middle() {
    Setting s;
    s.render.samples = 3, s.render.march_steps = 64;
    return s;
}

}  // namespace

TEST_CASE("search: nothing is asked twice, nor the own and the default again; the same runs, the same questions") {
    const Setting own = middle(), usual;
    const Search::Plan plan{named({"samples", "march_steps", "relaxation"}), pictureTerms(), 1000, 1e9};
    const std::vector<Run> a = searched({own, usual, plan}, own, usual, twoKnobs), b = searched({own, usual, plan}, own, usual, twoKnobs);
    std::vector<std::string> names;
    for (const Run& r : a) names.push_back(differences(r.setting, {}));
    std::ranges::sort(names);
    CHECK(std::ranges::adjacent_find(names) == names.end());
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) CHECK(differences(a[i].setting, b[i].setting) == "");
    // What is no knob of the plan stays the own.
    for (const Run& r : a)
        if (&r != &a[kDefaultRun]) CHECK(r.setting.render.reflections == own.render.reflections);
}

TEST_CASE("search: it asks for no more than it may, and ends by itself") {
    const Setting own = middle(), usual;
    for (const std::size_t most : {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{40}}) {
        Search search(own, usual, {named({"samples", "march_steps"}), pictureTerms(), most, 1e9});
        const std::vector<Run> runs = searched(search, own, usual, twoKnobs);
        CHECK(runs.size() <= most + 2);
        if (most <= 7) CHECK(runs.size() == most + 2);
    }
    Search nothing(own, usual, {{}, pictureTerms(), 100, 8});
    CHECK(searched(nothing, own, usual, twoKnobs).size() == 2);
    // All fail: the settings spread over all are tried, and no neighbour of any.
    const auto fails = [](Run& run) { twoKnobs(run), run.failure = "always"; };
    Search hopeless(own, usual, {named({"samples", "march_steps"}), pictureTerms(), 1000, 1e9});
    CHECK(searched(hopeless, own, usual, fails).size() <= 2 + 9);
}

TEST_CASE("search: nothing next to what is dearer than the limit is asked for that reason") {
    const Setting own = middle(), usual = own;
    constexpr double kDearest = 3;
    const std::vector<const Knob*> knobs = named({"samples", "march_steps"});
    const std::vector<Run> runs = searched({own, usual, {knobs, pictureTerms(), 1000, kDearest}}, own, usual, twoKnobs);
    const double limit = kDearest * runs[kOwnRun].costs[Cost::evaluations];
    // Past the settings spread over all, each is within two values along one knob of an affordable one.
    const auto placeOf = [&](const Run& r, std::size_t k) {
        const std::vector<double> values = valuesWith(*knobs[k], {valueOf(own, *knobs[k])});
        return std::ranges::find(values, valueOf(r.setting, *knobs[k])) - values.begin();
    };
    int dear = 0;
    for (std::size_t i = 2 + 9; i < runs.size(); ++i) {
        dear += runs[i].costs[Cost::evaluations] > limit;
        bool near = false;
        for (std::size_t j = 0; j < i && !near; ++j) {
            if (runs[j].costs[Cost::evaluations] > limit) continue;
            const auto a = std::abs(placeOf(runs[i], 0) - placeOf(runs[j], 0)), b = std::abs(placeOf(runs[i], 1) - placeOf(runs[j], 1));
            near = (a == 0 && b <= 2) || (b == 0 && a <= 2);
        }
        CHECK(near);
    }
    CHECK(dear > 0);
    // And of the settings spread from cheap to dear no more than one is beyond it.
    const auto all = searched({own, usual, {knobs, pictureTerms(), 1000, 1e9}}, own, usual, twoKnobs);
    CHECK(all.size() > runs.size());
}

TEST_CASE("search: of a known front nearly all is found by a part of the settings") {
    const std::vector<const Knob*> knobs = named({"samples", "march_steps", "normal_taps", "bias"});
    // Of four knobs two matter; the other two only cost or only hurt.
    const auto measure = [](Run& run) {
        twoKnobs(run);
        const PhysicsKnobs& unused = run.setting.physics;
        CHECK(unused.substeps == PhysicsKnobs{}.substeps);
        run.errors[Error::color] += 1e-3 * std::fabs(std::log2(run.setting.render.bias / 2));
        run.costs[Cost::evaluations] *= 1 + 0.1 * (run.setting.render.normal_taps - 4);
        run.errors[Error::normal] = run.setting.render.normal_taps == 6 ? 0.5 : 1;
    };
    const Setting own = middle(), usual = own;
    std::vector<Run> all;
    const std::function<void(Setting, std::size_t)> every = [&](Setting s, std::size_t k) {
        if (k == knobs.size()) {
            Run run = runOf(s);
            measure(run), all.push_back(run);
            return;
        }
        for (const double v : valuesWith(*knobs[k], {valueOf(own, *knobs[k])})) every(turned(s, *knobs[k], v), k + 1);
    };
    every(own, 0);
    const std::vector<Run> runs = searched({own, usual, {knobs, pictureTerms(), 100000, 1e9}}, own, usual, measure);
    CHECK(runs.size() < all.size() / 2);
    std::map<std::string, bool> tried;
    for (const Run& r : runs) tried[differences(r.setting, {})] = true;
    for (const Error e : {Error::color, Error::state, Error::normal}) {
        // A point of the line is found where the search has one as cheap and as right, within 1 %.
        const std::vector<std::size_t> front = frontOf(all, e, Cost::evaluations);
        int found = 0;
        for (const std::size_t i : front)
            found += std::ranges::any_of(runs, [&](const Run& r) { return r.errors[e] <= 1.01 * all[i].errors[e] && r.costs[Cost::evaluations] <= 1.01 * all[i].costs[Cost::evaluations]; });
        MESSAGE(std::string(rowOf(e).name) << ": " << found << " of " << front.size() << " with " << runs.size() << " of " << all.size() << " settings");
        CHECK(found >= 0.95 * static_cast<double>(front.size()));
    }
}

TEST_CASE("search: with an aim it finds the cheapest setting within the limit, or the least wrong, by few questions") {
    const std::vector<const Knob*> knobs = named({"samples", "march_steps", "normal_taps", "bias"});
    const auto measure = [](Run& run) {
        twoKnobs(run);
        run.errors[Error::color] += 1e-3 * std::fabs(std::log2(run.setting.render.bias / 2));
        run.costs[Cost::evaluations] *= 1 + 0.1 * (run.setting.render.normal_taps - 4);
    };
    const Setting own = middle(), usual;
    std::vector<Run> all;
    const std::function<void(Setting, std::size_t)> every = [&](Setting s, std::size_t k) {
        if (k == knobs.size()) {
            Run run = runOf(s);
            measure(run), all.push_back(run);
            return;
        }
        std::vector<double> values = valuesWith(*knobs[k], {valueOf(own, *knobs[k])});
        if (const double u = valueOf(usual, *knobs[k]); std::ranges::find(values, u) == values.end()) values.push_back(u);
        for (const double v : values) every(turned(s, *knobs[k], v), k + 1);
    };
    every(own, 0);
    for (const double limit : {0.2, 0.1, 0.06, 0.03, 0.015, 0.008, 1e-9}) {
        CAPTURE(limit);
        const Search::Plan plan{knobs, pictureTerms(), 60, 1e9, Search::Aim{Error::color, limit}};
        const std::vector<Run> runs = searched({own, usual, plan}, own, usual, measure), again = searched({own, usual, plan}, own, usual, measure);
        CHECK(runs.size() <= 62);
        std::vector<std::string> names;
        for (const Run& r : runs) names.push_back(differences(r.setting, {}));
        for (std::size_t i = 0; i < runs.size(); ++i) CHECK(differences(runs[i].setting, again[i].setting) == "");
        std::ranges::sort(names);
        CHECK(std::ranges::adjacent_find(names) == names.end());
        const auto best = cheapestWithin(all, Error::color, limit, Cost::evaluations), found = cheapestWithin(runs, Error::color, limit, Cost::evaluations);
        REQUIRE(best.has_value() == found.has_value());
        if (best) CHECK(runs[*found].costs[Cost::evaluations] <= 1.1 * all[*best].costs[Cost::evaluations]);
        else CHECK(runs[*leastWrong(runs, Error::color, Cost::evaluations)].errors[Error::color] <= 1.05 * all[*leastWrong(all, Error::color, Cost::evaluations)].errors[Error::color]);
    }
    // How far the whole picture's error may lie above that of the pixels measured counts too.
    const auto unsure = [&](Run& run) { measure(run), run.off[Error::color] = 0.25 * run.errors[Error::color]; };
    const std::vector<Run> careful = searched({own, usual, {knobs, pictureTerms(), 60, 1e9, Search::Aim{Error::color, 0.06, true}}}, own, usual, unsure);
    double cheapest_careful = 1e300, cheapest_of_all = 1e300;
    for (const Run& r : careful)
        if (1.5 * r.errors[Error::color] <= 0.06) cheapest_careful = std::min(cheapest_careful, r.costs[Cost::evaluations]);
    for (const Run& r : all)
        if (1.5 * r.errors[Error::color] <= 0.06) cheapest_of_all = std::min(cheapest_of_all, r.costs[Cost::evaluations]);
    CHECK(cheapest_careful <= 1.1 * cheapest_of_all);
}
