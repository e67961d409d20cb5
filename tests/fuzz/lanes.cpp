// Receivers in lanes against the scalar loop, bit for bit: any texels, depths and rule, in rows and anywhere on a map.
#include "bytes.hpp"

#include <gnomon/backend/reconstruct.hpp>

#include <concepts>
#include <cstring>
#include <vector>

using namespace gnomon;
using fuzz::demand;

namespace {

#if GNOMON_X86
using lanes = sse2; // which every processor has
#else
using lanes = emulated<16>;
#endif

/// No finite number beyond 2^20: before receivers beyond 2^24 lanes may decide otherwise of pairs that no caster is.
float any_near(fuzz::bytes& in) {
    const float v = in.any_float();
    return v > 0x1p20f ? test::infinity<float> : (v < -0x1p20f ? -test::infinity<float> : v);
}

template <typename Texel> typename Texel::storage any_number(fuzz::bytes& in) {
    using storage = typename Texel::storage;
    if constexpr (std::same_as<storage, float>) {
        return in.flip() ? in.unit() : in.any_float();
    } else {
        const int kind = in.within(0, 3);
        if (kind == 0) { // least numbers, of halves those less than nothing too
            const bool below = !Texel::channel_type::whole_codes && in.flip();
            return static_cast<storage>(in.within(0, 3) + (below ? 0x8000 : 0));
        }
        return kind == 1 ? static_cast<storage>(in.word()) : Texel::channel_type::encode(static_cast<double>(in.unit()));
    }
}
template <typename Texel> Texel any_texel(fuzz::bytes& in) {
    Texel t = Texel::clear();
    const std::uint8_t kind = in.byte();
    if (kind < 32) return t;
    for (auto& stored : t.stored) stored = any_number<Texel>(in);
    if (kind < 64) t.stored[Texel::depth_index] = t.stored[Texel::mask_index];
    if constexpr (Texel::effects.far_bound)
        if (kind % 4 == 0) t.stored[Texel::far_index] = t.stored[Texel::depth_index];
    return t;
}

bias any_bias(fuzz::bytes& in) {
    return {.towards = in.one_of({bias_towards::light, bias_towards::none, bias_towards::shadow}),
            .roundings = in.one_of({0, 1, 1, 2, 3, 5, 128, 129, 1000}),
            .depth = in.flip() ? 0.0f : any_near(in),
            .caster_is_code = in.flip()};
}
rule any_rule(fuzz::bytes& in) {
    return {.caster = any_bias(in),
            .far_bound = any_bias(in),
            .fade = in.one_of({0.0f, 0.25f, 0x1p-20f, in.any_float()}),
            .lit_beyond = in.flip()};
}

/// Any depth, or one within a few floats of where the shadow of a texel or a sample begins or ends.
template <typename Texel> float any_depth(fuzz::bytes& in, const filtered<Texel>& f, const rule& r) {
    const int kind = in.within(0, 3);
    if (kind == 0) return any_near(in);
    double e = f.depth();
    if constexpr (Texel::effects.far_bound)
        if (kind == 1) e = f.far_bound();
    float z = static_cast<float>(1.0 - e / f.mask());
    if (kind == 1 && r.fade < 1.0f) z += r.fade * in.unit();
    for (int step = in.within(-2, 2); step != 0; step += step > 0 ? -1 : 1) z = step > 0 ? test::up(z) : test::down(z);
    return z > -0x1p20f && z < 0x1p20f ? z : 0.5f;
}
template <typename Depth> Depth stored(fuzz::bytes& in, float z) {
    if constexpr (std::same_as<Depth, float>)
        return z;
    else
        return static_cast<Depth>(unorm16::encode(static_cast<double>(z)) + in.within(-1, 1));
}

template <typename Intensity> void demand_the_same(const std::vector<Intensity>& made, const std::vector<Intensity>& expected) {
    demand(std::memcmp(made.data(), expected.data(), made.size() * sizeof(Intensity)) == 0, "lanes have the scalar loop's bits");
}

template <typename Texel, typename Depth, typename Intensity> void row(fuzz::bytes& in) {
    const rule r = any_rule(in);
    const auto count = static_cast<std::size_t>(in.within(1, 18));
    std::vector<Texel> texels(count);
    std::vector<Depth> z(count);
    for (std::size_t i = 0; i < count; ++i) {
        texels[i] = i > 0 && in.empty() ? texels[i - 1] : any_texel<Texel>(in);
        z[i] = stored<Depth>(in, any_depth(in, read(texels[i]), r));
    }
    std::vector<Intensity> expected(count), made(count, Intensity(77));
    receive(texels, z, expected, r);
    reconstruct<lanes>(texels, z, made, r);
    demand_the_same(made, expected);
}

template <typename Texel, typename Depth, typename Intensity> void points(fuzz::bytes& in) {
    const rule r = any_rule(in);
    const extent size{in.within(1, 4), in.within(1, 3)};
    std::vector<Texel> texels(static_cast<std::size_t>(size.width * size.height)); // of their very size, for address sanitizers
    for (Texel& t : texels) t = any_texel<Texel>(in);
    const image_view<const Texel> map(texels.data(), size);
    const auto count = static_cast<std::size_t>(in.within(1, 9));
    std::vector<float> x(count), y(count);
    std::vector<Depth> z(count);
    const auto position = [&in](int side) {
        return in.within(0, 15) == 0 ? in.any_float() : static_cast<float>(in.within(-512, (side + 2) * 256)) / 256.0f;
    };
    for (std::size_t i = 0; i < count; ++i) {
        x[i] = position(size.width);
        y[i] = position(size.height);
        z[i] = stored<Depth>(in, any_depth(in, sample(map, x[i], y[i]), r));
    }
    std::vector<Intensity> expected(count), made(count, Intensity(77));
    receive(map, x, y, z, expected, r);
    reconstruct<lanes>(map, strided_span<const float>(x), strided_span<const float>(y), z, made, r);
    demand_the_same(made, expected);
}

template <typename Texel> void receivers(fuzz::bytes& in) {
    const bool in_rows = in.flip();
    switch (in.within(0, 2)) {
    case 0: return in_rows ? row<Texel, float, float>(in) : points<Texel, float, float>(in);
    case 1: return in_rows ? row<Texel, float, std::uint16_t>(in) : points<Texel, float, std::uint16_t>(in);
    default: return in_rows ? row<Texel, std::uint16_t, std::uint8_t>(in) : points<Texel, std::uint16_t, std::uint8_t>(in);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::bytes in(data, size);
    switch (in.within(0, 8)) {
    case 0: receivers<rgb8>(in); break;
    case 1: receivers<rg16>(in); break;
    case 2: receivers<rgba16>(in); break;
    case 3: receivers<rga16f>(in); break;
    case 4: receivers<rg32f>(in); break;
    case 5: receivers<rgba32f>(in); break;
    case 6: receivers<rg8>(in); break;
    case 7: receivers<tm8>(in); break;
    default: receivers<tm16>(in); break;
    }
    return 0;
}
