// Where the casters of a sparse map are: the same clusters of tiles for every bench that asks.
#pragma once

#include <gnomon/grid/tile_grid.hpp>
#include <gnomon/texel/image.hpp>

#include <random>
#include <vector>

namespace clusters {

/// Boxes of 1 to 5 tiles a side, wherever they fall, until so many of a hundred tiles are covered: always the same ones.
inline std::vector<gnomon::tile_rect> covering(int percent, int columns) {
    std::mt19937 dice(1);
    const auto roll = [&dice](int first, int last) {
        return first + static_cast<int>(dice() % static_cast<unsigned>(last - first + 1));
    };
    std::vector<gnomon::tile_rect> boxes;
    gnomon::tile_grid covered({columns, columns}, 1);
    while (covered.count() * 100 < percent * columns * columns) {
        const int width = roll(1, 5), height = roll(1, 5), x = roll(0, columns - width), y = roll(0, columns - height);
        boxes.push_back({x, y, x + width, y + height});
        covered.mark({x, y, x + width, y + height});
    }
    return boxes;
}

/// The share of a square map, so many texels a side, that lies within a radius of the tiles that hold casters.
inline double grown_area(const gnomon::tile_grid& tiles, int side, int radius) {
    gnomon::image<unsigned char> near_by({side, side});
    for (int y = 0; y < tiles.rows(); ++y)
        for (int x = 0; x < tiles.columns(); ++x)
            if (tiles.held(y).test(x)) near_by.view().fill(grow(tiles.texels_of({x, y, x + 1, y + 1}), radius), 1);
    long long sum = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) sum += near_by(x, y);
    return static_cast<double>(sum) / (1.0 * side * side);
}

} // namespace clusters
