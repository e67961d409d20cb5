// Receivers anywhere on maps of every format, blended and decided in doubles, against the oracle, bit for bit.
#include <gnomon/backend/reconstruct.hpp>
#include <gnomon/backend/simd_shade.hpp>
#include <gnomon/backend/simd_texel_blend.hpp>

#include "../support/formats.hpp"
#include "../support/lanes.hpp"
#include "../support/shades.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace {
using gnomon::extent;
using gnomon::rule;
using gnomon::strided_span;
using test::dice;
using test::for_each_isa;

using ratio_rga8 = gnomon::texel<gnomon::unorm8, gnomon::depth_ratio, test::translucent>;

/// A map whose memory ends where its last texel does: the address sanitizer watches.
template <typename Texel> struct tight_map {
    extent size;
    std::unique_ptr<Texel[]> memory;

    tight_map(dice& roll, extent s)
        : size(s), memory(std::make_unique<Texel[]>(static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.height))) {
        test::for_each_texel(whole(size), [&](int x, int y) {
            view_of_all()(x, y) = roll.one_in(4) ? Texel::clear() : test::any_filtered<Texel>(roll);
        });
    }
    [[nodiscard]] gnomon::image_view<Texel> view_of_all() const { return {memory.get(), size}; }
    [[nodiscard]] gnomon::image_view<const Texel> view() const { return view_of_all(); }
};

struct points {
    std::vector<float> x, y, z;
};
template <typename Texel> points some_points(dice& roll, const tight_map<Texel>& map, const rule& r, int count) {
    points p;
    const auto position = [&roll](int size) {
        if (roll.one_in(100)) return test::hostile_floats[static_cast<std::size_t>(roll(0, 29))];
        return static_cast<float>(roll(-2 * 256, (size + 2) * 256)) / 256.0f;
    };
    for (int i = 0; i < count; ++i) {
        const float x = position(map.size.width), y = position(map.size.height);
        for (const float z : test::depths_that_try(roll, gnomon::sample(map.view(), x, y), r)) {
            p.x.push_back(x);
            p.y.push_back(y);
            p.z.push_back(z);
        }
    }
    return p;
}
} // namespace

TEST_CASE_TEMPLATE(
    "receivers anywhere on maps of every format are decided in lanes as by the oracle, on the map and beside it, about "
    "where a shadow begins, ends and has faded",
    Texel, gnomon::rgb8, gnomon::rgba8, gnomon::rga16, gnomon::rgba16, gnomon::rg16f, gnomon::rga16f, gnomon::rgba32f, gnomon::tm8,
    gnomon::tm16, ratio_rga8) {
    dice roll(520);
    int dark = 0;
    for (const rule& r : test::rules_that_fade())
        for (const extent size : {extent{9, 7}, {2, 2}, {40, 3}}) {
            const tight_map<Texel> map(roll, size);
            const points p = some_points(roll, map, r, 60);
            test::for_each_kind(roll, p.z, [&](const auto& z, auto intensity) {
                std::vector<decltype(intensity)> expected(z.size()), made(z.size());
                gnomon::receive(map.view(), p.x, p.y, z, expected, r);
                for (const auto each : expected) dark += each > 0;
                for_each_isa([&]<typename Isa>() {
                    gnomon::reconstruct<Isa>(map.view(), strided_span<const float>(p.x), strided_span<const float>(p.y), z, made,
                                             r);
                    CHECK(test::equal_bits(made, expected));
                });
            });
        }
    CHECK(dark > 1000);
}

namespace {
using lanes = gnomon::emulated<16>;
template <typename Texel, typename Depth> using blending = gnomon::on_any::texel_blend<lanes, Texel, Depth, std::uint8_t>;

/// Is a register answered whose first receiver has this among its numbers?
template <typename Texel> bool answered(int channel, double code) {
    using by = blending<Texel, float>;
    typename by::blended of{};
    of.code[channel][0] = code;
    const std::array z{0.75f, 0.75f, 0.75f, 0.75f};
    std::array<std::uint8_t, 4> made{};
    return by::answered(by::moving::template of<Texel, float>({}), of, z.data(), made.data());
}
} // namespace

TEST_CASE("a blend of floats that is no number is the scalar loop's, of whichever number, and no other is") {
    for (int channel = 0; channel < 4; ++channel) {
        CHECK(answered<gnomon::rgba32f>(channel, 0.5));
        CHECK(answered<gnomon::rgba32f>(channel, test::infinity<double>));
        CHECK_FALSE(answered<gnomon::rgba32f>(channel, test::nan<double>));
        CHECK_FALSE(answered<gnomon::rgba32f>(channel, -test::infinity<double>));
        CHECK(answered<gnomon::rgba16>(channel, 65535.0));
    }
}
