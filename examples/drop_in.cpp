// examples/drop_in.cpp: the reconstruction alone, on an engine's own buffers. No map object, no filter, no package: one header.
#include <gnomon/backend/reconstruct.hpp>

#include <cstdint>
#include <cstdio>
#include <vector>

int main() {
    // What the engine has: a soft shadow map of two bytes a texel, that its GPU blurred, in rows of its own pitch ...
    constexpr gnomon::extent size{64, 48};
    constexpr int pitch = 80;
    std::vector<gnomon::rg8> memory(pitch * size.height, gnomon::rg8::clear());
    for (int y = 12; y < 36; ++y)
        for (int x = 16; x < 48; ++x) memory[std::size_t(y * pitch + x)] = {{90, 120}}; // a penumbra: mask 120/255, caster at 1 - 90/120
    const gnomon::image_view<const gnomon::rg8> map(memory.data(), size, pitch * sizeof(gnomon::rg8));

    // ... and pixels, whose fields lie side by side: a position on the map, a depth in 16 bits, and room for the light that is left.
    struct pixel {
        float x, y;
        std::uint16_t z;
        std::uint8_t shade;
    };
    std::vector<pixel> pixels;
    for (int i = 0; i < 8; ++i) pixels.push_back({15.0f + 0.25f * float(i), 20.0f, std::uint16_t(i % 2 ? 60000 : 9000), 0});

    // Spans in, spans out, any stride: in the best lanes that the processor has.
    const auto field = [&](auto pixel::*f) { return gnomon::strided_span(&(pixels[0].*f), int(pixels.size()), sizeof(pixel)); };
    gnomon::reconstruct(map, field(&pixel::x), field(&pixel::y), field(&pixel::z), field(&pixel::shade));
    for (const pixel& p : pixels) std::printf("%d ", p.shade);

    // One to one: a row of the map and a row of depths, where nothing is blended. Here in place of the depths.
    std::vector<std::uint16_t> row(std::size_t(size.width), 60000);
    gnomon::reconstruct(map.row_span(20), row, row);
    std::printf("| %d %d\n", row[8], row[20]);
}
