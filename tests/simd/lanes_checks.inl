// The comparison of one set of lanes with `emulated`. Included once for each target, inside its region: no lane may be called from
// outside of it. CHECKS_ON names the namespace.

namespace CHECKS_ON {

template <typename Isa> int differing(const typename Isa::ints& a, const typename gnomon::emulated<Isa::bytes>::ints& b) {
    return std::memcmp(&a, &b, sizeof a) != 0;
}
template <typename Isa> int differing(const typename Isa::doubles& a, const typename gnomon::emulated<Isa::bytes>::doubles& b) {
    return std::memcmp(&a, &b, sizeof a) != 0;
}

/// The same of those that serve running sums.
template <typename Isa> int wrong_sums(const memory* m) {
    using same = gnomon::emulated<Isa::bytes>;
    const auto a = Isa::load(m[0].byte), b = Isa::load(m[1].byte);
    const auto e = same::load(m[0].byte), f = same::load(m[1].byte);
    std::uint8_t bytes[17]{}, expected_bytes[17]{};
    std::uint16_t words[17]{}, expected_words[17]{}, from[16];
    std::memcpy(from, m[2].byte, sizeof from);
    Isa::store_low(bytes, a);
    same::store_low(expected_bytes, e);
    Isa::store_low(words, a);
    same::store_low(expected_words, e);
    const auto shifted = [&]<int Places>() {
        return differing<Isa>(Isa::template shift_up32<Places>(a), same::template shift_up32<Places>(e));
    };
    const auto repeated = [&]<int Count>() {
        return differing<Isa>(Isa::template repeat_last32<Count>(a), same::template repeat_last32<Count>(e));
    };
    int n = (std::memcmp(bytes, expected_bytes, sizeof bytes) != 0) + (std::memcmp(words, expected_words, sizeof words) != 0);
    n += shifted.template operator()<1>() + shifted.template operator()<2>() + shifted.template operator()<3>();
    if constexpr (Isa::float_lanes > 4) n += shifted.template operator()<4>() + shifted.template operator()<6>();
    if constexpr (Isa::float_lanes > 8) n += shifted.template operator()<8>() + shifted.template operator()<12>();
    n += repeated.template operator()<1>() + repeated.template operator()<2>() + repeated.template operator()<3>() +
         repeated.template operator()<4>();
    return n + differing<Isa>(Isa::add32(a, b), same::add32(e, f)) + differing<Isa>(Isa::subtract32(a, b), same::subtract32(e, f)) +
           differing<Isa>(Isa::widen32(m[2].byte), same::widen32(m[2].byte)) +
           differing<Isa>(Isa::widen32(from), same::widen32(from)) +
           differing<Isa>(Isa::template multiply_shift32<28>(a, Isa::both(b, Isa::repeat32(0x0FFFFFFF))),
                          same::template multiply_shift32<28>(e, same::both(f, same::repeat32(0x0FFFFFFF)))) +
           differing<Isa>(Isa::template multiply_shift32<32>(a, b), same::template multiply_shift32<32>(e, f)) +
           differing<Isa>(Isa::template multiply_shift32<45>(a, b), same::template multiply_shift32<45>(e, f));
}

/// The same of those that only some lanes have.
template <typename Isa> int wrong_fours(const memory* m) {
    int n = 0;
    if constexpr (gnomon::straddles<Isa>) { // a register that is cut out of two is what lies there in memory
        const auto straddles_wrongly = [m]<typename Number>(Number) {
            constexpr int lanes = Isa::bytes / static_cast<int>(sizeof(Number));
            Number both[static_cast<std::size_t>(2 * lanes)], cut[static_cast<std::size_t>(lanes)];
            std::memcpy(both, m[0].byte, sizeof cut);
            std::memcpy(both + lanes, m[1].byte, sizeof cut);
            const auto low = Isa::load(both), high = Isa::load(both + lanes);
            const auto wrong = [&]<int Places>() {
                Isa::store(cut, Isa::template straddle<Places>(low, high));
                return std::memcmp(cut, both + Places, sizeof cut) != 0;
            };
            return [&]<int... I>(std::integer_sequence<int, I...>) {
                return (wrong.template operator()<I + 1>() + ...);
            }(std::make_integer_sequence<int, lanes - 1>{});
        };
        n += straddles_wrongly(0.0f) + straddles_wrongly(0.0);
    }
    if constexpr (gnomon::sums_quads<Isa>) {
        using same = gnomon::emulated<Isa::bytes>;
        const auto a = Isa::load(m[0].byte), b = Isa::load(m[1].byte), c = Isa::load(m[2].byte);
        const auto e = same::load(m[0].byte), f = same::load(m[1].byte), g = same::load(m[2].byte);
        n += differing<Isa>(Isa::add_dot8(a, b, c), same::add_dot8(e, f, g));
    }
    return n;
}

/// How many operations on whole numbers answer otherwise.
template <typename Isa> int wrong_ints(const memory* m) {
    using same = gnomon::emulated<Isa::bytes>;
    const auto a = Isa::load(m[0].byte), b = Isa::load(m[1].byte), c = Isa::load(m[2].byte);
    const auto e = same::load(m[0].byte), f = same::load(m[1].byte), g = same::load(m[2].byte);
    std::uint32_t word;
    std::memcpy(&word, m[0].byte, sizeof word);
    // Two weights that sum to at most 256, as a kernel's do.
    const std::uint32_t pair = (word & 0xFF) | (256 - (word & 0xFF)) % 256 << 8, weights = pair | pair << 16;
    memory below_2_24[4] = {m[0], m[1], m[2], m[3]};
    for (memory& each : below_2_24)
        for (int i = 3; i < 64; i += 4) each.byte[i] = 0;
    memory stored, bytes_in_words = m[1];
    for (int i = 1; i < 64; i += 2) bytes_in_words.byte[i] = 0;
    alignas(64) unsigned char streamed[64];
    Isa::store(stored.byte, a);
    Isa::stream(streamed, a);
    Isa::fence();
    return differing<Isa>(a, e) + (std::memcmp(stored.byte, m[0].byte, static_cast<std::size_t>(Isa::bytes)) != 0) +
           (std::memcmp(streamed, m[0].byte, static_cast<std::size_t>(Isa::bytes)) != 0) +
           differing<Isa>(Isa::repeat32(word), same::repeat32(word)) +
           differing<Isa>(Isa::exclusive_or(a, b), same::exclusive_or(e, f)) +
           differing<Isa>(Isa::even_pairs8(a, b), same::even_pairs8(e, f)) +
           differing<Isa>(Isa::odd_pairs8(a, b), same::odd_pairs8(e, f)) +
           differing<Isa>(Isa::multiply_pairs8(Isa::repeat32(weights), b), same::multiply_pairs8(same::repeat32(weights), f)) +
           differing<Isa>(Isa::add16(a, b), same::add16(e, f)) + differing<Isa>(Isa::add_dot16(a, b, c), same::add_dot16(e, f, g)) +
           differing<Isa>(Isa::interleave_byte2(Isa::load(below_2_24[0].byte), Isa::load(below_2_24[1].byte),
                                                Isa::load(below_2_24[2].byte), Isa::load(below_2_24[3].byte)),
                          same::interleave_byte2(same::load(below_2_24[0].byte), same::load(below_2_24[1].byte),
                                                 same::load(below_2_24[2].byte), same::load(below_2_24[3].byte))) +
           differing<Isa>(Isa::low_pairs8(a, b), same::low_pairs8(e, f)) +
           differing<Isa>(Isa::high_pairs8(a, b), same::high_pairs8(e, f)) +
           differing<Isa>(Isa::low_pairs16(a, b), same::low_pairs16(e, f)) +
           differing<Isa>(Isa::high_pairs16(a, b), same::high_pairs16(e, f)) +
           differing<Isa>(Isa::first_half(a, b), same::first_half(e, f)) +
           differing<Isa>(Isa::second_half(a, b), same::second_half(e, f)) +
           differing<Isa>(Isa::template shift_right32<15>(a), same::template shift_right32<15>(e)) +
           differing<Isa>(Isa::narrow32(Isa::template shift_right32<16>(a), Isa::template shift_right32<16>(b)),
                          same::narrow32(same::template shift_right32<16>(e), same::template shift_right32<16>(f))) +
           differing<Isa>(Isa::narrow16(Isa::load(bytes_in_words.byte), Isa::load(bytes_in_words.byte)),
                          same::narrow16(same::load(bytes_in_words.byte), same::load(bytes_in_words.byte))) +
           differing<Isa>(Isa::even_words(a, b), same::even_words(e, f)) +
           differing<Isa>(Isa::odd_words(a, b), same::odd_words(e, f)) +
           differing<Isa>(Isa::even_lanes(a, b), same::even_lanes(e, f)) +
           differing<Isa>(Isa::odd_lanes(a, b), same::odd_lanes(e, f)) +
           differing<Isa>(Isa::low_pairs32(a, b), same::low_pairs32(e, f)) +
           differing<Isa>(Isa::high_pairs32(a, b), same::high_pairs32(e, f)) +
           differing<Isa>(Isa::template join_words<15>(a, b), same::template join_words<15>(e, f)) + wrong_sums<Isa>(m) +
           wrong_fours<Isa>(m);
}

/// The same for numbers of 16 bits, which the dice make equal or all but equal often enough.
template <typename Isa> int wrong_words(const memory* m) {
    using same = gnomon::emulated<Isa::bytes>;
    const auto a = Isa::load(m[0].byte), b = Isa::load(m[1].byte), c = Isa::load(m[2].byte), d = Isa::load(m[3].byte);
    const auto e = same::load(m[0].byte), f = same::load(m[1].byte), g = same::load(m[2].byte), h = same::load(m[3].byte);
    const auto a8 = Isa::template shift_right16<8>(a), b8 = Isa::template shift_right16<8>(b);
    const auto e8 = same::template shift_right16<8>(e), f8 = same::template shift_right16<8>(f);
    return differing<Isa>(Isa::either(a, b), same::either(e, f)) + differing<Isa>(Isa::subtract16(a, b), same::subtract16(e, f)) +
           differing<Isa>(Isa::subtract_to_zero16(a, b), same::subtract_to_zero16(e, f)) +
           differing<Isa>(Isa::multiply_low16(a, b), same::multiply_low16(e, f)) +
           differing<Isa>(Isa::multiply_high16(a, b), same::multiply_high16(e, f)) +
           differing<Isa>(Isa::template shift_left16<8>(a), same::template shift_left16<8>(e)) + differing<Isa>(a8, e8) +
           differing<Isa>(Isa::template shift_right16<7>(a), same::template shift_right16<7>(e)) +
           differing<Isa>(Isa::greater16(a, b), same::greater16(e, f)) +
           differing<Isa>(Isa::upper_where_greater16(c, a, b), same::upper_where_greater16(g, e, f)) +
           (Isa::any_equal16(a, b, c, d) != same::any_equal16(e, f, g, h)) +
           differing<Isa>(Isa::narrow16(a8, b8), same::narrow16(e8, f8));
}

/// The same for whole numbers of 32 bits.
template <typename Isa> int wrong_longs(const memory* m) {
    using same = gnomon::emulated<Isa::bytes>;
    const auto a = Isa::load(m[0].byte), b = Isa::load(m[1].byte);
    const auto e = same::load(m[0].byte), f = same::load(m[1].byte);
    float converted[16], expected[16];
    Isa::store(converted, Isa::numbers(a));
    same::store(expected, same::numbers(e));
    return differing<Isa>(Isa::both(a, b), same::both(e, f)) + differing<Isa>(Isa::add32(a, b), same::add32(e, f)) +
           differing<Isa>(Isa::subtract32(a, b), same::subtract32(e, f)) +
           differing<Isa>(Isa::multiply32(a, b), same::multiply32(e, f)) +
           differing<Isa>(Isa::lesser32(a, b), same::lesser32(e, f)) + differing<Isa>(Isa::greater32(a, b), same::greater32(e, f)) +
           differing<Isa>(Isa::template shift_left32<5>(a), same::template shift_left32<5>(e)) +
           differing<Isa>(Isa::template shift_right32<9>(a), same::template shift_right32<9>(e)) +
           (std::memcmp(converted, expected, static_cast<std::size_t>(Isa::bytes)) != 0);
}

/// Two floats of which neither is a number, or both are the same one.
inline bool same_or_none(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)); }
template <typename Isa>
bool same_or_none_each(const typename Isa::floats& mine, const typename gnomon::emulated<Isa::bytes>::floats& theirs) {
    float a[16], b[16];
    Isa::store(a, mine);
    gnomon::emulated<Isa::bytes>::store(b, theirs);
    for (int i = 0; i < Isa::float_lanes; ++i)
        if (!same_or_none(a[i], b[i])) return false;
    return true;
}

/// The same for arithmetic and comparisons of floats, any of which may be none: what is left of a NaN may be any NaN.
template <typename Isa> int wrong_floats(const float* number) {
    using same = gnomon::emulated<Isa::bytes>;
    constexpr auto width = static_cast<std::size_t>(Isa::bytes);
    const auto equal = same_or_none_each<Isa>;
    const auto a = Isa::load(number), b = Isa::load(number + 16), c = Isa::load(number + 32), one = Isa::repeat(1.0f);
    const auto e = same::load(number), f = same::load(number + 16), g = same::load(number + 32), unit = same::repeat(1.0f);
    // All greater but for a few now and then, or one.
    float more[16];
    for (int i = 0; i < 16; ++i) more[i] = number[32 + i] + (number[i] > 1e4f ? 0.0f : 1e7f);
    const auto d = Isa::load(more);
    const auto h = same::load(more);
    float stored[16];
    Isa::store(stored, a);
    return (std::memcmp(stored, number, width) != 0) + !equal(a, e) + !equal(Isa::repeat(number[3]), same::repeat(number[3])) +
           !equal(Isa::add(a, b), same::add(e, f)) + !equal(Isa::subtract(a, b), same::subtract(e, f)) +
           !equal(Isa::multiply(a, b), same::multiply(e, f)) + !equal(Isa::divide(a, b), same::divide(e, f)) +
           !equal(Isa::add_product(a, b, c), same::add_product(e, f, g)) +
           !equal(Isa::keep(Isa::greater(a, b), one), same::keep(same::greater(e, f), unit)) +
           !equal(Isa::keep(Isa::not_greater(a, b), one), same::keep(same::not_greater(e, f), unit)) +
           !equal(Isa::drop(Isa::greater(a, b), one), same::drop(same::greater(e, f), unit)) +
           !equal(Isa::keep(Isa::both(Isa::greater(a, b), Isa::greater(a, c)), one),
                  same::keep(same::both(same::greater(e, f), same::greater(e, g)), unit)) +
           !equal(Isa::keep(Isa::positive(a, b, c), one), same::keep(same::positive(e, f, g), unit)) +
           !equal(Isa::multiply(a, b), same::multiply(e, f)) + !equal(Isa::lesser(a, b), same::lesser(e, f)) +
           differing<Isa>(Isa::floor32(a), same::floor32(e)) + (Isa::any(Isa::greater(a, b)) != same::any(same::greater(e, f))) +
           (Isa::every(Isa::greater(a, b)) != same::every(same::greater(e, f))) +
           (Isa::every(Isa::greater(d, c)) != same::every(same::greater(h, g))) +
           (Isa::any(Isa::not_greater(d, c)) != same::any(same::not_greater(h, g)));
}

/// sum + a b, where the product is exact; and whole codes stored from numbers with a fraction, and nothing beyond them.
template <typename Isa> int wrong_whole(const float* number) {
    using same = gnomon::emulated<Isa::bytes>;
    const auto a = Isa::load(number), b = Isa::load(number + 16), c = Isa::load(number + 32), d = Isa::load(number + 48);
    const auto e = same::load(number), f = same::load(number + 16), g = same::load(number + 32), h = same::load(number + 48);
    float sum[16], expected[16];
    Isa::store(sum, Isa::add_product(c, a, b));
    same::store(expected, same::add_product(g, e, f));
    std::uint8_t bytes[17]{}, expected_bytes[17]{};
    std::uint16_t words[17]{}, expected_words[17]{};
    Isa::template store_codes<gnomon::unorm8>(bytes, c);
    same::template store_codes<gnomon::unorm8>(expected_bytes, g);
    Isa::template store_codes<gnomon::unorm16>(words, d);
    same::template store_codes<gnomon::unorm16>(expected_words, h);
    return (std::memcmp(sum, expected, static_cast<std::size_t>(Isa::bytes)) != 0) +
           (std::memcmp(bytes, expected_bytes, sizeof bytes) != 0) + (std::memcmp(words, expected_words, sizeof words) != 0);
}

/// `float_lanes` whole numbers from `first` on over 255 times a power of two.
template <typename Isa> int wrong_blends(int first) {
    float number[16], quotient[16];
    for (int i = 0; i < Isa::float_lanes; ++i) number[i] = static_cast<float>(first + i);
    Isa::store(quotient, Isa::fraction(Isa::load(number), 255.0f * 65536.0f));
    int n = 0;
    for (int i = 0; i < Isa::float_lanes; ++i) n += !gnomon::same(quotient[i], number[i] / (255.0f * 65536.0f));
    return n;
}

/// Each channel of texels of one to four, as it is, and whole codes as a share of their scale; NaN may be any NaN.
template <typename Isa, typename Channel> int wrong_channels(const typename Channel::storage* stored) {
    using same = gnomon::emulated<Isa::bytes>;
    int n = 0;
    const auto ask = [&]<int Channels>(std::integral_constant<int, Channels>) {
        for (int c = 0; c < Channels; ++c) {
            const auto mine = Isa::template codes_of<Channel, Channels>(stored, c);
            const auto theirs = same::template codes_of<Channel, Channels>(stored, c);
            n += !same_or_none_each<Isa>(mine, theirs);
            if constexpr (Channel::whole_codes)
                n += !same_or_none_each<Isa>(Isa::fraction(mine, Channel::scale), same::fraction(theirs, Channel::scale));
        }
    };
    ask(std::integral_constant<int, 1>{});
    ask(std::integral_constant<int, 2>{});
    ask(std::integral_constant<int, 3>{});
    ask(std::integral_constant<int, 4>{});
    return n;
}

/// The same for arithmetic on doubles, all of which are numbers.
template <typename Isa> int wrong_doubles(const double* number) {
    using same = gnomon::emulated<Isa::bytes>;
    const auto a = Isa::load(number), b = Isa::load(number + 8);
    const auto e = same::load(number), f = same::load(number + 8);
    double stored[8];
    Isa::store(stored, a);
    return differing<Isa>(a, e) + (std::memcmp(stored, number, static_cast<std::size_t>(Isa::bytes)) != 0) +
           differing<Isa>(Isa::repeat(number[3]), same::repeat(number[3])) + differing<Isa>(Isa::add(a, b), same::add(e, f)) +
           differing<Isa>(Isa::multiply(a, b), same::multiply(e, f)) + differing<Isa>(Isa::divide(a, b), same::divide(e, f)) +
           differing<Isa>(Isa::multiply_pairs(a, number[9]), same::multiply_pairs(e, number[9])) +
           differing<Isa>(Isa::add_and_mask(a, 1 << 16, ~std::uint64_t{0x1FFFF}),
                          same::add_and_mask(e, 1 << 16, ~std::uint64_t{0x1FFFF}));
}

/// The same for comparisons of doubles, any of which may be none; and truncation, of those that fit 32 bits.
template <typename Isa> int wrong_comparisons(const double* number, const double* fitting) {
    using same = gnomon::emulated<Isa::bytes>;
    const auto equal = [](const typename Isa::doubles& mine, const typename same::doubles& theirs) {
        double a[8], b[8];
        Isa::store(a, mine);
        same::store(b, theirs);
        for (int i = 0; i < Isa::double_lanes; ++i)
            if (std::memcmp(&a[i], &b[i], sizeof(double)) != 0 && !(std::isnan(a[i]) && std::isnan(b[i]))) return false;
        return true;
    };
    const auto a = Isa::load(number), b = Isa::load(number + 8);
    const auto e = same::load(number), f = same::load(number + 8);
    auto kept = a;
    Isa::settle(kept);
    float stored[9]{}, expected[9]{};
    const auto rounded = Isa::store_floats(stored, a);
    const auto nearest = same::store_floats(expected, e);
    int n = !equal(rounded, nearest) + !equal(kept, e);
    for (int i = 0; i < 9; ++i) n += std::memcmp(&stored[i], &expected[i], sizeof(float)) != 0 && !std::isnan(expected[i]);
    return n + !equal(Isa::subtract(a, b), same::subtract(e, f)) + !equal(Isa::smaller(a, b), same::smaller(e, f)) +
           !equal(Isa::larger(a, b), same::larger(e, f)) + (Isa::greater_bits(a, b) != same::greater_bits(e, f)) +
           !equal(Isa::keep_greater(a, b, b), same::keep_greater(e, f, f)) +
           !equal(Isa::drop_greater(a, b, b), same::drop_greater(e, f, f)) +
           !equal(Isa::truncate(Isa::load(fitting)), same::truncate(same::load(fitting)));
}

/// Casts onto pairs in the middle of memory, where it must stay, and onto `all_asked`, which ends behind the last pair that is asked.
template <typename Isa, gnomon::channel Channel>
int wrong_casts(const typename Channel::storage* pairs, unsigned where, const double* codes, typename Channel::storage* all_asked) {
    using same = gnomon::emulated<Isa::bytes>;
    typename Channel::storage mine[32], theirs[32];
    std::memcpy(mine, pairs, sizeof mine);
    std::memcpy(theirs, pairs, sizeof theirs);
    Isa::template cast_pairs<Channel>(mine + 6, where, Isa::load(codes));
    same::template cast_pairs<Channel>(theirs + 6, where, same::load(codes));
    Isa::template cast_pairs<Channel>(all_asked, where, Isa::load(codes)); // sanitizers see what it touches behind
    return std::memcmp(mine, theirs, sizeof mine) != 0;
}

/// sum + a b, where the product is exact.
template <typename Isa> int wrong_products(const double* sums, const double* whole) {
    using same = gnomon::emulated<Isa::bytes>;
    return differing<Isa>(Isa::add_product(Isa::load(sums), Isa::load(whole), Isa::load(whole + 8)),
                          same::add_product(same::load(sums), same::load(whole), same::load(whole + 8)));
}

/// The same in floats, and on both sides of each number.
template <typename Isa, gnomon::channel Channel>
int wrong_codes_in_floats(const typename Channel::storage* stored, const double* number) {
    using same = gnomon::emulated<Isa::bytes>;
    using storage = typename Channel::storage;
    storage codes[16], written[17]{}, expected[17]{};
    float mine[16], theirs[16];
    for (int i = 0; i < 16; ++i) codes[i] = stored[i % Isa::double_lanes];
    Isa::store(mine, Isa::template codes_of<Channel, 1>(codes, 0));
    same::store(theirs, same::template codes_of<Channel, 1>(codes, 0));
    int n = 0;
    for (int i = 0; i < Isa::float_lanes; ++i) n += !same_or_none(mine[i], theirs[i]);
    for (const int beyond : {-1, 0, 1}) {
        for (int i = 0; i < 16; ++i) {
            const auto f = static_cast<float>(number[i % Isa::double_lanes]);
            mine[i] = beyond == 0 ? f : std::nextafter(f, beyond < 0 ? -INFINITY : INFINITY);
        }
        Isa::template store_codes<Channel>(written, Isa::load(mine));
        same::template store_codes<Channel>(expected, same::load(mine));
        for (int i = 0; i < 17; ++i) n += !same_or_none(Channel::code(written[i]), Channel::code(expected[i]));
    }
    return n;
}

/// Reads codes from storage and stores numbers as codes; NaN may be any NaN.
template <typename Isa, gnomon::channel Channel> int wrong_codes(const typename Channel::storage* stored, const double* number) {
    using same = gnomon::emulated<Isa::bytes>;
    using storage = typename Channel::storage;
    double mine[8], theirs[8];
    Isa::store(mine, Isa::template codes<Channel>(stored));
    same::store(theirs, same::template codes<Channel>(stored));
    storage written[9]{}, expected[9]{};
    Isa::template store_codes<Channel>(written, Isa::load(number));
    same::template store_codes<Channel>(expected, same::load(number));
    int n = std::memcmp(&written[Isa::double_lanes], &expected[Isa::double_lanes], sizeof(storage)) != 0; // nothing more is written
    for (int i = 0; i < Isa::double_lanes; ++i) {
        n += std::memcmp(&mine[i], &theirs[i], sizeof(double)) != 0 && !(std::isnan(mine[i]) && std::isnan(theirs[i]));
        const float a = Channel::code(written[i]), b = Channel::code(expected[i]);
        n += std::memcmp(&written[i], &expected[i], sizeof(storage)) != 0 && !(std::isnan(a) && std::isnan(b));
    }
    if constexpr (!Channel::whole_codes) n += wrong_codes_in_floats<Isa, Channel>(stored, number);
    return n;
}

template <typename Isa>
inline constexpr checks_of all{Isa::float_lanes,
                               Isa::double_lanes,
                               wrong_ints<Isa>,
                               wrong_words<Isa>,
                               wrong_longs<Isa>,
                               wrong_doubles<Isa>,
                               wrong_products<Isa>,
                               wrong_floats<Isa>,
                               wrong_whole<Isa>,
                               wrong_blends<Isa>,
                               wrong_channels<Isa, gnomon::unorm8>,
                               wrong_channels<Isa, gnomon::unorm16>,
                               wrong_channels<Isa, gnomon::half16>,
                               wrong_channels<Isa, gnomon::float32>,
                               wrong_codes<Isa, gnomon::unorm8>,
                               wrong_codes<Isa, gnomon::unorm16>,
                               wrong_codes<Isa, gnomon::half16>,
                               wrong_codes<Isa, gnomon::float32>,
                               wrong_comparisons<Isa>,
                               wrong_casts<Isa, gnomon::unorm8>,
                               wrong_casts<Isa, gnomon::unorm16>};

} // namespace CHECKS_ON
