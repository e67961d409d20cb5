// A texel: its memory, what clear, caster, cast and bound write, and what a missing effect takes away.
#include <gnomon/texel/texel.hpp>

#include "../support/bits.hpp"
#include "../support/float_dice.hpp"
#include "../support/formats.hpp"
#include "../support/sweep.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>
#include <vector>

using namespace gnomon;
using test::sweep;

#define EVERY_TEXEL                                                                                                                \
    rg8, rg16, rg16f, rg32f, rgb8, rgb16, rgb16f, rgb32f, rga8, rga32f, rgba8, rgba16, rgba16f, rgba32f, tm8, tm16,                \
        test::ratio_rgba8, test::ratio_rgba16, test::paper8, test::paper16, test::paper16f, test::paper32f, test::paper_rgba8,     \
        test::paper_rgba16, test::paper_rgba16f, test::paper_rgba32f
#define EVERY_FULL_TEXEL                                                                                                           \
    rgba8, rgba16, rgba16f, rgba32f, test::ratio_rgba8, test::ratio_rgba16, test::paper_rgba8, test::paper_rgba16,                 \
        test::paper_rgba16f, test::paper_rgba32f

// Of the representation concept a model and two near misses. (Not in the unnamed namespace: nobody calls their members.)
namespace representation_models {
struct may_throw : depth_mask {
    static constexpr bool behind(double, double, double) { return false; }
};
struct cannot_clear {
    static constexpr bool premultiplied = true;
    template <channel Channel> static constexpr typename Channel::storage encode(float) noexcept { return {}; }
    template <typename Code> static constexpr bool nearer(Code a, Code b) noexcept { return a < b; }
    static constexpr double complement(double d, double) noexcept { return d; }
    static constexpr bool behind(double, double, double) noexcept { return false; }
    template <channel Channel> static constexpr rounding_error depth_rounding() noexcept { return Channel::rounding; }
    template <channel Channel> static constexpr rounding_error mask_rounding() noexcept { return Channel::rounding; }
    template <channel Channel> static constexpr caster_rounding depth_of_caster() noexcept { return {0.0f, 0.0f}; }
};
struct can_clear : cannot_clear {
    static constexpr double clear_depth = 0.0;
};
} // namespace representation_models

namespace {

template <typename Texel> constexpr double number(const Texel& t, int index) {
    return static_cast<double>(Texel::channel_type::decode(t.stored[index]));
}

template <typename T>
concept has_opacity = requires(float v) { T::caster(v, v); };
template <typename T>
concept has_bound = requires(T t, float v) { t.bound(v); };

// An effect that is off takes its members away, and only its own.
static_assert(!has_opacity<rg8> && !has_bound<rg8>);
static_assert(!has_opacity<rgb8> && has_bound<rgb8>);
static_assert(has_opacity<rga8> && !has_bound<rga8>);
static_assert(has_opacity<rgba8> && has_bound<rgba8>);
static_assert(has_opacity<test::paper_rgba8> && !has_opacity<test::paper8> && !has_bound<test::paper8>);

// Texel, not a struct that looks like one.
struct looks_like_a_texel {
    std::uint8_t stored[2];
};
static_assert(texel_format<rg8> && texel_format<test::paper_rgba32f>);
static_assert(!texel_format<looks_like_a_texel> && !texel_format<const rg8> && !texel_format<rg8&> && !texel_format<std::uint8_t> &&
              !texel_format<unorm8>);

static_assert(representation<depth_mask> && representation<depth_ratio> && representation<paper_depth_mask> &&
              representation<representation_models::can_clear>);
static_assert(!representation<representation_models::may_throw> && !representation<representation_models::cannot_clear>);
static_assert(!representation<unorm8> && !representation<void>);

// Memory: the channels in order, and nothing else.
template <typename Texel> constexpr bool is_only_its_channels() {
    return sizeof(Texel) == static_cast<std::size_t>(Texel::channels) * sizeof(typename Texel::storage) &&
           alignof(Texel) == alignof(typename Texel::storage) && std::is_trivially_copyable_v<Texel> &&
           std::is_standard_layout_v<Texel> && std::is_aggregate_v<Texel>;
}
template <typename... Texels> constexpr bool all_are_only_their_channels() { return (is_only_its_channels<Texels>() && ...); }
static_assert(all_are_only_their_channels<EVERY_TEXEL>());
static_assert(rg8::channels == 2 && rgb8::channels == 3 && rga8::channels == 3 && rgba8::channels == 4);
static_assert(rgb8::far_index == 2 && rgb8::contribution_index == -1);
static_assert(rga8::far_index == -1 && rga8::contribution_index == 2);
static_assert(rgba8::far_index == 2 && rgba8::contribution_index == 3);
static_assert(rg8::depth_index == 0 && rg8::mask_index == 1 && rg8::far_index == -1 && rg8::contribution_index == -1);

// At compile time, where an index outside of the channels does not compile.
static_assert(rg8::clear() == rg8{} && rga8::clear() == rga8{} && rg8::caster(0.0f) == rg8{{255, 255}});
template <typename Texel> constexpr bool comes_back(Texel texel) {
    using sum = typename Texel::linear_sum;
    sum sums[static_cast<std::size_t>(Texel::channels)];
    for (int c = 0; c < Texel::channels; ++c) sums[c] = texel.template linear<sum>(c);
    return Texel::from_linear(sums, sum{1}) == texel;
}
static_assert(comes_back(rg8{{100, 200}}) && comes_back(rg32f{{0.25f, 0.5f}}) && comes_back(tm8{{100, 200}}));
constexpr rgb8 a_caster_twice() {
    rgb8 t = rgb8::caster(0.2f);
    t.cast(rgb8::caster(0.2f));
    return t;
}
static_assert(a_caster_twice() == rgb8::caster(0.2f));
constexpr rgba8 a_bounded_caster() {
    rgba8 t = rgba8::clear();
    t.cast(rgba8::caster(0.8f, 1.0f));
    t.cast(rgba8::caster(0.2f, 0.4f));
    t.bound(0.6f);
    return t;
}
static_assert(a_bounded_caster() == rgba8{{204, 255, 102, 102}});

// The short names are names, not other types.
template <effects Effects, typename... Texels>
constexpr bool are = std::is_same_v<void(Texels...), void(texel<unorm8, depth_mask, Effects>, texel<unorm16, depth_mask, Effects>,
                                                          texel<half16, depth_mask, Effects>, texel<float32, depth_mask, Effects>)>;
static_assert(are<effects{}, rg8, rg16, rg16f, rg32f> && are<test::bounded, rgb8, rgb16, rgb16f, rgb32f> &&
              are<test::translucent, rga8, rga16, rga16f, rga32f> && are<test::both, rgba8, rgba16, rgba16f, rgba32f>);
static_assert(std::is_same_v<tm8, texel<unorm8, depth_ratio>> && std::is_same_v<tm16, texel<unorm16, depth_ratio>>);

/// All casters that can be told apart in 8 bits by few numbers: depths and opacities with ends, neighbours and equals.
template <typename Texel> std::vector<Texel> some_casters() {
    std::vector<Texel> casters;
    for (const float s : {0.0f, 1.0f / 255, 0.25f, 0.5f, 1.0f - 1.0f / 255, 1.0f})
        if constexpr (Texel::effects.translucency)
            for (const float opacity : {0.0f, 0.5f, 1.0f}) casters.push_back(Texel::caster(s, opacity));
        else
            casters.push_back(Texel::caster(s));
    return casters;
}

} // namespace

TEST_CASE_TEMPLATE("a clear texel is all zero and the paper's is one where depths are", Texel, EVERY_TEXEL) {
    const Texel clear = Texel::clear();
    const bool complement = !std::is_same_v<typename Texel::representation_type, paper_depth_mask>;
    for (int c = 0; c < Texel::channels; ++c) {
        const bool depth = c == Texel::depth_index || c == Texel::far_index;
        CHECK(test::equal(number(clear, c), depth && !complement ? 1.0 : 0.0));
    }
    CHECK(test::equal(Texel::representation_type::clear_depth, complement ? 0.0 : 1.0));
    CHECK(!clear.occupied());
    if (complement) CHECK(clear == Texel{});
}

TEST_CASE_TEMPLATE("texels are equal if and only if all of their channels are", Texel, EVERY_TEXEL) {
    const Texel texel = Texel::caster(0.25f);
    CHECK(texel == Texel::caster(0.25f));
    for (int c = 0; c < Texel::channels; ++c) {
        Texel other = texel;
        other.stored[c] = Texel::channel_type::encode(number(texel, c) > 0.5 ? 0.0 : 1.0);
        CHECK(other != texel);
    }
}

TEST_CASE_TEMPLATE("a caster stores its depth in its own way and a full mask", Texel, EVERY_TEXEL) {
    using channel_type = typename Texel::channel_type;
    const bool complement = !std::is_same_v<typename Texel::representation_type, paper_depth_mask>;
    test::float_dice dice(4);
    sweep wrong;
    for (int i = 0; i < 10'000; ++i) {
        const float s = dice.any_unit();
        const Texel t = Texel::caster(s);
        const double stored = complement ? 1.0 - static_cast<double>(s) : static_cast<double>(s);
        const auto nearest = channel_type::encode(stored); // a ratio rounds down: depth_ratio.cpp
        bool good = !Texel::representation_type::premultiplied ||
                    (t.stored[Texel::depth_index] >= nearest && t.stored[Texel::depth_index] <= nearest);
        good = good && t.occupied() && test::equal(number(t, Texel::mask_index), 1.0);
        if constexpr (Texel::effects.far_bound)
            good = good && test::equal(number(t, Texel::far_index), number(Texel::clear(), Texel::far_index));
        if constexpr (Texel::effects.translucency) good = good && test::equal(number(t, Texel::contribution_index), 1.0);
        wrong.unless(good, "s", s);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("a representation says how its texels round and the texel passes it on", Texel, EVERY_TEXEL) {
    using channel_type = typename Texel::channel_type;
    using representation_type = typename Texel::representation_type;
    // Through pointers that may change, or the compiler would answer instead.
    rounding_error (*volatile depth_rounding)() noexcept = &representation_type::template depth_rounding<channel_type>;
    rounding_error (*volatile mask_rounding)() noexcept = &representation_type::template mask_rounding<channel_type>;
    caster_rounding (*volatile depth_of_caster)() noexcept = &representation_type::template depth_of_caster<channel_type>;
    const rounding_error depth = depth_rounding(), mask = mask_rounding();
    const caster_rounding caster = depth_of_caster();
    CHECK(test::equal(Texel::depth_rounding.absolute, depth.absolute));
    CHECK(test::equal(Texel::depth_rounding.relative, depth.relative));
    CHECK(test::equal(Texel::mask_rounding.absolute, mask.absolute));
    CHECK(test::equal(Texel::mask_rounding.relative, mask.relative));
    CHECK(test::equal(Texel::depth_of_caster.nearer, caster.nearer));
    CHECK(test::equal(Texel::depth_of_caster.farther, caster.farther));
    if (representation_type::premultiplied) {
        CHECK(test::equal(mask.absolute, channel_type::rounding.absolute));
        CHECK(test::equal(caster.nearer, channel_type::max_error));
    } else { // a ratio errs one way, and what its filter rounds moves no decision
        CHECK(test::equal(depth.absolute + mask.absolute + depth.relative + mask.relative + caster.nearer, 0.0f));
        CHECK(test::equal(caster.farther, 1.0f / channel_type::scale));
    }
}

TEST_CASE_TEMPLATE("the complement of what a caster stores is as far from 0 as the caster is from the far plane", Texel, rg8, rg32f,
                   tm8, test::paper8, test::paper32f) {
    for (const float s : {0.0f, 0.2f, 0.6f, 1.0f}) {
        const double scale = static_cast<double>(Texel::channel_type::scale);
        const double depth = static_cast<double>(Texel::channel_type::code(Texel::caster(s).stored[Texel::depth_index]));
        const double expected = scale * (1.0 - static_cast<double>(s));
        const double error = Texel::representation_type::complement(depth, scale) - expected;
        CHECK(error <= 1e-7 * scale);
        CHECK(error >= -1.0 - 1e-7 * scale); // a ratio rounds down
    }
}

TEST_CASE_TEMPLATE("a receiver at the depth of its caster is lit and one float behind it is in shadow", Representation, depth_mask,
                   depth_ratio, paper_depth_mask) {
    sweep wrong;
    for (int m = 1; m <= 256; m *= 2) // so that a float holds the depth 1 - e/m, and nothing is rounded
        for (int e = 0; e <= m; ++e) {
            const double depth = e, mask = m;
            const auto s = static_cast<float>((mask - depth) / mask);
            for (const float z : {test::down(s), s, test::up(s)})
                wrong.unless(Representation::behind(depth, mask, static_cast<double>(z)) == (z > s), "e", e, "m", m, "z", z);
        }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("where no mask is left every receiver is behind a depth and none is behind nothing", Representation, depth_mask,
                   depth_ratio, paper_depth_mask) {
    for (const double z : {-1.0, 0.0, 0.25, 0.5, 1.0, 2.0})
        for (const double e : {0.0, 0x1p-100, 0.5, 1.0, 255.0})
            for (const double m : {0.0, -0.0}) CHECK(Representation::behind(e, m, z) == (e > 0.0));
}

TEST_CASE_TEMPLATE("a caster outside of 0 to 1 is clamped and one at NaN is at the far plane", Texel, EVERY_TEXEL) {
    for (const float s : {-test::infinity<float>, -1.0f, -test::smallest<float>, -0.0f})
        CHECK(Texel::caster(s) == Texel::caster(0.0f));
    for (const float s : {test::infinity<float>, 2.0f, test::up(1.0f), test::nan<float>})
        CHECK(Texel::caster(s) == Texel::caster(1.0f));
}

TEST_CASE_TEMPLATE("opacity is stored as the contribution and changes nothing else", Texel, rga8, rga32f, EVERY_FULL_TEXEL) {
    for (const float opacity : {0.0f, 0.25f, 1.0f, -1.0f, 7.0f, test::nan<float>}) {
        Texel expected = Texel::caster(0.3f);
        expected.stored[Texel::contribution_index] = Texel::channel_type::encode(static_cast<double>(opacity));
        CHECK(Texel::caster(0.3f, opacity) == expected);
    }
}

TEST_CASE_TEMPLATE("a mean of two texels is rounded once: whole codes to nearest and halves upwards", Texel, rg8, rgba16, rgba16f,
                   rgba32f, test::paper_rgba8) {
    using channel_type = typename Texel::channel_type;
    using sum = typename Texel::linear_sum;
    CHECK(test::equal(Texel::linear_scale, static_cast<double>(channel_type::scale)));
    test::float_dice dice(17);
    sweep wrong;
    for (int i = 0; i < 2'000; ++i) {
        Texel a{}, b{};
        sum sums[static_cast<std::size_t>(Texel::channels)];
        for (int c = 0; c < Texel::channels; ++c) {
            a.stored[c] = channel_type::encode(static_cast<double>(dice.unit()));
            b.stored[c] = channel_type::encode(static_cast<double>(dice.unit()));
            sums[c] = a.template linear<sum>(c) + b.template linear<sum>(c);
        }
        const Texel mean = Texel::from_linear(sums, sum{2});
        for (int c = 0; c < Texel::channels; ++c) {
            const double twice =
                static_cast<double>(channel_type::code(a.stored[c])) + static_cast<double>(channel_type::code(b.stored[c]));
            wrong.unless(same(mean.stored[c], channel_type::store(twice / 2.0)), "channel", c, "of", a.stored[c], b.stored[c]);
        }
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("the far bound of a ratio is a depth to a filter and its contribution is not") {
    const test::ratio_rgba8 a{{200, 100, 150, 60}}, b{{100, 50, 40, 20}};
    std::uint64_t sums[4];
    for (int c = 0; c < 4; ++c) sums[c] = 2 * a.linear<std::uint64_t>(c) + b.linear<std::uint64_t>(c);
    CHECK(sums[0] == 2 * 200 * 100 + 100 * 50);
    CHECK(sums[1] == 255 * (2 * 100 + 50));
    CHECK(sums[2] == 2 * 150 * 100 + 40 * 50);
    CHECK(sums[3] == 255 * (2 * 60 + 20));
    CHECK(test::ratio_rgba8::from_linear(sums, std::uint64_t{3}) == test::ratio_rgba8{{180, 83, 128, 47}}); // 83.3 and 46.7
    CHECK(test::equal(test::ratio_rgba8::linear_scale, 255.0 * 255.0));
}

TEST_CASE_TEMPLATE("cast keeps the nearest of three casters in whichever order they come", Texel, EVERY_TEXEL) {
    using representation_type = typename Texel::representation_type;
    const auto wins = [](const Texel& a, const Texel& b) { // a before b: nearer, or as near and more opaque
        if (representation_type::nearer(a.stored[Texel::depth_index], b.stored[Texel::depth_index])) return true;
        if (representation_type::nearer(b.stored[Texel::depth_index], a.stored[Texel::depth_index])) return false;
        if constexpr (Texel::effects.translucency) return a.stored[Texel::contribution_index] > b.stored[Texel::contribution_index];
        return false;
    };
    const auto casters = some_casters<Texel>();
    sweep wrong;
    for (const Texel& a : casters)
        for (const Texel& b : casters)
            for (const Texel& c : casters) {
                const std::array three{a, b, c};
                const Texel winner = *std::min_element(three.begin(), three.end(), wins);
                std::array order{0u, 1u, 2u};
                do {
                    Texel t = Texel::clear();
                    for (const unsigned i : order) t.cast(three[i]);
                    wrong.unless(t == winner, "order", order[0], order[1], order[2], "depths", a.stored[0], b.stored[0],
                                 c.stored[0]);
                } while (std::next_permutation(order.begin(), order.end()));
            }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("nothing cast on a caster changes it and nothing on nothing stays nothing", Texel, EVERY_TEXEL) {
    for (const Texel& caster : some_casters<Texel>()) {
        Texel t = caster;
        t.cast(Texel::clear());
        CHECK(t == caster);
    }
    Texel t = Texel::clear();
    t.cast(Texel::clear());
    CHECK(t == Texel::clear());
}

TEST_CASE("bound keeps the nearest receiver that is not before the caster for all triples of 8-bit depths") {
    // in stored codes, where near is large: the largest of the receivers that are not larger than the caster
    const auto at = [](int code) { return static_cast<float>((255 - code) / 255.0); };
    sweep wrong;
    for (int caster = 0; caster < 256; ++caster) {
        const rgb8 alone = rgb8::caster(at(caster));
        for (int a = 0; a < 256; ++a) {
            rgb8 once = alone;
            once.bound(at(a));
            for (int b = 0; b < 256; ++b) {
                rgb8 t = once;
                t.bound(at(b));
                const int nearest = greater(a <= caster ? a : 0, b <= caster ? b : 0);
                wrong.unless(t == rgb8{{alone.stored[0], 255, static_cast<std::uint8_t>(nearest)}}, "caster", caster, "receivers",
                             a, b);
            }
        }
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("bound ignores receivers before the caster and texels without one", Texel, rgb8, rgb16, rgb16f, rgb32f,
                   EVERY_FULL_TEXEL) {
    Texel t = Texel::clear();
    t.bound(0.5f);
    CHECK(t == Texel::clear());

    t = Texel::caster(0.5f);
    for (const float before : {-1.0f, 0.0f, 0.25f, 0.49f, -test::infinity<float>}) t.bound(before);
    CHECK(t == Texel::caster(0.5f));
    for (const float far_plane : {1.0f, 2.0f, test::infinity<float>, test::nan<float>}) t.bound(far_plane);
    CHECK(t == Texel::caster(0.5f));
    t.bound(0.75f);
    CHECK(test::equal(number(t, Texel::far_index),
                      static_cast<double>(Texel::channel_type::decode(
                          Texel::representation_type::template encode<typename Texel::channel_type>(0.75f)))));
    t.bound(0.5f); // what it lies on
    CHECK(t.stored[Texel::far_index] == t.stored[Texel::depth_index]);
}
