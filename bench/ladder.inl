// What other techniques ask of a receiver in rows, in the same lanes: what their accuracy costs beside ours. Included once for each target,
// inside its region; LADDER_ON names the namespace.

namespace ladder::LADDER_ON {

/// Variance shadow maps (Donnelly and Lauritzen 2006): pairs of the mean and the mean square of depths, Chebyshev's bound.
template <typename Isa> void vsm(const float* pairs, const float* z, float* to, int count) {
    const auto one = Isa::repeat(1.0f), least = Isa::repeat(1e-6f);
    for (int i = 0; i < count; i += Isa::float_lanes) {
        const auto mean = Isa::template codes_of<gnomon::float32, 2>(pairs + 2 * i, 0);
        const auto square = Isa::template codes_of<gnomon::float32, 2>(pairs + 2 * i, 1), depth = Isa::load(z + i);
        const auto variance = Isa::subtract(square, Isa::multiply(mean, mean)), behind = Isa::subtract(depth, mean);
        const auto at_least = Isa::subtract(
            Isa::repeat(0.0f), Isa::lesser(Isa::subtract(Isa::repeat(0.0f), variance), Isa::subtract(Isa::repeat(0.0f), least)));
        const auto lit = Isa::divide(at_least, Isa::add_product(at_least, behind, behind));
        Isa::store(to + i, Isa::keep(Isa::greater(depth, mean), Isa::subtract(one, lit)));
    }
}

/// Percentage closer filtering: the share of (2 radius + 1)^2 depths that are nearer than the receiver. As many rows of the map as it
/// takes lie from `map` on, `stride` floats apart.
template <typename Isa> void pcf(const float* map, int stride, int radius, const float* z, float* to, int count) {
    const int taps = 2 * radius + 1;
    const auto share = Isa::repeat(1.0f / static_cast<float>(taps * taps));
    for (int i = 0; i < count; i += Isa::float_lanes) {
        const auto depth = Isa::load(z + i);
        auto sum = Isa::repeat(0.0f);
        for (int y = 0; y < taps; ++y)
            for (int x = 0; x < taps; ++x)
                sum = Isa::add(sum, Isa::keep(Isa::greater(depth, Isa::load(map + y * stride + x + i)), share));
        Isa::store(to + i, sum);
    }
}

} // namespace ladder::LADDER_ON
