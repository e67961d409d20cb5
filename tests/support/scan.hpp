// A scan of a whole domain: minutes long, so on every processor, and with a word now and then on how far it is.
//     const sweep wrong = test::scan(65536, [](int i, sweep& part) { part.unless(...); });
#pragma once

#include "sweep.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <thread>
#include <vector>

namespace test {

/// Calls `part(i, wrong)` once for every i in [0, count), each call on one of as many threads as there are processors, and gives
/// all sweeps as one. Its last word on stderr is how many cases were tried. `part` must do without doctest, which has no threads.
template <typename Part> [[nodiscard]] sweep scan(int count, const Part& part) {
    using clock = std::chrono::steady_clock;
    constexpr std::chrono::seconds patience(10);
    std::mutex guard; // of all that follows
    sweep all;
    int next = 0, done = 0;
    auto spoken = clock::now();
    const auto work = [&] {
        for (;;) {
            int i = 0;
            {
                const std::lock_guard<std::mutex> lock(guard);
                if (next == count) return;
                i = next++;
            }
            sweep own;
            part(i, own);
            const std::lock_guard<std::mutex> lock(guard);
            all.add(own);
            ++done;
            if (clock::now() - spoken < patience) continue;
            spoken = clock::now();
            std::fprintf(stderr, "%3lld %%\n", 100LL * done / count);
        }
    };
    std::vector<std::thread> others;
    for (unsigned i = 1; i < std::max(std::thread::hardware_concurrency(), 1u); ++i) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
    std::fprintf(stderr, "%zu cases\n", all.tried());
    return all;
}

} // namespace test
