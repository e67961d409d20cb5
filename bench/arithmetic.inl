// Arithmetic in registers alone, which no filter can be quicker than. Included once for each target, inside its region; ARITHMETIC_ON
// names the namespace.

namespace floors::ARITHMETIC_ON {

inline constexpr int chains = 8; // more than the processor needs to have one step begun while others go on

/// As if somebody asked for them; the chains themselves stay in registers.
template <typename... Numbers> void keep(Numbers... sums) { (benchmark::DoNotOptimize(sums), ...); }

/// So many sums of products of pairs of 16 bits.
template <typename Isa> void products(std::int64_t count) {
    auto pair = Isa::repeat32(0x00010001);
    Isa::settle(pair);
    typename Isa::ints sum[chains] = {pair, pair, pair, pair, pair, pair, pair, pair};
    for (std::int64_t i = 0; i < count; i += chains) {
        GNOMON_UNROLL(8)
        for (int k = 0; k < chains; ++k) {
            Isa::settle(pair); // so each product is made
            sum[k] = Isa::add_dot16(sum[k], pair, pair);
            Isa::settle(sum[k]);
        }
    }
    keep(sum[0], sum[1], sum[2], sum[3], sum[4], sum[5], sum[6], sum[7]);
}

/// So many sums of floats.
template <typename Isa> void sums(std::int64_t count) {
    auto one = Isa::repeat(1.0f);
    Isa::settle(one);
    typename Isa::floats sum[chains] = {one, one, one, one, one, one, one, one};
    for (std::int64_t i = 0; i < count; i += chains) {
        GNOMON_UNROLL(8)
        for (int k = 0; k < chains; ++k) {
            sum[k] = Isa::add(sum[k], one);
            Isa::settle(sum[k]);
        }
    }
    keep(sum[0], sum[1], sum[2], sum[3], sum[4], sum[5], sum[6], sum[7]);
}

} // namespace floors::ARITHMETIC_ON
