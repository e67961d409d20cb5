// The judge of texture units before the bench: units made up here, good, coarse and wrong, so that none is needed that is real.
#include "../support/filtering.hpp"
#include "../support/formats.hpp"
#include "../support/sub_texel.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace {
using gnomon::image;
using test::verdict;

/// A texture unit with weights of so many bits, which takes positions so many texels off, and adds something to what it answers.
struct made_up_unit {
    int bits;
    double shifted = 0.0, added = 0.0;
    bool nearest = false;

    template <typename Texel> double operator()(const image<Texel>& map, double x, double y, int channel) const {
        const auto cut = [&](double v) {
            if (nearest) return std::floor(v) + 0.5;
            return std::round((v - 0.5 + shifted) * std::ldexp(1.0, bits)) * std::ldexp(1.0, -bits) + 0.5;
        };
        const auto value = [channel](const gnomon::filtered<Texel>& t) { return t.code[channel] / gnomon::filtered<Texel>::scale; };
        return test::detail::blended<Texel>(map.view(), cut(x), cut(y), value) + added;
    }
};

struct verdicts {
    int count[3] = {0, 0, 0};
    verdict worst = verdict::pass;
    void note(verdict v) {
        ++count[static_cast<int>(v)];
        worst = test::worse(worst, v);
    }
};

/// Judges a unit at positions all over a map and beyond its edges.
template <typename Texel> verdicts tried(const made_up_unit& unit, double value_error) {
    test::dice roll(511);
    const auto map = test::dense<gnomon::binomial<2>>(test::noise<Texel>(roll, {20, 15}, 4));
    verdicts found;
    for (int i = 0; i < 4000; ++i) {
        const double x = 24.0 * static_cast<double>(roll.unit()) - 2.0, y = 19.0 * static_cast<double>(roll.unit()) - 2.0;
        for (int c = 0; c < Texel::channels; ++c)
            found.note(test::judge<Texel>(map.view(), x, y, c, unit(map, x, y, c), value_error));
    }
    return found;
}
} // namespace

TEST_CASE_TEMPLATE("the judge of texture units passes weights of eight bits and more, warns of four, and fails fewer", Texel,
                   gnomon::rg8, gnomon::rgba16, gnomon::rg32f) {
    for (const int bits : {8, 9, 12, 20}) CHECK(tried<Texel>({bits}, 1e-12).worst == verdict::pass);
    for (const int bits : {4, 5, 6}) {
        const verdicts coarse = tried<Texel>({bits}, 1e-12);
        CHECK(coarse.worst == verdict::warn);
        CHECK(coarse.count[0] > 0);
    }
    for (const int bits : {1, 2}) CHECK(tried<Texel>({bits}, 1e-12).worst == verdict::fail);
    CHECK(tried<Texel>({.bits = 8, .nearest = true}, 1e-12).worst == verdict::fail);
}

TEST_CASE("the judge of texture units passes a result that is off by as much as is allowed, and fails one that is off by more") {
    CHECK(tried<gnomon::rg8>({.bits = 20, .added = 0.5 / 255}, 0.5 / 255 + 1e-12).worst == verdict::pass);
    CHECK(tried<gnomon::rg8>({.bits = 20, .added = 0.02}, 0.5 / 255).count[2] > 0);
    CHECK(tried<gnomon::rg8>({.bits = 20, .added = -0.02}, 0.5 / 255).count[2] > 0);
}

TEST_CASE("the judge of texture units passes a shift below 1/256 texel, warns below 1/16, and fails a texel's") {
    CHECK(tried<gnomon::rg16>({.bits = 30, .shifted = 0.9 / 256}, 1e-12).worst == verdict::pass);
    CHECK(tried<gnomon::rg16>({.bits = 30, .shifted = -0.9 / 256}, 1e-12).worst == verdict::pass);
    CHECK(tried<gnomon::rg16>({.bits = 30, .shifted = 1.5 / 256}, 1e-12).worst == verdict::warn);
    CHECK(tried<gnomon::rg16>({.bits = 30, .shifted = 0.9 / 16}, 1e-12).worst == verdict::warn);
    CHECK(tried<gnomon::rg16>({.bits = 30, .shifted = 1.0}, 1e-12).worst == verdict::fail);
}

TEST_CASE("the judge of texture units lets a decision be either only where the weights leave it open") {
    image<gnomon::rg16> map({4, 1}, gnomon::rg16::clear());
    map(1, 0) = gnomon::rg16::caster(0.25f);
    map(2, 0) = gnomon::rg16::caster(0.75f);
    const auto judged = [&](double x, float z, bool shadowed) {
        return test::judge_decision<gnomon::rg16>(map.view(), x, 0.5, z, shadowed, 1e-9);
    };
    // Between the two the mean depth goes from 1/4 to 3/4, by 1/2 in a texel: at x = 2 it is 1/2.
    CHECK(judged(2.0, 0.5f + 0.9f / 512, false) == verdict::pass);
    CHECK(judged(2.0, 0.5f + 0.9f / 512, true) == verdict::pass);
    CHECK(judged(2.0, 0.5f + 1.5f / 512, false) == verdict::warn);
    CHECK(judged(2.0, 0.5f - 1.5f / 512, true) == verdict::warn);
    CHECK(judged(2.0, 0.5f + 0.9f / 32, false) == verdict::warn);
    CHECK(judged(2.0, 0.5f + 1.1f / 32, false) == verdict::fail);
    CHECK(judged(2.0, 0.5f - 1.1f / 32, true) == verdict::fail);
    CHECK(judged(2.0, 0.5f + 1.1f / 32, true) == verdict::pass);
    CHECK(test::judge_decision<gnomon::rg16>(map.view(), 0.1, 0.5, 0.9f, true, 0.0) == verdict::fail); // nothing is there
}
