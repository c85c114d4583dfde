#include "physics/broadphase.h"

#include <algorithm>
#include <numeric>

namespace mb {
namespace {

int widestAxis(std::span<const Reach> balls) {
    glm::dvec3 mean{0}, spread{0};
    for (const Reach& b : balls) mean += b.centre / static_cast<double>(balls.size());
    for (const Reach& b : balls) spread += (b.centre - mean) * (b.centre - mean);
    return spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
}

}  // namespace

std::vector<std::pair<int, int>> overlappingPairs(std::span<const Reach> balls) {
    std::vector<std::pair<int, int>> pairs;
    const int axis = widestAxis(balls);
    const auto lo = [&](int i) { const Reach& b = balls[static_cast<std::size_t>(i)]; return b.centre[axis] - b.reach; };
    const auto hi = [&](int i) { const Reach& b = balls[static_cast<std::size_t>(i)]; return b.centre[axis] + b.reach; };

    std::vector<int> order(balls.size()), open;
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return lo(a) != lo(b) ? lo(a) < lo(b) : a < b; });
    for (const int i : order) {
        // Half an ulp may lie between this test and overlap()'s, hence the slack; overlap() decides.
        const double start = lo(i), slack = 1e-12 * (1 + std::abs(start));
        std::erase_if(open, [&](int k) { return hi(k) < start - slack; });
        for (const int k : open)
            if (overlap(balls[static_cast<std::size_t>(i)], balls[static_cast<std::size_t>(k)])) pairs.emplace_back(std::minmax(i, k));
        open.push_back(i);
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace mb
