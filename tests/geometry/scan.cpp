// The oracle here is the definition: a centre is inside if it is on the inner side of all three edges, and on an edge if that is a
// top or a left one. It knows nothing of rows, columns or division.
#include <gnomon/geometry/scan.hpp>

#include <doctest/doctest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace {
using gnomon::texel_rect;
using gnomon::detail::fixed_point;

static_assert(fixed_point{}.x == 0 && fixed_point{}.y == 0);

std::int64_t turn(fixed_point a, fixed_point b, fixed_point p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

bool owns(fixed_point a, fixed_point b, fixed_point p) { // y grows downwards, and the inside is where turn > 0
    const std::int64_t side = turn(a, b, p);
    const bool top = a.y == b.y && b.x > a.x, left = b.y < a.y;
    return side > 0 || (side == 0 && (top || left));
}

bool covers(fixed_point a, fixed_point b, fixed_point c, int x, int y) {
    const std::int64_t area = turn(a, b, c);
    if (area == 0) return false;
    if (area < 0) std::swap(b, c);
    const fixed_point p{x * 256 + 128, y * 256 + 128};
    return owns(a, b, p) && owns(b, c, p) && owns(c, a, p);
}

struct counted {
    texel_rect area;
    std::vector<int> count;
    int empty_runs = 0;

    explicit counted(texel_rect r) : area(r), count(static_cast<std::size_t>(r.width() * r.height())) {}
    int& at(int x, int y) { return count[static_cast<std::size_t>((y - area.y0) * area.width() + x - area.x0)]; }
    void add(const fixed_point* corners, int n) {
        gnomon::detail::scan(corners, n, area, [this](int y, int x0, int x1) {
            empty_runs += x0 >= x1;
            for (int x = x0; x < x1; ++x) ++at(x, y);
        });
    }
    void add(fixed_point a, fixed_point b, fixed_point c) {
        const fixed_point corners[3]{a, b, c};
        add(corners, 3);
    }
};

struct dice {
    std::mt19937_64 bits;
    std::int64_t operator()(std::int64_t low, std::int64_t high) {
        return std::uniform_int_distribution<std::int64_t>(low, high)(bits);
    }
};

int differences(counted& drawn, fixed_point a, fixed_point b, fixed_point c) {
    int wrong = drawn.empty_runs;
    for (int y = drawn.area.y0; y < drawn.area.y1; ++y)
        for (int x = drawn.area.x0; x < drawn.area.x1; ++x) wrong += drawn.at(x, y) != (covers(a, b, c, x, y) ? 1 : 0);
    return wrong;
}
} // namespace

TEST_CASE("a triangle covers exactly the centres that the top-left rule gives it, also where edges run through centres") {
    dice roll{std::mt19937_64(1)};
    for (const std::int64_t grid : {128, 64, 1}) { // 128: every other corner is a centre or a texel corner
        int wrong = 0, covered = 0;
        for (int i = 0; i < 20000; ++i) {
            fixed_point t[3];
            for (auto& p : t) p = {roll(-300, 300) * 8 / grid * grid, roll(-300, 300) * 8 / grid * grid};
            counted drawn({-6, -5, 7, 6});
            drawn.add(t, 3);
            wrong += differences(drawn, t[0], t[1], t[2]);
            for (int c : drawn.count) covered += c;
        }
        CAPTURE(grid);
        CHECK(wrong == 0);
        CHECK(covered > 20000);
    }
}

TEST_CASE("the largest coordinates are as exact as the small ones") {
    dice roll{std::mt19937_64(2)};
    constexpr std::int64_t far_out = 1 << 28;
    int wrong = 0, partly = 0;
    for (int i = 0; i < 20000; ++i) {
        fixed_point t[3];
        for (auto& p : t) p = {roll(-far_out, far_out), roll(-far_out, far_out)};
        if (i % 2) t[0] = {roll(-900, 900), roll(-900, 900)};
        if (i % 4 == 3) t[1] = {i % 8 == 3 ? far_out : -far_out, i % 16 < 8 ? far_out : -far_out};
        counted drawn({-4, -4, 4, 4});
        drawn.add(t, 3);
        wrong += differences(drawn, t[0], t[1], t[2]);
        int sum = 0;
        for (int c : drawn.count) sum += c;
        partly += sum > 0 && sum < 64;
    }
    CHECK(wrong == 0);
    CHECK(partly > 2000);
}

TEST_CASE("a centre that an edge passes by as closely as can be is on the side where it is") {
    // At y = 128, the edge is at 128 + 1/255, right of the first texel's centre; mirrored, at 128 - 1/255. Then 1/1279, after two rows.
    constexpr fixed_point left{-1000, 100}, right{1000, 100},
        edges[4][2]{{{127, 0}, {129, 255}}, {{129, 0}, {127, 255}}, {{127, -512}, {129, 767}}, {{129, -512}, {127, 767}}};
    for (const auto& edge : edges)
        for (const fixed_point side : {left, right}) {
            counted drawn({-2, -2, 3, 3});
            drawn.add(edge[0], edge[1], side);
            CHECK(differences(drawn, edge[0], edge[1], side) == 0);
            CHECK(drawn.at(0, 0) == ((side.x < 0) == (edge[0].x < edge[1].x) ? 1 : 0));
        }
}

TEST_CASE("a fan around any point covers each centre of a square once") {
    dice roll{std::mt19937_64(3)};
    int wrong = 0;
    for (int i = 0; i < 3000; ++i) {
        const std::int64_t grid = i % 3 ? 1 : 128;
        const fixed_point hub{roll(0, 4096) / grid * grid, roll(0, 4096) / grid * grid};
        std::vector<fixed_point> rim;
        for (std::int64_t s = 0; s < 4096; s += roll(20, 1500) / grid * grid + grid) rim.push_back({s, 0});
        for (std::int64_t s = 0; s < 4096; s += roll(20, 1500) / grid * grid + grid) rim.push_back({4096, s});
        for (std::int64_t s = 4096; s > 0; s -= roll(20, 1500) / grid * grid + grid) rim.push_back({s, 4096});
        for (std::int64_t s = 4096; s > 0; s -= roll(20, 1500) / grid * grid + grid) rim.push_back({0, s});
        counted drawn({-2, -2, 18, 18});
        for (std::size_t k = 0; k < rim.size(); ++k) drawn.add(hub, rim[k], rim[(k + 1) % rim.size()]);
        for (int y = -2; y < 18; ++y)
            for (int x = -2; x < 18; ++x) wrong += drawn.at(x, y) != (x >= 0 && y >= 0 && x < 16 && y < 16 ? 1 : 0);
    }
    CHECK(wrong == 0);
}

TEST_CASE("a convex polygon is the sum of the triangles of its fan") {
    dice roll{std::mt19937_64(4)};
    int wrong = 0, corners_seen = 0;
    for (int i = 0; i < 20000; ++i) {
        // Corners of a parabola cut off by a line, and so in convex position, turned by quarters.
        constexpr int most = gnomon::detail::most_corners;
        fixed_point polygon[most];
        int n = 0;
        const std::int64_t shift_x = roll(-128, 128), shift_y = roll(-128, 128), size = roll(1, 20), steep = roll(1, 3);
        for (std::int64_t k = 0; k < most; ++k) {
            if (i % 8 != 0 && roll(0, 2) == 0) continue;
            const std::int64_t u = (k - most / 2) * size * 8, v = ((k - most / 2) * (k - most / 2) - 40) * size * steep;
            polygon[n++] = {shift_x + (i % 2 == 0 ? u : -v), shift_y + (i % 2 == 0 ? v : u)};
        }
        if (n < 3) continue;
        corners_seen = n > corners_seen ? n : corners_seen;
        counted whole({-9, -9, 9, 9}), fan({-9, -9, 9, 9});
        whole.add(polygon, n);
        for (int k = 1; k + 1 < n; ++k) fan.add(polygon[0], polygon[k], polygon[k + 1]);
        wrong += whole.count != fan.count;
    }
    CHECK(wrong == 0);
    CHECK(corners_seen == gnomon::detail::most_corners);
}

TEST_CASE("snapping takes the nearest 1/256 texel, halves upwards, and keeps to its range") {
    CHECK(fixed_point::nearest(0.0, 1.0).x == 0);
    CHECK(fixed_point::nearest(0.0, 1.0).y == 256);
    CHECK(fixed_point::nearest(0.5 / 256.0, -0.5 / 256.0).x == 1);
    CHECK(fixed_point::nearest(0.5 / 256.0, -0.5 / 256.0).y == 0);
    CHECK(fixed_point::nearest(-0.51 / 256.0, -1.49 / 256.0).x == -1);
    CHECK(fixed_point::nearest(-0.51 / 256.0, -1.49 / 256.0).y == -1);
    const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(fixed_point::nearest(inf, 1e300).x == 1 << 28);
    CHECK(fixed_point::nearest(inf, 1e300).y == 1 << 28);
    CHECK(fixed_point::nearest(-inf, nan).x == -(1 << 28));
    CHECK(fixed_point::nearest(-inf, nan).y == -(1 << 28));
}

namespace {
constexpr fixed_point at(std::int64_t x, std::int64_t y) { return {x, y}; }
constexpr int texels_of(auto... corner) {
    const fixed_point corners[]{corner...};
    int count = 0;
    gnomon::detail::scan(corners, sizeof...(corner), {0, 0, 100, 100}, [&](int, int x0, int x1) { count += x1 - x0; });
    return count;
}
static_assert(texels_of(at(0, 0), at(2560, 0), at(0, 2560)) == 45,
              "half a square whose diagonal runs through 10 centres, none of them its own");
static_assert(texels_of(at(2560, 2560), at(2560, 0), at(0, 2560)) == 55, "the other half owns them: they are on its left edge");
static_assert(texels_of(at(0, 0), at(2560, 2560), at(5120, 5120)) == 0, "a line covers nothing");
static_assert(texels_of(at(0, 0), at(1024, 0), at(1024, 1024), at(2048, 1024), at(2048, 0), at(3072, 0), at(3072, 2048),
                        at(0, 2048)) == 4 * (4 + 4) + 4 * 12,
              "between the arms of a U is nothing");
} // namespace
