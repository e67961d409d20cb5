// Every wrong call that a debug build hears of, beside the call next to it that is right. A program of its own, since the
// assertion chosen here, before the first include as a host would, is compiled into the library's inline functions.
namespace {
int failed = 0;
const char* sentence_of_the_failed = "";
} // namespace
#define GNOMON_ASSERT(condition, sentence) ((condition) ? void() : (++failed, sentence_of_the_failed = (sentence), void()))
#include <gnomon/backend/backend.hpp>
#include <gnomon/backend/executor.hpp>
#include <gnomon/backend/scalar.hpp>
#include <gnomon/backend/simd.hpp>
#include <gnomon/filter/pyramid.hpp>
#include <gnomon/filter/separable.hpp>
#include <gnomon/gl/object.hpp>
#include <gnomon/gl/problem.hpp>
#include <gnomon/gl/state.hpp>
#include <gnomon/grid/reference_grid.hpp>
#include <gnomon/grid/regions.hpp>
#include <gnomon/grid/tile_grid.hpp>
#include <gnomon/texel/image.hpp>

#include "../support/fake_gl.hpp"
#include "../support/images.hpp"
#include "../support/lanes.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace {
using namespace gnomon;
using blur = box<1>;

/// The one sentence since it was asked last, or nothing.
std::string complaint() {
    const std::string said = failed == 0 ? "" : failed == 1 ? sentence_of_the_failed : "more than one";
    failed = 0;
    return said;
}
} // namespace

TEST_CASE("a strided_span whose elements are askew is a wrong call") {
    int memory[6]{};
    (void)strided_span<int>(memory, 3, 8);
    (void)strided_span<int>(memory + 5, 3, -8);
    (void)strided_span<int>(memory, 3, 0);
    (void)strided_span<char>(reinterpret_cast<char*>(memory), 3, 5);
    CHECK(complaint() == "");
    constexpr const char* askew = "gnomon: the elements of a strided_span must be aligned, and stay so: its stride is in bytes";
    (void)strided_span<int>(memory, 3, 6);
    CHECK(complaint() == askew);
    (void)strided_span<int>(reinterpret_cast<int*>(reinterpret_cast<std::uintptr_t>(memory) + 1), 3);
    CHECK(complaint() == askew);
}

TEST_CASE("an image_view without memory, with rows askew or with rows that overlap is a wrong call") {
    int memory[6]{};
    CHECK(image_view<int>(memory, {3, 2}).size() == extent{3, 2});
    CHECK(image_view<int>(nullptr, {0, 2}).size().empty());
    (void)image_view<int>(memory, {1, 2}, -8);
    CHECK(complaint() == "");
    CHECK(image_view<int>(nullptr, {3, 2}).size().empty()); // what is guarded has a written result all the same
    CHECK(complaint() == "gnomon: an image_view that is not empty needs memory");
    CHECK(image_view<int>(memory, {1, 2}, 9).stride() == 9);
    CHECK(complaint() == "gnomon: the rows of an image_view must be aligned for its texels");
    (void)image_view<int>(reinterpret_cast<int*>(reinterpret_cast<char*>(memory) + 2), {1, 1}, 4);
    CHECK(complaint() == "gnomon: the rows of an image_view must be aligned for its texels");
    (void)image_view<int>(memory + 4, {2, 3}, -8);
    (void)image_view<int>(memory, {6, 1}, 4);
    (void)image_view<const int>(memory, {2, 3}, 4); // may be read
    CHECK(complaint() == "");
    const std::string overlap = "gnomon: the rows of an image_view that is written overlap: its stride is in bytes";
    (void)image_view<int>(memory, {2, 2}, 4);
    CHECK(complaint() == overlap);
    (void)image_view<int>(memory + 4, {2, 3}, -4);
    CHECK(complaint() == overlap);
}

TEST_CASE("a grid of tiles below one texel is a wrong call") {
    (void)tile_grid({8, 8}, 1);
    (void)reference_grid({8, 0}, 0);
    CHECK(complaint() == "");
    (void)tile_grid({8, 8}, 0);
    CHECK(complaint() == "gnomon: a tile is at least one texel wide; 16 to 64 serve most maps");
}

TEST_CASE("a greedy merge with a word too little is a wrong call") {
    const tile_grid grid({70, 3}, 1); // two words a row
    std::vector<bit_word> scratch(6);
    for_each_tile_rect_greedy(grid, scratch, [](tile_rect) {});
    CHECK(complaint() == "");
    scratch.pop_back();
    for_each_tile_rect_greedy(grid, scratch, [](tile_rect) {});
    CHECK(complaint() == "gnomon: the greedy merge needs a word of scratch for every word of the grid");
}

TEST_CASE("a filter into texels that it reads is a wrong call, and writes nothing, but into texels between them it is none") {
    image<rg8> atlas({128, 6}, rg8::caster(0.5f));
    const image<rg8> before = atlas;
    filter_scratch<rg8, blur> scratch(64);
    const auto said_of = [&](const auto& run, texel_rect from, texel_rect to) {
        run.filter_region(image_view<const rg8>(atlas.view().part(from)), atlas.view().part(to), {0, 0, 64, 4}, scratch);
        return complaint();
    };
    const std::string sentence = "gnomon: a filter reads one image and writes another: give it two that share no texel";
    CHECK(said_of(scalar{}, {0, 0, 64, 4}, {0, 1, 64, 5}) == sentence);
    CHECK(said_of(simd<>{}, {0, 0, 64, 4}, {0, 1, 64, 5}) == sentence);
    CHECK(said_of(simd<>{}, {0, 0, 64, 4}, {63, 3, 127, 6}) == sentence);
    CHECK(test::differences(atlas, before) == 0);
    CHECK(said_of(scalar{}, {0, 0, 64, 4}, {64, 1, 128, 5}) == "");
    CHECK(said_of(simd<>{}, {0, 0, 64, 4}, {64, 1, 128, 5}) == "");
    CHECK(test::differences(atlas, before) > 0);
}

TEST_CASE("a filter into its own image or with a scratch of no room is a wrong call unless there is nothing to filter") {
    image<rg8> from({8, 2}, rg8::clear()), to = from;
    filter_scratch<rg8, blur> scratch(8), narrow(1), none;
    filter_region(from.view(), to.view(), {0, 0, 8, 2}, scratch);
    filter_region(from.view(), to.view(), {0, 0, 8, 2}, narrow);
    filter_region(from.view(), from.view(), {8, 0, 9, 2}, scratch);
    filter_region(from.view(), to.view(), {8, 0, 9, 2}, none);
    CHECK(complaint() == "");
    filter_region(from.view(), from.view(), {0, 0, 8, 2}, scratch);
    CHECK(complaint() == "gnomon: a filter reads one image and writes another: give it two that share no texel");
    image<rg8> wide({64, 2}, rg8::caster(0.5f)); // as wide as a register
    const image<rg8> before = wide;
    filter_scratch<rg8, binomial<1>> unused(64);
    simd<>{}.filter_region(image_view<const rg8>(wide.view()), wide.view(), {0, 0, 64, 2}, unused);
    CHECK(complaint() == "gnomon: a filter reads one image and writes another: give it two that share no texel");
    CHECK(test::differences(before, wide) == 0);
    const std::string room = "gnomon: the filter's scratch has no room for a texel; make it for the map's width";
    filter_region(from.view(), to.view(), {0, 0, 8, 2}, none);
    CHECK(complaint() == room);
    filter_scratch<rg8, box<0>> none_for_a_copy; // which needs no column beside a texel
    filter_region(from.view(), to.view(), {0, 0, 8, 2}, none_for_a_copy);
    CHECK(complaint() == room);
    filter_scratch<rg8, binomial<1>> none_either;
    simd<>{}.filter_region(before.view(), wide.view(), {0, 0, 64, 2}, none_either);
    CHECK(complaint() == room);
    CHECK(test::differences(before, wide) == 0);
    const image<gnomon::rg32f> floats({64, 20}, gnomon::rg32f::caster(0.5f)); // whose sums would run without one
    image<gnomon::rg32f> untouched(floats.size(), gnomon::rg32f::clear());
    filter_scratch<gnomon::rg32f, box<8>> nor_here;
    simd<>{}.filter_region(floats.view(), untouched.view(), whole(floats.size()), nor_here);
    CHECK(complaint() == room);
    CHECK(test::differences(untouched, image<gnomon::rg32f>(floats.size(), gnomon::rg32f::clear())) == 0);
}

TEST_CASE("lanes that the processor has not are a wrong call, and the oracle's call then") {
    const image<rg8> from({64, 2}, rg8::caster(0.5f));
    image<rg8> to(from.size(), rg8::clear()), expected = to;
    filter_scratch<rg8, binomial<1>> scratch(64);
    filter_region(from.view(), expected.view(), {0, 0, 64, 2}, scratch);
    simd<emulated<16>>{}.filter_region(from.view(), to.view(), {0, 0, 64, 2}, scratch);
    simd<>{}.filter_region(from.view(), to.view(), {0, 0, 64, 2}, scratch);
    CHECK(complaint() == "");
    to = image<rg8>(from.size(), rg8::clear());
    simd<test::lanes_to_come>{}.filter_region(from.view(), to.view(), {0, 0, 64, 2}, scratch);
    CHECK(complaint() == "gnomon: this processor has no such lanes as are named; ask best_lanes(), or take simd<>");
    CHECK(test::differences(to, expected) == 0);
    CHECK(test::lanes_to_come::loads == 0);
}

TEST_CASE(
    "results of receivers that lie on what is read of later ones are a wrong call, in place or on earlier ones they are none") {
    struct receiver {
        rg8 texel;
        std::uint16_t depth;
        float z, intensity;
    };
    constexpr const char* overtaken =
        "gnomon: results of receivers lie on what is read of later ones: write in place, or elsewhere";
    std::vector<float> memory(16), other(16);
    std::vector<receiver> all(9);
    const std::vector<rg8> texels(7, rg8::clear());
    const image<rg8> map({4, 4}, rg8::clear());
    const auto seven = [](auto& first, std::ptrdiff_t stride) { return strided_span(&first, 7, stride); };
    const auto ahead = [&](int first) { return seven(memory[static_cast<std::size_t>(first)], 4); };
    const auto backwards = [&](int first) { return seven(memory[static_cast<std::size_t>(first)], -4); };
    const auto both = [&](const auto& row, const auto& z, const auto& to, const char* expected) {
        receive(row, z, to);
        CHECK(complaint() == expected);
        reconstruct(row, z, to);
        CHECK(complaint() == expected);
    };
    for (const int first : {0, 1, 6, 7}) both(texels, ahead(0), ahead(first), first == 1 || first == 6 ? overtaken : "");
    for (const int first : {7, 8, 9}) both(texels, ahead(8), ahead(first), first == 9 ? overtaken : "");
    for (const int first : {13, 12, 7, 6})
        both(texels, backwards(13), backwards(first), first == 12 || first == 7 ? overtaken : "");
    for (const int first : {8, 9}) both(texels, backwards(8), backwards(first), "");
    constexpr std::ptrdiff_t size = sizeof(receiver);
    for (const std::size_t first : {0u, 1u, 2u}) {
        const char* const expected = first == 0 ? "" : overtaken;
        both(seven(all[0].texel, size), seven(all[0].z, size), seven(all[first].z, size), expected);
        both(seven(all[0].texel, size), seven(all[0].z, size), seven(all[first].intensity, size), "");
        for (std::size_t byte = 0; byte < 2; ++byte) {
            both(seven(all[0].texel, size), ahead(0), seven(all[first].texel.stored[byte], size), expected);
            both(seven(all[8].texel, -size), ahead(0), seven(all[8 - first].texel.stored[byte], -size), expected);
        }
        both(seven(all[0].texel, size), seven(all[0].depth, size), seven(all[first].depth, size), expected);
    }
    for (int which = 0; which < 3; ++which)
        for (const int first : {0, 1}) {
            const auto in = [&](int k) { return strided_span<const float>(k == which ? ahead(0) : seven(other[0], 4)); };
            receive(map.view(), in(0), in(1), in(2), ahead(first));
            CHECK(complaint() == (first == 1 ? overtaken : ""));
            reconstruct(map.view(), in(0), in(1), in(2), ahead(first));
            CHECK(complaint() == (first == 1 ? overtaken : ""));
        }
    const strided_span<float> same_place(memory.data(), 7, 0); // of no stride, or of two, nothing is told
    both(texels, same_place, same_place, "");
    both(texels, ahead(0), seven(memory[2], 8), "");
}

TEST_CASE("a filter of images and tiles that differ in size is a wrong call unless the grid has none") {
    image<rg8> from({8, 2}, rg8::clear()), to = from, small({8, 1}, rg8::clear());
    filter_scratch<rg8, blur> scratch(8);
    gnomon::band_scratch<rg8, blur> bands(8);
    const tile_grid tiles({8, 2}, 4);
    const auto said_of = [&](auto& source, auto& result, const tile_grid& marks) {
        filter(scalar{}, source.view(), result.view(), marks, scratch);
        const std::string said = complaint();
        filter(scalar{}, source.view(), result.view(), marks, bands, gnomon::sequential{});
        CHECK(complaint() == said); // by an executor too
        return said;
    };
    CHECK(said_of(from, to, tiles) == "");
    CHECK(said_of(small, to, tile_grid()) == "");
    const std::string sentence = "gnomon: the tile grid and both images must have the same size: make all three from one extent";
    CHECK(said_of(small, to, tiles) == sentence);
    CHECK(said_of(from, small, tiles) == sentence);
    CHECK(said_of(from, to, tile_grid({4, 2}, 4)) == sentence);
}

TEST_CASE("a pyramid of a map or of tiles that it was not made for is a wrong call") {
    const image<rg8> map({8, 2}, rg8::clear()), small({8, 1}, rg8::clear());
    const tile_grid tiles({8, 2}, 4);
    pyramid<rg8> mips({8, 2}, 4);
    mips.build(map.view(), tiles);
    (void)sample(map.view(), mips, 1.0f, 1.0f, 1.0f);
    (void)sample(map.view(), pyramid<rg8>(), 1.0f, 1.0f, 1.0f); // no levels: the map alone
    CHECK(complaint() == "");
    const std::string built = "gnomon: a pyramid is built for one size of map and of tile: make it anew for another";
    mips.build(small.view(), tiles);
    CHECK(complaint() == built);
    mips.build(map.view(), tile_grid({8, 1}, 4));
    CHECK(complaint() == built);
    mips.build(map.view(), tile_grid({8, 2}, 8));
    CHECK(complaint() == built);
    (void)sample(small.view(), mips, 1.0f, 1.0f, 1.0f);
    CHECK(complaint() == "gnomon: a pyramid is sampled together with the map it was built from");
}

TEST_CASE("a framebuffer of more than four colours is a wrong call and draws into the first four") {
    test::fake_gl fake("3.3");
    const auto c = *gl::context::of(fake.table);
    CHECK(gl::make_framebuffer(c, {1u, 2u, 3u, 4u}));
    CHECK(complaint() == "");
    fake.calls.clear();
    fake.table.DrawBuffers = [](int count, const unsigned*) { CHECK(count == 4); };
    CHECK(gl::make_framebuffer(c, {1u, 2u, 3u, 4u, 5u}));
    CHECK(complaint() == "gnomon: a framebuffer has at most four colour attachments everywhere");
    CHECK(fake.calls["FramebufferTexture2D"] == 4);
}

TEST_CASE("a state guard of more than eight texture units or of less than none is a wrong call and keeps eight or none") {
    test::fake_gl fake("3.3");
    const auto c = *gl::context::of(fake.table);
    const auto bound_by_guard_of = [&](int units) {
        fake.calls.clear();
        {
            const gl::state_guard<gl::state_policy::restore> guard(c, units);
        }
        return fake.calls["BindSampler"]; // of each unit when it comes and when it goes
    };
    CHECK(bound_by_guard_of(0) == 0);
    CHECK(bound_by_guard_of(8) == 16);
    CHECK(complaint() == "");
    const std::string eight = "gnomon: a state guard keeps at most eight texture units";
    CHECK(bound_by_guard_of(9) == 16);
    CHECK(complaint() == eight);
    CHECK(bound_by_guard_of(-1) == 0);
    CHECK(complaint() == eight);
}

TEST_CASE("a result of neither a value nor a sentence is a wrong call") {
    CHECK_FALSE(gl::result<int>(gl::problem{"no memory"}));
    CHECK(complaint() == "");
    CHECK_FALSE(gl::result<int>(gl::problem{}));
    CHECK(complaint() == "gnomon: a result without a value needs a sentence that says why");
}
