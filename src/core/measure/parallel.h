#pragma once
// Work that is done by several threads at once.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace mb {

/// As many threads as the machine runs at once, at least 1.
inline unsigned coresOf() { return std::max(std::thread::hardware_concurrency(), 1u); }

/// Calls work(i, here) for each i below `count`, by up to `threads` threads of which the caller is one: there `here` is true. Each takes
/// the next i when it is free, so that which does what is chance; returns when all are done.
template <class Work> void inParallel(unsigned threads, std::size_t count, Work work) {
    std::atomic<std::size_t> next{0};
    const auto run = [&](bool here) {
        for (std::size_t i = next++; i < count; i = next++) work(i, here);
    };
    std::vector<std::thread> others;
    for (std::size_t i = 1; i < std::min<std::size_t>(threads, count); ++i) others.emplace_back(run, false);
    run(true);
    for (std::thread& t : others) t.join();
}

}  // namespace mb
