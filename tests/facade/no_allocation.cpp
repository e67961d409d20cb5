// Constructors allocate and nothing else does.
#include <gnomon/backend/executor.hpp>
#include <gnomon/backend/simd.hpp>
#include <gnomon/geometry/directional_light.hpp>
#include <gnomon/geometry/rasterize_lanes.hpp>
#include <gnomon/grid/reference_grid.hpp>
#include <gnomon/soft_shadow_map.hpp>

#include "../support/allocations.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

using test::allocations_in;

TEST_CASE("allocations are counted") {
    CHECK(allocations_in([] { const std::vector<int> v(100); }) == 1);
    CHECK(allocations_in([] { const gnomon::image<gnomon::rg8> image({9, 9}); }) == 1);
}

TEST_CASE("a tile grid allocates in its constructor and never again") {
    gnomon::tile_grid grid({500, 300}, 4);
    gnomon::depth_tiles depths({500, 300}, 4);
    gnomon::reference_grid engine({512, 512}, 3);
    std::vector<gnomon::bit_word> scratch(static_cast<std::size_t>(gnomon::words_for(grid.columns()) * grid.rows()));
    long texels = 0;
    CHECK(allocations_in([&] {
              for (int i = 0; i < 3; ++i) {
                  for (int n = 0; n < 20; ++n) {
                      grid.mark({n * 20, n * 13, n * 20 + 30, n * 13 + 9}, n);
                      depths.mark({n * 20, n * 13, n * 20 + 30, n * 13 + 9}, {0.1f, 0.2f}, n);
                  }
                  grid.dilate(2);
                  for_each_region(grid, [&](gnomon::texel_rect r) { texels += r.width() * r.height(); });
                  for_each_tile_rect_greedy(grid, scratch, [&](gnomon::tile_rect r) { texels += r.x1; });
                  texels += grid.touches({1, 2, 30, 40}) + depths.touches({1, 2, 30, 40}, 0.5f) + grid.count();
                  grid.clear();
                  depths.clear();
                  engine.cast({10, 20, 30, 40});
                  engine.for_each_tile_rect([&](gnomon::tile_rect r) { texels += r.x1; });
                  texels += engine.receives({1, 2, 30, 40});
                  engine.clear();
              }
          }) == 0);
    CHECK(texels > 0);
}

TEST_CASE("the stages allocate nothing: filter a region, filter what is marked, receive rows, images and points") {
    using gnomon::rgba16;
    gnomon::image<rgba16> casters({90, 70}, rgba16::caster(0.5f)), soft({90, 70});
    gnomon::filter_scratch<rgba16, gnomon::gaussian<8>> scratch(90);
    gnomon::tile_grid tiles({90, 70}, 16);
    tiles.mark({20, 20, 40, 40}, 8);
    const gnomon::image<float> z({90, 70}, 0.9f);
    gnomon::image<float> intensity({90, 70});
    CHECK(allocations_in([&] {
              gnomon::filter_region(casters.view(), soft.view(), whole(soft.size()), scratch);
              gnomon::filter(gnomon::scalar{}, casters.view(), soft.view(), tiles, scratch);
              gnomon::receive(soft.view(), z.view(), intensity.view());
              gnomon::receive(soft.view(), z.view().row_span(0), z.view().row_span(1), z.view().row_span(2),
                              intensity.view().row_span(3));
          }) == 0);
}

TEST_CASE_TEMPLATE("the stages allocate nothing in lanes: blurs and boxes, of a map, of what is marked and in bands, and decisions",
                   Texel, gnomon::rg8, gnomon::rg16, gnomon::rgb8, gnomon::rg32f) {
    const gnomon::simd<> run;
    gnomon::image<Texel> casters({90, 70}, Texel::caster(0.5f)), soft({90, 70});
    gnomon::filter_scratch<Texel, gnomon::fast<gnomon::gaussian<8>>> scratch(90);
    gnomon::filter_scratch<Texel, gnomon::box<5>> box_scratch(90);
    gnomon::band_scratch<Texel, gnomon::box<5>> bands(90, 3);
    gnomon::tile_grid before({90, 70}, 16), now({90, 70}, 16);
    before.mark({60, 50, 80, 60}, 8);
    now.mark({20, 20, 40, 40}, 8);
    const gnomon::image<float> z({90, 70}, 0.9f);
    gnomon::image<float> intensity({90, 70});
    CHECK(allocations_in([&] {
              run.filter_region(casters.view(), soft.view(), whole(soft.size()), scratch);
              run.filter_region(casters.view(), soft.view(), whole(soft.size()), box_scratch);
              gnomon::filter(run, casters.view(), soft.view(), now, scratch);
              gnomon::refilter(run, casters.view(), soft.view(), before, now, bands, gnomon::sequential{});
              gnomon::receive(run, soft.view().row_span(0), z.view().row_span(0), intensity.view().row_span(0));
              gnomon::receive(run, soft.view(), z.view().row_span(0), z.view().row_span(1), z.view().row_span(2),
                              intensity.view().row_span(3));
          }) == 0);
    CHECK(intensity(30, 0) >= 0.0f);
}

TEST_CASE("triangles allocate nothing, one by one or in lanes") {
    const std::vector<glm::vec3> corners{{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}};
    const std::vector<std::uint32_t> triangles{0, 2, 1, 0, 3, 2};
    gnomon::image<gnomon::rgb16> map({64, 64}, gnomon::rgb16::clear());
    gnomon::directional_light sun({0.0, -1.0, 0.0});
    sun.add_caster(gnomon::bounding_box{{-1, 1, -1}, {1, 1, 1}});
    sun.add_receiver(gnomon::bounding_box{{-2, 0, -2}, {2, 0, 2}});
    const gnomon::triangle_mesh mesh{corners, triangles};
    int touched = 0;
    CHECK(allocations_in([&] {
              const gnomon::light_frame light = sun.frame(map.size(), 3);
              touched += cast_triangles(gnomon::scalar{}, map.view(), mesh, light).texels.width();
              touched += cast_triangles(gnomon::simd<>{}, map.view(), mesh, light).texels.width();
              touched += bound_triangles(gnomon::simd<>{}, map.view(), mesh, light, gnomon::faces::both).texels.width();
          }) == 0);
    CHECK(touched > 0);
}

TEST_CASE("a whole frame of the facade allocates nothing, nor does the next") {
    gnomon::soft_shadow_map<gnomon::rgba8, gnomon::binomial<3>> map({.width = 200, .height = 150, .tile = 16});
    const float z[4] = {0.9f, 0.9f, 0.9f, 0.9f}, x[4] = {1.0f, 50.0f, 60.0f, 300.0f};
    float intensity[4] = {};
    struct touched {
        gnomon::texel_rect texels;
        gnomon::depth_interval depth;
    };
    const auto draw = [](auto texels) {
        texels(85, 25).cast(gnomon::rgba8::caster(0.5f));
        return touched{{85, 25, 86, 26}, {0.5f, 0.5f}};
    };
    CHECK(allocations_in([&] {
              for (int frame = 0; frame < 4; ++frame) {
                  map.clear();
                  map.cast({10 + 30 * frame, 10, 60 + 30 * frame, 50}, 0.5f);
                  map.cast({70, 60, 100, 90}, 0.25f, 0.5f);
                  map.cast(draw);
                  map.bound(whole(map.size()), 0.75f);
                  if (frame < 2)
                      map.filter();
                  else
                      map.filter(gnomon::sequential{});
                  map.receive(x, x, z, intensity);
                  map.receive_row(20, z, intensity);
                  intensity[0] +=
                      map.shadow(110, 30, 0.6f) + map.shadow_at(110.0f, 30.0f, 0.6f) + (map.reaches({0, 0, 9, 9}) ? 1.0f : 0.0f);
              }
          }) == 0);
    CHECK(intensity[0] > 0.0f);
}
