#include <gnomon/gnomon.hpp>
#include <cstdio>
int main() {
    gnomon::soft_shadow_map<gnomon::rg8, gnomon::binomial<3>> map({.width = 512, .height = 512, .tile = 16});
    map.cast({.x0 = 200, .y0 = 200, .x1 = 300, .y1 = 300}, 0.4f);     // a caster at depth 0.4
    map.filter();                                                    // blurs occupied tiles only
    std::printf("lit %.3f umbra %.3f penumbra %.3f in front %.3f\n",
        map.shadow(10, 10, 0.9f), map.shadow(250, 250, 0.9f), map.shadow(199, 250, 0.9f), map.shadow(250, 250, 0.2f));
}   // lit 0.000 umbra 1.000 penumbra 0.345 in front 0.000
