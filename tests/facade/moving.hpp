// Sparse equals dense (h15), frame after frame: whatever moved, appeared or vanished, a map holds the bits of one that was made from
// scratch, on any backend.
#pragma once

#include "../support/backends.hpp"
#include "../support/filtering.hpp"
#include "../support/formats.hpp"

#include <cstdint>
#include <vector>

namespace test::moving {
using gnomon::image;
using gnomon::texel_rect;

inline constexpr gnomon::extent size{67, 45};

/// A caster on its way across the map and beyond its edges.
struct mover {
    static constexpr int speeds[] = {1, 4, 8, 40};
    int x, y, speed, step_x, step_y, width, height;
    float depth, opacity;

    explicit mover(dice& roll)
        : x(roll(-10, size.width)), y(roll(-10, size.height)), speed(speeds[roll(0, 3)]), step_x(roll(-1, 1) * speed),
          step_y(roll(-1, 1) * speed), width(roll(1, 16)), height(roll(1, 16)), depth(roll.unit()), opacity(roll.unit()) {}
    void move() {
        constexpr auto wrap = [](int v, int range) { return v < -20 ? range + 15 : (v > range + 15 ? -20 : v); };
        x = wrap(x + step_x, size.width);
        y = wrap(y + step_y, size.height);
    }
    texel_rect where() const { return {x, y, x + width, y + height}; }
};

/// The definition of a cast: every texel of the rectangle, one by one.
template <typename Texel> void draw(image<Texel>& casters, const mover& m) {
    for_each_texel(clip(m.where(), size), [&](int x, int y) {
        if constexpr (Texel::effects.translucency)
            casters(x, y).cast(Texel::caster(m.depth, m.opacity));
        else
            casters(x, y).cast(Texel::caster(m.depth));
    });
}
template <typename Map, typename Texel> void cast(Map& map, const mover& m, bool by_hand, const image<Texel>& drawn) {
    if constexpr (has_casters_on_the_host<Map>)
        if (by_hand) { // as a host does that rasterises itself
            for_each_texel(clip(m.where(), size), [&](int x, int y) { map.casters()(x, y) = drawn(x, y); });
            map.mark(m.where(), {m.depth, m.depth});
            return;
        }
    if constexpr (Texel::effects.translucency)
        map.cast(m.where(), m.depth, m.opacity);
    else
        map.cast(m.where(), m.depth);
}

/// Frames in which a map differs from dense filtering.
template <typename Texel, gnomon::kernel Kernel, typename Backend>
int wrong_frames(const Backend& run, int frames, std::uint64_t seed) {
    dice roll(seed);
    using map = gnomon::soft_shadow_map<Texel, Kernel, Backend>;
    std::vector<map> maps; // the same casters in tiles of several sizes
    for (const int tile : {1, 7, 16, 64}) maps.emplace_back(gnomon::map_size{size.width, size.height, tile}, run);
    std::vector<mover> movers;
    int wrong = 0;
    for (int frame = 0; frame < frames; ++frame) {
        if (roll.one_in(4) && !movers.empty()) movers.pop_back();
        if (roll.one_in(20)) movers.clear();
        if (roll.one_in(3) && movers.size() < 5) movers.emplace_back(roll);
        for (mover& m : movers) m.move();

        image<Texel> casters(size, Texel::clear());
        for (map& each : maps) each.clear();
        for (const mover& m : movers) {
            draw(casters, m);
            const bool by_hand = roll.one_in(4);
            for (map& each : maps) cast(each, m, by_hand, casters);
        }
        if constexpr (Texel::effects.far_bound) {
            const texel_rect ground = roll.rect(size, 10);
            const float z = roll.unit();
            for_each_texel(clip(ground, size), [&](int x, int y) { casters(x, y).bound(z); });
            for (map& each : maps) each.bound(ground, z);
        }
        const image<Texel> expected = dense<filters_as_kernel<Backend, Texel, Kernel>>(casters);
        for (map& each : maps) {
            each.filter();
            wrong += differences<Texel>(each.soft(), expected.view(), whole(size)) != 0;
        }
    }
    return wrong;
}

} // namespace test::moving
