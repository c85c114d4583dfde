#include "physics/broadphase.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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
            entries_.push_back({rowOf(r.centre), i, r});
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
            add(e, e.row, i + 1, io_pairs);
            for (std::size_t k = 0; k < kRows.size(); ++k) {
                const std::uint64_t row = e.row + kRows[k];
                while (first[k] < entries_.size() && isBefore(entries_[first[k]], row, e.x() - apart(largest_, e.x()))) ++first[k];
                add(e, row, first[k], io_pairs);
            }
        }
    }
    /// Of one of a finer level with this one's.
    void addPairsOf(const Entry& finer, Pairs& io_pairs) const {
        const std::uint64_t middle = rowOf(finer.reach.centre);
        for (const std::uint64_t layer : {middle - kLayer, middle, middle + kLayer})
            for (const std::uint64_t row : {layer - 1, layer, layer + 1}) {
                const double begin = finer.x() - apart(finer.reach.reach, finer.x());
                const auto first = std::partition_point(entries_.begin(), entries_.end(), [&](const Entry& e) { return isBefore(e, row, begin); });
                add(finer, row, static_cast<std::size_t>(first - entries_.begin()), io_pairs);
            }
    }
    std::span<const Entry> entries() const { return entries_; }

private:
    static constexpr std::uint64_t kLayer = std::uint64_t{1} << 31;

    /// How far from x one of the level may lie to overlap one of that reach at x; rounding included.
    double apart(double reach, double x) const { return (reach + largest_) * (1 + 1e-9) + 1e-12 * std::fabs(x); }
    static bool isBefore(const Entry& entry, std::uint64_t row, double x) { return entry.row < row || (entry.row == row && entry.x() < x); }
    /// Those of a row, from the first that may overlap e.
    void add(const Entry& e, std::uint64_t row, std::size_t first, Pairs& io_pairs) const {
        const double last = e.x() + apart(e.reach.reach, e.x());
        std::size_t end = first;
        while (end < entries_.size() && entries_[end].row == row && entries_[end].x() <= last) ++end;
        io_pairs.expect(end - first);
        for (std::size_t k = first; k < end; ++k) io_pairs.add(e.body, entries_[k].body, overlap(e.reach, entries_[k].reach));
    }
    /// Rows beyond the last are the last: what is near stays near, however far out it is.
    std::uint64_t rowOf(glm::dvec3 centre) const {
        constexpr double kLast = static_cast<double>(kLayer - 3);
        const double size = 2 * largest_ * (1 + 1e-9);  // rounding does not make two that overlap two rows apart
        const auto cell = [&](int axis) { return 1 + static_cast<std::uint64_t>(std::clamp(std::floor((centre[axis] - lo_[axis]) / size), 0.0, kLast)); };
        return cell(2) * kLayer + cell(1);
    }

    glm::dvec3 lo_;
    double largest_ = 0;                    // reach, m
    std::vector<Entry> entries_;
};

/// The bodies of one power of two of the reach each, the finest first.
std::vector<Level> levelsOf(std::span<const Reach> bodies) {
    std::vector<std::pair<int, int>> sizes;  // and the bodies
    for (std::size_t i = 0; i < bodies.size(); ++i) sizes.emplace_back(std::ilogb(bodies[i].reach), static_cast<int>(i));
    std::sort(sizes.begin(), sizes.end());
    std::vector<Level> levels;
    std::vector<int> members;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        members.push_back(sizes[i].second);
        if (i + 1 < sizes.size() && sizes[i + 1].first == sizes[i].first) continue;
        levels.emplace_back(bodies, members);
        members.clear();
    }
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
            for (const Level::Entry& e : levels[i].entries()) levels[k].addPairsOf(e, pairs);
    }
    std::vector<std::pair<int, int>> sorted = pairs.taken();
    sortPairs(sorted, bodies.size());
    return sorted;
}

}  // namespace mb
