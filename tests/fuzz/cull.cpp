// Culling never loses a shadow: frame after frame, a receiver that is culled is lit at every texel and between them.
#include "bytes.hpp"

#include <gnomon/soft_shadow_map.hpp>

using namespace gnomon;
using fuzz::demand;

namespace {

/// A depth in [0, 1], or anything.
float any_depth(fuzz::bytes& in) { return in.within(0, 3) > 0 ? in.unit() : in.any_float(); }

template <typename Map> void cast(Map& map, fuzz::bytes& in) {
    const int x = in.within(-12, 60), y = in.within(-12, 50);
    const texel_rect r{x, y, x + in.within(-1, 14), y + in.within(-1, 14)};
    const float s = any_depth(in);
    if (in.flip()) return map.cast(r, s);
    // The way of an engine that draws for itself: some texels of the rectangle, no two of them at the same depth.
    const float step = in.unit() / 32.0f;
    using Texel = typename decltype(map.soft())::element_type;
    map.cast([&](auto texels) {
        struct {
            texel_rect texels;
            depth_interval depth;
        } touched{};
        const texel_rect inside = clip(r, map.size());
        float depth = saturate(s);
        for (int j = inside.y0; j < inside.y1; ++j)
            for (int i = inside.x0; i < inside.x1; i += 1 + (j & 1)) {
                texels(i, j).cast(std::remove_const_t<Texel>::caster(depth));
                touched.texels = union_box(touched.texels, {i, j, i + 1, j + 1});
                touched.depth.include({depth, depth});
                depth = depth + step < 1.0f ? depth + step : saturate(s);
            }
        return touched;
    });
}

template <typename Map> void receive(Map& map, fuzz::bytes& in) {
    const int x = in.within(-12, 60), y = in.within(-12, 50);
    const texel_rect footprint{x, y, x + in.within(0, 9), y + in.within(0, 9)};
    const float farthest = any_depth(in), nearest = in.flip() ? farthest : any_depth(in);
    const depth_interval depth{nearest, farthest};
    map.decision = {.caster = {in.one_of({bias_towards::light, bias_towards::light, bias_towards::none, bias_towards::shadow}),
                               in.within(1, 3), in.flip() ? 0.0f : 2.0f * in.unit() - 1.0f},
                    .lit_beyond = in.flip()};
    const bool reached = map.reaches(footprint, depth), by_tiles = casters_reach(map.tiles().tiles(), footprint);
    demand(!footprint.empty() || !reached, "an empty receiver is reached by nothing");
    demand(by_tiles || !reached, "whoever knows the depths as well culls no less");
    demand(map.reaches(footprint) == by_tiles, "a receiver of unknown depth is culled by tiles alone");
    if (reached || footprint.empty()) return;

    const float between = nearest + (farthest - nearest) * in.unit();
    const float depths[] = {nearest, farthest, between >= nearest && between <= farthest ? between : farthest,
                            by_tiles ? farthest : in.any_float()};
    for (const float z : depths) {
        for (int j = footprint.y0; j < footprint.y1; ++j)
            for (int i = footprint.x0; i < footprint.x1; ++i)
                demand(map.shadow(i, j, z) <= 0.0f, "a culled receiver is lit at every texel");
        for (int n = 0; n < 12; ++n) {
            const auto inside = [&in](int first, int last) { // to 1/64 texel, both ends included
                return static_cast<float>(first) + static_cast<float>(in.within(0, 64 * (last - first))) / 64.0f;
            };
            const float px = inside(footprint.x0, footprint.x1), py = inside(footprint.y0, footprint.y1);
            demand(map.shadow_at(px, py, z) <= 0.0f, "a culled receiver is lit between the texels");
        }
    }
}

template <typename Texel, kernel Kernel> void run(fuzz::bytes& in) {
    soft_shadow_map<Texel, Kernel> map({.width = in.within(0, 48), .height = in.within(0, 40), .tile = in.within(1, 20)});
    for (int frame = 0; frame < 3 && !in.empty(); ++frame) {
        if (frame > 0) map.clear();
        for (int n = in.within(0, 4); n > 0; --n) cast(map, in);
        if constexpr (Texel::effects.far_bound)
            for (int n = in.within(0, 2); n > 0; --n) {
                const int x = in.within(-5, 48), y = in.within(-5, 40);
                map.bound({x, y, x + in.within(0, 30), y + in.within(0, 30)}, any_depth(in));
            }
        map.filter();
        for (int n = in.within(1, 12); n > 0; --n) receive(map, in);
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::bytes in(data, size);
    switch (in.within(0, 7)) {
    case 0: run<rg8, binomial<3>>(in); break;
    case 1: run<rg8, box<0>>(in); break;
    case 2: run<rg16, tent<1>>(in); break;
    case 3: run<rg16f, binomial<2>>(in); break;
    case 4: run<rg32f, gaussian<4>>(in); break;
    case 5: run<rgba8, box<2>>(in); break;
    case 6: run<rgb32f, binomial<1>>(in); break;
    default: run<texel<unorm8, paper_depth_mask>, binomial<3>>(in);
    }
    return 0;
}
