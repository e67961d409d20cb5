// Texels to GL and back, on a GL of one texture, which lies in the host's memory.
#include "../support/fake_gl.hpp"
#include "../support/formats.hpp"
#include "../support/images.hpp"

#include <gnomon/gl/transfer.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace {
namespace gl = gnomon::gl;
using gnomon::extent;
using gnomon::image;
using gnomon::texel_rect;

/// What is read and written is `held`; which parts, in order, is `asked`.
template <typename Texel> struct texture {
    using storage = typename Texel::storage;
    using element = gl::detail::read_element<Texel>;
    static constexpr int components = gl::format_of<Texel>.upload == gl::enums::rg ? 2 : 4;
    static constexpr std::size_t megabyte = 1 << 20;

    static inline image<Texel> held = {};
    static inline std::vector<texel_rect> asked = {};

    explicit texture(extent size) : fake("3.3"), context(*gl::context::of(fake.table)) {
        held = image<Texel>(size, Texel::clear());
        asked.clear();
        fake.table.ReadPixels = [](int x, int y, int width, int height, unsigned format, unsigned type, void* to) {
            CHECK(format == gl::enums::rgba);
            CHECK(type == gl::format_of<Texel>.read_type);
            asked.push_back({x, y, x + width, y + height});
            auto* next = static_cast<element*>(to);
            test::for_each_texel(asked.back(), [&](int column, int row) {
                for (int i = 0; i < 4; ++i, ++next) {
                    if (i >= Texel::channels)
                        *next = element(1);
                    else if constexpr (std::is_same_v<element, storage>)
                        *next = held(column, row).stored[i];
                    else
                        *next = Texel::channel_type::code(held(column, row).stored[i]);
                }
            });
        };
        fake.table.TexSubImage2D = [](unsigned, int level, int x, int y, int width, int height, unsigned format, unsigned type,
                                      const void* from) {
            CHECK(level == 0);
            CHECK(format == gl::format_of<Texel>.upload);
            CHECK(type == gl::format_of<Texel>.upload_type);
            asked.push_back({x, y, x + width, y + height});
            const auto* next = static_cast<const storage*>(from);
            test::for_each_texel(asked.back(), [&](int column, int row) {
                std::copy_n(next, Texel::channels, held(column, row).stored);
                next += components;
            });
        };
    }
    /// Was all of `part` asked for in as few pieces as a megabyte allows, row after row?
    static void check_asked(texel_rect part, std::size_t bytes_per_texel) {
        int y = part.y0;
        for (const texel_rect& each : asked) {
            CHECK(each == texel_rect{part.x0, y, part.x1, each.y1});
            y = each.y1;
        }
        CHECK(y == part.y1);
        const std::size_t row = static_cast<std::size_t>(held.size().width) * bytes_per_texel;
        const std::size_t rows = std::max<std::size_t>(1, megabyte / row);
        CHECK(asked.size() == (static_cast<std::size_t>(part.height()) + rows - 1) / rows);
    }

    test::fake_gl fake;
    gl::context context;
};
} // namespace

TEST_CASE_TEMPLATE("texels of any size of image are read and written bit for bit, a megabyte at once", Texel, gnomon::rg8,
                   gnomon::rgb16, gnomon::rg16f, gnomon::rgba16f, gnomon::rg32f, gnomon::rgba32f) {
    test::dice roll(761);
    for (const extent size : {extent{600, 450}, {3, 2}, {90000, 2}}) {
        CAPTURE(size.width);
        texture<Texel> there(size);
        const image<Texel> from = test::noise<Texel>(roll, size, 1);
        gl::write_texels<Texel>(there.context, from.view());
        CHECK(test::differences(there.held, from) == 0);
        there.check_asked(whole(size), sizeof(typename Texel::storage) * static_cast<std::size_t>(there.components));

        there.asked.clear();
        image<Texel> to(size, Texel::caster(0.25f)), expected = to;
        const texel_rect part{1, 1, size.width - 1, size.height};
        test::for_each_texel(part, [&](int x, int y) { expected(x, y) = from(x, y); });
        gl::texel_reader<Texel> reader(size);
        reader.read(there.context, 0, to.view(), part);
        CHECK(test::differences(to, expected) == 0);
        there.check_asked(part, 4 * sizeof(typename texture<Texel>::element));
    }
}

TEST_CASE("an image of no texels is neither read nor written") {
    texture<gnomon::rg8> there({8, 8});
    for (const extent size : {extent{0, 0}, {0, 5}, {5, 0}, {-3, 5}}) {
        image<gnomon::rg8> none(size);
        gl::texel_reader<gnomon::rg8> reader(size);
        reader.read(there.context, 0, none.view(), gnomon::whole({8, 8}));
        gl::write_texels<gnomon::rg8>(there.context, none.view());
    }
    CHECK(there.asked.empty());
}
