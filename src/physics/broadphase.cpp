#include "physics/broadphase.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>

namespace mb {
namespace {

/// Pairs that grow by those that overlap; whether one does is no branch, which the processor would guess wrong.
class Pairs {
public:
    /// Makes room for that many more.
    void expect(std::size_t more) {
        if (count_ + more > all_.size()) all_.resize(2 * (count_ + more));
    }
    void add(int a, int b, bool overlaps) {
        all_[count_] = std::minmax(a, b);
        count_ += overlaps;
    }
    std::vector<std::pair<int, int>> taken() {
        all_.resize(count_);
        return std::move(all_);
    }

private:
    std::vector<std::pair<int, int>> all_;
    std::size_t count_ = 0;
};

/// The bodies of about one size, in rows along x: the rows by z, then y, and each by x.
class Level {
public:
    struct Entry {
        std::uint64_t row = 0;
        int body = 0;
        Reach reach;
        double x() const { return reach.centre.x; }
    };

    Level(std::span<const Reach> bodies, std::span<const int> members) : lo_(INFINITY) {
        for (const int i : members) {
            lo_ = glm::min(lo_, bodies[static_cast<std::size_t>(i)].centre);
            largest_ = std::max(largest_, bodies[static_cast<std::size_t>(i)].reach);
        }
        entries_.reserve(members.size());
        for (const int i : members) {
            const Reach& r = bodies[static_cast<std::size_t>(i)];
            entries_.push_back({rowOf(cellOf(r.centre.z, 2), cellOf(r.centre.y, 1)), i, r});
        }
        std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
            return a.row != b.row ? a.row < b.row : a.x() != b.x() ? a.x() < b.x() : a.body < b.body;
        });
    }

    /// Of the level's own: each with those behind it in its row, and with the rows around it that are behind in the order.
    void addPairs(Pairs& io_pairs) const {
        constexpr std::array<std::uint64_t, 4> kRows{1, kLayer - 1, kLayer, kLayer + 1};
        std::array<std::size_t, kRows.size()> first{};  // where each row's neighbours begin: they come in order, as the entries do
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            const Entry& e = entries_[i];
            io_pairs.expect(entries_.size());
            addRow(e, e.row, i + 1, io_pairs);
            const double begin = e.x() - apart(largest_, e.x());
            for (std::size_t k = 0; k < kRows.size(); ++k) {
                const std::uint64_t row = e.row + kRows[k];
                while (first[k] < entries_.size() && isBefore(entries_[first[k]], row, begin)) ++first[k];
                addRow(e, row, first[k], io_pairs);
            }
        }
    }
    /// Of one of a coarser level with this one's: row by row, from each to the next that there is.
    void addPairsOf(const Entry& coarser, Pairs& io_pairs) const {
        const Rows rows = rowsOf(coarser.reach);
        io_pairs.expect(entries_.size());
        const double begin = coarser.x() - apart(coarser.reach.reach, coarser.x());
        for (std::size_t at = seek(0, rowOf(rows.first_z, rows.first_y), begin); at < entries_.size();) {
            const std::uint64_t row = entries_[at].row, z = row / kLayer, y = row % kLayer;
            if (z > rows.last_z) break;
            if (y < rows.first_y) at = seek(at, rowOf(z, rows.first_y), begin);
            else if (y > rows.last_y) at = seek(at, rowOf(z + 1, rows.first_y), begin);
            else if (entries_[at].x() < begin) at = seek(at, row, begin);
            else at = seek(addRow(coarser, row, at, io_pairs), row + 1, begin);
        }
    }
    std::span<const Entry> entries() const { return entries_; }

private:
    static constexpr std::uint64_t kLayer = std::uint64_t{1} << 31;
    struct Rows {
        std::uint64_t first_y, last_y, first_z, last_z;
    };

    /// How far from a coordinate one of the level may lie to overlap one of that reach there; rounding included.
    double apart(double reach, double at) const { return (reach + largest_) * (1 + 1e-9) + 1e-12 * std::fabs(at); }
    static bool isBefore(const Entry& entry, std::uint64_t row, double x) { return entry.row < row || (entry.row == row && entry.x() < x); }
    /// The first from there on that lies not before that x of that row, which is likely to be near.
    std::size_t seek(std::size_t from, std::uint64_t row, double x) const {
        std::size_t to = from, step = 4;
        while (to < entries_.size() && isBefore(entries_[to], row, x)) from = to + 1, to += step, step *= 2;
        const auto near = std::span(entries_).subspan(from, std::min(to, entries_.size()) - from);
        const auto found = std::ranges::partition_point(near, [&](const Entry& e) { return isBefore(e, row, x); });
        return from + static_cast<std::size_t>(found - near.begin());
    }
    /// Those of a row, from the first that may overlap e. Returns where they end.
    std::size_t addRow(const Entry& e, std::uint64_t row, std::size_t first, Pairs& io_pairs) const {
        const double last = e.x() + apart(e.reach.reach, e.x());
        std::size_t k = first;
        for (; k < entries_.size() && entries_[k].row == row && entries_[k].x() <= last; ++k)
            io_pairs.add(e.body, entries_[k].body, overlap(e.reach, entries_[k].reach));
        return k;
    }
    /// Cells beyond the last are the last: what is near stays near, however far out it is.
    std::uint64_t cellOf(double at, int axis) const {
        constexpr double kLast = static_cast<double>(kLayer - 3);
        const double size = 2 * largest_ * (1 + 1e-9) + 1e-300;  // rounding does not make two that overlap two rows apart; nor is it 0
        return 1 + static_cast<std::uint64_t>(std::clamp(std::floor((at - lo_[axis]) / size), 0.0, kLast));
    }
    static std::uint64_t rowOf(std::uint64_t z, std::uint64_t y) { return z * kLayer + y; }
    /// The rows in which the level's may lie that overlap it.
    Rows rowsOf(const Reach& r) const {
        const double y = apart(r.reach, r.centre.y), z = apart(r.reach, r.centre.z);
        return {cellOf(r.centre.y - y, 1), cellOf(r.centre.y + y, 1), cellOf(r.centre.z - z, 2), cellOf(r.centre.z + z, 2)};
    }

    glm::dvec3 lo_;
    double largest_ = 0;                    // reach, m
    std::vector<Entry> entries_;
};

/// The bodies of one power of two of the reach each, the finest first.
std::vector<Level> levelsOf(std::span<const Reach> bodies) {
    std::map<int, std::vector<int>> members;
    for (std::size_t i = 0; i < bodies.size(); ++i) members[std::ilogb(bodies[i].reach)].push_back(static_cast<int>(i));
    std::vector<Level> levels;
    for (const auto& [size, of_size] : members) levels.emplace_back(bodies, of_size);
    return levels;
}

/// Sorts pairs of numbers below `bodies`, in linear time: by the second, then, keeping that order, by the first.
void sortPairs(std::vector<std::pair<int, int>>& io_pairs, std::size_t bodies) {
    std::vector<std::pair<int, int>> sorted(io_pairs.size());
    const auto pass = [&](const auto& from, auto& to, auto key) {
        std::vector<std::uint32_t> begin(bodies + 1, 0);
        for (const auto& pair : from) ++begin[static_cast<std::size_t>(key(pair)) + 1];
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        for (const auto& pair : from) to[begin[static_cast<std::size_t>(key(pair))]++] = pair;
    };
    pass(io_pairs, sorted, [](const auto& pair) { return pair.second; });
    pass(sorted, io_pairs, [](const auto& pair) { return pair.first; });
}

}  // namespace

std::vector<std::pair<int, int>> overlappingPairs(std::span<const Reach> bodies) {
    Pairs pairs;
    const std::vector<Level> levels = levelsOf(bodies);
    for (std::size_t i = 0; i < levels.size(); ++i) {
        levels[i].addPairs(pairs);
        for (std::size_t k = i + 1; k < levels.size(); ++k)
            for (const Level::Entry& e : levels[k].entries()) levels[i].addPairsOf(e, pairs);
    }
    std::vector<std::pair<int, int>> sorted = pairs.taken();
    sortPairs(sorted, bodies.size());
    return sorted;
}

}  // namespace mb
