#pragma once
// A joint sweep: which settings of several knobs to try, coarse to fine. It begins with settings spread from the cheapest to the
// dearest, then tries the neighbours of those that nothing beats, by two values of a knob at first and by one when no more of these
// are left (Paquete, Chiarandini and Stuetzle, "Pareto Local Optimum Sets in the Biobjective Traveling Salesman Problem", 2004).
// A search with an aim moves one knob at a time from the best setting so far, then two against one another.
// What it asks for depends on errors and on counted costs alone, so that two runs ask for the same.
#include "core/accuracy/front.h"
#include "core/accuracy/knobs.h"

#include <deque>
#include <set>

namespace mb {

class Search {
public:
    /// What a search for one setting looks for: the cheapest whose error stays within the limit; while there is none, the least wrong.
    struct Aim {
        Error error = Error::color;
        double most = 0;
        bool sampled = false;            // the runs are measured at a part of the picture's pixels
    };
    struct Plan {
        std::vector<const Knob*> knobs;  // those paid in the terms' cost are searched
        Terms terms;                     // errors and a counted cost
        std::size_t most = 200;          // settings
        double dearest = 8;              // times the own setting's cost: nothing is tried beyond what costs more
        std::optional<Aim> aim = {};     // else the whole front
    };
    /// The values tried are each knob's own and those of these settings; whatever else they have stays as in `own`.
    Search(const Setting& own, const Setting& defaults, Plan plan);

    /// The next setting to try, given all the runs so far; none: it is done.
    std::optional<Setting> next(std::span<const Run> runs);
    std::size_t asked() const { return asked_; }
    std::size_t most() const { return plan_.most; }

private:
    using Place = std::vector<int>;      // of each knob: which of its values
    Setting settingAt(const Place& place) const;
    Place placeOf(const Setting& setting) const;
    void want(const Place& place);
    bool wantDiagonal(std::span<const Run> runs);
    void wantNeighbours(std::span<const Run> runs);
    void wantBetter(std::span<const Run> runs, bool pairs);
    bool wantMoved(const Place& from, std::size_t knob, int by, std::size_t other = 0, int other_by = 0);
    double limit(std::span<const Run> runs) const { return plan_.dearest * runs[kOwnRun].costs[plan_.terms.cost]; }

    Setting own_;
    Plan plan_;
    std::vector<std::vector<double>> values_;
    std::deque<Place> wanted_;
    std::set<Place> seen_;
    int diagonal_ = 0, stride_ = 2;
    std::size_t turn_ = 0;               // the knob that is moved first
    std::optional<std::size_t> moved_;   // the one moved last, and the run it was moved from
    std::size_t moved_from_ = 0;
    std::vector<char> idle_;             // those that changed nothing when they were
    std::size_t asked_ = 0;
};

}  // namespace mb
