// One frame filtered by several executors: gnomon starts no threads, and has the same bits on whichever it is given.
#include "jthread_pool.hpp"

#include <gnomon/backend/simd.hpp>
#include <gnomon/soft_shadow_map.hpp>

#include <cstdio>
#include <cstring>
#include <vector>
#if GNOMON_EXAMPLE_TBB
#include <tbb/parallel_for.h>
#endif

namespace {
using namespace gnomon;

using kernel = binomial<4>;

/// The filtered map, row by row.
template <typename On> std::vector<rg8> filtered_on(On&& on) {
    soft_shadow_map<rg8, kernel, simd<>> map({.width = 1000, .height = 700});
    for (int i = 0; i < 20; ++i) map.cast({i * 50, i * 33, i * 50 + 90, i * 33 + 70}, 0.05f * static_cast<float>(i));
    map.filter(on);
    std::vector<rg8> rows;
    for (int y = 0; y < map.size().height; ++y) rows.insert(rows.end(), map.soft().row(y), map.soft().row(y) + map.size().width);
    return rows;
}

bool same(const std::vector<rg8>& a, const std::vector<rg8>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(rg8)) == 0;
}

#if GNOMON_EXAMPLE_TBB
void try_tbb(const std::vector<rg8>& expected) {
    const auto on_tbb = [](int count, const auto& job) { tbb::parallel_for(0, count, job); };
    std::printf("oneTBB: %s\n", same(filtered_on(on_tbb), expected) ? "same bits" : "OTHER BITS");
}
#else
void try_tbb(const std::vector<rg8>&) { std::printf("oneTBB: not there when this was built\n"); }
#endif
} // namespace

int main() {
    const std::vector<rg8> expected = filtered_on(sequential{});
    for (const unsigned threads : {1u, 2u, 3u, 7u}) {
        jthread_pool pool(threads);
        std::printf("%u threads: %s\n", threads, same(filtered_on(pool), expected) ? "same bits" : "OTHER BITS");
    }
    try_tbb(expected);
}
