// The stages one by one, on memory that an engine owns: no map object, no allocation after set-up, no package.
#include <gnomon/gnomon.hpp>

#include <cstdio>
#include <vector>

using namespace gnomon;

int main() {
    using texel = rg16;         // 16-bit depth and mask
    using soft = gaussian<4>;   // 9 x 9 taps
    constexpr extent size{640, 360};

    // The engine's memory, with a row pitch of its own.
    constexpr int pitch = 704;
    std::vector<texel> caster_memory(pitch * size.height, texel::clear()), soft_memory(pitch * size.height, texel::clear());
    const image_view<texel> casters(caster_memory.data(), size, pitch * sizeof(texel));
    const image_view<texel> blurred(soft_memory.data(), size, pitch * sizeof(texel));

    // encode, mark: a disc at depth 0.25
    depth_tiles tiles(size, 32);
    constexpr texel_rect disc{270, 130, 370, 230};
    for (int y = disc.y0; y < disc.y1; ++y)
        for (int x = disc.x0; x < disc.x1; ++x)
            if ((x - 320) * (x - 320) + (y - 180) * (y - 180) < 50 * 50) casters(x, y).cast(texel::caster(0.25f));
    tiles.mark(disc, {.nearest = 0.25f, .farthest = 0.25f}, soft::radius);

    // filter: occupied rectangles only
    filter_scratch<texel, soft> scratch(size.width); // knows the kernel
    filter(scalar{}, casters, blurred, tiles.tiles(), scratch);
    int area = 0;
    for_each_region(tiles.tiles(), [&area](texel_rect r) { area += r.width() * r.height(); });
    std::printf("filtered %d of %d texels\n", area, size.width * size.height);

    // cull: a receiver off the disc, and one before it
    std::printf("far receiver %s, near receiver %s\n", casters_reach(tiles, {0, 0, 60, 60}, {0.5f, 0.9f}) ? "drawn with shadow" : "skipped",
                casters_reach(tiles, disc, {0.1f, 0.2f}) ? "drawn with shadow" : "skipped");

    // decide: a row of receivers at depth 0.75, and the light they get from a lightmap value of 0.8 with ambient 0.1
    std::vector<float> z(size.width, 0.75f), intensity(size.width);
    receive(blurred.row_span(180), z, intensity);
    for (const int x : {260, 268, 272, 320}) {
        const float shade = intensity[static_cast<std::size_t>(x)];
        std::printf("x %d: shadow %.3f light %.3f caster depth %.3f\n", x, double(shade), double(mask_light(0.8f, shade, 0.1f)), double(caster_depth(blurred(x, 180))));
    }
}
