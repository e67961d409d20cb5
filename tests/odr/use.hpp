// The ten lines as one function per file that includes this: two files then instantiate the same templates.
#pragma once

#include "all_headers.hpp"

namespace {

struct ten_lines {
    float lit, umbra, penumbra, in_front;
};

ten_lines run_ten_lines() {
    gnomon::soft_shadow_map<gnomon::rg8, gnomon::binomial<3>> map({.width = 512, .height = 512, .tile = 16});
    map.cast({.x0 = 200, .y0 = 200, .x1 = 300, .y1 = 300}, 0.4f);
    map.filter();
    return {map.shadow(10, 10, 0.9f), map.shadow(250, 250, 0.9f), map.shadow(199, 250, 0.9f), map.shadow(250, 250, 0.2f)};
}

} // namespace
