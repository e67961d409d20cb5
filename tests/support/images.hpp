// Images for the tests: how to fill one, compare two to the bit, and name one by a number.
#pragma once

#include "dice.hpp"

#include <gnomon/texel/image.hpp>
#include <gnomon/texel/texel.hpp>

#include <bit>
#include <cstdint>
#include <cstring>

namespace test {

template <typename F> void for_each_texel(gnomon::texel_rect r, F&& f) {
    for (int y = r.y0; y < r.y1; ++y)
        for (int x = r.x0; x < r.x1; ++x) f(x, y);
}

/// Texels of `part` whose bits differ between two images of the same size; -0 and NaN are bits like any other.
template <typename T> int differences(gnomon::image_view<const T> a, gnomon::image_view<const T> b, gnomon::texel_rect part) {
    int n = 0;
    for_each_texel(part, [&](int x, int y) { n += std::memcmp(&a(x, y), &b(x, y), sizeof(T)) != 0; });
    return n;
}
template <typename T> int differences(const gnomon::image<T>& a, const gnomon::image<T>& b) {
    return a.size() == b.size() ? differences<T>(a.view(), b.view(), gnomon::whole(a.size())) : -1;
}

/// A caster with all that its format can say: opacity and far bound where it has them.
template <gnomon::texel_format Texel> Texel any_caster(dice& roll) {
    const float s = roll.unit();
    Texel t = Texel::caster(s);
    if constexpr (Texel::effects.translucency) t = Texel::caster(s, roll.unit());
    if constexpr (Texel::effects.far_bound)
        t.bound(roll.unit()); // no bound if it lies before the caster; and no arithmetic here, which FMA could change
    return t;
}

/// One caster in `sparseness` texels, the rest clear.
template <gnomon::texel_format Texel> gnomon::image<Texel> noise(dice& roll, gnomon::extent size, int sparseness) {
    gnomon::image<Texel> image(size, Texel::clear());
    for_each_texel(gnomon::whole(size), [&](int x, int y) {
        if (roll.one_in(sparseness)) image(x, y) = any_caster<Texel>(roll);
    });
    return image;
}

/// FNV-1a over the numbers that are stored, so the same on either endianness.
template <gnomon::texel_format Texel> std::uint64_t hash(const gnomon::image<Texel>& image) {
    std::uint64_t h = 0xCBF29CE484222325u;
    for_each_texel(gnomon::whole(image.size()), [&](int x, int y) {
        for (const auto stored : image(x, y).stored) {
            std::uint32_t bits = 0;
            if constexpr (sizeof stored == 4)
                bits = std::bit_cast<std::uint32_t>(stored);
            else
                bits = stored;
            for (int byte = 0; byte < 4; ++byte) h = (h ^ (bits >> (8 * byte) & 0xFFu)) * 0x100000001B3u;
        }
    });
    return h;
}

} // namespace test
