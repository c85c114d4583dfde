#include "physics/islands.h"

#include <algorithm>
#include <numeric>

namespace mb {

/// A union-find forest whose roots are the least numbers (Tarjan, "Efficiency of a Good But Not Linear Set Union Algorithm", 1975).
Islands::Islands(std::size_t bodies, std::span<const Contact> contacts) : root_(bodies) {
    std::iota(root_.begin(), root_.end(), 0);
    const auto at = [&](int i) -> int& { return root_[static_cast<std::size_t>(i)]; };
    const auto root = [&](int i) {
        while (at(i) != i) i = at(i) = at(at(i));
        return i;
    };
    for (const Contact& c : contacts) {
        if (c.b == kStatic) continue;
        const int a = root(c.a), b = root(c.b);
        at(std::max(a, b)) = std::min(a, b);
    }
    for (int& r : root_) r = at(r);  // whose own root, being less, is known already
}

std::vector<std::uint32_t> Islands::sorted(std::span<const Contact> contacts) const {
    std::vector<std::uint32_t> begin(root_.size() + 1, 0), numbers(contacts.size());
    for (const Contact& c : contacts) ++begin[static_cast<std::size_t>(of(c)) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (std::size_t i = 0; i < contacts.size(); ++i) numbers[begin[static_cast<std::size_t>(of(contacts[i]))]++] = static_cast<std::uint32_t>(i);
    return numbers;
}

}  // namespace mb
