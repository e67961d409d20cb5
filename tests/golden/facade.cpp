// Everything together: frames of a soft_shadow_map.
#include "golden.hpp"

#include "../support/images.hpp"

#include <gnomon/soft_shadow_map.hpp>

#include <vector>

namespace golden {

void print_facade() {
    const std::tuple maps{named<rg8>{"rg8"},
                          named<rg16>{"rg16"},
                          named<rgba16f>{"rgba16f"},
                          named<rgba32f>{"rgba32f"},
                          named<tm8>{"tm8"},
                          named<paper<unorm8>>{"paper_rg8"},
                          named<paper<half16, both>>{"paper_rgba16f"}};
    const auto frames = []<texel_format T, kernel K>(named<T>, named<K>) {
        hash h;
        test::dice roll(110);
        soft_shadow_map<T, K> map({.width = 90, .height = 71, .tile = 16});
        for (int frame = 0; frame < 3; ++frame) {
            map.clear();
            for (int i = 0; i < 6; ++i) {
                const texel_rect r = roll.rect(map.size(), 20);
                const float s = roll.unit();
                if constexpr (T::effects.translucency)
                    map.cast(r, s, roll.unit());
                else
                    map.cast(r, s);
            }
            if constexpr (T::effects.far_bound) {
                const texel_rect r = roll.rect(map.size(), 20);
                map.bound(r, roll.unit());
            }
            map.filter();
            map.decision = {.caster = frame == 1 ? towards_shadow : towards_light, .fade = 0.125f};
            test::for_each_texel(whole(map.size()), [&](int x, int y) { h.add(map.soft()(x, y)); });
            std::vector<float> x(500), y(500), z(500), intensity(500);
            for (std::size_t i = 0; i < x.size(); ++i) {
                x[i] = roll.unit() * 128.0f;
                y[i] = roll.unit() * 128.0f;
                z[i] = roll.unit();
            }
            map.receive(x, y, z, intensity);
            for (const float v : intensity) h.add(v);
            for (int i = 0; i < 200; ++i) {
                const int column = roll(-1, 90), row = roll(-1, 71);
                h.add(map.shadow(column, row, roll.unit()));
                const texel_rect r = roll.rect(map.size(), 20);
                const float nearest = roll.unit(), farthest = roll.unit();
                h.add(map.reaches(r, {nearest, farthest}));
            }
        }
        return h;
    };
    print("soft_shadow_map", maps, std::tuple{named<binomial<3>>{"binomial<3>"}}, frames);
    print("soft_shadow_map", std::tuple{named<rg16>{"rg16"}}, std::tuple{named<gaussian<6, 40>>{"gaussian<6,40>"}}, frames);
}

} // namespace golden
