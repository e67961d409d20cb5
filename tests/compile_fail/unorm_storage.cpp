// expect: gnomon: unorm<Storage> takes std::uint8_t or std::uint16_t
#include <gnomon/texel/channel.hpp>

#if GNOMON_EXPECT_FAILURE
using chosen = gnomon::unorm<std::uint32_t>; // 2^32 - 1 is no float
#else
using chosen = gnomon::unorm<std::uint16_t>;
#endif

static_assert(chosen::encode(0.0) == 0);
