// gnomon: soft shadow maps. Reading a filtered map: a texel as numbers, and four of them blended.
#pragma once

#include <gnomon/texel/image.hpp>
#include <gnomon/texel/texel.hpp>

namespace gnomon::inline GNOMON_BUILD {

/// A filtered texel as numbers, in codes: what a decision is made from. Reading a stored texel loses nothing.
template <texel_format Texel, typename Number = double> struct filtered {
    /// What a full mask is.
    static constexpr double scale = Texel::linear_scale;

    Number code[static_cast<std::size_t>(Texel::channels)];

    /// Premultiplied reversed depth e, whichever way the representation stores it.
    [[nodiscard]] constexpr Number depth() const noexcept { return complement(Texel::depth_index); }
    [[nodiscard]] constexpr Number mask() const noexcept { return code[Texel::mask_index]; }
    /// Premultiplied reversed depth of the far bound; 0 where no receiver bounds the shadow.
    [[nodiscard]] constexpr Number far_bound() const noexcept
        requires(Texel::effects.far_bound)
    {
        return complement(Texel::far_index);
    }
    /// How dark the shadow is, in codes: the contribution if there is one, else the mask.
    [[nodiscard]] constexpr Number contribution() const noexcept {
        return code[Texel::effects.translucency ? Texel::contribution_index : Texel::mask_index];
    }

  private:
    [[nodiscard]] constexpr Number complement(int index) const noexcept {
        return Texel::representation_type::complement(code[index], Number(scale));
    }
};

/// The numbers of one stored texel.
template <texel_format Texel> [[nodiscard]] constexpr filtered<Texel> read(const Texel& texel) noexcept {
    filtered<Texel> f{};
    for (int c = 0; c < Texel::channels; ++c) f.code[c] = texel.template linear<double>(c);
    return f;
}

/// Four texels blended around the point (x, y), in texels: a texel's own value at its centre, (i + 0.5, j + 0.5).
///
/// Positions are taken to 1/256 texel, as texture units do, so the blend is exact for unorm and half texels; the error of position
/// is at most 1/512 texel. Clear lies off the map; NaN and infinities are off the map. Keeps e <= m.
/// \pre at most 2^22 texels a side
template <typename T>
    requires texel_format<std::remove_const_t<T>>
[[nodiscard]] filtered<std::remove_const_t<T>> sample(image_view<T> map, float x, float y) noexcept {
    using Texel = std::remove_const_t<T>;
    constexpr int steps = 256;
    const filtered<Texel> clear = read(Texel::clear());
    const double px = static_cast<double>(x), py = static_cast<double>(y);
    const int u = detail::floor_to_int((px - 0.5) * steps + 0.5);
    const int v = detail::floor_to_int((py - 0.5) * steps + 0.5);
    const int column = u >> 8, row = v >> 8;
    const int right = u & (steps - 1), below = v & (steps - 1);
    const auto at = [&](int i, int j) { return whole(map.size()).contains(i, j) ? read(map(i, j)) : clear; };
    const filtered<Texel> corner[4] = {at(column, row), at(column + 1, row), at(column, row + 1), at(column + 1, row + 1)};
    const double weight[4] = {1.0 * (steps - right) * (steps - below), 1.0 * right * (steps - below), 1.0 * (steps - right) * below,
                              1.0 * right * below};
    filtered<Texel> blend{};
    for (int c = 0; c < Texel::channels; ++c) {
        double sum = 0.0;
        for (int i = 0; i < 4; ++i) sum += weight[i] * corner[i].code[c];
        blend.code[c] = sum / (steps * steps);
    }
    return blend;
}

} // namespace gnomon::inline GNOMON_BUILD
