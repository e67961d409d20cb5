// Maps on a GPU, and what they draw with, allocate when they are made and never again.
#include <gnomon/gl/rectangles.hpp>
#include <gnomon/gl/soft_shadow_map.hpp>

#include "../support/allocations.hpp"
#include "../support/fake_gl.hpp"

#include <doctest/doctest.h>

namespace gl = gnomon::gl;

TEST_CASE("rectangles that are drawn and casters that wait for it allocate nothing, nor did the first") {
    test::fake_gl fake("3.3");
    const gl::context c = *gl::context::of(fake.table);
    auto list = gl::rectangle_list::make(c);
    REQUIRE(list);
    const auto walk = [](auto&& f) { // calls nothing of the fake, which does allocate
        CHECK(test::allocations_in([&f] {
                  for (int i = 1; i < gl::rectangle_list::capacity; ++i) f(gnomon::texel_rect{i, 0, i + 1, 1});
              }) == 0);
    };
    list->draw(c, walk);
    list->draw(c, walk);

    gnomon::soft_shadow_map<gnomon::rg8, gnomon::box<1>, gl::backend> map({.width = 512, .height = 64}, gl::backend(c));
    REQUIRE_FALSE(map.problem());
    CHECK(test::allocations_in([&map] {
              for (int i = 0; i < gl::rectangle_list::capacity; ++i) map.cast({i, 0, i + 1, 1}, 0.5f);
          }) == 0);
}
