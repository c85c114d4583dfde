#include "bench/timing.h"

#include <algorithm>
#include <cassert>
#include <chrono>

namespace mb::bench {

double median(std::vector<double> values) {
    assert(!values.empty());
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

Spread spread(const std::vector<double>& values) {
    const auto [least, most] = std::ranges::minmax(values);
    return {median(values), least, most};
}

std::vector<std::vector<double>> takeTurns(std::span<const Contender> contenders, int rounds) {
    std::vector<std::vector<double>> ms(contenders.size());
    for (const Contender& contender : contenders) contender();
    for (int round = 0; round < rounds; ++round)
        for (std::size_t c = 0; c < contenders.size(); ++c) ms[c].push_back(contenders[c]());
    return ms;
}

Spread ratio(const std::vector<double>& a, const std::vector<double>& b) {
    assert(a.size() == b.size());
    std::vector<double> ratios(a.size());
    std::ranges::transform(a, b, ratios.begin(), [](double x, double y) { return x / y; });
    return spread(ratios);
}

double timeOf(const std::function<void()>& call) {
    const auto from = std::chrono::steady_clock::now();
    call();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count();
}

}  // namespace mb::bench
