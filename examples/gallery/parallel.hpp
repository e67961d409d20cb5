// gallery: the rows of a picture shared out among the cores.
#pragma once

#include <atomic>
#include <thread>
#include <vector>

namespace gallery {

/// Calls f(row) once for every row in [0, rows), on all cores; returns when all are done. `f` must not throw.
template <typename F> void for_each_row(int rows, const F& f) {
    std::atomic<int> next{0};
    const auto work = [&] {
        for (int row = next++; row < rows; row = next++) f(row);
    };
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) others.emplace_back(work);
    work();
}

} // namespace gallery
