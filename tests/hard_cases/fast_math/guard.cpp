// h28_compiler_canaries, its other half: the guard in a program of its own under -ffast-math, which promises nothing and is held to
// one thing. Whatever finite pair a map holds, and whatever finite depth, an intensity stays in [0, 1]. Prints what did not.
#include <gnomon/receive/decide.hpp>

#include <cstdio>

namespace {

int outside = 0;

template <typename Texel> void look_at(double e, double m) {
    using channel_type = typename Texel::channel_type;
    const Texel texel{{channel_type::store(e), channel_type::store(m)}};
    for (const gnomon::bias b : {gnomon::towards_light, gnomon::unbiased, gnomon::towards_shadow})
        for (int i = -4; i <= 8; ++i) {
            const float z = 0.25f * static_cast<float>(i), intensity = gnomon::shadow(texel, z, {.caster = b});
            if (intensity >= 0.0f && intensity <= 1.0f) continue;
            if (outside++ == 0)
                std::printf("e %g m %g z %g gives %g\n", e, m, static_cast<double>(z), static_cast<double>(intensity));
        }
}

} // namespace

int main() {
    for (int e = 0; e < 256; ++e)
        for (int m = 0; m < 256; ++m) {
            look_at<gnomon::rg8>(e, m);
            for (const double scale : {0x1p-140, 0x1p-24, 0x1p-7, 1.0}) { // from nothing to far beyond 1, of either sign
                look_at<gnomon::rg32f>(e * scale, (m - 128) * scale);
                look_at<gnomon::rg16f>(e * scale, (m - 128) * scale);
            }
        }
    return outside == 0 ? 0 : 1;
}
