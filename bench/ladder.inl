// What other techniques ask of a receiver in rows, in the same lanes: what their accuracy costs beside ours. Blurs are not counted, of which
// percentage closer filtering needs none. Included once for each target, inside its region; LADDER_ON names the namespace.

namespace ladder::LADDER_ON {

/// Variance shadow maps (Donnelly and Lauritzen 2006): pairs of the mean and the mean square of depths, Chebyshev's bound.
template <typename Isa> void vsm(const float* pairs, const float* z, float* to, int count) {
    const auto most = Isa::repeat(-1e-6f); // the least variance, less than nothing
    for (int i = 0; i < count; i += Isa::float_lanes) {
        const auto mean = Isa::template codes_of<gnomon::float32, 2>(pairs + 2 * i, 0), depth = Isa::load(z + i);
        const auto square = Isa::template codes_of<gnomon::float32, 2>(pairs + 2 * i, 1), behind = Isa::subtract(depth, mean);
        const auto variance = Isa::lesser(Isa::subtract(Isa::multiply(mean, mean), square), most); // times -1
        const auto distance = Isa::multiply(behind, behind);
        Isa::store(to + i, Isa::keep(Isa::greater(depth, mean), Isa::divide(distance, Isa::subtract(distance, variance))));
    }
}

/// Percentage closer filtering: the share of Taps x Taps depths that are nearer than the receiver. As many rows of the map as it takes lie
/// from `map` on, `stride` floats apart.
template <typename Isa, int Taps> void pcf(const float* map, int stride, const float* z, float* to, int count) {
    const auto one = Isa::repeat(1.0f), share = Isa::repeat(1.0f / (Taps * Taps));
    for (int i = 0; i < count; i += Isa::float_lanes) {
        const auto depth = Isa::load(z + i);
        typename Isa::floats sum[static_cast<std::size_t>(Taps)]; // of the columns, so that no sum waits for another
        GNOMON_UNROLL(8)
        for (int x = 0; x < Taps; ++x) sum[x] = Isa::keep(Isa::greater(depth, Isa::load(map + x + i)), one);
        GNOMON_UNROLL(8)
        for (int y = 1; y < Taps; ++y) {
            GNOMON_UNROLL(8)
            for (int x = 0; x < Taps; ++x)
                sum[x] = Isa::add(sum[x], Isa::keep(Isa::greater(depth, Isa::load(map + y * stride + x + i)), one));
        }
        GNOMON_UNROLL(8)
        for (int x = 1; x < Taps; ++x) sum[0] = Isa::add(sum[0], sum[x]);
        Isa::store(to + i, Isa::multiply(sum[0], share));
    }
}

} // namespace ladder::LADDER_ON
