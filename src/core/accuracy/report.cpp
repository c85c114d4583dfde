#include "core/accuracy/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mb {
namespace {

std::string field(double x) { return std::isnan(x) ? std::string() : fmt::format("{}", x); }
std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + '"';
}

template <class Row> std::string axisName(const Quantity<Row>& row) { return fmt::format("{}, {}", row.name, row.unit); }

/// The setting that counts as the own one; of a sweep that has not begun, the default one.
Setting ownOf(const Sweep& sweep) { return sweep.stands ? *sweep.stands : sweep.runs.empty() ? Setting{} : sweep.runs[kOwnRun].setting; }

/// The runs of one knob alone that did not fail, in the order of its values.
std::vector<const Run*> pointsOf(const Sweep& sweep, const Knob& knob) {
    std::vector<const Run*> points;
    for (const Run& run : sweep.runs)
        if (run.knob == knob.key && !run.failed()) points.push_back(&run);
    return points;
}
bool isOwn(const Sweep& sweep, const Run& run) { return sameKnobs(run.setting, ownOf(sweep), sweep.motion); }

std::string tipOf(const Run& run, const Setting& own, Error error, Cost cost) {
    const std::string what = run.knob.empty() ? differences(run.setting, own) : fmt::format("{}={}", run.knob, brief(run.value));
    return fmt::format("{}: {} {}, {} {} {}", what.empty() ? "the scene's own setting" : what, rowOf(error).name, brief(run.errors[error]), brief(run.costs[cost]), rowOf(cost).name, rowOf(cost).unit);
}
ChartPoint pointOf(const Sweep& sweep, const Run& run, Error error, Cost cost, std::string label = {}) {
    constexpr double kNone = 1e-3;  // of the least that counts: on a logarithmic axis no more is worth a decade
    return {run.errors[error] > kNone * rowOf(error).least ? run.errors[error] : 0, run.costs[cost], std::move(label), tipOf(run, ownOf(sweep), error, cost), static_cast<int>(&run - sweep.runs.data())};
}
bool hasBoth(const Run& run, Error error, Cost cost) { return !run.failed() && run.errors.has(error) && run.costs.has(cost); }

ChartPanel knobPanel(const Sweep& sweep, const Knob& knob, Error error, Cost cost) {
    ChartSeries line{ChartSeries::Look::line, std::string(knob.key), {}}, mine{ChartSeries::Look::own, "the scene's own", {}};
    for (const Run* run : pointsOf(sweep, knob)) {
        if (!hasBoth(*run, error, cost)) continue;
        line.points.push_back(pointOf(sweep, *run, error, cost, brief(run->value)));
        if (isOwn(sweep, *run)) mine.points.push_back(pointOf(sweep, *run, error, cost));
    }
    return {fmt::format("{}: {}", knob.key, rowOf(error).name), axisName(rowOf(error)) + " (less is better)", axisName(rowOf(cost)), {line, mine}};
}

ChartPanel overviewPanel(const Sweep& sweep, Error error) {
    const Cost cost = sweep.terms.cost;
    using Look = ChartSeries::Look;
    ChartSeries all{Look::faint_dots, "a setting tried", {}}, line{Look::line, "nothing is both cheaper and less wrong", {}}, mine{Look::own, "the scene's own", {}},
        defaults{Look::usual, "the program's defaults", {}}, next{Look::better, "the nearest better one", {}};
    for (const Run& run : sweep.runs)
        if (hasBoth(run, error, cost)) all.points.push_back(pointOf(sweep, run, error, cost));
    for (const std::size_t i : frontOf(sweep.runs, error, cost)) line.points.push_back(pointOf(sweep, sweep.runs[i], error, cost));
    const auto mark = [&](ChartSeries& series, std::size_t i) {
        if (hasBoth(sweep.runs[i], error, cost)) series.points.push_back(pointOf(sweep, sweep.runs[i], error, cost));
    };
    if (sweep.runs.size() > kDefaultRun) mark(defaults, kDefaultRun);
    const auto own = std::ranges::find_if(sweep.runs, [&](const Run& run) { return isOwn(sweep, run); });
    if (own != sweep.runs.end()) {
        const auto number = static_cast<std::size_t>(own - sweep.runs.begin());
        mark(mine, number);
        if (const auto nearest = nearestBetter(sweep.runs, number, sweep.terms)) mark(next, *nearest);
    }
    return {fmt::format("All settings: {}", rowOf(error).name), axisName(rowOf(error)) + " (less is better)", axisName(rowOf(cost)), {all, line, defaults, mine, next}};
}

/// The greatest of a knob's values over the least.
template <class Value> double ratioOf(const std::vector<const Run*>& points, Value value) {
    double least = INFINITY, most = 0;
    for (const Run* p : points)
        if (!std::isnan(value(*p))) least = std::min(least, value(*p)), most = std::max(most, value(*p));
    return most <= 0 || least == INFINITY ? 1 : most / std::max(least, 1e-300);
}
bool changesNothing(const Knob& knob, const std::vector<const Run*>& points) {
    for (const Error e : knob.moves)
        if (ratioOf(points, [&](const Run& r) { return std::max(r.errors[e], std::max(rowOf(e).least, 1e-12)); }) > 1 + kSame) return false;
    return ratioOf(points, [&](const Run& r) { return r.costs[knob.cost]; }) < (knob.cost == Cost::ms ? 1.1 : 1 + kSame);
}

}  // namespace

std::string runsCsv(std::span<const Sweep> sweeps) {
    std::string out = "kind,knob,value,set";
    for (const auto& row : errorRows()) out += fmt::format(",{}", row.name);
    for (const auto& row : costRows()) out += fmt::format(",{}", row.name);
    out += ",undecided,status,reason\n";
    for (const Sweep& sweep : sweeps)
        for (std::size_t i = 0; i < sweep.runs.size(); ++i) {
            const Run& run = sweep.runs[i];
            const std::string knob = !run.knob.empty() ? run.knob : i == kOwnRun ? "own" : i == kDefaultRun ? "default" : "together";
            out += fmt::format("{},{},{},{}", sweep.motion ? "motion" : "picture", knob, field(run.value), quoted(differences(run.setting, sweep.runs[kOwnRun].setting)));
            for (const auto& row : errorRows()) out += ',' + field(run.errors[row.row]);
            for (const auto& row : costRows()) out += ',' + field(run.costs[row.row]);
            out += fmt::format(",{},{},{}\n", sweep.motion ? std::string() : field(run.undecided), run.failed() ? "FAILED" : "ok", quoted(run.failure));
        }
    return out;
}

std::vector<ChartPanel> knobPanels(const Sweep& sweep, const Knob& knob) {
    std::vector<ChartPanel> panels;
    for (const Error error : knob.moves) panels.push_back(knobPanel(sweep, knob, error, knob.cost));
    const Cost time = sweep.motion ? Cost::step_ms : Cost::ms;
    if (knob.cost != time) panels.push_back(knobPanel(sweep, knob, knob.moves.front(), time));
    return panels;
}

std::vector<ChartPanel> overviewPanels(const Sweep& sweep) {
    std::vector<ChartPanel> panels;
    for (const Error error : sweep.terms.errors) panels.push_back(overviewPanel(sweep, error));
    return panels;
}

std::string knobSays(const Sweep& sweep, const Knob& knob) {
    const std::vector<const Run*> points = pointsOf(sweep, knob);
    if (points.empty()) return "No value of it gave a picture that counts.";
    if (changesNothing(knob, points)) return "In this scene it changes nothing.";
    const Error error = knob.moves.front();
    const double least = sweep.terms.least[error];
    const auto wrong = [&](const Run* r) { return r->errors[error]; };
    const auto paid = [&](const Run* r) { return r->costs[knob.cost]; };
    const Run* best = *std::ranges::min_element(points, {}, wrong);
    // Of those that are as good as the best, as far as that counts, the cheapest.
    const Run* enough = best;
    for (const Run* p : points)
        if (wrong(p) <= std::max(1.1 * wrong(best), least) && paid(p) < paid(enough)) enough = p;
    std::string text = fmt::format("Its {} error is least at {}: {} for {} {} {}.", rowOf(error).name, brief(best->value), brief(wrong(best)), brief(paid(best)), rowOf(knob.cost).name, rowOf(knob.cost).unit);
    if (std::ranges::all_of(points, [&](const Run* p) { return wrong(p) <= least; })) text = fmt::format("Its {} error is too small to matter at all of its values.", rowOf(error).name);
    if (paid(enough) < (1 - kSame) * paid(best)) text += fmt::format(" {} is as good, as far as it matters, for {}.", brief(enough->value), brief(paid(enough)));
    for (const Run* p : points) {
        if (!isOwn(sweep, *p)) continue;
        text += fmt::format(" The scene has {}: {} for {}", brief(p->value), brief(wrong(p)), brief(paid(p)));
        const bool less_wrong = std::max(wrong(enough), least) < (1 - kSame) * wrong(p), cheaper = paid(enough) < (1 - kSame) * paid(p);
        if ((less_wrong || cheaper) && paid(p) > 0 && wrong(p) > 0)
            text += less_wrong ? fmt::format("; {} would be {:.2g} times as wrong for {:.2g} times the cost", brief(enough->value), wrong(enough) / wrong(p), paid(enough) / paid(p))
                               : fmt::format("; {} would do as well for {:.2g} times the cost", brief(enough->value), paid(enough) / paid(p));
        text += ".";
        break;
    }
    return text;
}

std::string frontSays(const Sweep& sweep) {
    if (sweep.runs.size() <= kDefaultRun) return "Nothing was tried yet.";
    const auto failed = static_cast<std::size_t>(std::ranges::count_if(sweep.runs, &Run::failed));
    const std::vector<std::size_t> front = unbeaten(sweep.runs, sweep.terms);
    const auto stands = [&](std::size_t i) {
        if (sweep.runs[i].failed()) return fmt::format("failed: {}", sweep.runs[i].failure);
        return std::string(std::ranges::find(front, i) != front.end() ? "is one of these" : "is not one of these");
    };
    std::string text = fmt::format("Of {} settings {} failed, and {} that differ are beaten by none: no other is at most as wrong in every error, as far as that counts, and as cheap, and better in one of them. "
                                   "The scene's own setting {}; that of the program's defaults {}.", sweep.runs.size(), failed, distinct(sweep.runs, front, sweep.terms).size(), stands(kOwnRun), stands(kDefaultRun));
    if (const auto nearest = nearestBetter(sweep.runs, kOwnRun, sweep.terms)) {
        const Run &better = sweep.runs[*nearest], &own = sweep.runs[kOwnRun];
        text += fmt::format(" The nearest better one has {} and costs {:.3g} times as much", differences(better.setting, own.setting), better.costs[sweep.terms.cost] / own.costs[sweep.terms.cost]);
        for (const Error e : sweep.terms.errors)
            if (better.errors.has(e) && better.errors[e] < (1 - kSame) * own.errors[e] && own.errors[e] > sweep.terms.least[e]) text += fmt::format(", {} {} instead of {}", rowOf(e).name, brief(better.errors[e]), brief(own.errors[e]));
        text += ".";
    }
    return text;
}

}  // namespace mb
