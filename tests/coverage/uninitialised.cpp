// Every stage on fresh memory from the heap, and then a branch on every bit that came out: what a memory sanitizer has to see. No
// doctest and no stream, because the standard library and what it writes are not instrumented.
#include <gnomon/geometry/directional_light.hpp>
#include <gnomon/geometry/footprint.hpp>
#include <gnomon/geometry/rasterize.hpp>
#include <gnomon/geometry/spot_light.hpp>
#include <gnomon/gnomon.hpp>

#include "../support/images.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {
using namespace gnomon;

template <channel Channel> using paper = texel<Channel, paper_depth_mask, effects{.far_bound = true, .translucency = true}>;

int odd = 0;

/// Branches on each bit.
void look_at(std::uint64_t bits) {
    for (; bits != 0; bits >>= 1)
        if ((bits & 1) != 0) ++odd;
}
void look_at(float v) { look_at(std::uint64_t{std::bit_cast<std::uint32_t>(v)}); }
void look_at(texel_rect r) {
    for (const int side : {r.x0, r.y0, r.x1, r.y1}) look_at(static_cast<std::uint64_t>(static_cast<std::uint32_t>(side)));
}
template <texel_format Texel> void look_at(image_view<const Texel> view) {
    for (int y = 0; y < view.height(); ++y)
        for (int x = 0; x < view.width(); ++x)
            for (const auto stored : view(x, y).stored) look_at(static_cast<float>(Texel::channel_type::code(stored)));
}

/// Casters, far bounds, two frames, every way to read; on a size that no tile and no cache line divides.
template <texel_format Texel, kernel Kernel> void all_stages(test::dice& roll) {
    constexpr extent size{61, 37};
    soft_shadow_map<Texel, Kernel> map({.width = size.width, .height = size.height, .tile = 8});
    for (int frame = 0; frame < 2; ++frame) {
        map.clear();
        for (int i = 0; i < 4; ++i) map.cast(roll.rect(size, 9), roll.unit());
        if constexpr (Texel::effects.translucency) map.cast(roll.rect(size, 9), roll.unit(), roll.unit());
        if constexpr (Texel::effects.far_bound) map.bound(roll.rect(size, 9), roll.unit());
        map.filter();
        look_at<Texel>(map.casters());
        look_at<Texel>(map.soft());
        look_at(map.tiles().tiles().bounds());
        for_each_tile_rect(map.tiles().tiles(), [](tile_rect t) { look_at({t.x0, t.y0, t.x1, t.y1}); });
        for (int i = 0; i < 200; ++i) {
            const int x = roll(-3, 63), y = roll(-3, 39);
            const float z = roll.unit(), to_the_right = static_cast<float>(x) + roll.unit();
            look_at(map.shadow(x, y, z));
            look_at(map.shadow_at(to_the_right, static_cast<float>(y), z));
            look_at(std::uint64_t{map.reaches({x, y, x + 2, y + 2}, {z, z})});
            if (whole(size).contains(x, y)) look_at(caster_depth(map.soft()(x, y)));
        }
        std::array<float, size.width> z, intensity; // without a value, as an engine has them
        z.fill(roll.unit());
        map.receive_row(frame, z, intensity);
        for (const float v : intensity) look_at(mask_light(0.8f, v, 0.1f));
    }
    // A filter on memory and scratch of one's own.
    const image<Texel> from = test::noise<Texel>(roll, size, 3);
    auto* const raw = static_cast<Texel*>(std::malloc(sizeof(Texel) * size.width * size.height));
    filter_scratch<Texel, Kernel> scratch(size.width);
    const image_view<Texel> to(raw, size);
    filter_region(from.view(), to, whole(size), scratch);
    look_at<Texel>(to);
    std::free(raw);
}

void all_of_the_grid(test::dice& roll) {
    tile_grid tiles({1000, 700}, 7);
    for (int i = 0; i < 20; ++i) look_at(tiles.texels_of(tiles.mark(roll.rect(tiles.size(), 40), roll(0, 9))));
    tiles.dilate(2);
    std::vector<bit_word> scratch(static_cast<std::size_t>(words_for(tiles.columns()) * tiles.rows()));
    for_each_tile_rect_greedy(tiles, scratch, [](tile_rect t) { look_at({t.x0, t.y0, t.x1, t.y1}); });
    reference_grid reference({512, 512}, 2);
    reference.cast({10.5, 20.0, 99.0, 100.25});
    reference.for_each_tile_rect([](tile_rect t) { look_at({t.x0, t.y0, t.x1, t.y1}); });
    look_at(reference.blur_scissor());
}

void all_of_geometry(test::dice& roll) {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 60; ++i) {
        positions.push_back({roll.unit() * 4.0f - 2.0f, roll.unit() * 4.0f - 2.0f, roll.unit() * 4.0f - 2.0f});
        indices.push_back(i);
    }
    directional_light sun({0.2, -1.0, 0.1});
    const bounding_sphere ball{{0, 0, 0}, 4.0};
    sun.add_caster(ball);
    const extent size{64, 64};
    const light_frame frames[]{sun.frame(size, 3), spot_light{.position = {0, 2.5, 0}, .direction = {0, -1, 0}}.frame(size, 3)};
    for (const light_frame& light : frames) {
        image<rgba16> map(size, rgba16::clear());
        look_at(cast_triangles(map.view(), {positions, indices}, light).texels);
        look_at(bound_triangles(map.view(), {positions, indices}, light).depth.nearest);
        look_at<rgba16>(map.view());
        look_at(footprint(ball, light).texels);
        look_at(footprint(box_around(ball), light).depth.farthest);
    }
}
} // namespace

int main() {
    test::dice roll(61);
    all_stages<rg8, box<1>>(roll);
    all_stages<rgb8, tent<2>>(roll);
    all_stages<rgba8, gaussian<4>>(roll);
    all_stages<rg16, binomial<3>>(roll);
    all_stages<rga16f, gaussian<4>>(roll);
    all_stages<rgba32f, binomial<3>>(roll);
    all_stages<paper<unorm8>, binomial<3>>(roll);
    all_stages<paper<float32>, tent<2>>(roll);
    all_of_the_grid(roll);
    all_of_geometry(roll);
    std::printf("looked at all of it, %d bits are set\n", odd);
}
