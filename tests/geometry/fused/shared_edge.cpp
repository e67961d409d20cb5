// An edge that a triangle of the lanes shares with one that the scalar code sets up, for it is wider than 4096 texels; compiled so that
// products and sums are fused wherever a compiler may. The edge lies so close to where a corner is snapped to another 256th of a texel
// that it matters how its corners are rounded. Prints the texels of the edge that were not drawn exactly once.
#include <gnomon/geometry/rasterize_lanes.hpp>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

namespace {
using namespace gnomon;

constexpr extent size{64, 64};

/// x = p.x + slant p.z + shift, y = p.y: the edge, at p.x = 0 and p.z = z, comes to `edge` but for a few units in the last place.
light_frame light_for(double edge, double slant, float z, int ulps) {
    double shift = edge - slant * static_cast<double>(z);
    for (int i = 0; i < std::abs(ulps); ++i) shift = std::nextafter(shift, ulps > 0 ? 1e9 : -1e9);
    glm::dmat4 to_map(1.0);
    to_map[2] = {slant, 0.0, 0.0625, 0.0};
    to_map[3] = {shift, 0.0, 0.0, 1.0};
    return {to_map, size, 1.0, 1.0};
}

/// Texels beside the edge that were drawn twice, or not at all.
template <typename Run> int wrong(Run run, const light_frame& light, float z, float towards) {
    const std::vector<glm::vec3> corners{{0, 0, z}, {0, 64, z}, {-20 * towards, 32, z}, {6000 * towards, 32, z}};
    const std::vector<std::uint32_t> triangles{0, 1, 2, 1, 0, 3};
    std::vector<int> drawn(64 * 64);
    rasterize(run, {corners, triangles}, light, whole(size), faces::both,
              [&](int x, int y, float) { ++drawn[static_cast<std::size_t>(64 * y + x)]; });
    int n = 0;
    for (int y = 14; y < 50; ++y)
        for (int x = 29; x < 33; ++x) n += drawn[static_cast<std::size_t>(64 * y + x)] != 1;
    return n;
}
} // namespace

int main() {
#if GNOMON_X86
    if (best_lanes() < cpu_level::avx2) return 77; // it could not run what follows
#endif
    std::mt19937 dice(1);
    const auto unit = [&dice] { return static_cast<double>(dice()) * 0x1p-32; };
    int in_lanes = 0, plainly = 0;
    for (int i = 0; i < 4000; ++i) {
        const float z = static_cast<float>(1.0 + 3.0 * unit()), towards = i % 2 == 0 ? 1.0f : -1.0f;
        const double slant = 3.0 * unit(), edge = (30 * 256 + 128.5 - 0x1p-23) / 256;
        for (int ulps = -2; ulps <= 2; ++ulps) {
            const light_frame light = light_for(edge, slant, z, ulps);
            in_lanes += wrong(simd<>{}, light, z, towards);
            plainly += wrong(scalar{}, light, z, towards);
        }
    }
    std::printf("%d in lanes, %d plainly\n", in_lanes, plainly);
    return in_lanes + plainly == 0 ? 0 : 1;
}
