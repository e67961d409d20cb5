// Sparse equals dense, bit for bit: any map, tile, kernel, format, memory layout and rubbish. And dense equals the definition.
#include "bytes.hpp"

#include <gnomon/backend/scalar.hpp>

#include "../support/kernels.hpp"

#include <cstring>
#include <type_traits>
#include <vector>

using namespace gnomon;
using fuzz::demand;

namespace {

/// An image in memory of the engine's own: a pitch, rows up or down, and rubbish between them that must stay.
template <typename Texel> class strided_image {
  public:
    strided_image(extent size, int gap, bool upside_down, std::uint8_t rubbish)
        : size_(size), pitch_(size.width + gap), upside_down_(upside_down), rubbish_(rubbish),
          memory_(static_cast<std::size_t>(pitch_) * static_cast<std::size_t>(size.height) + 1) {
        std::memset(static_cast<void*>(memory_.data()), rubbish_, memory_.size() * sizeof(Texel));
    }
    [[nodiscard]] image_view<Texel> view() {
        const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(sizeof(Texel)) * pitch_;
        Texel* last = memory_.data() + static_cast<std::ptrdiff_t>(pitch_) * greater(size_.height - 1, 0);
        return upside_down_ ? image_view<Texel>(last, size_, -stride) : image_view<Texel>(memory_.data(), size_, stride);
    }
    [[nodiscard]] bool gaps_are_untouched() {
        std::vector<std::uint8_t> rubbish(sizeof(Texel), rubbish_);
        for (int y = 0; y < size_.height; ++y)
            for (int x = size_.width; x < pitch_; ++x)
                if (std::memcmp(&view().row(y)[x], rubbish.data(), sizeof(Texel)) != 0) return false;
        return std::memcmp(&memory_.back(), rubbish.data(), sizeof(Texel)) == 0;
    }

  private:
    extent size_;
    int pitch_;
    bool upside_down_;
    std::uint8_t rubbish_;
    std::vector<Texel> memory_;
};

/// A NaN is a NaN: which of its bits survive an addition is the processor's affair.
template <typename Texel> bool same_bits(const Texel& a, const Texel& b) {
    for (int c = 0; c < Texel::channels; ++c) {
        const float p = Texel::channel_type::code(a.stored[c]), q = Texel::channel_type::code(b.stored[c]);
        if (p <= p || q <= q ? std::memcmp(&a.stored[c], &b.stored[c], sizeof a.stored[c]) != 0 : false) return false;
    }
    return true;
}

template <typename Texel> Texel any_caster(fuzz::bytes& in) {
    const float s = in.unit();
    Texel t = Texel::caster(s);
    if constexpr (Texel::effects.translucency) t = Texel::caster(s, in.unit());
    if constexpr (Texel::effects.far_bound) t.bound(in.unit());
    return t;
}
template <typename Texel> Texel any_bits(fuzz::bytes& in) {
    Texel t{};
    for (auto& stored : t.stored) {
        const std::uint32_t word = in.word();
        if constexpr (sizeof stored == sizeof word)
            stored = std::bit_cast<float>(word);
        else
            stored = static_cast<std::remove_reference_t<decltype(stored)>>(word);
    }
    return t;
}

/// sum of w(i) w(j) code(x+i, y+j), rounded once, halves upwards; clear lies off the map. Below 2^49, so exact.
template <typename Texel>
void check_against_definition(image_view<const Texel> from, const test::taps& k, int x, int y, const Texel& filtered) {
    const auto whole_sum = static_cast<std::uint64_t>(k.total) * static_cast<std::uint64_t>(k.total);
    for (int c = 0; c < Texel::channels; ++c) {
        std::uint64_t sum = 0;
        for (int j = -k.radius; j <= k.radius; ++j)
            for (int i = -k.radius; i <= k.radius; ++i) {
                const Texel t = whole(from.size()).contains(x + i, y + j) ? from(x + i, y + j) : Texel::clear();
                sum += static_cast<std::uint64_t>(k.at(i)) * static_cast<std::uint64_t>(k.at(j)) * t.stored[c];
            }
        // |stored whole - sum| <= whole / 2, and not a half below
        const std::uint64_t twice = 2 * sum, nearest = 2 * whole_sum * filtered.stored[c];
        demand(nearest <= twice + whole_sum && twice < nearest + whole_sum,
               "a filtered code is the exact convolution, rounded once");
    }
}

template <typename Texel, kernel Kernel> void run(fuzz::bytes& in) {
    const extent size{in.within(0, 40), in.within(0, 30)};
    const int tile = in.within(1, 24);
    const std::uint8_t rubbish = in.byte();
    const bool hostile = in.flip();
    bool keeps_order = true; // are all texels such as casters leave?
    strided_image<Texel> casters(size, in.within(0, 3), in.flip(), rubbish), soft(size, in.within(0, 3), in.flip(), rubbish);
    casters.view().fill(Texel::clear());
    soft.view().fill(Texel::clear());
    tile_grid tiles(size, tile);
    for (int n = in.within(0, 6); n > 0; --n) {
        const int x = in.within(-5, size.width + 5), y = in.within(-5, size.height + 5);
        const texel_rect r{x, y, x + in.within(-1, 14), y + in.within(-1, 14)};
        const bool bits = hostile && in.flip();
        keeps_order = keeps_order && !bits;
        casters.view().fill(r, bits ? any_bits<Texel>(in) : any_caster<Texel>(in));
        tiles.mark(clip(r, size), Kernel::radius + (in.flip() ? 0 : in.within(-2, 3)));
    }

    // Two scratches, each full of other rubbish.
    filter_scratch<Texel, Kernel> scratch(size.width), own(size.width);
    for (auto& element : scratch.line()) std::memset(&element, rubbish ^ 0x5A, sizeof element);
    for (auto& element : own.line()) std::memset(&element, 0xFF, sizeof element);
    image<Texel> dense(size, Texel::caster(0.25f));
    filter_region(casters.view(), dense.view(), whole(size), own);
    filter(scalar{}, casters.view(), soft.view(), tiles, scratch);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            demand(same_bits(soft.view()(x, y), dense(x, y)), "sparse equals dense, bit for bit");
            if (!keeps_order || std::is_same_v<typename Texel::representation_type, paper_depth_mask>) continue;
            const filtered<Texel> f = read(dense(x, y));
            demand(f.depth() >= 0.0 && f.depth() <= f.mask(), "a filter keeps e <= m");
            if constexpr (Texel::effects.far_bound)
                demand(f.far_bound() <= f.depth(), "a filter keeps the far bound behind its caster");
        }
    demand(casters.gaps_are_untouched() && soft.gaps_are_untouched(), "what lies between the rows is neither read nor written");
    if constexpr (Texel::channel_type::whole_codes && Texel::representation_type::premultiplied)
        if (!size.empty())
            for (int n = 0; n < 4; ++n) {
                const int x = in.within(0, size.width - 1), y = in.within(0, size.height - 1);
                check_against_definition<Texel>(casters.view(), test::taps_of<Kernel>(), x, y, dense(x, y));
            }

    // A part of the map, with a scratch of any width, into an image of any size: what all share is written, and nothing else.
    const extent other{in.flip() ? size.width : in.within(0, 40), in.flip() ? size.height : in.within(0, 30)};
    const int x0 = in.within(-3, 40), y0 = in.within(-3, 30);
    const texel_rect region{x0, y0, x0 + in.within(-1, 50), y0 + in.within(-1, 50)};
    strided_image<Texel> part(other, in.within(0, 3), in.flip(), rubbish);
    const Texel before = any_caster<Texel>(in);
    part.view().fill(before);
    const int width = in.flip() ? size.width : in.within(-1, 12);
    filter_scratch<Texel, Kernel> narrow(width);
    for (auto& element : narrow.line()) std::memset(&element, rubbish, sizeof element);
    {
        const fuzz::wrong_call any_size_and_scratch;
        filter_region(casters.view(), part.view(), region, narrow);
    }
    const texel_rect written = narrow.line().size() > 2 * std::size_t{Kernel::radius} * std::size_t{Texel::channels}
                                   ? clip(clip(region, other), size)
                                   : texel_rect{};
    for (int y = 0; y < other.height; ++y)
        for (int x = 0; x < other.width; ++x)
            demand(same_bits(part.view()(x, y), written.contains(x, y) ? dense(x, y) : before),
                   "a region has the bits of the whole, and what is outside is left alone");
    demand(part.gaps_are_untouched(), "a region writes nothing between the rows");

    clear_tiles(soft.view(), tiles);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            demand(tiles.guard() < Kernel::radius || same_bits(soft.view()(x, y), Texel::clear()),
                   "clearing the tiles clears all that was filtered");
}

template <typename Texel> void with_format(fuzz::bytes& in) {
    switch (in.within(0, 3)) {
    case 0: return run<Texel, box<0>>(in);
    case 1: return run<Texel, box<1>>(in);
    case 2: return run<Texel, binomial<3>>(in);
    default: return run<Texel, gaussian<8>>(in);
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::bytes in(data, size);
    switch (in.within(0, 5)) {
    case 0: with_format<rg8>(in); break;
    case 1: with_format<rgba16>(in); break;
    case 2: with_format<rg16f>(in); break;
    case 3: with_format<rgb32f>(in); break;
    case 4: with_format<texel<unorm16, depth_ratio, effects{.far_bound = true}>>(in); break;
    default: with_format<texel<unorm8, paper_depth_mask>>(in);
    }
    return 0;
}
