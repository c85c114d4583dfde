#include "core/accuracy/search.h"

#include <algorithm>
#include <cmath>

namespace mb {

Search::Search(const Setting& own, const Setting& defaults, Plan plan) : own_(own), plan_(std::move(plan)) {
    std::erase_if(plan_.knobs, [&](const Knob* knob) { return knob->cost != plan_.terms.cost; });
    for (const Knob* knob : plan_.knobs) values_.push_back(valuesWith(*knob, {valueOf(own, *knob), valueOf(defaults, *knob)}));
    seen_ = {placeOf(own), placeOf(defaults)};  // every sweep begins with these
}

Setting Search::settingAt(const Place& place) const {
    Setting setting = own_;
    for (std::size_t k = 0; k < place.size(); ++k) setting = turned(setting, *plan_.knobs[k], values_[k][static_cast<std::size_t>(place[k])]);
    return setting;
}

Search::Place Search::placeOf(const Setting& setting) const {
    Place place;
    for (std::size_t k = 0; k < plan_.knobs.size(); ++k) {
        const double value = valueOf(setting, *plan_.knobs[k]);
        const auto found = std::ranges::min_element(values_[k], {}, [&](double v) { return std::fabs(v - value); });
        place.push_back(static_cast<int>(found - values_[k].begin()));
    }
    return place;
}

void Search::want(const Place& place) {
    if (seen_.insert(place).second) wanted_.push_back(place);
}

/// The next setting on the way from the cheap ends of all knobs to the dear ones, as long as the last was not too dear.
bool Search::wantDiagonal(std::span<const Run> runs) {
    constexpr int kSteps = 9;
    while (diagonal_ < kSteps && wanted_.empty()) {
        if (diagonal_ > 0 && runs.back().costs[plan_.terms.cost] > limit(runs)) diagonal_ = kSteps;
        Place place;
        for (const std::vector<double>& values : values_) place.push_back((diagonal_ * (static_cast<int>(values.size()) - 1) + kSteps / 2) / (kSteps - 1));
        if (diagonal_ < kSteps) want(place);
        ++diagonal_;
    }
    return !wanted_.empty();
}

/// Of the runs on the line of each error, the places a stride off along each knob.
void Search::wantNeighbours(std::span<const Run> runs) {
    for (const Error error : plan_.terms.errors)
        for (const std::size_t i : frontOf(runs, error, plan_.terms.cost)) {
            if (runs[i].costs[plan_.terms.cost] > limit(runs)) continue;
            const Place place = placeOf(runs[i].setting);
            for (std::size_t k = 0; k < place.size(); ++k)
                for (const int by : {-stride_, stride_}) {
                    Place next = place;
                    next[k] = std::clamp(next[k] + by, 0, static_cast<int>(values_[k].size()) - 1);
                    want(next);
                }
        }
}

/// A place that was not seen, one or two knobs away; says whether it is one.
bool Search::wantMoved(const Place& from, std::size_t knob, int by, std::size_t other, int other_by) {
    Place place = from;
    const auto move = [&](std::size_t k, int step) { place[k] = std::clamp(place[k] + step, 0, static_cast<int>(values_[k].size()) - 1); };
    move(knob, by), move(other, other_by);
    want(place);
    return !wanted_.empty();
}

/// One move from the best run, or from the own one if all failed: of a knob towards cheap, by two values or by one, then towards dear, and at
/// last of two knobs against one another. What has just been better is moved on; a knob that changed nothing has to wait.
void Search::wantBetter(std::span<const Run> runs, bool pairs) {
    constexpr double kWorth = 0.1;  // a tenth less error is worth a hundredth of the cost: another knob may then be cheaper
    const auto badness = [&](const Run& r) {
        const double error = surely(r, plan_.aim->error, plan_.aim->sampled), cost = r.costs[plan_.terms.cost];
        return error <= plan_.aim->most ? std::pair{0.0, cost * std::pow(std::max(error, 1e-9), kWorth)} : std::pair{1.0, error};
    };
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < runs.size(); ++i)
        if (!runs[i].failed() && !runs[i].aside && !std::isnan(badness(runs[i]).second) && (!best || badness(runs[i]) < badness(runs[*best]))) best = i;
    const Run& start = runs[best.value_or(kOwnRun)];
    const Place from = placeOf(start.setting);
    const std::size_t n = from.size();

    idle_.resize(n, 0);
    if (moved_) {
        const auto same = [](double a, double b) { return std::fabs(a - b) <= 1e-3 * std::max(a, b); };
        const Run &was = runs[moved_from_], &is = runs.back();
        idle_[*moved_] = same(was.costs[plan_.terms.cost], is.costs[plan_.terms.cost]) && same(was.errors[plan_.aim->error], is.errors[plan_.aim->error]);
        if (best.value_or(kOwnRun) + 1 != runs.size()) ++turn_;
    }
    moved_.reset();
    const bool cheaper = !best || badness(start).first == 0;
    for (const bool idle : {false, true})
        for (const int way : {-1, 1})
            for (std::size_t i = 0; i < n; ++i)
                for (const int by : {2, 1}) {
                    const std::size_t knob = (turn_ + i) % n;
                    if (static_cast<bool>(idle_[knob]) != idle || !wantMoved(from, knob, cheaper ? way * by : -way * by)) continue;
                    turn_ = by == 2 ? knob + n - 1 : knob;  // after two values, one of the same
                    return void((moved_ = knob, moved_from_ = best.value_or(kOwnRun)));
                }
    if (!pairs) return;
    for (const int other_by : {1, 2, -1})
        for (const int by : {-1, -2})
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t k = 0; k < n; ++k)
                    if (i != k && wantMoved(from, (turn_ + i) % n, by, (turn_ + k) % n, other_by)) return;
}

std::optional<Setting> Search::next(std::span<const Run> runs) {
    if (asked_ >= plan_.most || plan_.knobs.empty()) return std::nullopt;
    // With an aim, half of the settings are moves from those there are, before others from cheap to dear are tried.
    if (plan_.aim && wanted_.empty()) {
        if (asked_ < plan_.most / 2) wantBetter(runs, false);
        if (wanted_.empty() && !wantDiagonal(runs)) wantBetter(runs, true);
        if (wanted_.empty()) return std::nullopt;
    }
    while (wanted_.empty() && !wantDiagonal(runs)) {
        wantNeighbours(runs);
        if (!wanted_.empty()) break;
        if (stride_ == 1) return std::nullopt;
        stride_ = 1;
    }
    const Place place = wanted_.front();
    wanted_.pop_front();
    ++asked_;
    return settingAt(place);
}

}  // namespace mb
