// What tries a decision in all its parts: rules that bound and fade, texels with all that their format can say, and where a shadow ends.
#pragma once

#include "dice.hpp"
#include "images.hpp"
#include "lanes.hpp"
#include "threshold.hpp"

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <vector>

namespace test {

/// Rules for the caster, the far bound, and what lies between.
[[nodiscard]] inline std::vector<gnomon::rule> rules_that_fade() {
    using enum gnomon::bias_towards;
    std::vector<gnomon::rule> rules{{}, {.caster = gnomon::unbiased, .far_bound = gnomon::unbiased, .lit_beyond = true}};
    for (const float fade : {0x1p-6f, 0x1p-20f, 3.0f, infinity<float>, -1.0f, nan<float>}) rules.push_back({.fade = fade});
    rules.push_back({.caster = {.towards = shadow}, .far_bound = {.towards = shadow}, .fade = 0.125f});
    rules.push_back({.caster = {.towards = none}, .far_bound = {.towards = shadow, .roundings = 300}, .fade = 0.3f});
    rules.push_back({.caster = {.roundings = 128, .depth = 0.01f}, .far_bound = {.depth = 0.25f}, .fade = 0.01f});
    rules.push_back(
        {.caster = {.roundings = 1000, .caster_is_code = true}, .far_bound = {.roundings = 1000, .caster_is_code = true}});
    rules.push_back(
        {.caster = {.towards = shadow, .roundings = 5, .depth = -0.25f}, .far_bound = {.depth = -0.125f}, .fade = 0x1p-27f});
    for (const float depth : {nan<float>, infinity<float>, -infinity<float>})
        rules.push_back({.caster = {.depth = depth}, .far_bound = {.depth = -depth}, .fade = 0.25f});
    return rules;
}

/// A caster at some depth, or at the light's near plane, over a receiver or over none, of which a filter left some share or all. One in
/// eight is any bits, with a mask or without.
template <gnomon::texel_format Texel> [[nodiscard]] Texel any_filtered(dice& roll) {
    Texel t = Texel::clear();
    if (roll.one_in(8)) {
        fill_with_bits(roll, gnomon::image_view<Texel>(&t, {1, 1}));
        if (roll.one_in(4)) t.stored[Texel::mask_index] = {};
        return t;
    }
    t = any_caster<Texel>(roll);
    if (roll.one_in(8)) t.stored[Texel::depth_index] = Texel::caster(0.0f).stored[Texel::depth_index];
    const int taps = roll.one_in(4) ? 65535 : 81, most = roll.one_in(4) ? 3 : taps;
    return filtered(t, roll.one_in(4) ? taps : roll(0, most), taps);
}

/// The first depth past the far bound.
template <gnomon::texel_format Texel> [[nodiscard]] float first_bounded(gnomon::filtered<Texel> f, const gnomon::rule& r) {
    f.code[Texel::depth_index] = f.far_bound();
    f.code[Texel::far_index] = 0.0;
    if constexpr (Texel::effects.translucency) f.code[Texel::contribution_index] = gnomon::filtered<Texel>::scale;
    return first_shadowed(f, {.caster = r.far_bound});
}

/// Depths that try a texel or a sample: about where its shadow begins, ends and has faded, between, anywhere, and none.
template <gnomon::texel_format Texel>
[[nodiscard]] std::vector<float> depths_that_try(dice& roll, const gnomon::filtered<Texel>& f, const gnomon::rule& r) {
    std::vector<float> depths{roll.unit(), hostile_floats[static_cast<std::size_t>(roll(0, 29))]};
    const auto add_around = [&depths](float at) { depths.insert(depths.end(), {down(at), at, up(at)}); };
    add_around(first_shadowed(f, r));
    if constexpr (Texel::effects.far_bound) {
        const float bound = first_bounded(f, r);
        add_around(bound);
        if (r.fade > 0.0f) {
            add_around(bound + r.fade);
            depths.push_back(bound + r.fade * roll.unit());
        }
    }
    return depths;
}

/// Depths as they are, or the codes about them.
template <typename Depth> [[nodiscard]] std::vector<Depth> stored_depths(dice& roll, const std::vector<float>& z) {
    std::vector<Depth> made(z.size());
    std::transform(z.begin(), z.end(), made.begin(), [&roll](float at) {
        if constexpr (std::same_as<Depth, float>)
            return at;
        else
            return static_cast<Depth>(std::clamp(int{gnomon::unorm16::encode(static_cast<double>(at))} + roll(-1, 1), 0, 65535));
    });
    return made;
}

/// How many are neither light nor all that the darkest of them is.
template <typename T> [[nodiscard]] int half_shadows(const std::vector<T>& intensities) {
    const T darkest = intensities.empty() ? T{} : *std::max_element(intensities.begin(), intensities.end());
    return static_cast<int>(
        std::count_if(intensities.begin(), intensities.end(), [darkest](T each) { return each > T{} && each < darkest; }));
}

/// Calls f(depths, intensity) for kinds of both that try all there is: z as it is and in codes, intensities of every kind.
template <typename F> void for_each_kind(dice& roll, const std::vector<float>& z, F&& f) {
    f(z, float{});
    f(z, std::uint16_t{});
    f(stored_depths<std::uint16_t>(roll, z), std::uint8_t{});
}

/// The same bits?
template <typename T> [[nodiscard]] bool equal_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

} // namespace test
