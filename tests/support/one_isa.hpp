// Which sets of lanes a test is compiled for: all, or the one that mutation asks first, because it is sooner compiled.
#pragma once

#include <concepts>

namespace test {

#if defined(GNOMON_TEST_ONE_ISA)
template <typename Isa> inline constexpr bool is_asked = std::same_as<Isa, GNOMON_TEST_ONE_ISA>;
#else
template <typename> inline constexpr bool is_asked = true;
#endif

} // namespace test
