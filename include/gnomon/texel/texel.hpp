// gnomon: soft shadow maps. A texel: channel x representation x effects, exactly as it lies in memory.
#pragma once

#include <gnomon/texel/channel.hpp>
#include <gnomon/texel/depth_mask.hpp>
#include <gnomon/texel/depth_ratio.hpp>
#include <gnomon/texel/effects.hpp>
#include <gnomon/texel/paper_depth_mask.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace gnomon::inline GNOMON_BUILD {

/// What the numbers of a texel mean. Models: depth_mask (the default), depth_ratio, paper_depth_mask.
template <typename R>
concept representation = requires(double v, float z) {
    requires std::same_as<std::remove_cv_t<decltype(R::premultiplied)>, bool>;
    { R::clear_depth } -> std::convertible_to<double>;
    { R::template encode<unorm8>(z) } noexcept -> std::same_as<std::uint8_t>;
    { R::nearer(z, z) } noexcept -> std::same_as<bool>;
    { R::complement(v, v) } noexcept -> std::same_as<double>;
    { R::behind(v, v, v) } noexcept -> std::same_as<bool>;
    { R::template depth_rounding<unorm8>() } noexcept -> std::same_as<rounding_error>;
    { R::template mask_rounding<unorm8>() } noexcept -> std::same_as<rounding_error>;
    { R::template depth_of_caster<unorm8>() } noexcept -> std::same_as<caster_rounding>;
};

/// Depth, mask, and the optional channels, interleaved: the object is the memory. Channel order: depth, mask, far bound
/// (if any), contribution (if any). No padding: sizeof is channels times the storage, so an engine's buffer can be viewed as it is.
template <channel Channel, representation Representation = depth_mask, effects Effects = effects{}> struct texel {
    static_assert(Representation::premultiplied || Channel::whole_codes,
                  "gnomon: depth_ratio, and whatever else is not premultiplied, is for unorm8 and unorm16; half16 and float32 keep "
                  "a depth's precision in depth_mask already");
    using channel_type = Channel;
    using representation_type = Representation;
    using storage = typename Channel::storage;

    static constexpr gnomon::effects effects = Effects;
    static constexpr int depth_index = 0;
    static constexpr int mask_index = 1;
    static constexpr int far_index = Effects.far_bound ? 2 : -1;
    static constexpr int contribution_index = Effects.translucency ? (Effects.far_bound ? 3 : 2) : -1;
    static constexpr int channels = 2 + (Effects.far_bound ? 1 : 0) + (Effects.translucency ? 1 : 0);

    /// How far a code of a filtered texel may be from its exact value, and a caster's stored depth from its own.
    static constexpr rounding_error depth_rounding = Representation::template depth_rounding<Channel>();
    static constexpr rounding_error mask_rounding = Representation::template mask_rounding<Channel>();
    static constexpr caster_rounding depth_of_caster = Representation::template depth_of_caster<Channel>();

    storage stored[static_cast<std::size_t>(channels)];

    /// Nothing here: lit at every depth.
    [[nodiscard]] static constexpr texel clear() noexcept {
        texel t{};
        t.stored[depth_index] = Channel::encode(Representation::clear_depth);
        if constexpr (Effects.far_bound) t.stored[far_index] = Channel::encode(Representation::clear_depth);
        return t;
    }

    /// An opaque caster at unit depth `s`; clamped to [0, 1], NaN is the far plane.
    [[nodiscard]] static constexpr texel caster(float s) noexcept {
        texel t = clear();
        t.stored[depth_index] = Representation::template encode<Channel>(s);
        t.stored[mask_index] = Channel::encode(1.0);
        if constexpr (Effects.translucency) t.stored[contribution_index] = Channel::encode(1.0);
        return t;
    }

    /// A caster that lets 1 - `opacity` of the light through. Exists only with `effects{.translucency = true}`.
    [[nodiscard]] static constexpr texel caster(float s, float opacity) noexcept
        requires(Effects.translucency)
    {
        texel t = caster(s);
        t.stored[contribution_index] = Channel::encode(static_cast<double>(opacity));
        return t;
    }

    /// Does an unfiltered texel hold a caster?
    [[nodiscard]] constexpr bool occupied() const noexcept { return Channel::code(stored[mask_index]) > 0.0f; }

    /// Puts a caster here unless a nearer one is here already. Of two at the same stored depth the more opaque one stays, so
    /// the order of casters never shows. A faint near caster hides an opaque far one: the shadow is that of the nearest.
    constexpr void cast(texel incoming) noexcept {
        if (!occupied() || nearer(incoming)) *this = incoming;
    }

    /// Lets a receiver at depth `z` end the shadow of the caster here: the nearest one not before the caster stays.
    /// Call it for receivers after all casters are in. Equal stored depths count as behind: what a caster stands on is bounded.
    /// Nothing bounds an empty texel, whose clear depth lies behind every receiver.
    constexpr void bound(float z) noexcept
        requires(Effects.far_bound)
    {
        const storage surface = Representation::template encode<Channel>(z);
        if (Representation::nearer(surface, stored[depth_index])) return;
        if (Representation::nearer(surface, stored[far_index])) stored[far_index] = surface;
    }

    /// What 1 is in `linear`.
    static constexpr double linear_scale =
        static_cast<double>(Channel::scale) * (Representation::premultiplied ? 1.0 : static_cast<double>(Channel::scale));

    /// A channel as a linear filter has to see it, exactly: its code; and where depths are not stored times the mask, their product,
    /// the other channels scaled alike. `Number` holds linear_scale.
    template <typename Number> [[nodiscard]] constexpr Number linear(int c) const noexcept {
        const auto code = static_cast<Number>(Channel::code(stored[c]));
        if constexpr (Representation::premultiplied) return code;
        return code * static_cast<Number>(is_depth(c) ? Channel::code(stored[mask_index]) : Channel::scale);
    }

    /// What sums of `linear` are kept in: whole numbers where codes are whole, so that they are exact.
    using linear_sum = std::conditional_t<Channel::whole_codes, std::uint64_t, double>;

    /// The texel whose linear channels are sums / whole: the one rounding of a filter. \pre weights >= 0 that sum to `whole`
    ///
    /// Whole codes are rounded to nearest, halves upwards, from exact integers; half and float as their channel does; a ratio of
    /// two sums is rounded down.
    [[nodiscard]] static constexpr texel from_linear(const linear_sum* sums, linear_sum whole) noexcept {
        texel t{};
        if constexpr (!Channel::whole_codes) {
            for (int c = 0; c < channels; ++c) t.stored[c] = Channel::store(sums[c] / whole);
        } else {
            const auto nearest = [whole](linear_sum sum) { return static_cast<storage>((sum + whole / 2) / whole); };
            if constexpr (Representation::premultiplied) {
                for (int c = 0; c < channels; ++c) t.stored[c] = nearest(sums[c]);
            } else {
                constexpr auto scale = static_cast<linear_sum>(Channel::scale);
                const linear_sum mask = sums[mask_index] / scale; // exact
                if (nearest(mask) == 0) return clear();
                for (int c = 0; c < channels; ++c)
                    t.stored[c] = is_depth(c) ? static_cast<storage>(sums[c] / mask) : nearest(sums[c] / scale);
            }
        }
        return t;
    }

    friend constexpr bool operator==(const texel& a, const texel& b) noexcept {
        for (int c = 0; c < channels; ++c)
            if (!same(a.stored[c], b.stored[c])) return false;
        return true;
    }

  private:
    [[nodiscard]] static constexpr bool is_depth(int c) noexcept { return c == depth_index || c == far_index; }
    [[nodiscard]] constexpr bool nearer(const texel& incoming) const noexcept {
        const storage here = stored[depth_index], there = incoming.stored[depth_index];
        if constexpr (Effects.translucency)
            if (!Representation::nearer(here, there) && !Representation::nearer(there, here))
                return incoming.stored[contribution_index] > stored[contribution_index];
        return Representation::nearer(there, here);
    }
};

namespace detail {
template <typename T> inline constexpr bool is_texel = false;
template <channel C, representation R, effects E> inline constexpr bool is_texel<texel<C, R, E>> = true;
} // namespace detail

/// Any instance of `texel`.
template <typename T>
concept texel_format = detail::is_texel<T>;

/// @name Texels by their memory layout: r depth, g mask, b far bound, a contribution.
/// @{
using rg8 = texel<unorm8>;
using rg16 = texel<unorm16>;
using rg16f = texel<half16>;
using rg32f = texel<float32>;

/// t and m, see depth_ratio.
using tm8 = texel<unorm8, depth_ratio>;
using tm16 = texel<unorm16, depth_ratio>;

using rgb8 = texel<unorm8, depth_mask, effects{.far_bound = true}>;
using rgb16 = texel<unorm16, depth_mask, effects{.far_bound = true}>;
using rgb16f = texel<half16, depth_mask, effects{.far_bound = true}>;
using rgb32f = texel<float32, depth_mask, effects{.far_bound = true}>;

using rga8 = texel<unorm8, depth_mask, effects{.translucency = true}>;
using rga16 = texel<unorm16, depth_mask, effects{.translucency = true}>;
using rga16f = texel<half16, depth_mask, effects{.translucency = true}>;
using rga32f = texel<float32, depth_mask, effects{.translucency = true}>;

using rgba8 = texel<unorm8, depth_mask, effects{.far_bound = true, .translucency = true}>;
using rgba16 = texel<unorm16, depth_mask, effects{.far_bound = true, .translucency = true}>;
using rgba16f = texel<half16, depth_mask, effects{.far_bound = true, .translucency = true}>;
using rgba32f = texel<float32, depth_mask, effects{.far_bound = true, .translucency = true}>;
/// @}

static_assert(sizeof(rg8) == 2 && sizeof(rgb8) == 3 && sizeof(rgba16) == 8 && sizeof(rg32f) == 8);

} // namespace gnomon::inline GNOMON_BUILD
