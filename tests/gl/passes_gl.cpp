// The passes against `scalar`, bit for bit, on the GL under test: casters, far bounds, column sums, the filter.
#include "../support/bits.hpp"
#include "../support/filtering.hpp"
#include "../support/formats.hpp"
#include "../support/gl_map.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <string>
#include <vector>

namespace {
namespace gl = gnomon::gl;
using gnomon::binomial;
using gnomon::box;
using gnomon::extent;
using gnomon::gaussian;
using gnomon::image;
using gnomon::tent;
using gnomon::texel_rect;
using test::dice;

/// Says in the table what was compared, and checks that nothing differs.
template <typename Texel> void compare(const char* pass, const image<Texel>& made, const image<Texel>& expected) {
    const int differing = test::differences(made, expected);
    test::gl_report(test::format_name<Texel>(), pass, 1ll * made.size().width * made.size().height, differing);
    CAPTURE(std::string(pass));
    CHECK(differing == 0);
}

/// Surfaces at depths that are easy to get wrong, too, and beyond the planes.
gl::surface any_surface(dice& roll, extent size) {
    constexpr float odd[] = {0.0f, 1.0f, 0.5f, -1.0f, 2.0f, 0x1p-24f, 1.0f - 0x1p-24f, test::nan<float>, test::infinity<float>};
    const auto depth = [&] { return roll.one_in(4) ? odd[roll(0, 8)] : roll.unit(); };
    return {.where = clip(roll.rect(size, 5), size), .depth = depth(), .opacity = static_cast<float>(roll(-2, 18)) / 16.0f};
}

template <typename Texel>
concept bounded = requires(gl::passes<Texel, box<1>> p, const gl::context& c, const gl::map_targets& map) { p.bound(c, map, 0); };
static_assert(bounded<gnomon::rgb8> && !bounded<gnomon::rg8>);
} // namespace

TEST_CASE_TEMPLATE("casters and far bounds on GL are the texels that scalar casts and bounds", Texel, gnomon::rg8, gnomon::rg16,
                   gnomon::rg16f, gnomon::rg32f, gnomon::rgb8, gnomon::rgb16, gnomon::rgb16f, gnomon::rgb32f, gnomon::rgba8,
                   gnomon::rgba16, gnomon::rgba16f, gnomon::rgba32f, gnomon::tm8, test::ratio_rgba8) {
    test::in_every_gl_context([](const gl::context& c) {
        if (const auto why = gl::supports<Texel>(c)) return test::skip(why.sentence);
        constexpr extent size{61, 47};
        dice roll(701);
        test::gl_map<Texel, box<0>> map(c, size);
        image<Texel> expected(size, Texel::clear());
        std::vector<gl::surface> surfaces, bounds;
        for (int i = 0; i < 300; ++i) { // more than one batch
            const gl::surface s = any_surface(roll, size);
            surfaces.push_back(s);
            test::for_each_texel(s.where, [&](int x, int y) {
                if constexpr (Texel::effects.translucency)
                    expected(x, y).cast(Texel::caster(s.depth, s.opacity));
                else
                    expected(x, y).cast(Texel::caster(s.depth));
            });
        }
        const auto walk_over = [](const auto& list) {
            return [&list](auto&& f) {
                for (const auto& each : list) f(each);
            };
        };
        const gl::state_guard<> forced(c);
        map.passes().cast(c, map.targets(), walk_over(surfaces));
        compare("casters", map.casters(), expected);
        if constexpr (Texel::effects.far_bound) {
            for (int i = 0; i < 20; ++i) {
                const gl::surface s = any_surface(roll, size);
                bounds.push_back(s);
                test::for_each_texel(s.where, [&](int x, int y) { expected(x, y).bound(s.depth); });
            }
            const gl::state_guard<> again(c);
            map.passes().bound(c, map.targets(), walk_over(bounds));
            compare("far bound", map.casters(), expected);
        }
    });
}
