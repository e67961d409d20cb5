// expect: max_error
#include <gnomon/texel/texel.hpp>

struct mine { // all that a channel needs
    using storage = std::uint8_t;
    static constexpr bool whole_codes = true;
    static constexpr float scale = 255.0f;
#if !GNOMON_EXPECT_FAILURE
    static constexpr float max_error = gnomon::unorm8::max_error;
#endif
    static constexpr gnomon::rounding_error rounding = gnomon::unorm8::rounding;
    static constexpr storage encode(double v) noexcept { return gnomon::unorm8::encode(v); }
    static constexpr storage store(double v) noexcept { return gnomon::unorm8::store(v); }
    static constexpr float code(storage s) noexcept { return gnomon::unorm8::code(s); }
    static constexpr float decode(storage s) noexcept { return gnomon::unorm8::decode(s); }
};

gnomon::texel<mine> made;
