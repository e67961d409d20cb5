#include "../support/filtering.hpp"
#include "../support/formats.hpp"
#include "../support/glsl.hpp"
#include "../support/images.hpp"

#include <gnomon/gl/shader_filter.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>

#include "../support/glsl_begin.inl"
namespace {
using namespace test::glsl;
namespace rg8_binomial {
namespace columns {
#include "golden/columns_rg8_binomial_2.glsl"
}
namespace rows {
#include "golden/rows_rg8_binomial_2.glsl"
}
} // namespace rg8_binomial
namespace rg16_gaussian {
namespace columns {
#include "golden/columns_rg16_gaussian_2.glsl"
}
namespace rows {
#include "golden/rows_rg16_gaussian_2.glsl"
}
} // namespace rg16_gaussian
namespace rg16_box {
namespace columns {
#include "golden/columns_rg16_box_130.glsl"
}
namespace rows {
#include "golden/rows_rg16_box_130.glsl"
}
} // namespace rg16_box
namespace rg16_fast {
namespace columns {
#include "golden/columns_rg16_fast_gaussian_2.glsl"
}
namespace rows {
#include "golden/rows_rg16_fast_gaussian_2.glsl"
}
} // namespace rg16_fast
namespace rg16f_tent {
namespace columns {
#include "golden/columns_rg16f_tent_2.glsl"
}
namespace rows {
#include "golden/rows_rg16f_tent_2.glsl"
}
} // namespace rg16f_tent
namespace rgba32f_gaussian {
namespace columns {
#include "golden/columns_rgba32f_gaussian_2.glsl"
}
namespace rows {
#include "golden/rows_rgba32f_gaussian_2.glsl"
}
} // namespace rgba32f_gaussian
namespace rg32f_box {
namespace columns {
#include "golden/columns_rg32f_box_20.glsl"
}
namespace rows {
#include "golden/rows_rg32f_box_20.glsl"
}
} // namespace rg32f_box
namespace tm8_tent {
namespace columns {
#include "golden/columns_tm8_tent_1.glsl"
}
namespace rows {
#include "golden/rows_tm8_tent_1.glsl"
}
} // namespace tm8_tent
namespace tmba8_gaussian {
namespace columns {
#include "golden/columns_tmba8_gaussian_2.glsl"
}
namespace rows {
#include "golden/rows_tmba8_gaussian_2.glsl"
}
} // namespace tmba8_gaussian
namespace rgba8_narrow {
namespace columns {
#include "golden/columns_rgba8_narrow_box_1.glsl"
}
namespace rows {
#include "golden/rows_rgba8_narrow_box_1.glsl"
}
} // namespace rgba8_narrow
namespace rg16f_narrow {
namespace columns {
#include "golden/columns_rg16f_narrow_tent_2.glsl"
}
namespace rows {
#include "golden/rows_rg16f_narrow_tent_2.glsl"
}
} // namespace rg16f_narrow
} // namespace
#include "../support/glsl_end.inl"

namespace {

using namespace gnomon;
namespace glsl = test::glsl;

/// A stage of a shader: its main, its sampler, its output, and the sums that a fragment begins with.
/// The scratch between the two holds `Number`s: unsigned integers, or what the map's texture does.
template <typename Number> struct columns_stage {
    void (*main)();
    glsl::sampler2D* texels;
    void (*begin)();
    glsl::vec<Number, 4> (*sums)();
};
template <typename Number> struct rows_stage {
    void (*main)();
    glsl::sampler<Number>* sums;
    void (*begin)();
    glsl::vec4 (*texel)();
};

template <typename T, int N> glsl::vec<T, 4> widened(const glsl::vec<T, N>& v) {
    glsl::vec<T, 4> made;
    for (int i = 0; i < N; ++i) made[i] = v[i];
    return made;
}

/// What a texture of the map's format keeps of a number. A driver may round or cut what it stores as a half: nothing is left to either.
template <gnomon::channel Channel> typename Channel::storage kept(float v) {
    if constexpr (!std::is_same_v<Channel, half16>) return Channel::encode(static_cast<double>(v));
    const auto stored = half_from(static_cast<double>(v));
    CHECK(test::glsl::real(half_to_float(stored)) == test::glsl::real(v));
    return static_cast<typename Channel::storage>(stored);
}

/// An image as GL reads it: channels in [0, 1] as floats.
template <texel_format Texel> glsl::sampler2D texture(const image<Texel>& from) {
    return {glsl::ivec2(from.size().width, from.size().height), [&from](glsl::ivec2 at) {
                glsl::vec4 read;
                for (int c = 0; c < Texel::channels; ++c) read[c] = Texel::channel_type::decode(from(at.x, at.y).stored[c]);
                return read;
            }};
}

/// Both passes over a whole image. Texels are stored as GL stores them; the scratch must hold what the first pass writes.
template <texel_format Texel, kernel Kernel, typename Number>
image<Texel> filtered_by(const columns_stage<Number>& columns, const rows_stage<Number>& rows, const image<Texel>& from) {
    using channel_type = typename Texel::channel_type;
    const auto size = from.size();
    std::vector<glsl::vec<Number, 4>> sums(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
    const auto at = [&](int x, int y) -> glsl::vec<Number, 4>& { return sums[static_cast<std::size_t>(y * size.width + x)]; };
    *columns.texels = texture(from);
    *rows.sums = {glsl::ivec2(size.width, size.height), [&](glsl::ivec2 p) { return at(p.x, p.y); }};
    const auto place = [](int x, int y) {
        glsl::gl_FragCoord = glsl::vec4(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 0.0f, 1.0f);
    };
    bool fits = true;
    test::for_each_texel(whole(size), [&](int x, int y) {
        place(x, y);
        columns.begin();
        columns.main();
        at(x, y) = columns.sums();
        for (int c = 0; c < Texel::channels; ++c)
            if constexpr (std::is_same_v<Number, glsl::uint>)
                fits = fits && at(x, y)[c] <= gl::filter_scratch_largest<Texel, Kernel>;
            else
                at(x, y)[c] = channel_type::decode(kept<channel_type>(at(x, y)[c].value));
    });
    CHECK(fits);
    image<Texel> to(size);
    test::for_each_texel(whole(size), [&](int x, int y) {
        place(x, y);
        rows.begin();
        rows.main();
        for (int c = 0; c < Texel::channels; ++c) to(x, y).stored[c] = kept<channel_type>(rows.texel()[c].value);
    });
    return to;
}

template <texel_format Texel, kernel Kernel, typename Number>
void compare(const columns_stage<Number>& columns, const rows_stage<Number>& rows) {
    test::dice roll(553);
    for (const extent size : {extent{1, 1}, extent{3, 2}, extent{23, 17}, extent{300, 5}, extent{4, 290}, extent{262, 262}})
        for (const int sparseness : {1, 3, 40}) {
            if (size.height == 262 && (Kernel::radius < 100 || sparseness > 1)) continue; // to fill the widest kernel

            image<Texel> from = test::noise<Texel>(roll, size, sparseness);
            if (sparseness == 1) // a full map is where sums are largest
                test::for_each_texel(whole(size), [&](int x, int y) { from(x, y) = Texel::caster(0.0f); });
            const int off = glsl::fetched_off_the_map;
            const auto made = filtered_by<Texel, Kernel>(columns, rows, from);
            CHECK(test::differences(made, test::dense<gl::kernel_in_gl<Texel, Kernel>>(from)) == 0);
            CHECK(glsl::fetched_off_the_map == off);
        }
}

} // namespace

// A text's stages; lambdas without captures, for a namespace is no argument.
#define STAGES(number, space, reset)                                                                                               \
    columns_stage<number>{space::columns::main, &space::columns::gnomon_texels, [] { space::columns::gnomon_sum = {}; },           \
                          [] { return widened(space::columns::gnomon_sums); }},                                                    \
        rows_stage<number> {                                                                                                       \
        space::rows::main, &space::rows::gnomon_sums, [] { reset; }, [] { return widened(space::rows::gnomon_texel); }             \
    }
#define ONE_WORD(space) STAGES(glsl::uint, space, space::rows::gnomon_sum = {})
#define NARROW(space) STAGES(glsl::real, space, space::rows::gnomon_sum = {})
#define TWO_WORDS(space) STAGES(glsl::uint, space, space::rows::gnomon_low = {}; space::rows::gnomon_high = {})

TEST_CASE("a map of bytes is filtered in GLSL as by the scalar filter") { compare<rg8, binomial<2>>(ONE_WORD(rg8_binomial)); }
TEST_CASE("sums of two words in GLSL, divided by a power of two, are those of the scalar filter") {
    compare<rg16, gaussian<2>>(TWO_WORDS(rg16_gaussian));
}
TEST_CASE("sums of two words in GLSL, divided by anything, are those of the scalar filter") {
    compare<rg16, box<130>>(TWO_WORDS(rg16_box));
}
TEST_CASE("a fast filter of 16 bits rounds between the passes in GLSL as on the CPU") {
    compare<rg16, fast<gaussian<2>>>(ONE_WORD(rg16_fast));
}
TEST_CASE("halves are filtered in GLSL as by the fast filter, and leave nothing for a driver to round") {
    compare<rg16f, tent<2>>(ONE_WORD(rg16f_tent));
}
TEST_CASE("floats are filtered in GLSL as by the fast filter") { compare<rgba32f, gaussian<2>>(ONE_WORD(rgba32f_gaussian)); }
TEST_CASE("a wide box of floats has no table in GLSL, and the weights of the fast filter") {
    static_assert(gl::detail::filter_in_gl<rg32f, box<20>>::alike == 8); // 2^24 is 16 more than a multiple of 41
    static_assert(gl::detail::filter_in_gl<rg32f, tent<20>>::alike == -1);
    static_assert(gl::detail::filter_in_gl<rg8, box<20>>::alike == 20 && gl::detail::filter_in_gl<rg8, gaussian<20>>::alike == -1);
    compare<rg32f, box<20>>(ONE_WORD(rg32f_box));
}
TEST_CASE("a ratio of depth and mask is filtered in GLSL as by the scalar filter") { compare<tm8, tent<1>>(ONE_WORD(tm8_tent)); }
TEST_CASE("a ratio of sums of two words is that of the scalar filter, bound and contribution with it") {
    compare<test::ratio_rgba8, gaussian<2>>(TWO_WORDS(tmba8_gaussian));
}
TEST_CASE("a narrow filter rounds to the map's own format between the passes, in GLSL as on the CPU") {
    static_assert(gl::filter_scratch_largest<rgba8, narrow<box<1>>> == 0);
    compare<rgba8, narrow<box<1>>>(NARROW(rgba8_narrow));
    compare<rg16f, narrow<tent<2>>>(NARROW(rg16f_narrow));
}

namespace {
template <int Total> struct three_taps {
    static constexpr int radius = 1, total = Total;
    static constexpr std::array weights{1, Total - 2, 1};
};
} // namespace

TEST_CASE("a sum takes two words from where one might not hold it and the half that rounds it") {
    const auto words = [](const std::string& text) { return text.find("as two words") != std::string::npos ? 2 : 1; };
    static_assert((255ull * 4100 * 4100 + 4100 * 4100 / 2) >> 32 == 0 && (255ull * 4101 * 4101 + 4101 * 4101 / 2) >> 32 == 1);
    CHECK(words(gl::filter_rows_text<rg8, three_taps<4100>>()) == 1);
    CHECK(words(gl::filter_rows_text<rg8, three_taps<4101>>()) == 2);
}

// So the scratch has as many bits as the sums between the passes need.
static_assert(gl::filter_scratch_largest<rg16, fast<gaussian<4>>> == 65535);
static_assert(gl::filter_scratch_largest<rg8, three_taps<257>> == 65535 &&
              gl::filter_scratch_largest<rg8, three_taps<258>> > 65535);
