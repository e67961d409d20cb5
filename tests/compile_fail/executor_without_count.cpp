// expect: gnomon: an executor is called as on\(count, job\)
#include <gnomon/soft_shadow_map.hpp>

#if GNOMON_EXPECT_FAILURE
const auto on = [](const auto& job) { job(0); }; // how often?
#else
const auto on = [](int count, const auto& job) {
    for (int i = 0; i < count; ++i) job(i);
};
#endif

void filter(gnomon::soft_shadow_map<gnomon::rg8>& map) { map.filter(on); }
