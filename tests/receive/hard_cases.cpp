// The hard cases of a decision by their names in shared/design/numerics.md, section 6. Each holds in every format and under every rule
// unless it says which.
#include <gnomon/receive/decide.hpp>

#include "../support/bits.hpp"
#include "../support/exact.hpp"
#include "../support/float_dice.hpp"
#include "../support/flush.hpp"
#include "../support/formats.hpp"
#include "../support/sweep.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <array>

using namespace gnomon;
using test::sweep;

#define EVERY_PLAIN_TEXEL rg8, rg16, rg16f, rg32f, test::paper8, test::paper16, test::paper16f, test::paper32f

namespace {

template <typename Texel>
const std::array<rule, 3> every_rule{rule{.caster = towards_light}, rule{.caster = unbiased}, rule{.caster = towards_shadow}};

// What g++ 12 may see whole, and from -O2 on then drops the rounding to float of the pair (numerics, section 8).
filtered<rg32f> stored_and_read(double e, double m) { return read(rg32f{{float32::store(e), float32::store(m)}}); }
float blended_and_decided(double e, double m, float z) { return shadow(filtered<rg32f>{{e, m}}, z, {.caster = unbiased}); }

double rounded_to_float(double v) {
    const volatile float rounded = static_cast<float>(v);
    return static_cast<double>(rounded);
}

template <typename Texel> bool lit(const Texel& texel, float z, const rule& r) {
    return test::same_bits(shadow(texel, z, r), 0.0f);
}
template <typename Texel> bool in_full_shadow(const Texel& texel, float z, const rule& r) {
    return test::same_bits(shadow(texel, z, r), 1.0f);
}

} // namespace

TEST_CASE_TEMPLATE("h01_clear_texel_is_lit: at every depth and no NaN escapes", Texel, EVERY_PLAIN_TEXEL) {
    for (const rule& r : every_rule<Texel>)
        for (const float z : test::hostile_floats) CHECK(lit(Texel::clear(), z, r));
}

TEST_CASE_TEMPLATE("h02_empty_mask_with_depth_is_lit: numbers no filter makes but a texture unit might", Texel, EVERY_PLAIN_TEXEL,
                   rga8, rgba16f, test::paper_rgba32f) {
    for (const double others : {0.0, 1.0 / 255, 0.5, 1.0}) {
        Texel texel{};
        for (auto& stored : texel.stored) stored = Texel::channel_type::encode(others);
        texel.stored[Texel::mask_index] = Texel::channel_type::encode(0.0);
        for (const rule& r : every_rule<Texel>)
            for (const float z : test::hostile_floats) CHECK(lit(texel, z, r));
    }
}

TEST_CASE_TEMPLATE("h07_casters_at_near_and_far_plane: the first shadows every receiver and the second only beyond the far plane",
                   Texel, EVERY_PLAIN_TEXEL) {
    constexpr rule exactly{.caster = unbiased};
    const auto sure_behind = [](double s) { return static_cast<float>(test::end_of_doubt<Texel>(s, 1.0)) + 0x1p-21f; };
    for (const float z : {test::smallest<float>, 0x1p-20f, 0.5f, 1.0f, 2.0f})
        CHECK(in_full_shadow(Texel::caster(0.0f), z, rule{.caster = towards_shadow}));
    for (const float z : {0x1p-20f, 0.5f, 1.0f, 2.0f}) CHECK(in_full_shadow(Texel::caster(0.0f), z, exactly));
    for (const float z : {sure_behind(0.0), 0.5f, 1.0f}) CHECK(in_full_shadow(Texel::caster(0.0f), z, rule{}));

    for (const float z : {0.0f, 0.5f, test::down(1.0f), 1.0f}) {
        CHECK(lit(Texel::caster(1.0f), z, rule{}));
        CHECK(lit(Texel::caster(1.0f), z, exactly));
    }
    CHECK(in_full_shadow(Texel::caster(1.0f), test::up(1.0f), exactly));
    CHECK(in_full_shadow(Texel::caster(1.0f), sure_behind(1.0), rule{}));
}

TEST_CASE_TEMPLATE(
    "h08_receiver_out_of_range: before the near plane and at NaN it is lit and beyond the far plane it is behind every caster",
    Texel, EVERY_PLAIN_TEXEL) {
    for (const float s : {0.0f, 0.25f, 0.5f, 1.0f})
        for (const rule& r : every_rule<Texel>) {
            for (const float z : {0.0f, -0.0f, -test::smallest<float>, -1.0f, -test::infinity<float>, test::nan<float>})
                CHECK(lit(Texel::caster(s), z, r));
            for (const float z : {1.125f, 2.0f, 0x1p127f, test::infinity<float>}) CHECK(in_full_shadow(Texel::caster(s), z, r));
            for (const float z : {1.125f, test::infinity<float>}) {
                rule forgiving = r;
                forgiving.lit_beyond = true;
                CHECK(lit(Texel::caster(s), z, forgiving));
            }
        }
}

TEST_CASE_TEMPLATE("h09_receiver_on_caster_is_lit: under the default rule at every share of the footprint", Texel,
                   EVERY_PLAIN_TEXEL) {
    sweep wrong;
    for (const float s : test::trying_depths<typename Texel::channel_type>(4096)) // both sides of many codes
        for (int covered = 1; covered <= 25; ++covered)
            wrong.unless(lit(test::filtered(Texel::caster(s), covered, 25), s, rule{}), "s", s, "covered", covered, "of 25");
    CHECK(wrong.report() == "");
}

TEST_CASE("h09_receiver_on_caster_is_lit: and without a bias about half of them are not which is why there is one") {
    int shadowed = 0, cases = 0;
    for (int code = 0; code < 256; ++code)
        for (int covered = 1; covered <= 289; ++covered) {
            const float s = unorm8::decode(static_cast<std::uint8_t>(255 - code));
            const rg8 texel = test::filtered(rg8::caster(s), covered, 289);
            shadowed += lit(texel, s, {.caster = unbiased}) ? 0 : 1;
            ++cases;
        }
    CHECK(shadowed > cases * 45 / 100);
    CHECK(shadowed < cases * 55 / 100);
}

TEST_CASE_TEMPLATE("h10_denormals_and_ftz_same_picture: flushing changes no intensity above 1e-37", Texel, EVERY_PLAIN_TEXEL) {
    using channel_type = typename Texel::channel_type;
    float (*const volatile decide)(const Texel&, float, const rule&) =
        &shadow<Texel>; // volatile: so that no arithmetic leaves its mode
    test::float_dice dice(10);
    sweep wrong;
    for (int i = 0; i < 100'000; ++i) {
        const auto m = channel_type::encode(static_cast<double>(dice.any_unit())),
                   e = channel_type::encode(static_cast<double>(dice.any_unit()));
        const Texel texel{{lesser(e, m), m}};
        const float z = dice.unit();
        for (const rule& r : every_rule<Texel>) {
            const float plain = decide(texel, z, r);
            float flushed = 0.0f;
            {
                const test::flush_subnormals mode(true);
                flushed = decide(texel, z, r);
            }
            wrong.unless(test::same_bits(plain, flushed) || (plain < 1e-37f && flushed < 1e-37f), "e", texel.stored[0], "m",
                         texel.stored[1], "z", z, plain, flushed);
        }
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("h19_degenerate_matrix_and_w: what comes out of it is lit at NaN and -inf and behind everything at +inf", Texel,
                   EVERY_PLAIN_TEXEL) {
    // The matrix path refuses w <= 0 before a depth exists; whatever still comes through has these answers.
    for (const float s : {0.0f, 0.5f, 1.0f})
        for (const rule& r : every_rule<Texel>) {
            CHECK(lit(Texel::caster(s), test::nan<float>, r));
            CHECK(lit(Texel::caster(s), -test::infinity<float>, r));
            CHECK(in_full_shadow(Texel::caster(s), test::infinity<float>, r));
        }
}

TEST_CASE("h28_compiler_canaries: a pair of floats that is stored and read in one expression is rounded in between") {
    filtered<rg32f> (*const volatile store_and_read)(double, double) = &stored_and_read;
    test::float_dice dice(28);
    sweep wrong;
    for (int i = 0; i < 1'000; ++i) {
        const double m = dice.binade(0.5), e = m * static_cast<double>(dice.unit());
        const filtered<rg32f> f = store_and_read(e, m);
        wrong.unless(test::equal(f.depth(), rounded_to_float(e)) && test::equal(f.mask(), rounded_to_float(m)), "e", e, "m", m);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("h28_compiler_canaries: a blend of floats is rounded to float before it is decided so that every ISA can agree") {
    float (*const volatile decide)(double, double, float) = &blended_and_decided;
    test::float_dice dice(29);
    sweep wrong;
    for (int i = 0; i < 100'000; ++i) {
        const double m = dice.binade(0.5), e = m * static_cast<double>(dice.unit());
        const double depth = rounded_to_float(e), mask = rounded_to_float(m);
        const float at = static_cast<float>(1.0 - depth / mask);
        for (const float z : {test::down(at), at, test::up(at)})
            wrong.unless((decide(e, m, z) > 0.0f) == (z > 0.0f && test::exactly_behind(depth, mask, static_cast<double>(z))), "e",
                         e, "m", m, "z", z);
    }
    CHECK(wrong.report() == "");
}
