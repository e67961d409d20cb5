// Many receivers at once are each receiver alone, whatever the spans they come in.
#include <gnomon/receive/receive.hpp>

#include "../support/bits.hpp"
#include "../support/float_dice.hpp"
#include "../support/formats.hpp"
#include "../support/images.hpp"
#include "../support/sweep.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

using namespace gnomon;
using test::sweep;

namespace {

constexpr float untouched = -7.0f;
constexpr rule decision{.caster = {bias_towards::shadow, 1, 0.25f}}; // far enough from the default one to be told from it

/// A row whose texels, receivers and results lie in one array of structures.
template <typename Texel> struct receiver {
    float z;
    Texel texel;
    float intensity;
};

template <typename Texel> std::vector<receiver<Texel>> some_receivers(int count) {
    test::float_dice dice(90);
    std::vector<receiver<Texel>> made;
    for (int i = 0; i < count; ++i)
        made.push_back({dice.one_in(4) ? dice.any() : dice.unit(), dice.one_in(4) ? Texel::clear() : test::any_caster<Texel>(dice),
                        untouched});
    return made;
}

static_assert(texel_row<std::vector<rg8>> && texel_row<std::array<const rg8, 2>> && texel_row<strided_span<const rgba16f>>);
static_assert(!texel_row<std::vector<float>> && !texel_row<std::vector<unorm8>>);

template <typename... Images>
concept can_receive = requires(Images... images) { receive(images...); };
static_assert(can_receive<image_view<const rg8>, image_view<const float>, image_view<float>>);
static_assert(!can_receive<image_view<const rg8>, image_view<const double>, image_view<float>>, "a depth is float or 16 bits");
static_assert(!can_receive<image_view<const float>, image_view<const float>, image_view<float>>, "a map is of texels");

} // namespace

TEST_CASE_TEMPLATE("a row of receivers equals each receiver alone and the shortest span counts", Texel, rg8, rg16f, rgba16, rgba32f,
                   tm8, test::paper8) {
    sweep wrong;
    for (const int texels : {0, 1, 5, 64})
        for (const int depths : {0, 1, 7, 64})
            for (const int results : {0, 1, 6, 64}) {
                auto row = some_receivers<Texel>(64);
                constexpr auto stride = static_cast<std::ptrdiff_t>(sizeof(receiver<Texel>));
                receive(strided_span<const Texel>(&row[0].texel, texels, stride),
                        strided_span<const float>(&row[0].z, depths, stride),
                        strided_span<float>(&row[0].intensity, results, stride), decision);
                const int count = lesser(texels, lesser(depths, results));
                for (int i = 0; i < 64; ++i) {
                    const auto& r = row[static_cast<std::size_t>(i)];
                    wrong.unless(test::same_bits(r.intensity, i < count ? shadow(r.texel, r.z, decision) : untouched), "spans",
                                 texels, depths, results, "at", i);
                }
            }
    CHECK(wrong.report() == "");
}

TEST_CASE("a row may be a vector or an array or a std::span and its rule is the default one if none is given") {
    const auto row = some_receivers<rg16>(5);
    std::vector<rg16> texels;
    std::array<float, 5> z{};
    for (std::size_t i = 0; i < 5; ++i) {
        texels.push_back(row[i].texel);
        z[i] = row[i].z;
    }
    std::vector<float> from_vector(5), from_span(5);
    receive(texels, z, from_vector);
    receive(std::span(texels).subspan(1), z, from_span);
    for (std::size_t i = 0; i < 5; ++i) CHECK(test::same_bits(from_vector[i], shadow(texels[i], z[i], rule{})));
    for (std::size_t i = 0; i < 4; ++i) CHECK(test::same_bits(from_span[i], shadow(texels[i + 1], z[i])));
}

TEST_CASE("a column may be received backwards") {
    test::dice dice(91);
    const image<rg8> map = test::noise<rg8>(dice, {5, 9}, 2);
    const std::vector<float> z(9, 0.875f);
    std::vector<float> intensity(9);
    receive(strided_span<const rg8>(&map(3, 8), 9, -map.view().stride()), z, intensity);
    for (int y = 0; y < 9; ++y) CHECK(test::same_bits(intensity[static_cast<std::size_t>(y)], shadow(map(3, 8 - y), 0.875f)));
}

TEST_CASE_TEMPLATE("of three images the texels that all have are received", Texel, rg8, rgb16, test::paper32f) {
    test::dice dice(92);
    const image<Texel> map = test::noise<Texel>(dice, {10, 10}, 2);
    image<float> z(map.size());
    test::for_each_texel(whole(z.size()), [&](int x, int y) { z(x, y) = dice.unit(); });
    sweep wrong;
    const extent sizes[]{{7, 6}, {9, 5}, {8, 4}}; // as three parts of larger images, in three orders
    for (int first = 0; first < 3; ++first) {
        image<float> intensity(map.size(), untouched);
        const auto part = [&](int i) { return whole(sizes[(first + i) % 3]); };
        receive(map.view().part(part(0)), image_view<const float>(z.view()).part(part(1)), intensity.view().part(part(2)),
                decision);
        test::for_each_texel(whole(map.size()), [&](int x, int y) {
            const bool in_all = x < 7 && y < 4;
            wrong.unless(test::same_bits(intensity(x, y), in_all ? shadow(map(x, y), z(x, y), decision) : untouched), "order",
                         first, "x", x, "y", y);
        });
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("receivers anywhere equal a sample and a decision and off the map they are lit", Texel, rg8, rgba16f, tm16,
                   test::paper8) {
    test::float_dice dice(93);
    const image<Texel> map = test::noise<Texel>(dice, {7, 6}, 2);
    std::vector<float> x, y, z;
    for (int i = 0; i < 2'000; ++i) {
        x.push_back(i % 9 == 0 ? dice.any() : dice.unit() * 12.0f - 2.0f);
        y.push_back(i % 7 == 0 ? dice.any() : dice.unit() * 11.0f - 2.0f);
        z.push_back(dice.unit());
    }
    sweep wrong;
    for (int shortest = 0; shortest < 4; ++shortest) {
        std::vector<float> intensity(x.size(), untouched);
        const auto first = [shortest](auto& all, int index) { return strided_span(all.data(), index == shortest ? 1'900 : 2'000); };
        receive(map.view(), first(x, 0), first(y, 1), first(z, 2), first(intensity, 3), decision);
        for (std::size_t i = 0; i < x.size(); ++i) {
            const bool off = !(x[i] >= -0.5f && x[i] <= 7.5f && y[i] >= -0.5f && y[i] <= 6.5f);
            const float expected = i >= 1'900 ? untouched : (off ? 0.0f : shadow(sample(map.view(), x[i], y[i]), z[i], decision));
            wrong.unless(test::same_bits(intensity[i], expected), "x", x[i], "y", y[i], "z", z[i], "shortest", shortest);
        }
    }
    CHECK(wrong.report() == "");
}
