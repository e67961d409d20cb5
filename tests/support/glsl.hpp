// GLSL as C++: a shader's text, included into a namespace, is functions that tests call, so the very text is tested without a GPU.
//
//     #include "../support/glsl.hpp"
//     #include "../support/glsl_begin.inl"
//     namespace shader {
//     using namespace test::glsl;
//     #include "golden/caster_rg8.glsl"
//     }
//     #include "../support/glsl_end.inl"
//
// Enough of the language for gnomon's texts. A literal like 0.5 is a double in C++: so `float` is a class here, to which it is rounded
// before anything is computed with it.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <type_traits>

namespace test::glsl {

/// A bool as a driver may have it, which writes !(a > b) as a <= b: so of a NaN neither a comparison nor its contrary holds.
struct truth {
    constexpr truth(bool v = false) : truth(v, !v) {}
    constexpr truth(bool holds_, bool contrary_) : holds(holds_), contrary(contrary_) {}
    constexpr operator bool() const { return holds; }
    friend constexpr truth operator!(truth t) { return {t.contrary, t.holds}; }
    template <typename A, typename B>
        requires(std::is_same_v<A, truth> || std::is_same_v<B, truth>)
    friend constexpr truth operator&&(A a, B b) {
        return {truth(a).holds && truth(b).holds, truth(a).contrary || truth(b).contrary};
    }
    template <typename A, typename B>
        requires(std::is_same_v<A, truth> || std::is_same_v<B, truth>)
    friend constexpr truth operator||(A a, B b) {
        return {truth(a).holds || truth(b).holds, truth(a).contrary && truth(b).contrary};
    }

    bool holds, contrary;
};

/// A float whose every operation is rounded to one.
struct real {
    constexpr real() = default;
    constexpr real(float v) : value(v) {}
    constexpr real(double v) : value(static_cast<float>(v)) {}
    constexpr explicit real(std::uint32_t v) : value(static_cast<float>(v)) {}
    constexpr explicit real(int v) : value(static_cast<float>(v)) {}
    constexpr explicit operator std::uint32_t() const { return static_cast<std::uint32_t>(value); }
    constexpr explicit operator int() const { // GPUs take the nearest int, and 0 for a NaN
        return value >= 0x1p31f ? 0x7FFFFFFF : value >= -0x1p31f ? static_cast<int>(value) : value < 0.0f ? -0x7FFFFFFF - 1 : 0;
    }
    friend constexpr real operator-(real a) { return -a.value; }
    friend constexpr real operator+(real a, real b) { return a.value + b.value; }
    friend constexpr real operator-(real a, real b) { return a.value - b.value; }
    friend constexpr real operator*(real a, real b) { return a.value * b.value; }
    friend constexpr real operator/(real a, real b) { return a.value / b.value; }
    friend constexpr truth operator<(real a, real b) { return {a.value < b.value, a.value >= b.value}; }
    friend constexpr truth operator>(real a, real b) { return b < a; }
    friend constexpr truth operator<=(real a, real b) { return !(b < a); }
    friend constexpr truth operator>=(real a, real b) { return b <= a; }
    friend constexpr truth operator==(real a, real b) { return a <= b && a >= b; }

    float value = 0.0f;
};

using uint = std::uint32_t;

template <typename T, int N> struct components;
template <typename T> struct components<T, 2> {
    T x{}, y{};
};
template <typename T> struct components<T, 3> {
    T x{}, y{}, z{};
};
template <typename T> struct components<T, 4> {
    T x{}, y{}, z{}, w{};
};

/// vec2 to vec4, and those of int and uint. All operations go component by component.
template <typename T, int N> struct vec : components<T, N> {
    vec() = default;
    explicit vec(T all) {
        for (int i = 0; i < N; ++i) (*this)[i] = all;
    }
    template <typename U>
        requires(!std::is_same_v<T, U> && std::is_constructible_v<T, U>)
    explicit vec(U all) : vec(static_cast<T>(all)) {}
    template <typename... U>
        requires(sizeof...(U) == N)
    explicit vec(U... each) {
        int i = 0;
        (((*this)[i++] = static_cast<T>(each)), ...);
    }
    /// The first of longer ones, or others converted.
    template <typename U, int M>
        requires(M >= N)
    explicit vec(const vec<U, M>& other) {
        for (int i = 0; i < N; ++i) (*this)[i] = static_cast<T>(other[i]);
    }

    vec(const vec<T, 2>& first, T third, T fourth)
        requires(N == 4)
        : vec(first.x, first.y, third, fourth) {}

    T& operator[](int i) {
        if constexpr (N == 4)
            if (i == 3) return this->w;
        if constexpr (N >= 3)
            if (i == 2) return this->z;
        return i == 0 ? this->x : this->y;
    }
    const T& operator[](int i) const { return const_cast<vec&>(*this)[i]; }

    template <typename F> static vec each(const vec& a, const vec& b, F&& f) {
        vec made;
        for (int i = 0; i < N; ++i) made[i] = f(a[i], b[i]);
        return made;
    }
    friend vec operator-(const vec& a) { return vec(T{}) - a; }
    friend vec operator+(const vec& a, const vec& b) {
        return each(a, b, [](T p, T q) { return p + q; });
    }
    friend vec operator-(const vec& a, const vec& b) {
        return each(a, b, [](T p, T q) { return p - q; });
    }
    friend vec operator*(const vec& a, const vec& b) {
        return each(a, b, [](T p, T q) { return p * q; });
    }
    friend vec operator/(const vec& a, const vec& b) {
        return each(a, b, [](T p, T q) { return p / q; });
    }
    friend vec operator+(const vec& a, T b) { return a + vec(b); }
    friend vec operator-(const vec& a, T b) { return a - vec(b); }
    friend vec operator-(T a, const vec& b) { return vec(a) - b; }
    friend vec operator*(const vec& a, T b) { return a * vec(b); }
    friend vec operator*(T a, const vec& b) { return vec(a) * b; }
    friend vec operator/(const vec& a, T b) { return a / vec(b); }
    friend vec operator&(const vec& a, T b) {
        return each(a, vec(b), [](T p, T q) { return p & q; });
    }
    friend vec operator>>(const vec& a, int b) {
        return each(a, a, [b](T p, T) { return p >> b; });
    }
    vec& operator+=(const vec& b) { return *this = *this + b; }
};
using vec2 = vec<real, 2>;
using vec3 = vec<real, 3>;
using vec4 = vec<real, 4>;
using uvec2 = vec<uint, 2>;
using uvec3 = vec<uint, 3>;
using uvec4 = vec<uint, 4>;
using ivec2 = vec<int, 2>;
using ivec4 = vec<int, 4>;

struct mat4 {
    std::array<vec4, 4> columns{};
    friend vec4 operator*(const mat4& m, const vec4& v) {
        return m.columns[0] * v.x + m.columns[1] * v.y + m.columns[2] * v.z + m.columns[3] * v.w;
    }
};

inline uint floatBitsToUint(real v) { return std::bit_cast<uint>(v.value); }
inline real uintBitsToFloat(uint bits) { return std::bit_cast<float>(bits); }
template <int N> vec<uint, N> floatBitsToUint(const vec<real, N>& v) {
    vec<uint, N> bits;
    for (int i = 0; i < N; ++i) bits[i] = floatBitsToUint(v[i]);
    return bits;
}
template <int N> vec<real, N> uintBitsToFloat(const vec<uint, N>& bits) {
    vec<real, N> v;
    for (int i = 0; i < N; ++i) v[i] = uintBitsToFloat(bits[i]);
    return v;
}
/// For numbers below 2^31, which are all that shaders ask for; larger ones are whole already.
inline real floor(real v) {
    if (!(v.value > -0x1p31f && v.value < 0x1p31f)) return v;
    const auto cut = static_cast<float>(static_cast<int>(v.value));
    return cut > v.value ? cut - 1.0f : cut;
}
template <int N> vec<real, N> floor(const vec<real, N>& v) {
    vec<real, N> made;
    for (int i = 0; i < N; ++i) made[i] = floor(v[i]);
    return made;
}
inline real abs(real v) { return v < real(0.0f) ? -v : v; }
inline uint max(uint a, uint b) { return a < b ? b : a; }
inline uint min(uint a, uint b) { return b < a ? b : a; }
inline int max(int a, int b) { return a < b ? b : a; }
inline real max(real a, real b) { return a < b ? b : a; }

/// A texture is what is read from it.
template <typename T> struct sampler {
    ivec2 size{};
    std::function<vec<T, 4>(ivec2)> read{};
};
using sampler2D = sampler<real>;
using usampler2D = sampler<uint>;
template <typename T> ivec2 textureSize(const sampler<T>& texture, int) { return texture.size; }
/// What lies off a texture is undefined: here that is a failure, which the caller of the text sees in `fetched_off_the_map`.
inline int fetched_off_the_map = 0;
template <typename T> vec<T, 4> texelFetch(const sampler<T>& texture, ivec2 at, int) {
    if (at.x >= 0 && at.y >= 0 && at.x < texture.size.x && at.y < texture.size.y) return texture.read(at);
    ++fetched_off_the_map;
    return {};
}

inline vec4 gl_FragCoord, gl_Position;
inline real gl_FragDepth;
inline int gl_VertexID;

} // namespace test::glsl
