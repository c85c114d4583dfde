// Carved dice that fall into a tray, come to rest in a pile, and sleep.
#include "bench/figure_pile.h"

#include "bench/pile.h"
#include "physics/world.h"

#include <fmt/format.h>

namespace mb::bench {

void printPile(PhysicsBench& bench, int dice) {
    constexpr double kLongest = 30;  // s
    bench.say(fmt::format("pile: {} carved dice, until they sleep", dice));
    Scene scene = pileScene(dice, bench.options.seed);
    PhysicsWorld world(scene);
    world.setThreads(1);
    std::vector<double> ms;
    while (world.awake() > 0 && world.time_s() < kLongest) ms.push_back(timeOf([&] { world.step(); }));
    world.writeTo(scene);
    double sum = 0;
    for (const double t : ms) sum += t;
    bench.print({{"figure", "pile"},
                 {"dice", dice},
                 {"steps", ms.size()},
                 {"ms_a_step", rounded(ms.empty() ? 0 : sum / static_cast<double>(ms.size()))},
                 {"ms_a_step_median", rounded(median(ms))},
                 {"seconds_to_rest", rounded(world.time_s())},
                 {"asleep", dice - world.awake()},
                 {"overlap", {{"largest", rounded(deepestOverlap(scene))}, {"by_contacts", rounded(world.maxPenetration())}}},
                 {"state", world.stateText()}});
}

}  // namespace mb::bench
