// The oracle is written from design/reference-engine.md, section 4, in whole eighths of a texel: it never rounds and knows no words
// of bits. The vectors in data/tiles.json come from a third implementation.
#include <gnomon/grid/reference_grid.hpp>

#include "../support/bits.hpp"
#include "../support/dice.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace {
using gnomon::extent;
using gnomon::real_rect;
using gnomon::reference_grid;
using gnomon::texel_rect;
using gnomon::tile_rect;
using test::dice;

std::vector<tile_rect> rects_of(const reference_grid& grid) {
    std::vector<tile_rect> found;
    grid.for_each_tile_rect([&](tile_rect r) {
        found.push_back(r);
        return found.size(); // which nobody asks for
    });
    return found;
}

/// A rectangle in eighths of a texel.
struct eighths {
    long x0, y0, x1, y1;

    operator real_rect() const { return {real(x0), real(y0), real(x1), real(y1)}; }
    static double real(long v) { return static_cast<double>(v) / 8.0; }
};

struct engine {
    static constexpr int side = 32;
    extent map;
    long reach, guard;
    std::array<std::array<bool, side>, side + 1> set{}; // one row above stays empty for good
    std::optional<eighths> box{};

    engine(extent size, int radius, int margin) : map(size), reach(2 * radius), guard(2 * radius + margin) {}

    static long tile(long edge, int texels) {
        const long t = edge * side / (8L * texels); // truncates
        return t < 0 ? 0 : (t > side - 1 ? side - 1 : t);
    }
    bool cast(eighths r) {
        const long right = 8L * map.width, top = 8L * map.height;
        if (r.x1 <= 0 || r.y1 <= 0 || r.x0 >= right || r.y0 >= top) return false; // before dilation
        const eighths on_map{std::max(r.x0, 0L), std::max(r.y0, 0L), std::min(r.x1, right), std::min(r.y1, top)};
        box = !box ? on_map
                   : eighths{std::min(box->x0, on_map.x0), std::min(box->y0, on_map.y0), std::max(box->x1, on_map.x1),
                             std::max(box->y1, on_map.y1)};
        for (long y = tile(r.y0 - 8 * guard, map.height); y <= tile(r.y1 + 8 * guard, map.height); ++y)
            for (long x = tile(r.x0 - 8 * guard, map.width); x <= tile(r.x1 + 8 * guard, map.width); ++x) at(x, y) = true;
        return true;
    }
    bool receives(eighths r) const {
        if (!box || r.x1 < box->x0 - 8 * guard || r.x0 > box->x1 + 8 * guard || r.y1 < box->y0 - 8 * guard ||
            r.y0 > box->y1 + 8 * guard)
            return false;
        for (long y = tile(r.y0, map.height); y <= tile(r.y1, map.height); ++y)
            for (long x = tile(r.x0, map.width); x <= tile(r.x1, map.width); ++x)
                if (set[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)]) return true;
        return false;
    }
    std::vector<tile_rect> rects() const {
        if (!box) return {};
        if (box->x0 == box->x1 || box->y0 == box->y1) return {{0, 0, side, side}};
        std::vector<tile_rect> found;
        auto left = set;
        for (std::size_t y = 0; y < side; ++y) {
            const auto snapshot = left[y];
            for (std::size_t first = 0; first < side; ++first) {
                if (!snapshot[first] || (first > 0 && snapshot[first - 1])) continue;
                std::size_t last = first, end = y;
                while (last < side && snapshot[last]) ++last;
                const auto contains = [&](const auto& row) {
                    for (std::size_t x = first; x < last; ++x)
                        if (!row[x]) return false;
                    return true;
                };
                for (; contains(left[end]); ++end)
                    for (std::size_t x = first; x < last; ++x) left[end][x] = false;
                found.push_back({static_cast<int>(first), static_cast<int>(y), static_cast<int>(last), static_cast<int>(end)});
            }
        }
        return found;
    }
    texel_rect scissor() const {
        if (!box) return {};
        const auto down = [](long v) { return v / 8; }; // of a rectangle on the map, so never negative
        const auto up = [](long v) { return (v + 7) / 8; };
        const auto limit = [](long v, int texels) { return static_cast<int>(std::max(2L, std::min(v, texels - 2L))); };
        return {limit(down(box->x0) - reach, map.width), limit(down(box->y0) - reach, map.height),
                limit(up(box->x1) + reach, map.width), limit(up(box->y1) + reach, map.height)};
    }

  private:
    bool& at(long x, long y) { return set[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)]; }
};

static_assert(test::same_bits(real_rect{}.x0, 0.0) && test::same_bits(real_rect{}.y0, 0.0) &&
              test::same_bits(real_rect{}.x1, 0.0) && test::same_bits(real_rect{}.y1, 0.0));

nlohmann::json vectors() {
    std::ifstream file(GNOMON_TEST_DATA "/tiles.json");
    REQUIRE(file);
    return nlohmann::json::parse(file).at("vectors");
}
real_rect rect(const nlohmann::json& j) { return {j.at(0), j.at(1), j.at(2), j.at(3)}; }

reference_grid with_casters(const nlohmann::json& v) {
    reference_grid grid({v.at("width"), v.at("height")}, v.at("radius"), v.at("margin"));
    for (const auto& caster : v.at("casters")) grid.cast(rect(caster));
    return grid;
}
nlohmann::json vector_named(const std::string& prefix) {
    for (const auto& v : vectors())
        if (v.at("name").get<std::string>().starts_with(prefix)) return v;
    return {};
}
} // namespace

TEST_CASE("every field of every vector of the reference engine is reproduced") {
    std::vector<int> written; // texels that one pass of the engine's blur writes
    for (const auto& v : vectors()) {
        CAPTURE(v.at("name").get<std::string>());
        reference_grid grid({v.at("width"), v.at("height")}, v.at("radius"), v.at("margin"));
        for (std::size_t i = 0; i < v.at("casters").size(); ++i)
            CHECK(grid.cast(rect(v.at("casters").at(i))) == v.at("accepted").at(i).get<bool>());

        for (int y = 0; y < reference_grid::side; ++y)
            CHECK(grid.row(y) == std::stoul(v.at("rows").at(static_cast<std::size_t>(y)).get<std::string>(), nullptr, 16));

        std::vector<tile_rect> expected;
        for (const auto& r : v.at("rects"))
            expected.push_back(
                {r.at(0), r.at(1), r.at(0).get<int>() + r.at(2).get<int>(), r.at(1).get<int>() + r.at(3).get<int>()});
        CHECK(rects_of(grid) == expected);

        texel_rect scissor{};
        if (const auto& s = v.at("blur_scissor"); !s.is_null())
            scissor = {s.at(0), s.at(1), s.at(0).get<int>() + s.at(2).get<int>(), s.at(1).get<int>() + s.at(3).get<int>()};
        CHECK(grid.blur_scissor() == scissor);

        for (std::size_t i = 0; i < v.at("receivers").size(); ++i)
            CHECK(grid.receives(rect(v.at("receivers").at(i))) == v.at("received").at(i).get<bool>());

        int area = 0;
        grid.for_each_tile_rect([&](tile_rect t) {
            const texel_rect r = intersection({t.x0 * 16, t.y0 * 16, t.x1 * 16, t.y1 * 16}, grid.blur_scissor());
            area += r.width() * r.height();
        });
        written.push_back(area);
    }
    CHECK(written == std::vector<int>{0, 1296, 1936, 1024, 144, 121, 392, 0, 210, 258064, 3456, 23500, 45568});
}

TEST_CASE("random casters and receivers, fractional and on maps of any size, are treated as the engine's text says") {
    dice roll(41);
    int wrong = 0, accepted = 0, received = 0, asked = 0;
    for (int round = 0; round < 1500; ++round) {
        const extent map = roll.one_in(2) ? extent{roll(5, 900), roll(5, 900)} : extent{96 << roll(0, 3), 300};
        const int radius = roll(0, 7), margin = roll(0, 3), fraction = roll.one_in(3) ? 1 : 8; // one in three in whole texels
        reference_grid grid(map, radius, margin);
        engine truth(map, radius, margin);
        const auto any_rect = [&](int largest) {
            const long x = roll(-200, 8 * map.width + 200) / fraction * fraction,
                       y = roll(-200, 8 * map.height + 200) / fraction * fraction;
            return eighths{x, y, x + roll(0, 8 * largest) / fraction * fraction, y + roll(0, 8 * largest) / fraction * fraction};
        };
        for (int casters = roll(0, 6); casters > 0; --casters) {
            const eighths r = any_rect(roll.one_in(5) ? 400 : 40);
            const bool on_map = truth.cast(r);
            wrong += grid.cast(r) != on_map;
            accepted += on_map;
        }
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x)
                wrong += (grid.row(y) >> x & 1) != (truth.set[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] ? 1u : 0u);
        wrong += rects_of(grid) != truth.rects();
        const texel_rect scissor = truth.scissor();
        wrong += scissor.empty() ? !grid.blur_scissor().empty() : grid.blur_scissor() != scissor;
        for (int receivers = 0; receivers < 20; ++receivers, ++asked) {
            const eighths r = any_rect(60);
            wrong += grid.receives(r) != truth.receives(r);
            received += truth.receives(r);
        }
    }
    CHECK(wrong == 0);
    CHECK(accepted > 3000);
    CHECK(received > asked / 10);
    CHECK(received < asked / 2);
}

TEST_CASE("casters without area are accepted, and then the engine blurs the whole map") {
    reference_grid grid({512, 512}, 1);
    CHECK(grid.cast({100, 50, 100, 80}));
    CHECK(rects_of(grid) == std::vector<tile_rect>{{0, 0, 32, 32}});
    CHECK(grid.blur_scissor() == texel_rect{98, 48, 102, 82});
    CHECK(grid.cast({100, 50, 101, 80}));
    CHECK(rects_of(grid).size() == 1);
    CHECK(rects_of(grid) != std::vector<tile_rect>{{0, 0, 32, 32}});
}

TEST_CASE("what the engine has no rule for is rejected: NaN and inverted rectangles, as casters and as receivers") {
    constexpr double nan = test::nan<double>;
    const real_rect refused[] = {{nan, 0, 9, 9}, {0, nan, 9, 9}, {0, 0, nan, 9},       {0, 0, 9, nan},
                                 {9, 0, 3, 9},   {0, 9, 9, 3},   {255, 255, 250, 250}, {100, 100, 50, 50}};
    for (const real_rect r : refused) {
        reference_grid grid({512, 512}, 1);
        CHECK_FALSE(grid.cast(r));
        CHECK(rects_of(grid).empty());
        REQUIRE(grid.cast({0, 0, 512, 512}));
        CAPTURE(r.x0);
        CAPTURE(r.x1);
        CHECK_FALSE(grid.receives(r));
    }
}

TEST_CASE("a reference grid without a map takes no caster and knows no shadow") {
    for (const extent none : {extent{}, extent{0, 512}, extent{512, -1}}) {
        reference_grid grid(none, 1);
        CHECK_FALSE(grid.cast({-5, -5, 9, 9}));
        CHECK_FALSE(grid.receives({-5, -5, 9, 9}));
        CHECK(rects_of(grid).empty());
        CHECK(grid.blur_scissor() == texel_rect{});
    }
}

TEST_CASE("infinite and huge rectangles cover the map, and no setting overflows") {
    constexpr double inf = test::infinity<double>;
    for (const real_rect everything : {real_rect{-inf, -inf, inf, inf}, {-1e300, -1e300, 1e300, 1e300}, {-3e9, -3e9, 3e9, 3e9}})
        for (const int radius : {-1, 0, 1, 2147483647}) {
            reference_grid grid({512, 512}, radius);
            CHECK_FALSE(grid.receives(everything));
            CHECK(grid.cast(everything));
            CHECK(grid.receives(everything));
            CHECK(grid.tiles().count() == 32 * 32);
            CHECK(grid.blur_scissor() == texel_rect{2, 2, 510, 510});
        }
}

TEST_CASE("the margin is the engine's 2 texels if none is given") {
    reference_grid grid({512, 512}, 1); // tiles of 16 texels
    CHECK(grid.cast({20, 20, 44, 44}));
    CHECK(rects_of(grid) == std::vector<tile_rect>{{1, 1, 4, 4}}); // 16 to 48, inclusive
}

TEST_CASE("a radius or a margin beyond 2^20 counts as 2^20") {
    for (const int setting : {1 << 20, (1 << 20) + 1, 2147483647}) { // tiles of 2^17 texels
        reference_grid wide({1 << 22, 64}, setting, 0), margin({1 << 22, 64}, 0, setting);
        CHECK(wide.cast({0, 0, 1, 64}));
        CHECK(margin.cast({0, 0, 1, 64}));
        CHECK(wide.row(0) == 0x1FFFF); // 2^21 texels to the right, inclusive: the first 17
        CHECK(margin.row(0) == 0x1FF); // 2^20
    }
}

TEST_CASE("a cleared reference grid is a new one") {
    reference_grid grid({512, 512}, 3);
    grid.cast({100, 100, 200, 200});
    grid.clear();
    CHECK(grid.tiles().empty());
    CHECK(rects_of(grid).empty());
    CHECK(grid.blur_scissor().empty());
    CHECK_FALSE(grid.receives({0, 0, 512, 512}));
    CHECK(grid.cast({240, 240, 272, 272}));
    CHECK(rects_of(grid) == std::vector<tile_rect>{{14, 14, 18, 18}});
}

TEST_CASE(
    "V05, V06: an upper edge on a tile border takes the next tile in the engine, and in a tile_grid it takes none it does not "
    "touch") {
    for (const char* name : {"V05", "V06"}) {
        const auto v = vector_named(name);
        gnomon::tile_grid grid({512, 512}, 16);
        const real_rect r = rect(v.at("casters").at(0));
        const tile_rect marked =
            grid.mark(gnomon::enclosing_texels(r.x0, r.y0, r.x1, r.y1), 2 * v.at("radius").get<int>() + v.at("margin").get<int>());
        CAPTURE(name);
        CHECK(marked == tile_rect{1, 1, 2, 2});
        CHECK(with_casters(v).tiles().count() == (std::string(name) == "V05" ? 4 : 1));
    }
}

TEST_CASE("V08: a caster just off the map throws its penumbra in: the engine drops it, a tile_grid marks where it enters") {
    const auto v = vector_named("V08");
    CHECK(with_casters(v).tiles().empty());
    gnomon::tile_grid grid({512, 512}, 16);
    CHECK(grid.mark({-30, 100, 0, 130}, 2 * v.at("radius").get<int>()) == tile_rect{0, 5, 1, 9});
    CHECK(grid.touches({0, 100, 10, 130}));
}

TEST_CASE("V07: a receiver off the map is pulled to the edge tiles by the engine, and a tile_grid knows that it is lit") {
    const auto v = vector_named("V07");
    gnomon::tile_grid grid({512, 512}, 16);
    for (const auto& caster : v.at("casters")) {
        const real_rect r = rect(caster);
        grid.mark(gnomon::enclosing_texels(r.x0, r.y0, r.x1, r.y1), 2 * v.at("radius").get<int>());
    }
    const texel_rect off_map{512, 512, 530, 530};
    CHECK(with_casters(v).receives({512, 512, 530, 530}));
    CHECK_FALSE(grid.touches(off_map));
    CHECK(grid.touches({500, 500, 530, 530}));
}
