#include "core/measure/timing.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <fstream>
#include <string>

#include <sys/times.h>
#include <unistd.h>

namespace mb {
namespace {

/// Seconds since some start: of all cores' work, of this program's with the programs it ran, and of the clock.
struct Busy {
    double machine, own, wall;
};
std::optional<Busy> busyNow() {
    std::ifstream stat("/proc/stat");  // proc(5): user nice system idle iowait irq softirq steal, in ticks
    std::string name;
    double ticks[8] = {};
    stat >> name;
    for (double& t : ticks) stat >> t;
    tms own{};
    if (!stat || name != "cpu" || times(&own) == static_cast<clock_t>(-1)) return std::nullopt;
    const double second = static_cast<double>(sysconf(_SC_CLK_TCK));
    const double machine = ticks[0] + ticks[1] + ticks[2] + ticks[5] + ticks[6] + ticks[7];
    const auto mine = static_cast<double>(own.tms_utime + own.tms_stime + own.tms_cutime + own.tms_cstime);
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return Busy{machine / second, mine / second, std::chrono::duration<double>(now).count()};
}

}  // namespace

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

Turns takeTurns(std::span<const Contender> contenders, int rounds) {
    Turns turns;
    turns.ms.resize(contenders.size());
    for (const Contender& contender : contenders) contender();
    const std::optional<Busy> before = busyNow();
    for (int round = 0; round < rounds; ++round)
        for (std::size_t c = 0; c < contenders.size(); ++c) turns.ms[c].push_back(contenders[c]());
    if (const std::optional<Busy> after = busyNow(); before && after && after->wall > before->wall)
        turns.foreign_cores = std::max(0.0, (after->machine - before->machine - after->own + before->own) / (after->wall - before->wall));
    return turns;
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

}  // namespace mb
