// examples/building_blocks.cpp: the stages one by one, on memory that an engine owns. No map object, no package.
#include <gnomon/gnomon.hpp>

#include <cstdio>
#include <vector>

using namespace gnomon;

int main() {
    using pair = rg16;        // 16-bit depth and mask
    using blur = gaussian<4>; // 9 x 9 taps
    constexpr extent size{640, 360};

    // The engine's memory, with a row pitch of its own.
    constexpr int pitch = 704;
    std::vector<pair> caster_memory(pitch * size.height, pair::clear()), soft_memory(pitch * size.height, pair::clear());
    const image_view<pair> casters(caster_memory.data(), size, pitch * sizeof(pair));
    const image_view<pair> soft(soft_memory.data(), size, pitch * sizeof(pair));

    // encode, mark: a disc at depth 0.25, and the kernel's radius around it
    depth_tiles tiles(size, 32);
    constexpr texel_rect disc{270, 130, 370, 230};
    for (int y = disc.y0; y < disc.y1; ++y)
        for (int x = disc.x0; x < disc.x1; ++x)
            if ((x - 320) * (x - 320) + (y - 180) * (y - 180) < 50 * 50) casters(x, y).cast(pair::caster(0.25f));
    tiles.mark(disc, {.nearest = 0.25f, .farthest = 0.25f}, blur::radius);

    // blur: marked tiles only
    filter_scratch<pair, blur> scratch(size.width);
    filter(simd<>{}, casters, soft, tiles, scratch);
    int area = 0;
    for_each_region(tiles, [&area](texel_rect r) { area += r.width() * r.height(); });
    std::printf("filtered %d of %d texels\n", area, size.width * size.height);

    // cull: receivers beside the disc, before it, and behind it
    const auto say = [&tiles](const char* where, texel_rect r, depth_interval z) {
        std::printf("%s: %s\n", where, casters_reach(tiles, r, z) ? "needs the shadow" : "lit");
    };
    say("beside", {0, 0, 60, 60}, {0.5f, 0.9f});
    say("before", disc, {0.1f, 0.2f});
    say("behind", disc, {0.5f, 0.9f});

    // decide: a row of receivers at depth 0.75; and what is left of a lightmap's 0.8 over an ambient floor of 0.1
    std::vector<float> z(size.width, 0.75f), intensity(size.width);
    receive(simd<>{}, soft.row_span(180), z, intensity);
    for (const int x : {260, 268, 272, 320}) {
        const float shade = intensity.at(std::size_t(x));
        std::printf("x %d: shadow %.3f, light %.3f, caster at %.3f\n", x, double(shade), double(mask_light(0.8f, shade, 0.1f)),
                    double(caster_depth(soft(x, 180))));
    }
}
