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

/// The bodies of about one size, in the order of their cells: along x, then y, then z.
class Level {
public:
    struct Entry {
        std::uint64_t cell = 0;
        int body = 0;
        Reach reach;
    };

    Level(std::span<const Reach> bodies, std::span<const int> members) : lo_(INFINITY) {
        double largest = 0;
        for (const int i : members) {
            lo_ = glm::min(lo_, bodies[static_cast<std::size_t>(i)].centre);
            largest = std::max(largest, bodies[static_cast<std::size_t>(i)].reach);
        }
        size_ = 2 * largest * (1 + 1e-9);  // rounding does not make two that overlap two cells apart
        for (const int i : members) {
            const Reach& r = bodies[static_cast<std::size_t>(i)];
            entries_.push_back({cellOf(r.centre), i, r});
        }
        std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.cell != b.cell ? a.cell < b.cell : a.body < b.body; });
    }

    /// Of the level's own: each cell with itself, with the next along x, and with the rows behind it in the order.
    void addPairs(Pairs& io_pairs) const {
        constexpr std::array kRows{kRow, kLayer - kRow, kLayer, kLayer + kRow};
        std::array<std::size_t, kRows.size()> first{};  // where each row's neighbours begin: they come in order, as the cells do
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            const Entry& e = entries_[i];
            std::size_t end = i + 1;
            while (end < entries_.size() && entries_[end].cell <= e.cell + 1) ++end;
            add(e, i + 1, end, io_pairs);
            for (std::size_t row = 0; row < kRows.size(); ++row) {
                const std::uint64_t middle = e.cell + kRows[row];
                std::size_t& k = first[row];
                while (k < entries_.size() && entries_[k].cell < middle - 1) ++k;
                end = k;
                while (end < entries_.size() && entries_[end].cell <= middle + 1) ++end;
                add(e, k, end, io_pairs);
            }
        }
    }
    /// Of one of a finer level with this one's.
    void addPairsOf(const Entry& finer, Pairs& io_pairs) const {
        const std::uint64_t cell = cellOf(finer.reach.centre);
        for (const std::uint64_t layer : {cell - kLayer, cell, cell + kLayer})
            for (const std::uint64_t middle : {layer - kRow, layer, layer + kRow}) {
                const auto begin = std::ranges::lower_bound(entries_, middle - 1, {}, &Entry::cell);
                const auto end = std::ranges::upper_bound(begin, entries_.end(), middle + 1, {}, &Entry::cell);
                add(finer, static_cast<std::size_t>(begin - entries_.begin()), static_cast<std::size_t>(end - entries_.begin()), io_pairs);
            }
    }
    std::span<const Entry> entries() const { return entries_; }

private:
    static constexpr std::uint64_t kRow = std::uint64_t{1} << 21, kLayer = kRow << 21;

    void add(const Entry& e, std::size_t begin, std::size_t end, Pairs& io_pairs) const {
        io_pairs.expect(end - begin);
        for (std::size_t k = begin; k < end; ++k) io_pairs.add(e.body, entries_[k].body, overlap(e.reach, entries_[k].reach));
    }
    /// Cells beyond the last are the last: what is near stays near, however far out it is.
    std::uint64_t cellOf(glm::dvec3 centre) const {
        constexpr double kLast = static_cast<double>(kRow - 3);
        std::uint64_t cell = 0;
        for (const int axis : {2, 1, 0}) cell = cell * kRow + 1 + static_cast<std::uint64_t>(std::clamp(std::floor((centre[axis] - lo_[axis]) / size_), 0.0, kLast));
        return cell;
    }

    glm::dvec3 lo_;
    double size_ = 0;                       // of a cell, m
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
