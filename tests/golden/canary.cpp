// What the compiler at hand does with these flags that would change numbers, were the library not written to stand it. Says so in one
// line of words; never fails.
#include <cstdio>

namespace {

// Pairs, as shared/design/numerics.md has them in section 8: from -O2 on g++ 12 takes two roundings side by side for none at all.
__attribute__((noinline)) void round_a_pair(double* __restrict out, const double* __restrict in) {
    out[0] = static_cast<double>(static_cast<float>(in[0]));
    out[1] = static_cast<double>(static_cast<float>(in[1]));
}

// (1 + 2^-30)^2 - (1 + 2^-29) is 2^-60 if the product is not rounded, and 0 if it is.
__attribute__((noinline)) double multiply_and_add(double a, double b) { return a * a + b; }

} // namespace

int main() {
    const volatile double pair[2] = {0.1, 0.2}, near_one = 1.0 + 0x1p-30, minus = -(1.0 + 0x1p-29);
    const double in[2] = {pair[0], pair[1]};
    double out[2];
    round_a_pair(out, in);
    const bool dropped = out[0] >= in[0] && out[0] <= in[0], fused = multiply_and_add(near_one, minus) > 0.0;
    std::printf("%s, %s\n", dropped ? "DROPS the rounding of a pair" : "rounds pairs",
                fused ? "FUSES multiply-adds" : "fuses nothing");
}
