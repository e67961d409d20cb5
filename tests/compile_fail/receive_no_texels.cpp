// expect: (no matching function for call to|constraints not satisfied).*receive
#include <gnomon/receive/receive.hpp>

#if GNOMON_EXPECT_FAILURE
using chosen = std::uint16_t; // storage is not a texel
#else
using chosen = gnomon::rg8;
#endif

void receive_row(const std::vector<chosen>& texels, const std::vector<float>& z, std::vector<float>& intensity) {
    gnomon::receive(texels, z, intensity);
}
