// What a suite that runs over all backends has to know of one.
#pragma once

#include <gnomon/backend/simd.hpp>
#include <gnomon/soft_shadow_map.hpp>

namespace test {

/// The kernel that `scalar` takes to give the bits of a backend: the same. Where a backend has no double, another: see gl/backends.hpp.
template <typename Backend, gnomon::texel_format Texel, gnomon::kernel Kernel> struct filters_as {
    using kernel = Kernel;
};
template <typename Backend, typename Texel, typename Kernel>
using filters_as_kernel = typename filters_as<Backend, Texel, Kernel>::kernel;

/// A map whose casters an engine may write on the host.
template <typename Map>
concept has_casters_on_the_host = requires(Map& map) { map.casters()(0, 0); };

} // namespace test
