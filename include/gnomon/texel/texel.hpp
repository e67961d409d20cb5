// gnomon: soft shadow maps. A texel: channel x representation x effects, exactly as it lies in memory.
#pragma once

#include <gnomon/texel/channel.hpp>
#include <gnomon/texel/depth_mask.hpp>
#include <gnomon/texel/effects.hpp>
#include <gnomon/texel/paper_depth_mask.hpp>

#include <concepts>
#include <cstddef>

namespace gnomon {

/// What the numbers of a texel mean. Models: depth_mask (the default), paper_depth_mask.
template <typename R>
concept representation = requires(double v, float code) {
    { R::clear_depth } -> std::convertible_to<double>;
    { R::stored_depth(v) } noexcept -> std::same_as<double>;
    { R::nearer(code, code) } noexcept -> std::same_as<bool>;
    { R::complement(v, v) } noexcept -> std::same_as<double>;
    { R::behind(v, v, v) } noexcept -> std::same_as<bool>;
    { R::template depth_rounding<float32>() } noexcept -> std::same_as<rounding_error>;
};

/// Depth, mask, and the optional channels, interleaved: the object is the memory. Channel order: depth, mask, far bound
/// (if any), contribution (if any). No padding: sizeof is channels times the storage, so an engine's buffer can be viewed as it is.
template <channel Channel, representation Representation = depth_mask, effects Effects = effects{}> struct texel {
    using channel_type = Channel;
    using representation_type = Representation;
    using storage = typename Channel::storage;

    static constexpr gnomon::effects effects = Effects;
    static constexpr int depth_index = 0;
    static constexpr int mask_index = 1;
    static constexpr int far_index = Effects.far_bound ? 2 : -1;
    static constexpr int contribution_index = Effects.translucency ? (Effects.far_bound ? 3 : 2) : -1;
    static constexpr int channels = 2 + (Effects.far_bound ? 1 : 0) + (Effects.translucency ? 1 : 0);

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
        t.stored[depth_index] = Channel::encode(Representation::stored_depth(static_cast<double>(s)));
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
        const storage surface = Channel::encode(Representation::stored_depth(static_cast<double>(z)));
        if (Representation::nearer(surface, stored[depth_index])) return;
        if (Representation::nearer(surface, stored[far_index])) stored[far_index] = surface;
    }

    friend constexpr bool operator==(const texel& a, const texel& b) noexcept {
        for (int c = 0; c < channels; ++c)
            if (!same(a.stored[c], b.stored[c])) return false;
        return true;
    }

  private:
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

} // namespace gnomon
