// Grown regions are judged by painting: each texel within the radius of a mark once, nothing farther from its tiles, nothing twice.
#include <gnomon/grid/grown_regions.hpp>

#include "../support/dice.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

namespace {
using gnomon::extent;
using gnomon::texel_rect;
using gnomon::tile_grid;
using test::dice;
constexpr int highest = std::numeric_limits<int>::max();

/// How often each texel of a map was painted.
class painting {
  public:
    explicit painting(extent size)
        : size_(size), times_(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height)) {}
    void paint(texel_rect r) {
        outside_ += r.empty() || clip(r, size_) != r;
        r = clip(r, size_);
        for (int y = r.y0; y < r.y1; ++y)
            for (int x = r.x0; x < r.x1; ++x) ++times_[index(x, y)];
    }
    int at(int x, int y) const { return times_[index(x, y)]; }
    int outside() const { return outside_; }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) + static_cast<std::size_t>(x);
    }
    extent size_;
    std::vector<int> times_;
    int outside_ = 0;
};

/// A grid with marks, what they need by definition, and the most that a region may be.
struct marked {
    tile_grid tiles;
    painting needed, most;

    marked(extent size, int tile) : tiles(size, tile), needed(size), most(size) {}
    marked(dice& roll, extent size, int tile, int radius, int guard) : marked(size, tile) {
        for (int n = roll(0, 5); n > 0; --n) {
            texel_rect r = roll.rect(size, 6);
            if (roll.one_in(2)) r = {r.x0, r.y0, r.x0 + roll(1, 4), r.y0 + roll(1, 4)};
            mark(r, radius, guard + roll(0, 2));
        }
    }
    void mark(texel_rect r, int radius, int guard) {
        tiles.mark(r, guard);
        if (clip(r, tiles.size()).empty()) return;
        needed.paint(clip(grow(clip(r, tiles.size()), radius), tiles.size()));
        most.paint(clip(grow(tiles.texels_of(tiles.tiles_of(r)), radius), tiles.size()));
    }
};

painting painted(const tile_grid& tiles, int radius) {
    painting p(tiles.size());
    for_each_region_within(tiles, radius, [&p](texel_rect r) { p.paint(r); });
    return p;
}
std::vector<texel_rect> regions(const tile_grid& tiles, int radius) {
    std::vector<texel_rect> found;
    for_each_region_within(tiles, radius, [&found](texel_rect r) { found.push_back(r); });
    return found;
}

/// Judges the regions of many grids.
class judged {
  public:
    void judge(const marked& m, int radius) {
        const painting p = painted(m.tiles, radius);
        off_the_map_ += p.outside();
        const int tile = m.tiles.tile();
        const bool cut = m.tiles.guard() >= radius && tile >= radius;
        for (int y = 0; y < m.tiles.size().height; ++y)
            for (int x = 0; x < m.tiles.size().width; ++x) {
                const bool allowed = m.most.at(x, y) > 0, reached = m.tiles.test(x / tile, y / tile);
                missing_ += m.needed.at(x, y) > 0 && p.at(x, y) == 0;
                twice_ += p.at(x, y) > 1;
                too_far_ += p.at(x, y) > 0 && !allowed;
                if (cut) {
                    unreached_ += p.at(x, y) > 0 && !reached;
                    clipped_ += allowed && !reached;
                } else {
                    exact_ += allowed && p.at(x, y) == 0; // all that is within the radius of the tiles
                }
            }
    }
    void check() const {
        CHECK(missing_ == 0);
        CHECK(twice_ == 0);
        CHECK(too_far_ == 0);
        CHECK(off_the_map_ == 0);
        CHECK(unreached_ == 0);
        CHECK(clipped_ > 1000);
        CHECK(exact_ == 0);
    }

  private:
    int missing_ = 0, twice_ = 0, too_far_ = 0, off_the_map_ = 0, unreached_ = 0, clipped_ = 0, exact_ = 0;
};
} // namespace

TEST_CASE("every texel within the radius of a mark lies in one region, and none farther than that from the marked tiles") {
    dice roll(501);
    judged j;
    for (int round = 0; round < 2000; ++round) {
        const extent size{roll(1, round % 3 == 0 ? 150 : 60), roll(1, 50)}; // up to three words
        const int tile = roll(1, round % 2 == 0 ? 6 : 40), radius = roll(0, round % 5 == 0 ? 40 : 9);
        const bool guarded = round % 4 != 0;
        j.judge(marked(roll, size, tile, radius, guarded ? radius : roll(0, radius)), radius);
    }
    j.check();
}

TEST_CASE("so it is where words of tiles meet, and the guard band of one word reaches the next or does not") {
    dice roll(504);
    judged j;
    for (int round = 0; round < 2000; ++round) {
        const int tile = roll(1, 3), radius = roll(1, tile);
        const extent size{64 * tile * roll(2, 3) - roll(0, 2 * tile), roll(1, 3 * tile)};
        marked m(size, tile);
        for (int n = roll(1, 2); n > 0; --n) {
            const int x = 64 * tile * roll(1, 2) + roll(-2 * tile, 2 * tile), y = roll(0, size.height - 1);
            m.mark({x, y, x + 1, y + roll(1, tile)}, radius, radius);
        }
        j.judge(m, radius);
    }
    for (int round = 0; round < 200; ++round) { // and so is a radius wider than a word
        const int radius = roll(65, 140);
        marked m({roll(130, 400), roll(1, 3)}, 1);
        for (int n = roll(1, 2); n > 0; --n) {
            const int x = roll.one_in(2) ? 64 * roll(0, 3) : roll(0, m.tiles.size().width - 1);
            m.mark({x, 0, x + 1, 1}, radius, 0);
        }
        j.judge(m, radius);
    }
    j.check();
}

TEST_CASE("what is left of a frame is what it needed and the next one does not") {
    dice roll(502);
    int wrong = 0, left = 0;
    for (int round = 0; round < 1500; ++round) {
        const extent size{roll(1, round % 3 == 0 ? 150 : 60), roll(1, 50)};
        const int tile = roll(1, round % 2 == 0 ? 6 : 40), radius = roll(0, round % 5 == 0 ? 40 : 9);
        const marked before(roll, size, tile, radius, radius), now(roll, size, tile, radius, radius);
        painting cleared(size);
        for_each_region_left(before.tiles, now.tiles, radius, [&](texel_rect r) { cleared.paint(r); });
        const painting was = painted(before.tiles, radius), is = painted(now.tiles, radius);
        wrong += cleared.outside();
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                wrong += cleared.at(x, y) != (was.at(x, y) > 0 && is.at(x, y) == 0 ? 1 : 0);
                left += cleared.at(x, y);
            }
    }
    CHECK(wrong == 0);
    CHECK(left > 1000);
}

TEST_CASE("of the regions of a word of tiles no two could be one") {
    dice roll(503);
    int apart = 0, could_be_one = 0;
    for (int round = 0; round < 1500; ++round) {
        const extent size{roll(1, 150), roll(1, 50)};
        const int tile = roll(1, round % 2 == 0 ? 3 : 12), radius = roll(0, 9);
        const marked before(roll, size, tile, radius, radius), now(roll, size, tile, radius, radius);
        std::vector<texel_rect> left;
        for_each_region_left(before.tiles, now.tiles, radius, [&left](texel_rect r) { left.push_back(r); });
        for (const std::vector<texel_rect>& found : {regions(now.tiles, radius), left})
            for (const texel_rect& a : found)
                for (const texel_rect& b : found) {
                    if (a.x0 / (64 * tile) != b.x0 / (64 * tile)) continue;
                    const bool beside = a.x1 == b.x0 && a.y0 < b.y1 && b.y0 < a.y1;
                    const bool below = a.y1 == b.y0 && a.x0 == b.x0 && a.x1 == b.x1;
                    could_be_one += beside || below;
                    apart += a.x0 > b.x1 || a.y1 == b.y0;
                }
    }
    CHECK(could_be_one == 0);
    CHECK(apart > 1000);
}

TEST_CASE("a lone tile grows into one rectangle, and one that bends is cut where it bends") {
    tile_grid tiles({100, 100}, 10);
    tiles.mark({40, 40, 50, 50}, 3);
    CHECK(regions(tiles, 3) == std::vector<texel_rect>{{37, 37, 53, 53}});
    CHECK(regions(tiles, 0) == std::vector<texel_rect>{{40, 40, 50, 50}});
    CHECK(regions(tiles, -1) == regions(tiles, 0));
    tiles.mark({50, 50, 60, 60}, 3);
    CHECK(regions(tiles, 3) == std::vector<texel_rect>{{37, 37, 53, 47}, {37, 47, 63, 53}, {47, 53, 63, 63}});
    CHECK(regions(tiles, 0) == std::vector<texel_rect>{{40, 40, 50, 50}, {50, 50, 60, 60}});
}

TEST_CASE("a caster inside its tile is not grown beyond it, for its guard band did not leave it") {
    tile_grid tiles({100, 100}, 10);
    tiles.mark({44, 44, 46, 46}, 3);
    CHECK(regions(tiles, 3) == std::vector<texel_rect>{{40, 40, 50, 50}});
    CHECK(regions(tiles, 4) == std::vector<texel_rect>{{36, 36, 54, 54}}); // that tells nothing about four texels
    tiles.mark({41, 44, 42, 46}, 3);
    CHECK(regions(tiles, 3) == std::vector<texel_rect>{{37, 40, 50, 50}});
}

TEST_CASE("the largest map and the largest radius there can be are grown without overflow") {
    for (const int tile : {1 << 26, 1 << 30, highest}) {
        tile_grid tiles({highest, highest}, tile);
        tiles.mark({highest - 5, highest - 5, highest, highest});
        CHECK(regions(tiles, highest) == std::vector<texel_rect>{{0, 0, highest, highest}});
        const int first = (highest - 1) / tile * tile, grown = first > 3 ? first - 3 : 0;
        CHECK(regions(tiles, 3) == std::vector<texel_rect>{{grown, grown, highest, highest}});
    }
    tile_grid texels({30, 20}, 1); // whose rows of tiles reach over as many others as there are
    texels.mark({7, 9, 8, 10});
    CHECK(regions(texels, highest) == std::vector<texel_rect>{{0, 0, 30, 20}});
}

TEST_CASE("no map, no marks and marks off the map have no regions") {
    CHECK(regions(tile_grid{}, 3).empty());
    tile_grid tiles({30, 30}, 10);
    CHECK(regions(tiles, 3).empty());
    tiles.mark({-9, 5, 0, 9}, 4); // its penumbra enters, but a filter reads nothing off the map
    CHECK_FALSE(tiles.empty());
    CHECK(tiles.held_count() == 0);
    CHECK(regions(tiles, 4).empty());
    for_each_region_left(tile_grid{}, tiles, 4, [](texel_rect) { CHECK(false); });
    int left = 0;
    tiles.mark({0, 0, 10, 10});
    for_each_region_left(tiles, tile_grid({30, 30}, 10), -1, [&](texel_rect r) { left += r == texel_rect{0, 0, 10, 10} ? 1 : 9; });
    CHECK(left == 1);
}

TEST_CASE("of a frame whose map was cut otherwise all that it needed is left") {
    tile_grid before({90, 70}, 10);
    before.mark({3, 3, 20, 9}, 4);
    before.mark({60, 40, 61, 41}, 4);
    for (const tile_grid& now : {tile_grid{}, tile_grid({90, 70}, 30), tile_grid({90, 71}, 10), tile_grid({80, 70}, 10)}) {
        tile_grid marked = now;
        marked.mark(whole(now.size()), 4);
        std::vector<texel_rect> left;
        for_each_region_left(before, marked, 4, [&left](texel_rect r) { left.push_back(r); });
        CHECK(left == regions(before, 4));
    }
}
