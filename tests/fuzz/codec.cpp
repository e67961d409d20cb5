// One number, one texel or one decision at a time, against arithmetic without rounding.
#include "bytes.hpp"

#include <gnomon/receive/decide.hpp>
#include <gnomon/receive/lightmap.hpp>

#include "../support/bits.hpp"
#include "../support/exact.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

using namespace gnomon;
using fuzz::demand;
using test::exact_sum;

namespace {

constexpr effects all{.far_bound = true, .translucency = true};

// --- channels ---------------------------------------------------------------------------------------------------------------

/// The value of a half, by its definition, and of the first one that would follow the largest.
double half_value(unsigned h) {
    const int exponent = static_cast<int>(h >> 10 & 0x1F), fraction = static_cast<int>(h & 0x3FF);
    return exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
}

void half(fuzz::bytes& in) {
    constexpr unsigned infinity = 0x7C00, sign = 0x8000;
    double v = in.any_double();
    if (in.flip()) { // a tie, or what lies beside one
        const unsigned h = in.word() % infinity;
        v = (half_value(h) + half_value(h + 1)) / 2.0;
        v = in.one_of({test::down(v), v, test::up(v)});
        if (in.flip()) v = -v;
    }
    const unsigned h = half_from(v);
    demand(((h & sign) != 0) == std::signbit(v) || test::is_nan(v), "a half keeps the sign");
    const unsigned magnitude = h & ~sign;
    if (test::is_nan(v)) return demand(magnitude == 0x7E00, "NaN is a quiet NaN");
    const double own = std::abs(v);
    demand(magnitude <= infinity, "a number is no NaN");
    const double above = magnitude == infinity ? test::infinity<double> : (half_value(magnitude) + half_value(magnitude + 1)) / 2.0;
    const double below = magnitude == 0 ? -1.0 : (half_value(magnitude - 1) + half_value(magnitude)) / 2.0;
    const bool even = (magnitude & 1) == 0;
    demand(even ? own >= below && own <= above : own > below && own < above, "a half is the nearest one, ties to even");

    const auto any = static_cast<std::uint16_t>(in.word());
    const float value = half_to_float(any);
    if ((any & ~sign) > infinity) return demand(test::is_nan(value), "a NaN is read as NaN");
    const double defined = (any & ~sign) == infinity ? test::infinity<double> : half_value(any & ~sign);
    demand(test::same_bits(static_cast<double>(value), (any & sign) != 0 ? -defined : defined), "a half is read as what it is");
}

/// Is what `encode` made of a float in [0, 1] the nearest there is?
template <channel C> bool is_nearest(typename C::storage stored, float v) {
    if constexpr (C::whole_codes) { // 2c - 1 <= 2 scale v < 2c + 1
        const double code = stored, twice = 2.0 * static_cast<double>(C::scale), value = static_cast<double>(v);
        return exact_sum{}.add_product(twice, value).add(1.0 - 2.0 * code).sign() >= 0 &&
               exact_sum{}.add_product(twice, value).add(-1.0 - 2.0 * code).sign() < 0;
    } else if constexpr (std::is_same_v<C, half16>) {
        return stored == half_from(static_cast<double>(v)); // which has its own oracle
    } else {
        return test::equal(stored, v);
    }
}

template <channel C> void one_channel(fuzz::bytes& in) {
    const float v = in.any_float();
    const auto stored = C::encode(static_cast<double>(v));
    const float limited = v > 0.0f ? (v < 1.0f ? v : 1.0f) : 0.0f, decoded = C::decode(stored);
    demand(is_nearest<C>(stored, limited), "encode takes the nearest");
    demand(exact_sum{}.add(static_cast<double>(decoded))
                       .add(-static_cast<double>(limited))
                       .add(-static_cast<double>(C::max_error))
                       .sign() <= 0 &&
               exact_sum{}
                       .add(static_cast<double>(limited))
                       .add(-static_cast<double>(decoded))
                       .add(-static_cast<double>(C::max_error))
                       .sign() <= 0,
           "max_error");
    demand(test::equal(C::decode(C::encode(static_cast<double>(decoded))), decoded), "what was read is stored again as it was");

    const double a = in.any_double(), b = in.any_double();
    if (a <= b) demand(C::code(C::encode(a)) <= C::code(C::encode(b)), "encode is monotone");
    if constexpr (C::whole_codes) {
        const auto code = static_cast<typename C::storage>(in.word());
        demand(C::encode(static_cast<double>(C::decode(code))) == code, "every code comes back");
        demand(test::equal(C::code(code), static_cast<float>(code)), "a code is the number that is stored");
        const double value = static_cast<double>(C::decode(code)), whole = code;
        const auto beside = [&](float other) { // twice the code against the middle, times scale
            return exact_sum{}
                .add_product((value + static_cast<double>(other)) / 2.0, static_cast<double>(C::scale))
                .add(-whole)
                .sign();
        };
        demand(beside(test::down(C::decode(code))) <= 0 && beside(test::up(C::decode(code))) >= 0, "decode is correctly rounded");
        const int half_codes = in.within(0, 2 * static_cast<int>(C::scale));
        demand(C::store(half_codes / 2.0) == static_cast<typename C::storage>(half_codes / 2 + half_codes % 2),
               "store rounds halves upwards");
    }
}

// --- texels -----------------------------------------------------------------------------------------------------------------

/// Casters, then receivers, in two orders: one texel, and by definition.
template <texel_format Texel> void cast_and_bound(fuzz::bytes& in) {
    using channel_type = typename Texel::channel_type;
    using representation_type = typename Texel::representation_type;
    struct surface {
        float z, opacity;
    };
    std::vector<surface> casters, receivers;
    for (int n = in.within(0, 4); n > 0; --n) casters.push_back({in.any_float(), in.any_float()});
    for (int n = in.within(0, 4); n > 0; --n) receivers.push_back({in.any_float(), 1.0f});
    const auto draw = [&] {
        Texel t = Texel::clear();
        for (const surface& c : casters)
            if constexpr (Texel::effects.translucency)
                t.cast(Texel::caster(c.z, c.opacity));
            else
                t.cast(Texel::caster(c.z));
        if constexpr (Texel::effects.far_bound)
            for (const surface& r : receivers) t.bound(r.z);
        return t;
    };
    const auto stored = [](float z) { return channel_type::code(representation_type::template encode<channel_type>(z)); };

    const Texel drawn = draw();
    demand(drawn.occupied() == !casters.empty(), "a texel is occupied if something was cast");
    if (!casters.empty()) {
        float nearest = stored(casters[0].z), faintest = 0.0f;
        for (const surface& c : casters)
            if (representation_type::nearer(stored(c.z), nearest)) nearest = stored(c.z);
        for (const surface& c : casters)
            if (test::equal(stored(c.z), nearest))
                faintest = std::max(faintest, channel_type::code(channel_type::encode(static_cast<double>(c.opacity))));
        demand(test::equal(channel_type::code(drawn.stored[Texel::depth_index]), nearest), "the nearest caster stays");
        demand(test::equal(channel_type::code(drawn.stored[Texel::mask_index]), channel_type::scale), "its mask is one");
        if constexpr (Texel::effects.translucency)
            demand(test::equal(channel_type::code(drawn.stored[Texel::contribution_index]), faintest),
                   "of equally near ones the most opaque");
        if constexpr (Texel::effects.far_bound) {
            float bound = channel_type::code(Texel::clear().stored[Texel::far_index]);
            for (const surface& r : receivers)
                if (!representation_type::nearer(stored(r.z), nearest) && representation_type::nearer(stored(r.z), bound))
                    bound = stored(r.z);
            demand(test::equal(channel_type::code(drawn.stored[Texel::far_index]), bound),
                   "the nearest receiver not before the caster bounds it");
        }
    }
    for (std::vector<surface>* order : {&casters, &receivers})
        for (std::size_t i = order->size(); i > 1; --i) std::swap((*order)[i - 1], (*order)[in.byte() % i]);
    demand(draw() == drawn, "the order of casters and receivers does not show");
}

// --- decisions --------------------------------------------------------------------------------------------------------------

template <texel_format Texel> Texel any_texel(fuzz::bytes& in) {
    using storage = typename Texel::storage;
    Texel t{};
    for (storage& s : t.stored)
        if constexpr (std::is_floating_point_v<storage>)
            s = in.any_float();
        else
            s = static_cast<storage>(in.flip() ? in.word() : in.byte());
    return t;
}

bias any_bias(fuzz::bytes& in) {
    return {in.one_of({bias_towards::light, bias_towards::none, bias_towards::shadow}),
            in.flip() ? 1 : in.within(-2147483647, 2147483647), in.flip() ? 0.0f : in.any_float(), in.flip()};
}

/// Whatever is stored and asked, and under whatever rule.
template <texel_format Texel> void guarded(fuzz::bytes& in) {
    const Texel t = any_texel<Texel>(in);
    const rule r{any_bias(in), any_bias(in), in.flip() ? 0.0f : in.any_float(), in.flip()};
    const float z = in.any_float(), intensity = shadow(t, z, r), s = caster_depth(t);
    demand(intensity >= 0.0f && intensity <= 1.0f, "an intensity lies in [0, 1]");
    demand(s >= 0.0f && s <= 1.0f, "a caster's depth lies in [0, 1]");
    demand(intensity <= 0.0f || (read(t).mask() > 0.0 && z > 0.0f),
           "an empty texel is lit, and so is what is not behind the near plane");
}

/// A pair with e <= m, as filters leave it, against e > m (1-z) without rounding.
template <channel C> void decided(fuzz::bytes& in) {
    using Texel = texel<C>;
    Texel t = any_texel<Texel>(in);
    float e = C::code(t.stored[0]), m = C::code(t.stored[1]);
    if (!(e >= 0.0f && m <= C::scale)) return;
    if (in.flip()) t.stored[0] = t.stored[1], e = m;
    if (!(e <= m)) return;
    float z = in.any_float();
    if (in.flip() && m > 0.0f) z = in.one_of({test::down(caster_depth(t)), caster_depth(t), test::up(caster_depth(t))});
    const bool finite = std::abs(z) < test::infinity<float>;
    const auto truth = [finite](double depth, double mask, float at) {
        return finite ? test::exactly_behind(depth, mask, static_cast<double>(at)) : at > 0.0f;
    };
    const double depth = static_cast<double>(e), mask = static_cast<double>(m);
    const bool asked = m > 0.0f && z > 0.0f;
    const float exact = shadow(t, z, rule{.caster = unbiased});
    demand((exact > 0.0f) == (asked && truth(depth, mask, z)), "a decision on a stored pair is exact");
    demand(exact <= 0.0f || test::equal(exact, static_cast<float>(mask / static_cast<double>(C::scale))),
           "its intensity is the mask");
    if constexpr (C::whole_codes) {
        const int k = in.within(0, 4);
        const bias b{.roundings = k, .caster_is_code = in.flip()};
        const float moved = z - (b.caster_is_code ? 0.0f : caster_depth_error<Texel>.nearer); // in float, as bias.hpp says
        const bool behind = asked && truth(depth - 0.5 * k, mask + 0.5 * k, moved);
        demand((shadow(t, z, rule{.caster = b}) > 0.0f) == behind, "E - k/2 > (M + k/2) (1 - (z - h)), exactly");
    }
    if (m > 0.0f) demand(test::is_nearest_depth(caster_depth(t), e, m), "a caster's depth is correctly rounded");
}

/// An un-premultiplied pair decides by its depth alone, T > N (1-z), and its rounding of a caster goes one way.
template <channel C> void ratio(fuzz::bytes& in) {
    using Texel = texel<C, depth_ratio, all>;
    cast_and_bound<Texel>(in);
    guarded<Texel>(in);
    const auto t = any_texel<texel<C, depth_ratio>>(in);
    const float z = in.any_float(), s = in.any_float();
    if (!(std::abs(z) < test::infinity<float>)) return;
    const bool behind =
        test::exactly_behind(static_cast<double>(C::code(t.stored[0])), static_cast<double>(C::scale), static_cast<double>(z));
    demand((shadow(t, z) > 0.0f) == (C::code(t.stored[1]) > 0.0f && z > 0.0f && behind), "a ratio is decided exactly");
    demand(!(s <= 1.0f) || !(shadow(Texel::caster(s), s) > 0.0f), "a receiver on its caster is lit");
}

void lightmap(fuzz::bytes& in) {
    const float light = in.any_float(), share = in.any_float(), ambient = in.any_float(), left = mask_light(light, share, ambient);
    if (!(light > ambient)) return demand(test::same_bits(left, light), "light under the ambient floor is left alone");
    if (std::isinf(light) || std::isinf(ambient)) return demand(!test::is_nan(left), "infinite light gives no NaN");
    demand(left <= light && left >= ambient, "a shadow makes nothing brighter, and nothing darker than the ambient floor");
    const double s = static_cast<double>(saturate(share)), l = static_cast<double>(light), a = static_cast<double>(ambient);
    if (test::is_nan(share) || share <= 0.0f) demand(test::equal(left, light), "no shadow leaves the light");
    const auto side = [&](float other) { // of light - s (light - ambient)
        if (std::isinf(other)) return other > 0.0f ? -1 : 1;
        return exact_sum{}.add(l).add_product(-s, l).add_product(s, a).add(-static_cast<double>(other)).sign();
    };
    demand(side(test::down(left)) >= 0 && side(test::up(left)) <= 0, "within one ulp of light - shadow (light - ambient)");
}

template <channel C> void with_channel(int what, fuzz::bytes& in) {
    switch (what) {
    case 0: return one_channel<C>(in);
    case 1: return cast_and_bound<texel<C>>(in);
    case 2: return cast_and_bound<texel<C, depth_mask, all>>(in);
    case 3: return cast_and_bound<texel<C, paper_depth_mask, all>>(in);
    case 4: return guarded<texel<C, depth_mask, all>>(in);
    case 5: return guarded<texel<C, paper_depth_mask, all>>(in);
    case 6: return guarded<texel<C>>(in);
    case 7:
        if constexpr (C::whole_codes) return ratio<C>(in);
        [[fallthrough]];
    default: return decided<C>(in);
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::bytes in(data, size);
    for (int step = 0; step < 16 && !in.empty(); ++step) {
        const int what = in.within(0, 8);
        switch (in.within(0, 4)) {
        case 0: with_channel<unorm8>(what, in); break;
        case 1: with_channel<unorm16>(what, in); break;
        case 2: with_channel<half16>(what, in); break;
        case 3: with_channel<float32>(what, in); break;
        default: what < 6 ? half(in) : lightmap(in);
        }
    }
    return 0;
}
